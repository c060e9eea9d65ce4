// Mouse, touch, keyboard and gamepad, as what the rules take: a target or a direction, and a launch.
import type { PlayInput } from "./engine.ts";

/** A finger goes less far than the paddle, so that it need not cover the ball. */
const kFingerGain = 1.35;
const kDeadZone = 0.18;

export interface ControlsHost {
  /** x of the field (m) under a page's x, and how many m a pixel is. */
  toField(page_x: number): number;
  readonly metresPerPixel: number;
  readonly halfWidth: number;
  /** The paddle's x, m. */
  readonly paddleX: number;
  /** Whether play goes on, so that keys are the game's. */
  readonly playing: boolean;
  pause(): void;
  mute(): void;
}

export class Controls {
  private held = new Set<string>();
  private target: number | undefined;
  private launches = false;
  private finger: { id: number; from: number; paddle: number; moved: number } | undefined;
  private padButtons: boolean[] = [];
  private axis = 0;

  constructor(private readonly surface: HTMLElement, private readonly host: ControlsHost) {
    surface.addEventListener("pointermove", (event) => this.move(event));
    surface.addEventListener("pointerdown", (event) => this.down(event));
    for (const type of ["pointerup", "pointercancel"] as const) surface.addEventListener(type, (event) =>
      this.up(event));
    addEventListener("keydown", (event) => this.key(event, true));
    addEventListener("keyup", (event) => this.key(event, false));
    addEventListener("blur", () => this.forget());
  }

  forget(): void {
    this.held.clear();
    this.finger = undefined;
    this.launches = false;
    this.target = undefined;
  }

  private clamp(x: number): number {
    return Math.min(Math.max(x / this.host.halfWidth, -1), 1);
  }
  private move(event: PointerEvent): void {
    if (event.pointerType === "mouse") {
      this.target = this.clamp(this.host.toField(event.clientX));
    } else if (this.finger?.id === event.pointerId) {
      const way = event.clientX - this.finger.from;
      this.finger.moved = Math.max(this.finger.moved, Math.abs(way));
      this.target = this.clamp(this.finger.paddle + way * this.host.metresPerPixel * kFingerGain);
    }
  }
  private down(event: PointerEvent): void {
    if (event.pointerType === "mouse") {
      this.launches = event.button === 0;
      return;
    }
    if (this.finger !== undefined) return;
    this.finger = { id: event.pointerId, from: event.clientX, paddle: this.host.paddleX, moved: 0 };
    this.surface.setPointerCapture(event.pointerId);
  }
  private up(event: PointerEvent): void {
    if (this.finger?.id !== event.pointerId) return;
    // A tap, or the end of a drag that brought the paddle where it should be: either lets the ball go.
    this.launches = event.type === "pointerup";
    this.finger = undefined;
  }
  private key(event: KeyboardEvent, down: boolean): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (!down) {
      this.held.delete(key);
      return;
    }
    if (!this.host.playing) return;
    if (["ArrowLeft", "ArrowRight", "a", "d", "Shift"].includes(key)) {
      this.held.add(key);
      this.target = key === "Shift" ? this.target : undefined;
    } else if (key === " " || key === "Enter" || key === "ArrowUp" || key === "w") this.launches = true;
    else if (key === "Escape" || key === "p") this.host.pause();
    else if (key === "m") this.host.mute();
    else return;
    if (key.startsWith("Arrow") || key === " " || key === "Enter") event.preventDefault();
  }

  /** The first pad that moves or is pressed. */
  private pad(): void {
    for (const pad of navigator.getGamepads?.() ?? []) {
      if (pad === null || !pad.connected) continue;
      const pressed = pad.buttons.map((button) => button.pressed);
      const fresh = (i: number) => pressed[i] === true && this.padButtons[i] !== true;
      if (fresh(0) || fresh(7)) this.launches = true;
      if (fresh(9)) this.host.pause();
      this.padButtons = pressed;
      const stick = pad.axes[0] ?? 0;
      const cross = (pressed[15] === true ? 1 : 0) - (pressed[14] === true ? 1 : 0);
      this.axis = cross !== 0 ? cross : Math.abs(stick) > kDeadZone ? stick : 0;
      if (this.axis !== 0) this.target = undefined;
      return;
    }
    this.axis = 0;
  }

  /** For the coming frame. A launch counts once: `taken` tells that it was. */
  input(): PlayInput {
    this.pad();
    const left = this.held.has("ArrowLeft") || this.held.has("a");
    const right = this.held.has("ArrowRight") || this.held.has("d");
    const keys = ((right ? 1 : 0) - (left ? 1 : 0)) * (this.held.has("Shift") ? 0.45 : 1);
    return { launch: this.launches, target: this.target, axis: keys !== 0 ? keys : this.axis };
  }
  taken(): void {
    this.launches = false;
  }
}
