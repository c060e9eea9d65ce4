// What happened in a step, typed.
import type { Body } from "./body.js";
import type { Core, Vector } from "./core.js";
import { layout } from "./generated/layout.js";
import type { Obstacle } from "./obstacle.js";
import type { World } from "./world.js";

interface EventBase {
  /** World time, s. */
  readonly time: number;
  readonly body: Body;
  /** What it was against; null where there is no such thing any more. */
  readonly other: Obstacle | null;
  /** Contact, world. */
  readonly point: Readonly<Vector>;
  /** Unit, towards the body. */
  readonly normal: Readonly<Vector>;
}

/** A touch began an impact. */
export interface ImpactEvent extends EventBase {
  readonly type: "impact";
  /** Relative to the surface, before it, m/s. */
  readonly speed: number;
  /** Stretch at the touch, at the deepest squash, and at the end. */
  readonly stretchIn: number;
  readonly stretchMid: number;
  readonly stretchOut: number;
  /** Duration of the squash and of the stretch half, s. */
  readonly timeIn: number;
  readonly timeOut: number;
}

/** An impact ended and the body flies. */
export interface ReleaseEvent extends EventBase {
  readonly type: "release";
  /** Relative to the surface, after it, m/s. */
  readonly speed: number;
}

/** rest: an impact ended and the body is still. wake: it flies again. squeeze: it has no room left. */
export interface StateEvent extends EventBase {
  readonly type: "rest" | "wake" | "squeeze";
}

export type ElastoonEvent = ImpactEvent | ReleaseEvent | StateEvent;
const types = ["impact", "release", "rest", "wake", "squeeze"] as const;

/** @internal */
export function readEvent(c: Core, world: World, at: number): ElastoonEvent {
  const f = layout.Event;
  const type = types[c.u32(at + f.type)] ?? "impact";
  const base: EventBase = {
    time: c.f64(at + f.time),
    body: world.bodyOf(c.id(at + f.body)),
    other: world.obstacleOf(c.id(at + f.other)),
    point: c.vector(at + f.point),
    normal: c.vector(at + f.normal),
  };
  if (type === "impact") {
    return {
      ...base,
      type,
      speed: c.f64(at + f.speed),
      stretchIn: c.f64(at + f.s_in),
      stretchMid: c.f64(at + f.s_mid),
      stretchOut: c.f64(at + f.s_out),
      timeIn: c.f64(at + f.t_in),
      timeOut: c.f64(at + f.t_out),
    };
  }
  return type === "release" ? { ...base, type, speed: c.f64(at + f.speed) } : { ...base, type };
}
