// Bodies, and the description that one is made from.
import { core, type Core, type Id, type Rotation, type Vector } from "./core.js";
import { type ElastoonEvent, readEvent } from "./event.js";
import { layout } from "./generated/layout.js";
import type { StyleParameters } from "./generated/styles.js";
import type { Obstacle } from "./obstacle.js";
import { Shape } from "./shape.js";
import { readStyle, type StyleLike, writeStyle } from "./style.js";
import type { World } from "./world.js";

/** x = position + R diag(s, 1/sqrt(s), 1/sqrt(s)) X for a point X of the shape. */
export interface Pose {
  /** Of the centroid, m. */
  position: Vector;
  /** Its x axis is the principal axis. */
  rotation: Rotation;
  /** s, the scale along the principal axis; the volume is kept. */
  stretch: number;
}

/** @internal */
export function readPose(c: Core, at: number): Pose {
  return {
    position: c.vector(at),
    rotation: c.rotation(at + layout.Pose.orientation),
    stretch: c.f64(at + layout.Pose.stretch),
  };
}

export type PhaseKind = "flight" | "impact" | "rest" | "slide";
const phaseKinds: readonly PhaseKind[] = ["flight", "impact", "rest", "slide"];

/** What a body does now. */
export interface Phase {
  kind: PhaseKind;
  /** World time, s. */
  start: number;
  /** Its own end, as far as it is known. */
  end: number;
  /** That an impact, rest or slide is against, or that a flight has just left. */
  obstacle: Obstacle | null;
}

/** Describes a body: `BodyDesc.ball(0.5).setTranslation(0, 5, 0).setStyle("jelly")`. May be used again and again. */
export class BodyDesc {
  shape: Shape;
  style: StyleLike = {};
  translation: Vector = { x: 0, y: 0, z: 0 };
  linvel: Vector = { x: 0, y: 0, z: 0 };
  rotation: Rotation = { x: 0, y: 0, z: 0, w: 1 };
  name = "";
  /** Yours; not read. */
  userData: unknown = undefined;

  constructor(shape: Shape) {
    this.shape = shape;
  }
  static ball(radius: number): BodyDesc {
    return new BodyDesc(Shape.ball(radius));
  }
  /** With full edge lengths. */
  static box(x: number, y: number, z: number): BodyDesc {
    return new BodyDesc(Shape.box(x, y, z));
  }
  static cylinder(radius: number, length: number): BodyDesc {
    return new BodyDesc(Shape.cylinder(radius, length));
  }
  static cone(radius: number, length: number): BodyDesc {
    return new BodyDesc(Shape.cone(radius, length));
  }
  static capsule(radius: number, length: number): BodyDesc {
    return new BodyDesc(Shape.capsule(radius, length));
  }
  static convexHull(points: ArrayLike<number>): BodyDesc {
    return new BodyDesc(Shape.hull(points));
  }

  setStyle(style: StyleLike): this {
    this.style = style;
    return this;
  }
  /** Of the centroid, m. */
  setTranslation(x: number, y: number, z: number): this {
    this.translation = { x, y, z };
    return this;
  }
  /** Velocity, m/s. */
  setLinvel(x: number, y: number, z: number): this {
    this.linvel = { x, y, z };
    return this;
  }
  /** Only the roll about the heading is kept: bodies are turned to where they go. */
  setRotation(rotation: Rotation): this {
    this.rotation = { ...rotation };
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

/** @internal Fills the definition's room. */
export function writeBodyDef(c: Core, desc: BodyDesc): number {
  const at = c.definition;
  c.plain("elastoonDefaultBodyDef", at);
  writeStyle(c, at + layout.BodyDef.style, desc.style);
  c.setId(at + layout.BodyDef.shape, desc.shape.id);
  c.setVector(at + layout.BodyDef.position, desc.translation);
  c.setVector(at + layout.BodyDef.velocity, desc.linvel);
  c.setRotation(at + layout.BodyDef.rotation, desc.rotation);
  return at;
}

/** A body of a world. Calls on one that was removed throw, with the code "bad id". */
export class Body {
  readonly world: World;
  name: string;
  /** As its description gave it; undefined where a scene, a snapshot or a recording brought it. */
  userData: unknown;
  /** sRGB, 0 to 1, of a body that a scene brought. */
  color: Readonly<Vector> | undefined;
  /** @internal */
  readonly id: Id;

  private ownShape: Shape | undefined;

  /** @internal Without a shape: that is asked for when it is needed, of a body that may be gone. */
  constructor(world: World, id: Id, shape?: Shape, name = "", userData?: unknown) {
    this.world = world;
    this.id = id;
    this.ownShape = shape;
    this.name = name;
    this.userData = userData;
  }

  get shape(): Shape {
    return (this.ownShape ??= this.world.shapeOf("elastoonBodyShape", this.id));
  }
  /** Its place in `world.matrices`: as long as it lives. */
  get index(): number {
    return this.id.slot - 1;
  }
  isValid(): boolean {
    const c = core();
    return c.plain("elastoonBodyIsValid", c.putId(this.id, this.world.id)) !== 0;
  }
  private ask(name: string, size: number): number {
    const c = core();
    const out = c.take(size);
    c.call(name, c.putId(this.id, this.world.id), out);
    return out;
  }
  private change(name: string, argument: number): void {
    const c = core();
    this.world.changed();
    c.call(name, c.putId(this.id, this.world.id), argument);
  }

  pose(): Pose {
    return readPose(core(), this.ask("elastoonBodyPose", layout.Pose.size));
  }
  translation(): Vector {
    return this.pose().position;
  }
  rotation(): Rotation {
    return this.pose().rotation;
  }
  linvel(): Vector {
    return core().vector(this.ask("elastoonBodyVelocity", layout.Vec3.size));
  }
  phase(): Phase {
    const c = core();
    const at = this.ask("elastoonBodyPhase", layout.PhaseInfo.size);
    const kind = phaseKinds[c.u32(at)] ?? "flight";
    const start = c.f64(at + layout.PhaseInfo.start);
    const end = c.f64(at + layout.PhaseInfo.end);
    const obstacle = this.world.obstacleOf(c.id(at + layout.PhaseInfo.obstacle));
    return { kind, start, end, obstacle };
  }
  style(): StyleParameters {
    return readStyle(core(), this.ask("elastoonBodyStyle", layout.Style.size));
  }

  /** Puts it there and lets it fly on with its velocity. Refused inside an obstacle. */
  setTranslation(position: Readonly<Vector>): void {
    this.change("elastoonBodySetPosition", core().putVector(position));
  }
  /** It flies with this velocity from now on. */
  setLinvel(velocity: Readonly<Vector>): void {
    this.change("elastoonBodySetVelocity", core().putVector(velocity));
  }
  /** The impact that it is in ends with this velocity. Refused in no impact, and where that does not part from the surface. */
  steerImpact(velocity: Readonly<Vector>): void {
    this.change("elastoonBodySteerImpact", core().putVector(velocity));
  }
  /** Holds from the next phase on; a flight takes it over at once. */
  setStyle(style: StyleLike): void {
    const c = core();
    writeStyle(c, c.definition, style);
    this.change("elastoonBodySetStyle", c.definition);
  }

  /** Its poses that many seconds from now, as far as nothing is changed meanwhile. */
  predictPoses(delays: ArrayLike<number>): Pose[] {
    const c = core();
    const numbers = Float64Array.from(delays);
    const out = c.allocate(Math.max(numbers.length * layout.Pose.size, 1));
    try {
      return c.withBytes(new Uint8Array(numbers.buffer), (at) => {
        c.call("elastoonBodyPredictPoses", c.putId(this.id, this.world.id), at, numbers.length, out);
        return Array.from(numbers, (_, i) => readPose(c, out + i * layout.Pose.size));
      });
    } finally {
      c.free(out);
    }
  }
  /** What will happen to it within `horizon` s, likewise. */
  predictEvents(horizon: number): ElastoonEvent[] {
    const c = core();
    let capacity = 0;
    for (;;) {
      const out = c.allocate(Math.max(capacity, 1) * layout.Event.size);
      try {
        const count_at = c.take(4);
        const array = capacity === 0 ? 0 : out;
        c.call("elastoonBodyPredictEvents", c.putId(this.id, this.world.id), horizon, array, capacity, count_at);
        const count = c.u32(count_at);
        if (count <= capacity) {
          return Array.from({ length: count }, (_, i) => readEvent(c, this.world, out + i * layout.Event.size));
        }
        capacity = count;
      } finally {
        c.free(out);
      }
    }
  }
}
