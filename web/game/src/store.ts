// What the page keeps in this browser: options, best scores, how far the player came. It goes without where it may not.
export interface Options {
  sound: boolean;
  gravity: boolean;
  hitStop: boolean;
  shake: boolean;
  particles: boolean;
  reducedMotion: boolean;
}

export interface Score {
  readonly name: string;
  readonly score: number;
  /** From 1. */
  readonly level: number;
  readonly gravity: boolean;
  readonly date: string;
}

const kOptions = "squashout.options", kScores = "squashout.scores", kReached = "squashout.reached",
  kName = "squashout.name";
export const kMostScores = 10;

function read(key: string): unknown {
  try {
    return JSON.parse(localStorage.getItem(key) ?? "null");
  } catch {
    return null;
  }
}
function write(key: string, value: unknown): void {
  try {
    localStorage.setItem(key, JSON.stringify(value));
  } catch {
    // A private window: it lasts as long as the page.
  }
}

export function loadOptions(): Options {
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const options: Options = { sound: true, gravity: false, hitStop: true, shake: true, particles: true,
    reducedMotion: calm };
  const kept = read(kOptions);
  if (typeof kept === "object" && kept !== null) {
    for (const key of Object.keys(options) as (keyof Options)[]) {
      const value = (kept as Record<string, unknown>)[key];
      if (typeof value === "boolean") options[key] = value;
    }
  }
  return options;
}
export const saveOptions = (options: Options) => write(kOptions, options);

export function loadScores(): Score[] {
  const kept = read(kScores);
  if (!Array.isArray(kept)) return [];
  return kept.filter((s): s is Score => typeof s === "object" && s !== null && typeof s.name === "string" &&
    Number.isFinite(s.score) && Number.isFinite(s.level)).slice(0, kMostScores);
}
/** Whether a score has a place among the best. */
export function isBest(score: number): boolean {
  const scores = loadScores();
  return score > 0 && (scores.length < kMostScores || score > scores.at(-1)!.score);
}
/** Its place, from 0. */
export function addScore(score: Score): number {
  const scores = [...loadScores(), score].sort((a, b) => b.score - a.score).slice(0, kMostScores);
  write(kScores, scores);
  write(kName, score.name);
  return scores.indexOf(score);
}
export function lastName(): string {
  const name = read(kName);
  return typeof name === "string" ? name.slice(0, 12) : "";
}

/** The furthest level that was begun, from 0. */
export function reached(): number {
  const level = read(kReached);
  return typeof level === "number" && Number.isInteger(level) && level > 0 ? level : 0;
}
export function reach(level: number): void {
  if (level > reached()) write(kReached, level);
}
