// Spacing as animators draw it: where a body is on each frame, and how far apart those places are between two extremes.

export interface Point {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

export interface SpacingTick {
  /** From the first extreme, in frames. */
  readonly frame: number;
  /** Of the whole way, 0 to 1. */
  readonly share: number;
}

export const kFramesPerSecond = 24;

const between = (a: Point, b: Point): number => Math.hypot(a.x - b.x, a.y - b.y, a.z - b.z);

/** Ticks of a chart for the places of the frames from one extreme to the next, by the length of the way. */
export function spacingTicks(places: readonly Point[]): SpacingTick[] {
  const lengths = [0];
  for (let i = 1; i < places.length; ++i) lengths.push(lengths[i - 1]! + between(places[i - 1]!, places[i]!));
  const whole = lengths.at(-1) ?? 0;
  return lengths.map((length, frame) => ({ frame, share: whole > 0 ? length / whole : 0 }));
}

/** Times of the frames from `from` to `to`, both ends included. */
export function frameTimes(from: number, to: number, rate = kFramesPerSecond): number[] {
  const count = Math.max(Math.floor((to - from) * rate + 1e-9), 0);
  const times = Array.from({ length: count + 1 }, (_, i) => from + i / rate);
  if (to - (times.at(-1) ?? from) > 1e-6) times.push(to);
  return times;
}

/** The stretch of time around `time` between two of the marks (extremes); the ends are 0 and `end`. */
export function spanAround(marks: readonly number[], time: number, end: number): [number, number] {
  let [from, to] = [0, end];
  for (const mark of marks) {
    if (mark <= time + 1e-9 && mark > from) from = mark;
    if (mark > time + 1e-9 && mark < to) to = mark;
  }
  return [from, to];
}
