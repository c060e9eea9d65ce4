// Plays a take: steps its world, keeps all that happened, and goes to any step again, to the bit.
import {
  type Body,
  BodyDesc,
  type ElastoonEvent,
  Scene,
  type Shape,
  Timeline,
  type Vector,
  type World,
} from "elastoon";
import { arrivalsScene, kStepsPerSecond, type SceneFile, type Take, type TakeInput, type Triple } from "./take.js";

/** Steps between two snapshots. */
const kSnapshotEvery = 30;
/** Bytes of all snapshots; beyond, every second one goes. */
const kMostSnapshotBytes = 96_000_000;

export interface PlayedBody {
  readonly body: Body;
  readonly name: string;
  /** sRGB. */
  readonly color: number;
  /** Of the step before which it comes in. */
  readonly since: number;
}

const vectorOf = ([x, y, z]: Triple): Vector => ({ x, y, z });
const hexOf = (color: Readonly<Vector> | undefined): number => {
  const byte = (share: number) => Math.round(255 * Math.min(Math.max(share, 0), 1));
  return color === undefined ? 0xe4572e : (byte(color.x) << 16) | (byte(color.y) << 8) | byte(color.z);
};

/** Dressed bodies for those that come in later: what the scene's reader made of them. */
function dressed(take: Take): Map<string, { desc: BodyDesc; color: number }> {
  const made = new Map<string, { desc: BodyDesc; color: number }>();
  if (!take.inputs.some((input) => input.kind === "arrival")) return made;
  const scene = Scene.parse(arrivalsScene(take));
  const world = scene.stage();
  for (const body of world.bodies()) {
    const velocity = body.linvel();
    const position = body.translation();
    const desc = new BodyDesc(body.shape)
      .setStyle(body.style())
      .setName(body.name)
      .setTranslation(position.x, position.y, position.z)
      .setLinvel(velocity.x, velocity.y, velocity.z);
    made.set(body.name, { desc, color: hexOf(body.color) });
  }
  world.dispose();
  scene.dispose();
  return made;
}

export class Player {
  readonly scene: Scene;
  readonly world: World;
  readonly bodies: PlayedBody[] = [];
  /** What inputs were refused for: a body that would come in inside an obstacle. */
  readonly refused: string[] = [];
  private readonly timeline: Timeline;
  private readonly snapshots = new Map<number, Uint8Array>();
  private readonly names = new Map<string, Body>();
  private present: Take;
  private arrivals: Map<string, { desc: BodyDesc; color: number }>;
  private snapshotEvery = kSnapshotEvery;
  private snapshotBytes = 0;
  /** Steps that the world has made. */
  private at = 0;
  private known: ElastoonEvent[] = [];
  private knownAt = -1;

  /** Throws what the reader refuses. */
  constructor(taken: Take) {
    this.present = taken;
    const { take } = this;
    this.scene = Scene.parse(take.scene);
    this.world = this.scene.stage();
    this.arrivals = dressed(take);
    for (const body of this.world.bodies()) {
      this.bodies.push({ body, name: body.name, color: hexOf(body.color), since: 0 });
      this.names.set(body.name, body);
    }
    this.timeline = new Timeline(this.world);
    this.keepSnapshot();
  }

  get take(): Take {
    return this.present;
  }
  /** Steps that are known: any time up to there can be shown. */
  get recorded(): number {
    return this.timeline.captures;
  }
  get recordedTime(): number {
    return this.timeline.end;
  }
  /** Steps that the world has made. */
  get step(): number {
    return this.at;
  }

  /** One step more than is known. */
  private advance(): void {
    this.applyInputs();
    // As the command line steps: to the times of a grid, which do not drift.
    this.world.step(Math.max((this.at + 1) / kStepsPerSecond - this.world.time, 0));
    this.at += 1;
    if (this.at > this.recorded) {
      this.timeline.capture();
      if (this.at % this.snapshotEvery === 0) this.keepSnapshot();
    }
  }

  private applyInputs(): void {
    for (const input of this.take.inputs) {
      if (input.step !== this.at) continue;
      try {
        this.apply(input);
      } catch (error) {
        const told = `${input.kind} at ${(input.step / kStepsPerSecond).toFixed(2)} s: ${(error as Error).message}`;
        if (!this.refused.includes(told)) this.refused.push(told);
      }
    }
  }

  private apply(input: TakeInput): void {
    if (input.kind === "throw") {
      const body = this.names.get(input.body);
      if (body === undefined) return;
      body.setTranslation(vectorOf(input.position));
      body.setLinvel(vectorOf(input.velocity));
      return;
    }
    const { desc, color } = this.arrivals.get(input.body.name)!;
    const body = this.world.createBody(desc);
    this.names.set(body.name, body);
    if (!this.bodies.some(({ name }) => name === body.name)) {
      this.bodies.push({ body, name: body.name, color, since: input.step });
    }
  }

  private keepSnapshot(): void {
    const bytes = this.world.snapshot();
    this.snapshots.set(this.at, bytes);
    this.snapshotBytes += bytes.length;
    if (this.snapshotBytes <= kMostSnapshotBytes) return;
    this.snapshotEvery *= 2;
    for (const [step, kept] of this.snapshots) {
      if (step % this.snapshotEvery === 0) continue;
      this.snapshots.delete(step);
      this.snapshotBytes -= kept.length;
    }
  }

  /** Makes the motion known up to a step, for at most `budget` ms. True where it is. */
  ensure(step: number, budget = Infinity): boolean {
    if (this.recorded >= step) return true;
    this.goTo(this.recorded);
    const began = performance.now();
    while (this.recorded < step) {
      this.advance();
      if (performance.now() - began > budget) break;
    }
    return this.recorded >= step;
  }

  /** Takes the world to the step: back by the last snapshot before it, then the same steps again. */
  goTo(step: number): void {
    if (step < this.at || (step > this.at && this.nearestSnapshot(step) > this.at)) {
      const from = this.nearestSnapshot(step);
      this.world.restore(this.snapshots.get(from)!);
      this.at = from;
      this.names.clear();
      for (const { body, name } of this.bodies) if (this.world.has(body)) this.names.set(name, body);
    }
    while (this.at < step) this.advance();
  }

  private nearestSnapshot(step: number): number {
    let nearest = 0;
    for (const at of this.snapshots.keys()) if (at <= step && at > nearest) nearest = at;
    return nearest;
  }

  /** Of the state that is reached by playing, or by scrubbing, to this step. */
  hashAt(step: number): string {
    this.goTo(step);
    return this.world.stateHash();
  }

  /** 12 numbers for each body by its index, exact at any known time. Good until the next call. */
  matricesAt(time: number): Float32Array {
    // The world's own are quicker for many: at once, without looking phases up.
    if (Math.abs(this.world.time - time) < 1e-9 && this.at === this.recorded) return this.world.matrices;
    return this.timeline.matricesAt(time);
  }
  motionOf(body: Body, times: ArrayLike<number>): ReturnType<Timeline["motionOf"]> {
    return this.timeline.motionOf(body, times);
  }
  /** All that are known. */
  events(): readonly ElastoonEvent[] {
    if (this.knownAt !== this.recorded) {
      this.goTo(this.recorded);
      this.known = this.known.concat(this.timeline.events(this.known.length));
      this.knownAt = this.recorded;
    }
    return this.known;
  }
  bodyNamed(name: string | null): PlayedBody | undefined {
    return this.bodies.find((played) => played.name === name);
  }
  get shapes(): Set<Shape> {
    return new Set(this.bodies.map(({ body }) => body.shape));
  }

  /** Step up to which what is known holds for that take too; infinity where it is the same motion. */
  sharesUpTo(take: Take): number {
    const moves: (keyof SceneFile)[] = ["gravity", "shapes", "styles", "bodies", "obstacles"];
    if (moves.some((key) => take.scene[key] !== this.take.scene[key])) return 0;
    const differs = take.inputs.findIndex((input, i) => input !== this.take.inputs[i]);
    if (differs === -1) {
      return take.inputs.length === this.take.inputs.length ? Infinity : this.take.inputs[take.inputs.length]!.step;
    }
    return Math.min(take.inputs[differs]!.step, this.take.inputs[differs]?.step ?? Infinity);
  }

  /** Goes on as that take: keeps what is known up to `sharesUpTo`, and forgets the rest. */
  goOnAs(take: Take): void {
    const shared = Math.min(this.sharesUpTo(take), this.recorded);
    this.arrivals = dressed(take);
    this.goTo(shared);
    this.present = take;
    this.timeline.cut(shared);
    for (const [step, bytes] of this.snapshots) {
      if (step <= shared) continue;
      this.snapshots.delete(step);
      this.snapshotBytes -= bytes.length;
    }
    const here = this.bodies.filter(({ since }) => since < shared || since === 0);
    this.bodies.splice(0, this.bodies.length, ...here);
    this.known = this.timeline.events();
    this.knownAt = shared;
    this.refused.length = 0;
  }

  dispose(): void {
    this.timeline.dispose();
    this.world.dispose();
    this.scene.dispose();
    this.snapshots.clear();
  }
}
