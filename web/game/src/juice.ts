// What a hit does to the view: a moment's stop, a small shake. Both grow with its speed, and neither touches the rules.
const kMostShake = 0.16; // m
const kMostStop = 0.05; // s

export class Juice {
  private trauma = 0;
  private stop = 0;
  private time = 0;

  /** A hit at `speed` m/s; `weight` 1 for a ball against a block. */
  hit(speed: number, weight: number, shakes: boolean, stops: boolean): void {
    const strength = Math.min(1, Math.max(0, speed - 4) / 14) * weight;
    if (shakes) this.trauma = Math.min(1, this.trauma + 0.35 * strength);
    if (stops) this.stop = Math.max(this.stop, Math.min(kMostStop, 0.032 * strength));
  }

  /** How much of `elapsed` s the game goes on for. */
  pass(elapsed: number): number {
    const held = Math.min(this.stop, elapsed);
    this.stop -= held;
    this.time += elapsed;
    this.trauma = Math.max(0, this.trauma - 2.6 * elapsed);
    return elapsed - held;
  }

  /** Where the camera is pushed to, m. */
  get offset(): { x: number; y: number } {
    const size = kMostShake * this.trauma * this.trauma;
    return { x: size * Math.sin(this.time * 71), y: size * Math.sin(this.time * 57 + 1) };
  }

  calm(): void {
    this.trauma = this.stop = 0;
  }
}
