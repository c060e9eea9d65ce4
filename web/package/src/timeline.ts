// All that a world's bodies did, for any time, forwards and back: what a time line scrubs through.
import { type Body, type Pose, readPose } from "./body.js";
import { core, type Id, type Vector } from "./core.js";
import { type ElastoonEvent, readEvent } from "./event.js";
import { layout } from "./generated/layout.js";
import type { World } from "./world.js";

/** Poses are exact at any time, not only at steps: motion is kept as its closed-form phases.
 *  `capture()` after each `world.step()`; `dispose()` when it is done with. */
export class Timeline {
  private readonly id: Id;
  private room = { at: 0, slots: 0 };
  private alive = true;

  /** Takes what is in the world now. */
  constructor(readonly world: World) {
    const c = core();
    const out = c.take(layout.Timeline.size);
    c.call("elastoonTimelineBegin", c.putId(world.id), out);
    this.id = c.id(out);
  }

  /** Takes what the last step did. */
  capture(): void {
    const c = core();
    c.call("elastoonTimelineCapture", c.putId(this.id));
  }
  /** Forgets what came after that many captures: for a world that was restored to that step and goes another way. */
  cut(captures: number): void {
    const c = core();
    c.call("elastoonTimelineCut", c.putId(this.id), captures);
  }

  private info(): number {
    const c = core();
    const out = c.take(layout.TimelineInfo.size);
    c.call("elastoonTimelineInfo", c.putId(this.id), out);
    return out;
  }
  /** World time of the last capture, s. */
  get end(): number {
    return core().f64(this.info() + layout.TimelineInfo.end);
  }
  get captures(): number {
    return core().u32(this.info() + layout.TimelineInfo.capture_count);
  }

  /** As `world.matrices`, at that time; zeros for bodies that came later. A view, good until the next call. */
  matricesAt(time: number): Float32Array {
    const c = core();
    let count = c.take(4);
    c.call("elastoonTimelineMatrices", c.putId(this.id), time, 0, 0, count);
    const slots = c.u32(count);
    if (slots > this.room.slots) {
      if (this.room.at !== 0) c.free(this.room.at);
      this.room = { at: c.allocate(48 * slots), slots };
    }
    count = c.take(4);
    if (slots > 0) c.call("elastoonTimelineMatrices", c.putId(this.id), time, this.room.at, this.room.slots, count);
    return new Float32Array(c.memory.buffer, this.room.at, 12 * slots);
  }

  /** The body's poses and velocities at the times. */
  motionOf(body: Body, times: ArrayLike<number>): { poses: Pose[]; velocities: Vector[] } {
    const c = core();
    const numbers = Float64Array.from(times);
    const out = c.allocate(Math.max(numbers.length * (layout.Pose.size + layout.Vec3.size), 1));
    const velocities = out + numbers.length * layout.Pose.size;
    try {
      return c.withBytes(new Uint8Array(numbers.buffer), (at) => {
        c.call("elastoonTimelinePoses", c.putId(this.id), c.putId(body.id, body.world.id), at, numbers.length, out,
          velocities);
        return {
          poses: Array.from(numbers, (_, i) => readPose(c, out + i * layout.Pose.size)),
          velocities: Array.from(numbers, (_, i) => c.vector(velocities + i * layout.Vec3.size)),
        };
      });
    } finally {
      c.free(out);
    }
  }

  /** All events from `first` on, by step. */
  events(first = 0): ElastoonEvent[] {
    const c = core();
    const out = c.take(8);
    c.call("elastoonTimelineEvents", c.putId(this.id), out, out + 4);
    const [at, count] = [c.u32(out), c.u32(out + 4)];
    return Array.from({ length: Math.max(count - first, 0) },
      (_, i) => readEvent(c, this.world, at + (first + i) * layout.Event.size));
  }

  /** Gives its memory back. */
  dispose(): void {
    if (!this.alive) return;
    this.alive = false;
    const c = core();
    c.call("elastoonTimelineDestroy", c.putId(this.id));
    if (this.room.at !== 0) c.free(this.room.at);
  }
}
