// Quality steps: what a slow renderer leaves out, one thing after the other. The governor steps down by itself.

export interface Quality {
  /** Most device pixels for a CSS pixel. */
  readonly pixelRatio: number;
  /** Edge of the shadow map; 0: no cast shadows. */
  readonly shadowMap: number;
  /** Bodies that darken what is under them. */
  readonly occluders: number;
}

/** From the best on. */
export const qualities: readonly Quality[] = [
  { pixelRatio: 2, shadowMap: 2048, occluders: 32 },
  { pixelRatio: 1.5, shadowMap: 1024, occluders: 24 },
  { pixelRatio: 1, shadowMap: 1024, occluders: 12 },
  { pixelRatio: 1, shadowMap: 0, occluders: 8 },
  { pixelRatio: 0.75, shadowMap: 0, occluders: 4 },
  { pixelRatio: 0.5, shadowMap: 0, occluders: 0 },
];

/** Longest mean time between frames that is not slow, ms. */
const kSlow = 22;
const kFast = 12.5;
/** Frames that are looked at together; a first few after a change do not count. */
const kWindow = 24;
const kSettle = 6;
/** Fast windows in a row before a step up is tried; a step up that had to be taken back is not tried again. */
const kFastWindows = 12;

/** Watches the time between frames and says which quality to draw with. */
export class Governor {
  level: number;
  private readonly worst = qualities.length - 1;
  private best = 0;
  private sum = 0;
  private frames = -kSettle;
  private fast = 0;
  private rose = false;

  /** `fixed`: the level stays as it is. */
  constructor(
    level = 0,
    private readonly fixed = false,
  ) {
    this.level = Math.min(Math.max(level, 0), this.worst);
  }

  /** `elapsed` ms went by since the last frame. True where the level changed. A pause (over a second) does not
   *  count. */
  frame(elapsed: number): boolean {
    if (this.fixed || (elapsed > 1000 && this.frames <= 0)) return false;
    if (this.frames++ < 0) return false;
    // A renderer that needs a quarter of a second for a frame need not be watched for 24 of them.
    this.sum += Math.min(elapsed, 1000);
    const clearly_slow = this.frames >= 4 && this.sum / this.frames > 120;
    if (this.frames < kWindow && !clearly_slow) return false;
    const mean = this.sum / this.frames;
    this.sum = 0;
    this.frames = 0;
    if (mean > kSlow) return this.step(clearly_slow ? 2 : 1);
    this.fast = mean < kFast ? this.fast + 1 : 0;
    if (this.fast < kFastWindows || this.level <= this.best) return false;
    return this.step(-1);
  }

  private step(by: number): boolean {
    const level = Math.min(Math.max(this.level + by, this.best), this.worst);
    if (by > 0 && this.rose) this.best = level;
    this.rose = by < 0;
    this.fast = 0;
    this.frames = -kSettle;
    if (level === this.level) return false;
    this.level = level;
    return true;
  }
}

export interface Capability {
  /** Empty: this page can be drawn. Else what to tell the visitor. */
  readonly missing: string;
  /** Drawn by the processor: begin with a low quality and without antialiasing. */
  readonly software: boolean;
  readonly renderer: string;
}

/** Looks at what the browser can draw, on a canvas of its own. */
export function capability(canvas = document.createElement("canvas")): Capability {
  const gl = canvas.getContext("webgl2");
  if (gl === null) {
    return {
      software: true,
      renderer: "none",
      missing:
        "This page draws with WebGL 2, which this browser does not " +
        "offer or has switched off. Try a current browser, or switch graphics acceleration on in its settings.",
    };
  }
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(gl.getParameter(info === null ? gl.RENDERER : info.UNMASKED_RENDERER_WEBGL));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return { missing: "", renderer, software: /swiftshader|llvmpipe|software|basic render/i.test(renderer) };
}
