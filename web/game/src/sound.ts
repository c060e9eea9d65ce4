// The sounds: the stage's spring for hits, and short plucked notes for what pops, higher with every block of a combo.
import { Boing } from "../../stage/src/boing.ts";
import type { BlockKind } from "./engine.ts";

/** A pentatonic scale: whatever follows whatever sounds well. */
const scale = [0, 2, 4, 7, 9, 12, 14, 16, 19];
const kRoot = 392; // Hz

const lengths: Partial<Record<BlockKind, number>> = { jelly: 2.2, stone: 0.35, tough: 0.3, explosive: 3, wide: 1.4 };

export class Sound {
  private readonly boing = new Boing();
  private context: AudioContext | undefined;
  private out: AudioNode | undefined;
  private on = false;

  /** From a click or key, as browsers ask for. */
  async setOn(on: boolean): Promise<void> {
    this.on = on;
    await this.boing.setOn(on);
    if (on && this.context === undefined && typeof AudioContext !== "undefined") {
      this.context = new AudioContext();
      const out = new GainNode(this.context, { gain: 0.5 });
      out.connect(new DynamicsCompressorNode(this.context)).connect(this.context.destination);
      this.out = out;
    }
    if (this.context !== undefined) await (on ? this.context.resume() : this.context.suspend());
  }
  get isOn(): boolean {
    return this.on;
  }

  hit(speed: number, block?: BlockKind): void {
    const length = block === undefined ? 0.7 : lengths[block] ?? 0.8;
    this.boing.play({ speed: speed * 0.8, length, squash: block === "stone" || block === "tough" ? 0.95 : 0.6,
      duration: 0.05 });
  }
  /** `combo` from 1. */
  pop(combo: number): void {
    const note = scale[Math.min(Math.max(combo, 1), scale.length) - 1]!;
    this.note(kRoot * 2 ** (note / 12), 0.16, 0.16, "triangle");
    this.note(2 * kRoot * 2 ** (note / 12), 0.07, 0.05, "sine");
  }
  boom(): void {
    this.note(95, 0.4, 0.5, "sine", 34);
    this.note(160, 0.12, 0.25, "sawtooth", 50);
  }
  lost(): void {
    this.note(330, 0.5, 0.22, "triangle", 110);
  }
  fanfare(): void {
    [0, 4, 7, 12].forEach((note, i) => this.note(kRoot * 2 ** (note / 12), 0.3, 0.16, "triangle", undefined, 0.09 * i));
  }
  gift(): void {
    [0, 7, 12].forEach((note, i) => this.note(kRoot * 2 ** (note / 12), 0.2, 0.12, "sine", undefined, 0.06 * i));
  }

  private note(pitch: number, seconds: number, volume: number, type: OscillatorType, to?: number, delay = 0): void {
    if (!this.on || this.context === undefined || this.out === undefined) return;
    const at = this.context.currentTime + delay;
    const tone = new OscillatorNode(this.context, { type, frequency: pitch });
    const level = new GainNode(this.context, { gain: 0 });
    tone.connect(level).connect(this.out);
    if (to !== undefined) {
      tone.frequency.setValueAtTime(pitch, at);
      tone.frequency.exponentialRampToValueAtTime(to, at + seconds);
    }
    level.gain.setValueAtTime(0, at);
    level.gain.linearRampToValueAtTime(volume, at + 0.005);
    level.gain.exponentialRampToValueAtTime(0.0008, at + seconds);
    tone.start(at);
    tone.stop(at + seconds + 0.02);
    tone.onended = () => level.disconnect();
  }
}
