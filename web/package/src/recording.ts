// What was done to a world, kept with the step of each input: replayed it gives the same world, to the bit.
import { core, type Id } from "./core.js";
import { layout } from "./generated/layout.js";
import { World } from "./world.js";

/** Takes every call that changes a world, with the number of steps before it. `bytes()` keeps it, `Recording.fromBytes()`
 *  brings it back, `start()` and `replay()` do it again. `dispose()` when it is done with: until then its world is recorded. */
export class Recording {
  private readonly id: Id;
  private alive = true;

  /** That it takes from, or took; null for one from bytes. */
  readonly world: World | null;

  /** Takes the world as it is, and what is done to it from now on. Refused: a second one of the same world. */
  constructor(world: World);
  /** @internal */
  constructor(world: null, read: Id);
  constructor(world: World | null, read?: Id) {
    this.world = world;
    this.id = read ?? Recording.begin(world as World);
  }
  private static begin(world: World): Id {
    const c = core();
    const out = c.take(layout.Recording.size);
    c.call("elastoonRecordingBegin", c.putId(world.id), out);
    return c.id(out);
  }

  /** From what `bytes()` gave, here or in another program. Refused, as "bad data": bytes that are damaged. */
  static fromBytes(bytes: Uint8Array): Recording {
    const c = core();
    return c.withBytes(bytes, (at, size) => {
      const out = c.take(layout.Recording.size);
      c.call("elastoonRecordingRead", at, size, out);
      return new Recording(null, c.id(out));
    });
  }

  /** All of it, with the shapes. */
  bytes(): Uint8Array {
    const c = core();
    let out = c.take(4);
    c.call("elastoonRecordingBytes", c.putId(this.id), 0, 0, out);
    const size = c.u32(out);
    const at = c.allocate(size);
    try {
      out = c.take(4);
      c.call("elastoonRecordingBytes", c.putId(this.id), at, size, out);
      return c.u8.slice(at, at + size);
    } finally {
      c.free(at);
    }
  }

  private info(): number {
    const c = core();
    const out = c.take(layout.RecordingInfo.size);
    c.call("elastoonRecordingInfo", c.putId(this.id), out);
    return out;
  }
  /** Steps that were taken. */
  get steps(): number {
    return core().u32(this.info() + layout.RecordingInfo.step_count);
  }
  /** Calls that changed the world, steps not counted. */
  get inputs(): number {
    return core().u32(this.info() + layout.RecordingInfo.input_count);
  }
  /** Whether it takes what is done to its world: false for one from bytes, and when the world is gone. */
  get isLive(): boolean {
    const at = this.info() + layout.RecordingInfo.is_live;
    return core().u8[at] !== 0;
  }

  /** Makes the world, a new one if none is given, the one that the recording began with: then `replay()` it. The bodies and
   *  obstacles have the indices that they had. Refused: a world that is being recorded. */
  start(world?: World): World {
    const c = core();
    const started = world ?? new World();
    try {
      started.stepping();
      c.call("elastoonRecordingStart", c.putId(this.id), c.putId(started.id));
      started.adopt();
    } catch (error) {
      if (world === undefined) started.dispose();
      throw error;
    }
    return started;
  }
  /** Takes a world that is where the recorded one was before step `from` through its inputs and steps, up to step `to`, which is
   *  not made, nor its inputs. Inputs after the last step are made if `to` is beyond it, as it is by default. Refused: a world
   *  that is being recorded, and at the first input that the world does not take as the recorded one did; it stays where it
   *  came to. */
  replay(world: World, from = 0, to = Infinity): void {
    const steps = this.steps;
    // What comes after the last step may remove what its events are about: the world is to know it before.
    if (from < steps) this.replayTo(world, from, Math.min(to, steps));
    if (to > steps) this.replayTo(world, Math.max(from, steps), steps + 1);
  }
  private replayTo(world: World, from: number, to: number): void {
    const c = core();
    if (from < this.steps) world.stepping();
    else world.changed();
    try {
      c.call("elastoonRecordingReplay", c.putId(this.id), c.putId(world.id), from, to);
    } finally {
      world.adopt();
    }
  }

  /** Takes the world that is being recorded back to a snapshot from before step `step` and its inputs, and forgets what was
   *  recorded since: for an input that comes late. Refused as `world.restore()`, with all as it was. */
  rewind(step: number, snapshot: Uint8Array): void {
    const c = core();
    this.world?.changed();
    c.withBytes(snapshot, (at, size) => c.call("elastoonRecordingRewind", c.putId(this.id), step, at, size));
    this.world?.adopt();
  }

  /** Gives its memory back, and lets go of the world. */
  dispose(): void {
    if (!this.alive) return;
    this.alive = false;
    const c = core();
    c.call("elastoonRecordingDestroy", c.putId(this.id));
  }
}
