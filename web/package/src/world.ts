// The world: bodies, obstacles, the step, and what a frame needs of it.
import { Body, type BodyDesc, writeBodyDef } from "./body.js";
import { core, type Id, type Vector } from "./core.js";
import { type ElastoonEvent, readEvent } from "./event.js";
import { layout } from "./generated/layout.js";
import { Obstacle, type ObstacleDesc, withObstacleDef } from "./obstacle.js";
import { Shape } from "./shape.js";

/** Bodies do not meet each other; obstacles do not give way. */
export class World {
  /** @internal */
  readonly id: Id;
  private readonly bodiesBySlot: (Body | undefined)[] = [];
  private readonly obstaclesBySlot: (Obstacle | undefined)[] = [];
  /** Bodies that are gone, but that the events of the last step may be about: first those that went before it. */
  private readonly removed: Body[] = [];
  private removedBefore = 0;
  private matrixView: Float32Array | undefined;
  private eventList: readonly ElastoonEvent[] | undefined;
  private alive = true;

  /** @param gravity m/s^2, default 0, -9.81, 0 */
  constructor(gravity: Readonly<Vector> = { x: 0, y: -9.81, z: 0 }, /** @internal */ staged?: Id) {
    if (staged !== undefined) {
      this.id = staged;
      return;
    }
    const c = core();
    const def = c.definition;
    c.plain("elastoonDefaultWorldDef", def);
    c.setVector(def, gravity);
    const out = c.take(layout.World.size);
    c.call("elastoonWorldCreate", def, out);
    this.id = c.id(out);
  }

  /** Moves the world on by dt s. */
  step(dt = 1 / 60): void {
    this.stepping();
    const c = core();
    c.call("elastoonWorldStep", c.putId(this.id), dt);
  }

  /** 12 floats for each slot of a body: the three columns of the linear part, then the position (x = M X + position). Body b's
   *  begin at 12 * b.index; those of a free slot are zero. A view without a copy, good until the next change of the world. */
  get matrices(): Float32Array {
    const c = core();
    if (this.matrixView === undefined || this.matrixView.buffer !== c.memory.buffer) {
      const out = c.take(8);
      c.call("elastoonWorldMatricesView", c.putId(this.id), out, out + 4);
      this.matrixView = new Float32Array(c.memory.buffer, c.u32(out), 12 * c.u32(out + 4));
    }
    return this.matrixView;
  }
  /** 9 floats for each slot, a copy: the columns of the inverse transpose, for normals. */
  normalMatrices(): Float32Array {
    const c = core();
    const count = this.matrices.length / 12;
    const at = c.allocate(Math.max(36 * count, 1));
    try {
      c.call("elastoonWorldNormalMatrices", c.putId(this.id), at, count, c.take(4));
      return new Float32Array(c.memory.buffer, at, 9 * count).slice();
    } finally {
      c.free(at);
    }
  }
  /** What happened in the last step, by time. */
  events(): readonly ElastoonEvent[] {
    if (this.eventList === undefined) {
      const c = core();
      const out = c.take(8);
      c.call("elastoonWorldEvents", c.putId(this.id), out, out + 4);
      const [at, length] = [c.u32(out), c.u32(out + 4)];
      this.eventList = Array.from({ length }, (_, i) => readEvent(c, this, at + i * layout.Event.size));
    }
    return this.eventList;
  }

  /** Throws "refused" where it would start inside an obstacle. */
  createBody(desc: BodyDesc): Body {
    const c = core();
    this.changed();
    const def = writeBodyDef(c, desc);
    const out = c.take(layout.Body.size);
    c.call("elastoonBodyCreate", c.putId(this.id), def, out);
    const body = new Body(this, c.id(out), desc.shape, desc.name, desc.userData);
    this.bodiesBySlot[body.index] = body;
    return body;
  }
  removeBody(body: Body): void {
    const c = core();
    this.changed();
    c.call("elastoonBodyDestroy", c.putId(body.id, this.id));
    delete this.bodiesBySlot[body.index];
    this.removed.push(body);
  }
  createObstacle(desc: ObstacleDesc): Obstacle {
    const c = core();
    this.changed();
    const id = withObstacleDef(c, desc, (def) => {
      const out = c.take(layout.Obstacle.size);
      c.call("elastoonObstacleCreate", c.putId(this.id), def, out);
      return c.id(out);
    });
    const obstacle = new Obstacle(this, id, desc.shape, desc.name, desc.userData);
    this.obstaclesBySlot[id.slot - 1] = obstacle;
    return obstacle;
  }
  /** Bodies that rest on it fly on. */
  removeObstacle(obstacle: Obstacle): void {
    const c = core();
    this.changed();
    c.call("elastoonObstacleDestroy", c.putId(obstacle.id, this.id));
    delete this.obstaclesBySlot[obstacle.id.slot - 1];
  }
  /** Whether the body is still in it; without a call into the module. */
  has(body: Body): boolean {
    return this.bodiesBySlot[body.index]?.id.generation === body.id.generation && body.world === this;
  }
  /** In the order of their slots. */
  bodies(): Body[] {
    return this.bodiesBySlot.filter((body) => body !== undefined);
  }
  obstacles(): Obstacle[] {
    return this.obstaclesBySlot.filter((obstacle) => obstacle !== undefined);
  }
  /** The body of this name, as a scene or its description gave it. */
  bodyNamed(name: string): Body | undefined {
    return this.bodiesBySlot.find((body) => body?.name === name);
  }
  obstacleNamed(name: string): Obstacle | undefined {
    return this.obstaclesBySlot.find((obstacle) => obstacle?.name === name);
  }

  /** Seconds since it was made. */
  get time(): number {
    const c = core();
    const out = c.take(8);
    c.call("elastoonWorldTime", c.putId(this.id), out);
    return c.f64(out);
  }
  get gravity(): Vector {
    const c = core();
    const out = c.take(layout.Vec3.size);
    c.call("elastoonWorldGravity", c.putId(this.id), out);
    return c.vector(out);
  }
  /** Flights go on under the new gravity. */
  set gravity(gravity: Readonly<Vector>) {
    const c = core();
    this.changed();
    c.call("elastoonWorldSetGravity", c.putId(this.id), c.putVector(gravity));
  }
  /** 16 hex digits: equal worlds have equal hashes, in every browser and in native programs. */
  stateHash(): string {
    const c = core();
    const out = c.take(8);
    c.call("elastoonWorldStateHash", c.putId(this.id), out);
    return c.data.getBigUint64(out, true).toString(16).padStart(16, "0");
  }

  /** All that later steps read. With its shapes, for another program or another day; else shorter. */
  snapshot(includeShapes = false): Uint8Array {
    const c = core();
    const ask = (at: number, capacity: number): number => {
      const out = c.take(4);
      c.call("elastoonWorldSnapshot", c.putId(this.id), includeShapes ? 1 : 0, at, capacity, out);
      return c.u32(out);
    };
    const size = ask(0, 0);
    const at = c.allocate(size);
    try {
      return c.u8.slice(at, at + ask(at, size));
    } finally {
      c.free(at);
    }
  }
  /** Makes this world the one of the snapshot. Refused, with the world as it was: bytes that are damaged; and a world
   *  that is being recorded (`Recording.rewind()` takes both back). */
  restore(bytes: Uint8Array): void {
    const c = core();
    this.changed();
    c.withBytes(bytes, (at, size) => c.call("elastoonWorldRestore", c.putId(this.id), at, size));
    this.adopt();
  }
  /** Gives its memory back. Nothing of it may be used any more. */
  dispose(): void {
    if (!this.alive) return;
    this.alive = false;
    this.changed();
    const c = core();
    c.call("elastoonWorldDestroy", c.putId(this.id));
    this.bodiesBySlot.length = this.obstaclesBySlot.length = 0;
  }

  /** @internal To be called before any change. */
  changed(): void {
    this.matrixView = undefined;
    this.eventList = undefined;
  }
  /** @internal Likewise before what makes other events. */
  stepping(): void {
    this.changed();
    this.removed.splice(0, this.removedBefore);
    this.removedBefore = this.removed.length;
  }
  /** @internal The body of an id of this world. */
  bodyOf(id: Id): Body {
    return this.knownBody(id) ?? new Body(this, id);
  }
  private knownBody(id: Id): Body | undefined {
    const known = this.bodiesBySlot[id.slot - 1];
    if (known?.id.generation === id.generation) return known;
    return this.removed.find((body) => body.id.slot === id.slot && body.id.generation === id.generation);
  }
  /** @internal */
  obstacleOf(id: Id): Obstacle | null {
    const known = this.obstaclesBySlot[id.slot - 1];
    return known?.id.generation === id.generation ? known : null;
  }
  /** @internal Makes objects for what is in the world and has none, and forgets those of what is not. */
  adopt(): void {
    const before = this.bodies();
    this.adoptInto(this.bodiesBySlot, "elastoonWorldBodies", (id) => {
      return this.knownBody(id) ?? new Body(this, id, this.shapeOf("elastoonBodyShape", id));
    });
    this.removed.push(...before.filter((body) => !this.has(body)));
    this.adoptInto(this.obstaclesBySlot, "elastoonWorldObstacles", (id) => {
      return this.obstacleOf(id) ?? new Obstacle(this, id, this.shapeOf("elastoonObstacleShape", id, true));
    });
  }
  private adoptInto<T>(into: (T | undefined)[], name: string, make: (id: Id) => T): void {
    const c = core();
    let out = c.take(4);
    c.call(name, c.putId(this.id), 0, 0, out);
    const count = c.u32(out);
    const at = c.allocate(Math.max(16 * count, 1));
    out = c.take(4);
    c.call(name, c.putId(this.id), at, count, out);
    const made: T[] = [];
    for (let i = 0; i < count; ++i) {
      const id = c.id(at + 16 * i);
      made[id.slot - 1] = make(id);
    }
    c.free(at);
    into.length = 0;
    made.forEach((thing, i) => (into[i] = thing));
  }
  /** @internal */
  shapeOf(name: string, id: Id): Shape;
  /** @internal */
  shapeOf(name: string, id: Id, maybe: true): Shape | null;
  shapeOf(name: string, id: Id, _maybe?: true): Shape | null {
    const c = core();
    const out = c.take(layout.Shape.size);
    c.call(name, c.putId(id, this.id), out);
    const shape = c.id(out);
    return shape.slot === 0 ? null : Shape.ofId(shape);
  }
}
