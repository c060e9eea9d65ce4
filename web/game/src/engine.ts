// The rules, as WebAssembly: a thin hand on apps/game/squashout.h.
import wasmUrl from "../../../build/wasm/squashout.wasm?url";
import levelsText from "../../../apps/game/levels.json?raw";

export const kStep = 1 / 120;

export const stages = ["ready", "playing", "cleared", "won", "lost"] as const;
export type StageName = (typeof stages)[number];

export const eventKinds = ["levelBegun", "launched", "wallHit", "paddleHit", "blockHit", "popped", "exploded",
  "ballLost",
  "lifeLost", "ballAdded", "widened", "narrowed", "lifeGained", "levelCleared", "gameWon", "gameLost",
    "nudged"] as const;
export type EventKind = (typeof eventKinds)[number];

export const blockKinds = ["plain", "tough", "jelly", "moving", "explosive", "ball", "wide", "heart", "stone"] as const;
export type BlockKind = (typeof blockKinds)[number];

export interface GameEvent {
  readonly kind: EventKind;
  readonly block: BlockKind;
  readonly id: number;
  readonly x: number;
  readonly y: number;
  readonly normalX: number;
  readonly normalY: number;
  /** m/s. */
  readonly speed: number;
  readonly value: number;
}

export interface State {
  readonly stage: StageName;
  readonly score: number;
  readonly lives: number;
  /** From 0. */
  readonly level: number;
  readonly combo: number;
  readonly balls: number;
  readonly blocksLeft: number;
  readonly steps: number;
  readonly paddleX: number;
  readonly paddleHalfWidth: number;
  readonly paddleVelocity: number;
  readonly wideLeft: number;
  readonly fastest: number;
  readonly gravity: boolean;
}

export interface Sizes {
  readonly halfWidth: number;
  readonly ceiling: number;
  readonly ballRadius: number;
  readonly blockWidth: number;
  readonly blockHeight: number;
  readonly blockDepth: number;
  readonly roundRadius: number;
}

/** What is drawn: 16 numbers each; see squashout.h. */
export const kDrawnFloats = 16;
export const drawnWhat = { block: 0, paddle: 1, ball: 2, waitingBall: 3 } as const;

export interface PlayInput {
  readonly launch: boolean;
  /** -1 left wall .. 1 right wall; undefined: `axis` counts. */
  readonly target?: number | undefined;
  /** -1 left .. 1 right. */
  readonly axis: number;
}

type Numbers = Record<string, (...args: number[]) => number>;

export class Engine {
  private constructor(private readonly wasm: Numbers, private readonly memory: WebAssembly.Memory,
    private readonly scratch: number) {}

  /** Loads the rules and the levels. Throws with what is wrong where they are. */
  static async load(): Promise<Engine> {
    const nothing = new Proxy({}, { get: () => () => 0 });
    const response = await fetch(wasmUrl);
    if (!response.ok) throw new Error(`the rules could not be loaded (${response.status})`);
    const { instance } = await WebAssembly.instantiate(await response.arrayBuffer(),
      { wasi_snapshot_preview1: nothing });
    const wasm = instance.exports as unknown as Numbers;
    wasm["_initialize"]?.();
    const engine = new Engine(wasm, instance.exports["memory"] as WebAssembly.Memory, wasm["malloc"]!(8));
    const wrong = engine.withText(levelsText, (at, length) => wasm["squashoutLoadLevels"]!(at, length));
    if (wrong !== 0) throw new Error(engine.text(wrong));
    return engine;
  }

  get levelNames(): string[] {
    return Array.from({ length: this.call("squashoutLevelCount") }, (_, i) => this.text(this.call("squashoutLevelName",
      i)));
  }
  get sizes(): Sizes {
    const n = new Float64Array(this.memory.buffer, this.call("squashoutSizes"), 7);
    return { halfWidth: n[0]!, ceiling: n[1]!, ballRadius: n[2]!, blockWidth: n[3]!, blockHeight: n[4]!,
      blockDepth: n[5]!,
      roundRadius: n[6]! };
  }

  /** A new game. `skill` is the bot's, should it play. */
  create(seed: number, gravity: boolean, level: number, skill = 1): Game {
    return new Game(this, this.call("squashoutCreate", seed, gravity ? 1 : 0, level, skill));
  }
  /** A game that was taken through a recorded play. Throws where its hash is another than the recorded one. */
  replay(text: string): Game {
    const game = this.withText(text, (at, length) => this.call("squashoutReplay", at, length));
    if (game === 0) throw new Error(this.text(this.call("squashoutError")));
    return new Game(this, game);
  }

  call(name: string, ...args: number[]): number {
    return this.wasm[name]!(...args);
  }
  text(at: number): string {
    const bytes = new Uint8Array(this.memory.buffer);
    return new TextDecoder().decode(bytes.subarray(at, bytes.indexOf(0, at)));
  }
  doubles(at: number, count: number): Float64Array {
    return new Float64Array(this.memory.buffer, at, count);
  }
  /** A list that a call gives with its length. */
  floats(size: number, call: (count: number) => number): Float32Array {
    const at = call(this.scratch);
    const count = new Uint32Array(this.memory.buffer, this.scratch, 1)[0]!;
    return new Float32Array(this.memory.buffer, at, count * size);
  }
  private withText<T>(text: string, use: (at: number, length: number) => T): T {
    const bytes = new TextEncoder().encode(text);
    const at = this.call("malloc", bytes.length + 1);
    new Uint8Array(this.memory.buffer, at, bytes.length).set(bytes);
    try {
      return use(at, bytes.length);
    } finally {
      this.call("free", at);
    }
  }
}

export class Game {
  constructor(private readonly engine: Engine, private readonly at: number) {
    if (at === 0) throw new Error("no game without levels");
  }

  step(input: PlayInput): void {
    const whole = (share: number, most: number) => Math.round(Math.min(Math.max(share, -1), 1) * most);
    const { target, axis, launch } = input;
    this.engine.call("squashoutStep", this.at, launch ? 1 : 0, target === undefined ? 0 : 1, whole(axis, 127),
      whole(target ?? 0, 32767));
  }
  stepBot(): void {
    this.engine.call("squashoutStepBot", this.at);
  }

  get state(): State {
    const n = this.engine.doubles(this.engine.call("squashoutNumbers", this.at), 16);
    return { stage: stages[n[0]!]!, score: n[1]!, lives: n[2]!, level: n[3]!, combo: n[4]!, balls: n[5]!,
      blocksLeft: n[6]!,
      steps: n[7]!, paddleX: n[8]!, paddleHalfWidth: n[9]!, paddleVelocity: n[10]!, wideLeft: n[11]!, fastest: n[12]!,
      gravity: n[13] === 1 };
  }
  /** Of the last step. */
  events(): GameEvent[] {
    const n = this.engine.floats(9, (count) => this.engine.call("squashoutEvents", this.at, count));
    return Array.from({ length: n.length / 9 }, (_, i) => {
      const [kind, block, id, x, y, normalX, normalY, speed, value] = n.subarray(9 * i, 9 * i + 9) as unknown as
        [number, number, number, number, number, number, number, number, number];
      return { kind: eventKinds[kind]!, block: blockKinds[block]!, id, x, y, normalX, normalY, speed, value };
    });
  }
  /** A view of memory: good until the next call. */
  drawn(share: number): Float32Array {
    return this.engine.floats(kDrawnFloats, (count) => this.engine.call("squashoutDrawn", this.at, share, count));
  }
  /** x and y of each point, about the foot's middle. */
  paddleOutline(halfWidth: number): Float32Array {
    return this.engine.floats(2, (count) => this.engine.call("squashoutPaddleOutline", this.at, halfWidth,
      count)).slice();
  }
  get hash(): string {
    return this.engine.text(this.engine.call("squashoutHash", this.at));
  }
  get recording(): string {
    return this.engine.text(this.engine.call("squashoutRecording", this.at));
  }
  destroy(): void {
    this.engine.call("squashoutDestroy", this.at);
  }
}
