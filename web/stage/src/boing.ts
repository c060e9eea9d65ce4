// The sound of an impact, made as it is heard: a plucked spring whose pitch wobbles. Silent until it is turned on.

export interface Hit {
  /** m/s. */
  readonly speed: number;
  /** Of the body along its axis, m: the large are low. */
  readonly length: number;
  /** s_mid, 0 to 1: the deeper the squash, the wider the wobble. */
  readonly squash: number;
  /** How long the impact lasts, s. */
  readonly duration: number;
}

/** Most sounds that begin within a twentieth of a second. */
const kMostAtOnce = 4;

/** What a hit sounds like, as numbers: Hz, share of full volume, s. */
export function voiceOf(hit: Hit): { pitch: number; volume: number; wobble: number; seconds: number } {
  const size = Math.min(Math.max(hit.length, 0.05), 20);
  const depth = Math.min(Math.max(1 - hit.squash, 0), 1);
  return {
    pitch: Math.min(Math.max(210 / Math.sqrt(size), 60), 900),
    volume: Math.min(0.5, 0.035 * Math.max(hit.speed, 0) ** 0.75),
    wobble: 0.15 + 0.9 * depth,
    seconds: Math.min(Math.max(0.16 + 1.2 * hit.duration, 0.16), 0.9),
  };
}

export class Boing {
  private context: AudioContext | undefined;
  private out: GainNode | undefined;
  private recent: number[] = [];
  private on = false;

  /** To be called from a click or key, as browsers ask for. False where there is no sound here. */
  async setOn(on: boolean): Promise<boolean> {
    this.on = on;
    if (!on) {
      await this.context?.suspend();
      return true;
    }
    if (typeof AudioContext === "undefined") return false;
    if (this.context === undefined) {
      this.context = new AudioContext();
      const soft = this.context.createDynamicsCompressor();
      this.out = this.context.createGain();
      this.out.gain.value = 0.8;
      this.out.connect(soft).connect(this.context.destination);
    }
    await this.context.resume();
    return true;
  }
  get isOn(): boolean {
    return this.on;
  }

  play(hit: Hit): void {
    if (!this.on || this.context === undefined || this.out === undefined || hit.speed < 0.3) return;
    const now = this.context.currentTime;
    this.recent = this.recent.filter((time) => now - time < 0.05);
    if (this.recent.length >= kMostAtOnce) return;
    this.recent.push(now);
    const { pitch, volume, wobble, seconds } = voiceOf(hit);
    const tone = new OscillatorNode(this.context, { type: "triangle", frequency: pitch });
    const bend = new OscillatorNode(this.context, { type: "sine", frequency: 9 + 5 / seconds });
    const depth = new GainNode(this.context, { gain: pitch * wobble * 0.3 });
    const level = new GainNode(this.context, { gain: 0 });
    bend.connect(depth).connect(tone.frequency);
    tone.connect(level).connect(this.out);
    tone.frequency.setValueAtTime(pitch * (1 - 0.35 * wobble), now);
    tone.frequency.exponentialRampToValueAtTime(pitch * (1 + 0.5 * wobble), now + seconds);
    depth.gain.linearRampToValueAtTime(0, now + seconds);
    level.gain.setValueAtTime(0, now);
    level.gain.linearRampToValueAtTime(volume, now + 0.006);
    level.gain.exponentialRampToValueAtTime(0.0008, now + seconds);
    for (const node of [tone, bend]) {
      node.start(now);
      node.stop(now + seconds + 0.02);
    }
    tone.onended = () => level.disconnect();
  }
}
