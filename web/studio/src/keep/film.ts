// Films and pictures, frame by frame at exact times: WebCodecs where the browser has it, else a zip of PNGs.
import type { Director, Overlay } from "../view/director.js";
import { zipSync } from "fflate";
import {
  BufferTarget,
  CanvasSource,
  getFirstEncodableVideoCodec,
  Mp4OutputFormat,
  Output,
  QUALITY_HIGH,
  WebMOutputFormat,
} from "mediabunny";

export interface FilmOptions {
  readonly width: number;
  readonly height: number;
  readonly rate: number;
  /** s */
  readonly from: number;
  readonly to: number;
  readonly overlay: Overlay;
  readonly onProgress: (share: number) => void;
  readonly signal: AbortSignal;
}

export interface Film {
  readonly data: Uint8Array;
  readonly type: string;
  readonly ending: string;
}

const pause = () => new Promise((resolve) => setTimeout(resolve, 0));

function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((resolve, reject) =>
    canvas.toBlob(
      (blob) => (blob === null ? reject(new Error("the browser made no picture")) : resolve(blob)),
      "image/png",
    ),
  );
}

/** A copy of what was drawn, before the next frame takes its place. */
function copyOf(canvas: HTMLCanvasElement, width: number, height: number): HTMLCanvasElement {
  const copy = document.createElement("canvas");
  copy.width = width;
  copy.height = height;
  copy.getContext("2d")!.drawImage(canvas, 0, 0, width, height);
  return copy;
}

export async function stillOf(
  director: Director,
  width: number,
  height: number,
  time: number,
  overlay: Overlay,
): Promise<Blob> {
  let copy: HTMLCanvasElement | undefined;
  director.picture(width, height, time, overlay, (canvas) => (copy = copyOf(canvas, width, height)));
  return pngOf(copy!);
}

async function* frames(director: Director, options: FilmOptions): AsyncGenerator<[HTMLCanvasElement, number]> {
  const count = Math.max(Math.round((options.to - options.from) * options.rate), 1);
  const canvas = document.createElement("canvas");
  canvas.width = options.width;
  canvas.height = options.height;
  const pen = canvas.getContext("2d")!;
  for (let i = 0; i < count; ++i) {
    options.signal.throwIfAborted();
    director.picture(options.width, options.height, options.from + i / options.rate, options.overlay, (drawn) =>
      pen.drawImage(drawn, 0, 0, options.width, options.height),
    );
    yield [canvas, i];
    options.onProgress((i + 1) / count);
    await pause();
  }
}

async function encoded(director: Director, options: FilmOptions): Promise<Film | null> {
  if (typeof VideoEncoder === "undefined") return null;
  const size = { width: options.width, height: options.height };
  const webm_codec = await getFirstEncodableVideoCodec(["vp9", "vp8", "av1"], size);
  const mp4_codec = webm_codec === null ? await getFirstEncodableVideoCodec(["avc", "hevc"], size) : null;
  const codec = webm_codec ?? mp4_codec;
  if (codec === null) return null;
  const target = new BufferTarget();
  const output = new Output({ format: webm_codec === null ? new Mp4OutputFormat() : new WebMOutputFormat(), target });
  const canvas = document.createElement("canvas");
  canvas.width = options.width;
  canvas.height = options.height;
  const pen = canvas.getContext("2d")!;
  const source = new CanvasSource(canvas, { codec, bitrate: QUALITY_HIGH });
  output.addVideoTrack(source, { frameRate: options.rate });
  await output.start();
  try {
    for await (const [frame, i] of frames(director, options)) {
      pen.drawImage(frame, 0, 0);
      await source.add(i / options.rate, 1 / options.rate);
    }
    await output.finalize();
  } catch (error) {
    await output.cancel();
    throw error;
  }
  const type = webm_codec === null ? "video/mp4" : "video/webm";
  return { data: new Uint8Array(target.buffer!), type, ending: webm_codec === null ? "mp4" : "webm" };
}

async function zipped(director: Director, options: FilmOptions): Promise<Film> {
  const files: Record<string, [Uint8Array, { level: 0 }]> = {};
  for await (const [frame, i] of frames(director, options)) {
    const bytes = new Uint8Array(await (await pngOf(frame)).arrayBuffer());
    files[`frame-${String(i + 1).padStart(4, "0")}.png`] = [bytes, { level: 0 }];
  }
  return { data: zipSync(files), type: "application/zip", ending: "zip" };
}

export async function filmOf(director: Director, options: FilmOptions, as_pictures = false): Promise<Film> {
  const film = as_pictures ? null : await encoded(director, options);
  return film ?? zipped(director, options);
}
