// The motion model's two curves: stretch by speed in flight, and stretch through an impact.
import { core } from "./core.js";
import { layout } from "./generated/layout.js";
import { type StyleLike, writeStyle } from "./style.js";

/** Stretch of a body that flies at this speed, m/s. */
export function stretchAtSpeed(style: StyleLike, speed: number): number {
  const c = core();
  writeStyle(c, c.definition, style);
  const out = c.take(8);
  c.call("elastoonStretchAtSpeed", c.definition, speed, out);
  return c.f64(out);
}

export interface ImpactInput {
  /** Of the body along its principal axis, m. */
  length: number;
  /** Before and after, relative to the surface, m/s. */
  speedIn: number;
  speedOut: number;
  /** Stretch at the touch and after the impact; default: that of flights at these speeds. */
  stretchIn?: number;
  stretchOut?: number;
  /** The body has to turn, which takes time even where nothing squashes. */
  turns?: boolean;
}

/** Stretch through an impact: a sine down to `stretchMid` in `timeIn`, a cosine up to `stretchOut` in `timeOut`. */
export class ImpactCurve {
  readonly stretchIn: number;
  readonly stretchMid: number;
  readonly stretchOut: number;
  /** s */
  readonly timeIn: number;
  readonly timeOut: number;
  private readonly numbers: Uint8Array;

  constructor(style: StyleLike, input: ImpactInput) {
    const s_in = input.stretchIn ?? stretchAtSpeed(style, input.speedIn);
    const s_out = input.stretchOut ?? stretchAtSpeed(style, input.speedOut);
    const c = core();
    const f = layout.ImpactInput;
    writeStyle(c, c.definition, style);
    const at = c.take(f.size);
    c.setF64(at + f.length, input.length);
    c.setF64(at + f.speed_in, input.speedIn);
    c.setF64(at + f.s_in, s_in);
    c.setF64(at + f.speed_out, input.speedOut);
    c.setF64(at + f.s_out, s_out);
    c.u8[at + f.turns] = input.turns === true ? 1 : 0;
    const out = c.take(layout.ImpactCurve.size);
    c.call("elastoonImpactCurve", c.definition, at, out);
    const g = layout.ImpactCurve;
    this.stretchIn = c.f64(out + g.s_in);
    this.stretchMid = c.f64(out + g.s_mid);
    this.stretchOut = c.f64(out + g.s_out);
    this.timeIn = c.f64(out + g.t_in);
    this.timeOut = c.f64(out + g.t_out);
    this.numbers = c.u8.slice(out, out + g.size);
  }

  /** The stretch at each of the times after the touch; the ends hold before and after. */
  at(times: ArrayLike<number>): Float64Array {
    const c = core();
    const given = Float64Array.from(times);
    const out = c.allocate(Math.max(8 * given.length, 1));
    try {
      return c.withBytes(this.numbers, (curve) => c.withBytes(new Uint8Array(given.buffer), (at) => {
        c.call("elastoonImpactCurveAt", curve, at, given.length, out);
        return new Float64Array(c.memory.buffer.slice(out, out + 8 * given.length));
      }));
    } finally {
      c.free(out);
    }
  }
}
