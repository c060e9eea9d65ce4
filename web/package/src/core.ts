// The WebAssembly module, and how its C interface is called: scratch memory, texts, errors. Not part of the package's
// interface.
import { binary } from "./generated/binary.js";
import { layout } from "./generated/layout.js";

/** Why a call was refused. */
export type ErrorCode = "bad id" | "bad argument" | "refused" | "too small" | "bad data" | "out of memory" | "not ready";

/** What a refused call throws: `code` says what kind, the message what, where, and what would be right. */
export class ElastoonError extends Error {
  readonly code: ErrorCode;
  constructor(code: ErrorCode, message: string) {
    super(message);
    this.name = "ElastoonError";
    this.code = code;
  }
}

/** Something that can be turned into a module: else the one that comes with the package is taken. */
export type WasmSource = BufferSource | WebAssembly.Module | Response | PromiseLike<Response>;

/** A thing's slot and generation, as the C interface has them. */
export interface Id {
  readonly slot: number;
  readonly generation: number;
}

export interface Vector {
  x: number;
  y: number;
  z: number;
}

export interface Rotation {
  x: number;
  y: number;
  z: number;
  w: number;
}

type Call = (...values: number[]) => number;
const codes: readonly ErrorCode[] = ["not ready", "bad id", "bad argument", "refused", "too small", "bad data",
  "out of memory"];
/** Of scratch memory: the largest struct many times over. */
const scratchBytes = 8192;

export class Core {
  readonly memory: WebAssembly.Memory;
  private readonly exports: WebAssembly.Exports;
  /** Room for one definition that is filled by several calls. */
  readonly definition: number;
  private readonly scratch: number;
  private used = 0;
  private bytes!: Uint8Array;
  private view!: DataView;

  constructor(module: WebAssembly.Module) {
    const instance = new WebAssembly.Instance(module, {
      wasi_snapshot_preview1: { fd_close: () => 0, fd_seek: () => 70, fd_write: this.write.bind(this) },
    });
    this.exports = instance.exports;
    this.memory = instance.exports["memory"] as WebAssembly.Memory;
    (instance.exports["_initialize"] as Call)();
    this.scratch = this.allocate(scratchBytes);
    this.definition = this.allocate(512);
  }

  /** Calls a function of the C interface that is not refused. */
  plain(name: string, ...values: number[]): number {
    const result = (this.exports[name] as Call)(...values);
    this.used = 0;
    return result;
  }

  /** Calls a function that may be refused, and throws what it was refused for. */
  call(name: string, ...values: number[]): void {
    const result = this.plain(name, ...values);
    if (result !== 0) {
      throw new ElastoonError(codes[result] ?? "bad argument", this.text(this.plain("elastoonLastError")));
    }
  }

  /** Room for an argument of the next call, zeroed; it is gone after that call's results are read. */
  take(size: number): number {
    const at = this.scratch + this.used;
    this.used += (size + 7) & ~7;
    if (this.used > scratchBytes) {
      this.used = 0;
      throw new ElastoonError("out of memory", "an argument is too large");
    }
    this.u8.fill(0, at, at + size);
    return at;
  }

  allocate(size: number): number {
    const at = (this.exports["malloc"] as Call)(size);
    if (at === 0) throw new ElastoonError("out of memory", "there is not enough memory");
    return at;
  }

  free(at: number): void {
    (this.exports["free"] as Call)(at);
  }

  /** Gives `work` the bytes in memory of the module's own, and frees them. */
  withBytes<T>(bytes: Uint8Array, work: (at: number, size: number) => T): T {
    const at = this.allocate(bytes.length + 1);
    try {
      this.u8.set(bytes, at);
      this.u8[at + bytes.length] = 0;
      return work(at, bytes.length);
    } finally {
      this.free(at);
    }
  }

  get u8(): Uint8Array {
    if (this.bytes?.buffer !== this.memory.buffer) this.bytes = new Uint8Array(this.memory.buffer);
    return this.bytes;
  }

  get data(): DataView {
    if (this.view?.buffer !== this.memory.buffer) this.view = new DataView(this.memory.buffer);
    return this.view;
  }

  u32(at: number): number {
    return this.data.getUint32(at, true);
  }

  f64(at: number): number {
    return this.data.getFloat64(at, true);
  }

  setF64(at: number, value: number): void {
    this.data.setFloat64(at, value, true);
  }

  setU32(at: number, value: number): void {
    this.data.setUint32(at, value, true);
  }

  text(at: number): string {
    const bytes = this.u8;
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }

  putText(text: string): number {
    const bytes = new TextEncoder().encode(text.slice(0, 1000));
    const at = this.take(bytes.length + 1);
    this.u8.set(bytes, at);
    return at;
  }

  vector(at: number): Vector {
    return { x: this.f64(at), y: this.f64(at + 8), z: this.f64(at + 16) };
  }

  setVector(at: number, v: Readonly<Vector>): void {
    this.setF64(at, v.x);
    this.setF64(at + 8, v.y);
    this.setF64(at + 16, v.z);
  }

  putVector(v: Readonly<Vector>): number {
    const at = this.take(layout.Vec3.size);
    this.setVector(at, v);
    return at;
  }

  rotation(at: number): Rotation {
    return { x: this.f64(at), y: this.f64(at + 8), z: this.f64(at + 16), w: this.f64(at + 24) };
  }

  setRotation(at: number, q: Readonly<Rotation>): void {
    this.setVector(at, q);
    this.setF64(at + 24, q.w);
  }

  putRotation(q: Readonly<Rotation>): number {
    const at = this.take(layout.Quat.size);
    this.setRotation(at, q);
    return at;
  }

  id(at: number): Id {
    return { slot: this.u32(at), generation: this.u32(at + 4) };
  }

  setId(at: number, id: Id): void {
    this.setU32(at, id.slot);
    this.setU32(at + 4, id.generation);
  }

  /** An id, with that of its world where it has one. */
  putId(id: Id, world?: Id): number {
    const at = this.take(16);
    this.setId(at, id);
    if (world !== undefined) this.setId(at + 8, world);
    return at;
  }

  /** What the library prints: only when an assertion of its own fails. */
  private write(_file: number, parts: number, count: number, written: number): number {
    let size = 0;
    for (let i = 0; i < count; ++i) {
      const at = this.u32(parts + 8 * i);
      const length = this.u32(parts + 8 * i + 4);
      console.error(new TextDecoder().decode(this.u8.slice(at, at + length)));
      size += length;
    }
    this.setU32(written, size);
    return 0;
  }
}

let ready: Core | undefined;
let coming: Promise<void> | undefined;

async function ownModule(): Promise<WebAssembly.Module> {
  const text = atob(binary);
  const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

async function moduleOf(source: WasmSource | undefined): Promise<WebAssembly.Module> {
  if (source === undefined) return ownModule();
  if (source instanceof WebAssembly.Module) return source;
  if (ArrayBuffer.isView(source) || source instanceof ArrayBuffer) return WebAssembly.compile(source);
  return WebAssembly.compile(await (await (source as PromiseLike<Response>)).arrayBuffer());
}

/** Loads the module, once: later calls wait for the first. */
export function start(source?: WasmSource): Promise<void> {
  coming ??= moduleOf(source).then(
    (module) => {
      ready = new Core(module);
    },
    (error: unknown) => {
      coming = undefined;
      throw error;
    },
  );
  return coming;
}

export function core(): Core {
  if (ready === undefined) throw new ElastoonError("not ready", "call `await Elastoon.init()` first");
  return ready;
}
