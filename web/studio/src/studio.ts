// The studio's state, as signals, and all that may be done with it. The interface shows it; the director draws it.
import type { StyleParameters } from "elastoon";
import { batch, computed, signal } from "@preact/signals";
import { type Capability, type PatternName, systemTheme, type ThemeName } from "stage";
import type { Object3D } from "three";
import {
  addBody,
  addObstacle,
  assignStyle,
  bodiesOf,
  changeBody,
  changeObstacle,
  dropOverride,
  type NewBody,
  removeBody,
  removeObstacle,
  setParameter,
  setStyle,
  styleOf,
  throwBody,
} from "./core/edit.js";
import { gallery } from "./core/gallery.js";
import { History } from "./core/history.js";
import { packedIn, packTake, unpackTake } from "./core/link.js";
import { Player } from "./core/player.js";
import {
  durationOf,
  kStepsPerSecond,
  readTake,
  type SceneObstacle,
  type SceneShape,
  type Take,
  type Triple,
} from "./core/take.js";
import { vet } from "./core/vet.js";
import { Director, type Figures, type Overlay, type Show } from "./view/director.js";

export type Panel = "scenes" | "tune" | "motion" | "things" | "keep";
export type Tool = "throw" | "edit";
export type Selection =
  { readonly kind: "body"; readonly name: string } | { readonly kind: "obstacle"; readonly index: number };

export interface Toast {
  readonly id: number;
  readonly kind: "info" | "error";
  readonly text: string;
}

/** Motions that are longer than this to work out anew wait until a slider is let go, ms. */
const kLiveBudget = 45;

const stored = (key: string): string | null => {
  try {
    return localStorage.getItem(`elastoon-studio-${key}`);
  } catch {
    return null;
  }
};
export function store(key: string, value: string): void {
  try {
    localStorage.setItem(`elastoon-studio-${key}`, value);
  } catch {
    // Without storage the choice holds for this visit.
  }
}

export const reducedMotion = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

export class Studio {
  private readonly history = new History<Take>(readTake(gallery[0]!.text()));
  readonly take = signal<Take>(this.history.value);
  readonly sceneId = signal<string>(gallery[0]!.id);
  readonly canUndo = signal(false);
  readonly canRedo = signal(false);
  readonly time = signal(0);
  readonly playing = signal(false);
  readonly speed = signal(1);
  readonly loop = signal(true);
  readonly overlay = signal<Overlay>("none");
  readonly spacing = signal(false);
  readonly pattern = signal<PatternName>("checker");
  readonly tool = signal<Tool>("throw");
  readonly selection = signal<Selection | null>(null);
  readonly panel = signal<Panel | null>(null);
  readonly theme = signal<ThemeName>((stored("theme") as ThemeName | null) ?? systemTheme());
  readonly sound = signal(false);
  readonly showFigures = signal(false);
  readonly figures = signal<Figures | null>(null);
  readonly hash = signal("");
  readonly toasts = signal<readonly Toast[]>([]);
  readonly help = signal(false);
  readonly busy = signal("");
  readonly contextLost = signal(false);
  /** The second style of a comparison; null: none. */
  readonly other = signal<StyleParameters | null>(null);
  readonly editing = signal<"a" | "b">("a");
  readonly thrown = signal(stored("thrown") === "yes");
  /** Counts up when more of the motion is known. */
  readonly known = signal(0);
  readonly meshes = signal<ReadonlyMap<string, Object3D>>(new Map());
  readonly gizmoMode = signal<"translate" | "rotate">("translate");
  readonly aiming = signal<{ speed: number } | null>(null);

  readonly duration = computed(() => durationOf(this.take.value));
  readonly players = signal<readonly Player[]>([]);
  readonly selectedBody = computed(() => (this.selection.value?.kind === "body" ? this.selection.value.name : null));
  /** Place of the body that the panels are about among all bodies of the take. */
  readonly bodyIndex = computed(() => {
    void this.known.value;
    const name = this.selectedBody.value;
    const at = this.players.value[0]?.bodies.findIndex((played) => played.name === name) ?? -1;
    return Math.max(at, 0);
  });

  director!: Director;
  private toastCount = 0;
  private pending: { take: Take; gesture: string | undefined } | null = null;

  /** Begins with the take of the address, or with the welcome. */
  async start(canvas: HTMLCanvasElement, capability: Capability): Promise<void> {
    const show: Show = {
      time: 0,
      playing: false,
      speed: 1,
      loop: true,
      overlay: "none",
      spacing: false,
      selected: null,
      obstacle: -1,
      pattern: this.pattern.value,
    };
    this.director = new Director(canvas, capability, this.theme.value, show, {
      onTime: (time, playing) =>
        batch(() => {
          this.time.value = time;
          this.playing.value = playing;
        }),
      onKnown: () => {
        this.known.value += 1;
        this.tellRefusals();
      },
      onFigures: (figures) => (this.figures.value = figures),
      onContext: (lost) => (this.contextLost.value = lost),
    });
    this.setTake(this.take.value, { frame: true });
    this.selectBody(this.players.value[0]?.bodies[0]?.name ?? null);
    this.setPlaying(!reducedMotion());
    await this.openLink(location.hash);
    addEventListener("hashchange", () => void this.openLink(location.hash));
  }

  // ---- The document

  /** Shows another take. Refused: the old one stays, and the message is shown. */
  private setTake(take: Take, options: { frame?: boolean } = {}): boolean {
    let players: Player[];
    try {
      const before = this.players.value[0];
      if (before !== undefined && before.sharesUpTo(take) > 0) {
        before.goOnAs(take);
        players = [before];
      } else players = [new Player(take)];
      if (this.other.value !== null) {
        players.push(new Player(setStyle(take, this.bodyIndex.peek(), this.other.value)));
      }
    } catch (error) {
      this.tell((error as Error).message, "error");
      return false;
    }
    const old = this.players.value;
    this.director.show.time = Math.min(this.director.show.time, durationOf(take));
    this.director.setPlayers(players, this.meshes.value, options.frame === true);
    old.filter((player) => !players.includes(player)).forEach((player) => player.dispose());
    batch(() => {
      this.take.value = take;
      this.players.value = players;
      this.known.value += 1;
      this.canUndo.value = this.history.canUndo;
      this.canRedo.value = this.history.canRedo;
      this.time.value = this.director.show.time;
    });
    this.refreshSelection();
    this.hash.value = "";
    this.keepForNextTime();
    return true;
  }

  /** The last take is kept in the browser, so that closing the page loses nothing. */
  private keepForNextTime(): void {
    clearTimeout(this.keeping);
    this.keeping = setTimeout(() => {
      if (this.take.value.scene !== this.welcome) store("last", packTake(this.take.value));
    }, 1500);
  }
  private keeping: ReturnType<typeof setTimeout> | undefined;
  private readonly welcome = this.history.value.scene;
  readonly hasLast = signal(stored("last") !== null);
  async openLast(): Promise<void> {
    const packed = stored("last");
    if (packed === null) return;
    try {
      await this.openText(unpackTake(packed), "the last scene");
    } catch (error) {
      this.tell((error as Error).message, "error");
    }
  }

  /** Changes the document. Ticks of one gesture are undone together. */
  change(take: Take, gesture?: string): boolean {
    const slow = (this.players.value[0]?.bodies.length ?? 0) * this.director.show.time > 900;
    if (gesture !== undefined && slow) {
      this.pending = { take, gesture };
      this.take.value = take;
      return true;
    }
    const began = performance.now();
    if (!this.setTake(take)) return false;
    this.history.push(take, gesture);
    this.canUndo.value = true;
    this.canRedo.value = false;
    if (performance.now() - began > kLiveBudget * 20) this.tell("This scene is heavy: changes take a moment.");
    return true;
  }
  /** A slider or gizmo was let go. */
  settle(): void {
    const pending = this.pending;
    this.pending = null;
    if (pending !== null) {
      this.busy.value = "Working out the motion";
      setTimeout(() => {
        if (this.setTake(pending.take)) this.history.push(pending.take);
        else this.take.value = this.history.value;
        this.canUndo.value = this.history.canUndo;
        this.busy.value = "";
      }, 20);
    }
    this.history.settle();
  }
  undo(): void {
    if (this.history.undo()) this.setTake(this.history.value);
  }
  redo(): void {
    if (this.history.redo()) this.setTake(this.history.value);
  }

  /** Another document, which is looked at from its own camera. Undo goes back. */
  open(take: Take, id = ""): void {
    batch(() => {
      this.other.value = null;
      this.selection.value = null;
      this.sceneId.value = id;
    });
    this.director.show.time = 0;
    if (!this.setTake(take, { frame: true })) return;
    this.history.push(take);
    this.canUndo.value = true;
    this.canRedo.value = false;
    this.selectBody(this.players.value[0]?.bodies[0]?.name ?? null);
    this.setPlaying(!reducedMotion());
  }
  openScene(id: string): void {
    const scene = gallery.find((each) => each.id === id);
    if (scene !== undefined) this.open(readTake(scene.text(), scene.title), id);
  }

  /** A stranger's text: looked at in a worker before it is shown. */
  async openText(text: string, what: string): Promise<boolean> {
    this.busy.value = `Looking at ${what}`;
    try {
      const take = readTake(text, what);
      await vet(text, what);
      this.open(take);
      this.tell(`Opened ${what}`);
      return true;
    } catch (error) {
      this.tell((error as Error).message, "error");
      return false;
    } finally {
      this.busy.value = "";
    }
  }
  private async openLink(hash: string): Promise<void> {
    const packed = packedIn(hash);
    if (packed === null) return;
    try {
      await this.openText(unpackTake(packed), "the link");
    } catch (error) {
      this.tell((error as Error).message, "error");
    }
  }

  // ---- Time

  setPlaying(playing: boolean): void {
    if (playing && !this.loop.value && this.director.show.time >= this.duration.value) this.scrub(0);
    this.director.show.playing = this.playing.value = playing;
    if (!playing) this.hash.value = "";
    this.director.invalidate();
  }
  scrub(time: number): void {
    this.setPlaying(false);
    const to = Math.min(Math.max(time, 0), this.duration.value);
    const step = Math.ceil(to * kStepsPerSecond - 1e-6);
    const known = this.players.value.every((player) => player.ensure(step, 400));
    this.director.show.time = known ? to : Math.min(...this.players.value.map((player) => player.recordedTime));
    this.time.value = this.director.show.time;
    this.director.invalidate();
  }
  stepBy(steps: number): void {
    this.scrub((Math.round(this.director.show.time * kStepsPerSecond) + steps) / kStepsPerSecond);
  }
  get step(): number {
    return Math.round(this.director.show.time * kStepsPerSecond);
  }
  /** Of the state at this moment, by going there from the last snapshot. */
  stateHash(): string {
    const hash = this.players.value[0]?.hashAt(this.step) ?? "";
    this.hash.value = hash;
    this.director.invalidate();
    return hash;
  }
  /** Where a body is on the page, CSS pixels. */
  placeOf(name: string): { x: number; y: number } | null {
    const player = this.players.value[0];
    const played = player?.bodyNamed(name);
    if (player === undefined || played === undefined) return null;
    const { x, y, z } = player.motionOf(played.body, [this.director.show.time]).poses[0]!.position;
    return this.director.placeOf(x, y, z);
  }
  setSpeed(speed: number): void {
    this.speed.value = this.director.show.speed = speed;
  }
  setLoop(loop: boolean): void {
    this.loop.value = this.director.show.loop = loop;
  }

  // ---- Looks

  setOverlay(overlay: Overlay): void {
    this.overlay.value = this.director.show.overlay = overlay;
    this.director.invalidate();
  }
  setSpacing(on: boolean): void {
    this.spacing.value = this.director.show.spacing = on;
    this.director.invalidate();
  }
  setPattern(pattern: PatternName): void {
    this.pattern.value = this.director.show.pattern = pattern;
    this.director.setPlayers(this.players.value, this.meshes.value, false);
  }
  setTheme(theme: ThemeName): void {
    this.theme.value = theme;
    store("theme", theme);
    this.director.setTheme(theme);
  }
  async setSound(on: boolean): Promise<void> {
    const works = await this.director.boing.setOn(on);
    this.sound.value = on && works;
    if (!works) this.tell("This browser has no sound for pages.", "error");
  }

  // ---- Selection and edits

  selectBody(name: string | null): void {
    this.selection.value = name === null ? null : { kind: "body", name };
    this.refreshSelection();
  }
  selectObstacle(index: number): void {
    this.selection.value = { kind: "obstacle", index };
    this.refreshSelection();
  }
  refreshSelection(): void {
    const selection = this.selection.value;
    if (selection?.kind === "obstacle" && selection.index >= (this.take.value.scene.obstacles?.length ?? 0)) {
      this.selection.value = null;
    }
    this.director.show.selected = this.selectedBody.value;
    this.director.show.obstacle = this.selection.value?.kind === "obstacle" ? this.selection.value.index : -1;
    this.director.invalidate();
    this.onSelection();
  }
  /** The gizmo listens. */
  onSelection: () => void = () => {};

  setTool(tool: Tool): void {
    this.tool.value = tool;
    this.refreshSelection();
  }

  /** A throw at this moment; it goes on from there. */
  throwNow(name: string, position: Triple, velocity: Triple): void {
    const step = this.step;
    const take = throwBody(this.take.value, { kind: "throw", step, body: name, position, velocity });
    this.director.show.time = step / kStepsPerSecond;
    if (!this.change(take)) return;
    this.thrown.value = true;
    store("thrown", "yes");
    this.setPlaying(true);
  }

  /** The style that the panels show: that of the selected body, or the other one of a comparison. */
  shownStyle(): StyleParameters {
    if (this.other.value !== null && this.editing.value === "b") return this.other.value;
    return styleOf(this.take.value, bodiesOf(this.take.value)[this.bodyIndex.value]?.style);
  }
  setParameter(key: keyof StyleParameters, value: number | string): void {
    if (this.other.value !== null && this.editing.value === "b") {
      this.setOther({ ...this.other.value, [key]: value });
      return;
    }
    this.change(setParameter(this.take.value, this.bodyIndex.value, key, value), `parameter ${key}`);
  }
  /** Gives the preset to the selected body, or to all. */
  applyPreset(name: string, all: boolean): void {
    if (this.other.value !== null && this.editing.value === "b") {
      this.setOther(styleOf({ scene: { elastoon: 1 }, inputs: [] }, name));
      return;
    }
    const bodies = bodiesOf(this.take.value);
    const indices = new Set(all ? bodies.keys() : [this.bodyIndex.value]);
    this.change(assignStyle(this.take.value, indices, name));
  }
  resetStyle(name: string): void {
    this.change(dropOverride(this.take.value, name));
  }
  /** Begins, changes or ends the comparison. */
  setOther(style: StyleParameters | null): void {
    const began = (this.other.value === null) !== (style === null);
    batch(() => {
      this.other.value = style;
      this.editing.value = style === null ? "a" : began ? "b" : this.editing.value;
    });
    this.setTake(this.take.value);
    if (began) this.director.goHome();
  }
  /** Takes the other style over. */
  keepOther(): void {
    const style = this.other.value;
    if (style === null) return;
    const take = setStyle(this.take.value, this.bodyIndex.value, style);
    this.setOther(null);
    this.change(take);
  }

  addBody(body: Omit<NewBody, "position">): void {
    const target = this.director.controls.target;
    const names = this.players.value[0]!.bodies.map((played) => played.name);
    const style = bodiesOf(this.take.value)[this.bodyIndex.value]?.style;
    const step = this.playing.value || this.step > 0 ? this.step : 0;
    // The first free place above the middle of the picture.
    for (let up = 1; up < 12; ++up) {
      const position: Triple = [
        Number(target.x.toFixed(2)),
        Number((target.y + up).toFixed(2)),
        Number(target.z.toFixed(2)),
      ];
      const { take, name } = addBody(
        this.take.value,
        step,
        { ...body, position, ...(style !== undefined && { style }) },
        names,
      );
      try {
        const trial = new Player(take);
        trial.ensure(step + 1);
        const free = trial.bodies.some((played) => played.name === name);
        trial.dispose();
        if (!free) continue;
      } catch {
        continue;
      }
      if (this.change(take)) this.selectBody(name);
      return;
    }
    this.tell("There is no free place for it above the middle of the picture.", "error");
  }
  addObstacle(obstacle: SceneObstacle, shape?: SceneShape): void {
    const take = addObstacle(this.take.value, obstacle, shape);
    if (this.change(take)) this.selectObstacle((take.scene.obstacles?.length ?? 1) - 1);
  }
  changeObstacle(index: number, change: Partial<SceneObstacle>, gesture?: string): boolean {
    return this.change(changeObstacle(this.take.value, index, change), gesture);
  }
  moveBody(name: string, position: Triple, gesture?: string): boolean {
    const index = this.players.value[0]!.bodies.findIndex((played) => played.name === name);
    const played = this.players.value[0]!.bodies[index];
    if (played === undefined) return false;
    if (this.step === played.since) return this.change(changeBody(this.take.value, index, { position }), gesture);
    const { velocities } = this.players.value[0]!.motionOf(played.body, [this.director.show.time]);
    const { x, y, z } = velocities[0]!;
    return this.change(
      throwBody(this.take.value, { kind: "throw", step: this.step, body: name, position, velocity: [x, y, z] }),
      gesture,
    );
  }
  removeSelected(): void {
    const selection = this.selection.value;
    if (selection === null) return;
    const take =
      selection.kind === "obstacle"
        ? removeObstacle(this.take.value, selection.index)
        : removeBody(this.take.value, this.bodyIndex.value, selection.name);
    this.selection.value = null;
    this.change(take);
  }
  setColor(color: string): void {
    const selection = this.selection.value;
    if (selection?.kind === "body") this.change(changeBody(this.take.value, this.bodyIndex.value, { color }), "color");
    else if (selection?.kind === "obstacle") this.changeObstacle(selection.index, { color }, "color");
  }

  /** What this moment looks like as the start of a scene: bodies where they are, with their speeds, and no throws. */
  startHere(): void {
    const player = this.players.value[0]!;
    const time = this.director.show.time;
    const round = (value: number) => Number(value.toFixed(6));
    const bodies = player.bodies
      .filter((played) => played.since <= this.step)
      .map((played) => {
        const { poses, velocities } = player.motionOf(played.body, [time]);
        const [{ position }, velocity] = [poses[0]!, velocities[0]!];
        const from_file = bodiesOf(this.take.value)[player.bodies.indexOf(played)]!;
        return {
          ...from_file,
          name: played.name,
          position: [position.x, position.y, position.z].map(round) as unknown as Triple,
          velocity: [velocity.x, velocity.y, velocity.z].map(round) as unknown as Triple,
        };
      });
    this.director.show.time = 0;
    this.change({ scene: { ...this.take.value.scene, bodies }, inputs: [] });
  }
  clearThrows(): void {
    this.change({ ...this.take.value, inputs: this.take.value.inputs.filter((input) => input.kind !== "throw") });
  }

  /** Mesh `object`, in the frame of the hull that stands for it, as a new body. */
  bringMesh(name: string, shape: SceneShape, object: Object3D): void {
    const shapes = this.take.value.scene.shapes ?? {};
    let key = name;
    for (let i = 2; key in shapes; ++i) key = `${name} ${i}`;
    this.meshes.value = new Map([...this.meshes.value, [key, object]]);
    this.history.push(this.take.value);
    this.take.value = { ...this.take.value, scene: { ...this.take.value.scene, shapes: { ...shapes, [key]: shape } } };
    this.addBody({ shape, name: key });
  }

  // ---- Messages

  tell(text: string, kind: Toast["kind"] = "info"): void {
    const id = ++this.toastCount;
    this.toasts.value = [...this.toasts.value.slice(-2), { id, kind, text: text.slice(0, 600) }];
    setTimeout(() => this.dismiss(id), kind === "error" ? 12000 : 4000);
  }
  dismiss(id: number): void {
    this.toasts.value = this.toasts.value.filter((toast) => toast.id !== id);
  }
  private told = new Set<string>();
  private tellRefusals(): void {
    for (const text of this.players.value[0]?.refused ?? []) {
      if (!this.told.has(text)) this.tell(text, "error");
      this.told.add(text);
    }
  }
}
