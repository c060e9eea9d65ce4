// Obstacles, planes and solids that do not give way, and the description that one is made from.
import { core, type Core, type Id, type Rotation, type Vector } from "./core.js";
import { layout } from "./generated/layout.js";
import { Shape } from "./shape.js";
import type { World } from "./world.js";

/** A place on an obstacle's path. */
export interface PathKey {
  /** s after the obstacle was added; ascending, > 0. */
  time: number;
  position: Vector;
  rotation?: Rotation;
}

/** Describes an obstacle: `ObstacleDesc.plane({ x: 0, y: 1, z: 0 })`, `ObstacleDesc.box(2, 1, 2).setTranslation(0, 1, 0)`. */
export class ObstacleDesc {
  /** Null: a plane. */
  shape: Shape | null;
  normal: Vector = { x: 0, y: 1, z: 0 };
  translation: Vector = { x: 0, y: 0, z: 0 };
  rotation: Rotation = { x: 0, y: 0, z: 0, w: 1 };
  linvel: Vector = { x: 0, y: 0, z: 0 };
  /** rad/s, world axes. */
  angvel: Vector = { x: 0, y: 0, z: 0 };
  path: PathKey[] = [];
  pathRepeats = false;
  name = "";
  /** Yours; not read. */
  userData: unknown = undefined;

  constructor(shape: Shape | null) {
    this.shape = shape;
  }
  /** The half space below the plane { x : x . normal = offset }. */
  static plane(normal: Readonly<Vector> = { x: 0, y: 1, z: 0 }, offset = 0): ObstacleDesc {
    const desc = new ObstacleDesc(null);
    const square = normal.x ** 2 + normal.y ** 2 + normal.z ** 2;
    const along = square > 0 ? offset / square : 0;
    desc.normal = { ...normal };
    return desc.setTranslation(normal.x * along, normal.y * along, normal.z * along);
  }
  static box(x: number, y: number, z: number): ObstacleDesc {
    return new ObstacleDesc(Shape.box(x, y, z));
  }
  static ball(radius: number): ObstacleDesc {
    return new ObstacleDesc(Shape.ball(radius));
  }
  static convexHull(points: ArrayLike<number>): ObstacleDesc {
    return new ObstacleDesc(Shape.hull(points));
  }

  setTranslation(x: number, y: number, z: number): this {
    this.translation = { x, y, z };
    return this;
  }
  setRotation(rotation: Rotation): this {
    this.rotation = { ...rotation };
    return this;
  }
  setLinvel(x: number, y: number, z: number): this {
    this.linvel = { x, y, z };
    return this;
  }
  setAngvel(x: number, y: number, z: number): this {
    this.angvel = { x, y, z };
    return this;
  }
  /** It goes from key to key; `repeats`: at the last it jumps back to where it was added. */
  setPath(path: PathKey[], repeats = false): this {
    this.path = path;
    this.pathRepeats = repeats;
    return this;
  }
  setName(name: string): this {
    this.name = name;
    return this;
  }
  setUserData(data: unknown): this {
    this.userData = data;
    return this;
  }
}

/** @internal Fills the definition's room and gives it to `work`. */
export function withObstacleDef<T>(c: Core, desc: ObstacleDesc, work: (at: number) => T): T {
  const f = layout.ObstacleDef;
  const size = layout.PathKey.size;
  return c.withBytes(new Uint8Array(desc.path.length * size), (path) => {
    desc.path.forEach((key, i) => {
      c.setF64(path + i * size, key.time);
      c.setVector(path + i * size + layout.PathKey.position, key.position);
      c.setRotation(path + i * size + layout.PathKey.rotation, key.rotation ?? { x: 0, y: 0, z: 0, w: 1 });
    });
    const at = c.definition;
    c.plain("elastoonDefaultObstacleDef", at);
    if (desc.shape !== null) c.setId(at + f.shape, desc.shape.id);
    c.setVector(at + f.normal, desc.normal);
    c.setVector(at + f.position, desc.translation);
    c.setRotation(at + f.rotation, desc.rotation);
    c.setVector(at + f.velocity, desc.linvel);
    c.setVector(at + f.angular_velocity, desc.angvel);
    c.setU32(at + f.path, desc.path.length > 0 ? path : 0);
    c.setU32(at + f.path_count, desc.path.length);
    c.u8[at + f.path_repeats] = desc.pathRepeats ? 1 : 0;
    return work(at);
  });
}

/** Where an obstacle is and how it moves. */
export interface Frame {
  position: Vector;
  rotation: Rotation;
  linvel: Vector;
  angvel: Vector;
}

/** @internal */
export function readFrame(c: Core, at: number): Frame {
  return {
    position: c.vector(at),
    rotation: c.rotation(at + layout.ObstacleFrame.rotation),
    linvel: c.vector(at + layout.ObstacleFrame.velocity),
    angvel: c.vector(at + layout.ObstacleFrame.angular_velocity),
  };
}

/** An obstacle of a world. Calls on one that was removed throw, with the code "bad id". */
export class Obstacle {
  readonly world: World;
  /** Null: a plane. */
  readonly shape: Shape | null;
  name: string;
  /** As its description gave it; undefined where a scene, a snapshot or a recording brought it. */
  userData: unknown;
  /** sRGB, 0 to 1, of an obstacle that a scene brought. */
  color: Readonly<Vector> | undefined;
  /** @internal */
  readonly id: Id;

  /** @internal */
  constructor(world: World, id: Id, shape: Shape | null, name = "", userData?: unknown) {
    this.world = world;
    this.id = id;
    this.shape = shape;
    this.name = name;
    this.userData = userData;
  }
  isValid(): boolean {
    const c = core();
    return c.plain("elastoonObstacleIsValid", c.putId(this.id, this.world.id)) !== 0;
  }
  private change(name: string, ...values: number[]): void {
    const c = core();
    this.world.changed();
    c.call(name, c.putId(this.id, this.world.id), ...values);
  }

  frame(): Frame {
    const c = core();
    const out = c.take(layout.ObstacleFrame.size);
    c.call("elastoonObstacleFrame", c.putId(this.id, this.world.id), out);
    return readFrame(c, out);
  }
  /** Of a plane, unit, in its frame. */
  planeNormal(): Vector {
    const c = core();
    const out = c.take(layout.Vec3.size);
    c.call("elastoonObstaclePlaneNormal", c.putId(this.id, this.world.id), out);
    return c.vector(out);
  }
  /** It goes on from where it is with these velocities; bodies on it go along. */
  setMotion(linvel: Readonly<Vector>, angvel: Readonly<Vector> = { x: 0, y: 0, z: 0 }): void {
    this.change("elastoonObstacleSetMotion", core().putVector(linvel), core().putVector(angvel));
  }
  /** It is there from now on and stands still. */
  setPose(position: Readonly<Vector>, rotation: Readonly<Rotation> = { x: 0, y: 0, z: 0, w: 1 }): void {
    this.change("elastoonObstacleSetPose", core().putVector(position), core().putRotation(rotation));
  }
  /** It goes there within `duration` s and stops. */
  moveTo(position: Readonly<Vector>, duration: number, rotation: Readonly<Rotation> = { x: 0, y: 0, z: 0, w: 1 }): void {
    this.change("elastoonObstacleMove", core().putVector(position), core().putRotation(rotation), duration);
  }
}
