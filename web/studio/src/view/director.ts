// Runs the picture: takes what the studio's signals say, moves and draws it, frame by frame, and only where
// something changed.
import { Boing, type Capability, type PatternName, type Pane, Stage, type ThemeName } from "stage";
import { Raycaster, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import type { Player } from "../core/player.js";
import { durationOf, kStepsPerSecond, type Take } from "../core/take.js";
import { frameTimes, spanAround } from "../core/spacing.js";
import { Band, SpacingDots } from "./previews.js";
import { type BroughtMeshes, TakeView } from "./take_view.js";
import { Thrower } from "./thrower.js";

/** Bodies from which on nothing is worked out ahead and the picture keeps to whole steps. */
const kCrowd = 400;
/** ms of a frame for what is worked out ahead, and for what is needed now. */
const kAheadBudget = 4;
const kNowBudget = 60;

export type Overlay = "none" | "onion" | "strobe";

/** What is to be seen; the studio keeps it. */
export interface Show {
  time: number;
  playing: boolean;
  speed: number;
  loop: boolean;
  overlay: Overlay;
  spacing: boolean;
  selected: string | null;
  /** Of the selected obstacle; -1: none. */
  obstacle: number;
  pattern: PatternName;
}

export interface Figures {
  fps: number;
  /** ms for a frame: simulation, and all. */
  simulation: number;
  frame: number;
  bodies: number;
  calls: number;
  quality: number;
}

export interface DirectorEvents {
  onTime(time: number, playing: boolean): void;
  onKnown(recorded: number): void;
  onFigures(figures: Figures): void;
  onContext(lost: boolean): void;
}

/** `?quality=1` (best) to `6` holds the quality: for pictures, and for those who know better. */
function qualityWanted(): number | undefined {
  const wanted = Number(new URLSearchParams(location.search).get("quality") ?? "");
  return Number.isInteger(wanted) && wanted >= 1 && wanted <= 6 ? wanted - 1 : undefined;
}

/** The scene's own strobe; where it says nothing, what is around the time that is shown. */
function strobeTimes(take: Take, time: number): number[] {
  const end = durationOf(take);
  const strobe = take.scene.strobe as { every?: number; from?: number; to?: number } | undefined;
  if (strobe === undefined) {
    const from = Math.max(Math.min(time - 0.8, end - 2.4), 0);
    return frameTimes(from, Math.min(from + 2.4, end), 12);
  }
  return frameTimes(strobe.from ?? 0, Math.min(strobe.to ?? end, end), 1 / Math.max(strobe.every ?? 0.1, 1 / 60));
}

export class Director {
  readonly stage: Stage;
  readonly controls: OrbitControls;
  readonly gizmo: TransformControls;
  readonly thrower: Thrower;
  readonly boing = new Boing();
  show: Show;
  views: TakeView[] = [];
  private readonly spacingDots: SpacingDots[] = [];
  private readonly ray = new Raycaster();
  private last = performance.now();
  private drawn = "";
  private dirty = true;
  private ghostKey = "";
  private tally = { frames: 0, simulation: 0, work: 0, since: performance.now() };
  private knownTold = -1;
  private running = true;
  private home = { eye: new Vector3(), target: new Vector3(), fov: 35 };

  constructor(
    readonly canvas: HTMLCanvasElement,
    capability: Capability,
    theme: ThemeName,
    show: Show,
    private readonly events: DirectorEvents,
  ) {
    this.show = show;
    this.stage = new Stage(canvas, {
      theme,
      capability,
      quality: qualityWanted(),
      onContext: (lost) => {
        events.onContext(lost);
        this.invalidate();
      },
    });
    this.controls = new OrbitControls(this.stage.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.52;
    this.controls.addEventListener("change", () => this.invalidate());
    this.gizmo = new TransformControls(this.stage.camera, canvas);
    this.gizmo.setSize(0.8);
    this.gizmo.addEventListener("dragging-changed", (event) => {
      this.controls.enabled = event.value !== true;
    });
    this.gizmo.addEventListener("change", () => this.invalidate());
    this.stage.scene.add(this.gizmo.getHelper());
    const band = new Band(this.stage.theme.accent);
    this.stage.scene.add(band.group);
    this.thrower = new Thrower(band);
    for (let i = 0; i < 2; ++i) {
      const shown = new SpacingDots(this.stage.theme.accent);
      this.spacingDots.push(shown);
      this.stage.scene.add(shown.group);
    }
    this.stage.renderer.setAnimationLoop((now) => this.frame(now));
  }

  invalidate(): void {
    this.dirty = true;
  }
  resize(width: number, height: number): void {
    this.stage.resize(width, height);
    this.fit();
    // At once: a canvas of another size is empty.
    if (this.views.length > 0 && this.running) this.draw();
    this.invalidate();
  }
  /** Whether what is compared stands one above the other. */
  get upright(): boolean {
    return this.canvas.clientHeight > this.canvas.clientWidth;
  }

  /** One player, or two that are compared. `frame`: look at all of it anew. */
  setPlayers(players: readonly Player[], meshes: BroughtMeshes, frame: boolean): void {
    for (const view of this.views) view.dispose();
    this.views = [];
    for (const player of players) {
      player.ensure(Math.ceil(this.show.time * kStepsPerSecond), kNowBudget);
      this.views.push(new TakeView(this.stage, player, { pattern: this.show.pattern, meshes }));
    }
    if (frame) this.reframe();
    this.ghostKey = "";
    this.knownTold = -1;
    this.invalidate();
  }

  /** Light, floor and camera for all that happens. */
  reframe(): void {
    const view = this.views[0];
    if (view === undefined) return;
    view.player.ensure(Math.ceil(Math.min(durationOf(view.player.take), 8) * kStepsPerSecond), kNowBudget);
    const { center, radius } = view.bounds(durationOf(view.player.take));
    this.stage.setBounds(center, radius);
    this.views.forEach((each) => each.setObstacles());
    const wanted = view.player.scene.camera;
    const vector = ({ x, y, z }: { x: number; y: number; z: number }) => new Vector3(x, y, z);
    this.home =
      wanted !== null
        ? { eye: vector(wanted.eye), target: vector(wanted.target), fov: wanted.fov }
        : { eye: center.clone().add(new Vector3(0.1, 0.35, 2.9).multiplyScalar(radius)), target: center, fov: 35 };
    this.goHome();
  }
  goHome(): void {
    this.controls.target.copy(this.home.target);
    this.fit();
    this.controls.update();
    this.invalidate();
  }
  /** From where the scene is to be seen, further back where the picture is narrow. */
  private fit(): void {
    const { camera } = this.stage;
    const [pane] = this.panes();
    const aspect =
      (this.canvas.clientWidth * (pane?.width ?? 1)) / Math.max(this.canvas.clientHeight * (pane?.height ?? 1), 1);
    const back = Math.max(1, (this.views.length > 1 ? 1.25 : 1.6) / Math.max(aspect, 0.3));
    camera.fov = this.home.fov;
    camera.position.copy(this.home.target).add(this.home.eye.clone().sub(this.home.target).multiplyScalar(back));
    camera.near = Math.max(camera.position.distanceTo(this.home.target) / 500, 0.01);
    camera.far = camera.position.distanceTo(this.home.target) * 30 + this.stage.bounds.radius * 12;
    this.controls.minDistance = this.stage.bounds.radius * 0.15;
    this.controls.maxDistance = this.stage.bounds.radius * 12 + 20;
    camera.lookAt(this.home.target);
  }

  setTheme(theme: ThemeName): void {
    this.stage.setTheme(theme);
    this.views.forEach((view) => view.setObstacles());
    this.invalidate();
  }

  private panes(): Pane[] {
    const count = this.views.length;
    const { upright } = this;
    return this.views.map((view, i) => ({
      x: upright ? 0 : i / count,
      y: upright ? i / count : 0,
      width: upright ? 1 : 1 / count,
      height: upright ? 1 / count : 1,
      draw: () => {
        this.views.forEach((other, j) => {
          other.group.visible = i === j;
          this.spacingDots[j]!.group.visible = i === j;
        });
        view.occlude(this.show.time, this.controls.target);
      },
    }));
  }

  private frame(now: number): void {
    if (!this.running) return;
    const elapsed = now - this.last;
    this.last = now;
    const began = performance.now();
    this.advance(elapsed / 1000);
    const simulated = performance.now();
    this.controls.update();
    this.follow();
    const { time, selected, overlay, spacing, obstacle } = this.show;
    const key = [time, selected, overlay, spacing, obstacle, this.views.length].join();
    if (key === this.drawn && !this.dirty) return;
    if (this.show.playing || this.dirty) {
      if (this.stage.watch(elapsed)) this.dirty = true;
    }
    this.drawn = key;
    this.dirty = false;
    this.draw();
    this.count(simulated - began, performance.now() - began);
  }

  /** Puts everything where it is at the shown time, and draws it. */
  draw(): void {
    for (const view of this.views) view.show(this.show.time);
    this.drawGhosts();
    const index = this.selectedIndex();
    this.views.forEach((view) => {
      view.bodies.highlight(index);
      view.obstacles.mark(this.show.obstacle, this.show.obstacle >= 0 ? this.stage.theme.accent : null);
    });
    this.stage.render(this.panes());
  }

  private selectedIndex(): number {
    return this.views[0]?.player.bodyNamed(this.show.selected)?.body.index ?? -1;
  }

  private advance(elapsed: number): void {
    const { show } = this;
    const first = this.views[0];
    if (first === undefined || this.thrower.aiming) return;
    const crowd = first.player.bodies.length > kCrowd;
    const end = durationOf(first.player.take);
    if (show.playing) {
      let next = show.time + Math.min(elapsed, 0.1) * show.speed;
      if (crowd) next = Math.round(next * kStepsPerSecond) / kStepsPerSecond;
      const step = Math.ceil(Math.min(next, end) * kStepsPerSecond - 1e-6);
      const known = this.views.map(({ player }) => player.ensure(step, kNowBudget));
      if (known.includes(false)) next = Math.min(...this.views.map(({ player }) => player.recordedTime));
      this.sound(show.time, Math.min(next, end));
      if (next >= end) {
        next = show.loop ? 0 : end;
        show.playing = show.loop;
      }
      show.time = crowd && next > 0 ? Math.min(first.player.recordedTime, next) : next;
      this.events.onTime(show.time, show.playing);
    }
    if (!crowd) this.workAhead(end);
    this.tellKnown();
  }

  private workAhead(end: number): void {
    const last = Math.ceil(end * kStepsPerSecond);
    for (const { player } of this.views) player.ensure(last, kAheadBudget / this.views.length);
  }
  private tellKnown(): void {
    const recorded = Math.min(...this.views.map(({ player }) => player.recorded));
    const end = Math.ceil(durationOf(this.views[0]!.player.take) * kStepsPerSecond);
    if (recorded === this.knownTold || (recorded < end && recorded - this.knownTold < 20 && this.knownTold >= 0))
      return;
    this.knownTold = recorded;
    this.ghostKey = "";
    this.invalidate();
    this.events.onKnown(recorded);
  }

  private sound(from: number, to: number): void {
    if (!this.boing.isOn || this.show.speed < 0.2) return;
    for (const event of this.views[0]!.player.events()) {
      if (event.type !== "impact" || event.time <= from || event.time > to) continue;
      this.boing.play({
        speed: event.speed,
        length: event.body.shape.length,
        squash: event.stretchMid,
        duration: event.timeIn + event.timeOut,
      });
    }
  }

  private drawGhosts(): void {
    const { overlay, time, spacing, selected } = this.show;
    const end = durationOf(this.views[0]!.player.take);
    const moment = overlay === "none" && !spacing ? "" : time.toFixed(2);
    const key = [overlay, spacing, selected, moment].join(" ");
    if (key === this.ghostKey) return;
    this.ghostKey = key;
    this.views.forEach((view, i) => {
      const known = view.player.recordedTime;
      const within = (times: number[]) => times.filter((t) => t >= 0 && t <= known);
      if (overlay === "strobe") view.showGhosts(within(strobeTimes(view.player.take, time)));
      else if (overlay === "onion") view.showGhosts(within([-4, -3, -2, -1, 1, 2, 3, 4].map((n) => time + n / 24)));
      else view.showGhosts([]);
      this.drawSpacing(view, i, end);
    });
  }

  private drawSpacing(view: TakeView, i: number, end: number): void {
    const dots = this.spacingDots[i]!;
    const played = view.player.bodyNamed(this.show.selected);
    if (!this.show.spacing || played === undefined) {
      dots.hide();
      return;
    }
    const marks = view.player
      .events()
      .filter((event) => event.type === "impact" && event.body.index === played.body.index)
      .map((event) => event.time);
    const known = Math.min(end, view.player.recordedTime);
    const [from] = spanAround(marks, this.show.time, known);
    const times = frameTimes(Math.max(from - 0.5, 0), Math.min(from + 3, known));
    const { poses } = view.player.motionOf(played.body, times);
    dots.show(
      poses.map(({ position: { x, y, z } }) => new Vector3(x, y, z)),
      played.body.shape.length,
    );
  }

  /** The gizmo's object may have moved by itself. */
  private follow(): void {
    if (this.gizmo.object !== undefined && !this.gizmo.dragging && this.show.playing) this.invalidate();
  }

  private count(simulation: number, work: number): void {
    const tally = this.tally;
    tally.frames += 1;
    tally.simulation += simulation;
    tally.work += work;
    const span = performance.now() - tally.since;
    if (span < 500) return;
    this.events.onFigures({
      fps: (1000 * tally.frames) / span,
      simulation: tally.simulation / tally.frames,
      frame: tally.work / tally.frames,
      bodies: this.views[0]?.player.bodies.length ?? 0,
      calls: this.stage.drawCalls,
      quality: this.stage.governor.level,
    });
    this.tally = { frames: 0, simulation: 0, work: 0, since: performance.now() };
  }

  /** The pane that the last ray fell into: its place in `views`. */
  pane = 0;
  /** A ray through a place of the page, in the pane that it falls into. */
  rayAt(x: number, y: number): Raycaster {
    const box = this.canvas.getBoundingClientRect();
    const place = new Vector2((x - box.left) / box.width, (y - box.top) / box.height);
    const panes = this.panes();
    const found = panes.findIndex(
      (each) =>
        place.x >= each.x && place.x <= each.x + each.width && place.y >= each.y && place.y <= each.y + each.height,
    );
    this.pane = Math.max(found, 0);
    const pane = panes[this.pane] ?? { x: 0, y: 0, width: 1, height: 1 };
    place.set((2 * (place.x - pane.x)) / pane.width - 1, 1 - (2 * (place.y - pane.y)) / pane.height);
    this.stage.camera.aspect = (box.width * pane.width) / Math.max(box.height * pane.height, 1);
    this.stage.camera.updateProjectionMatrix();
    this.stage.camera.updateMatrixWorld();
    this.ray.setFromCamera(place, this.stage.camera);
    return this.ray;
  }
  /** Where a point of the world is on the page, CSS pixels, in the first pane. */
  placeOf(x: number, y: number, z: number): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    const pane = this.panes()[0] ?? { width: 1, height: 1 };
    const seen = new Vector3(x, y, z).project(this.stage.camera);
    return {
      x: box.left + (0.5 + seen.x / 2) * box.width * pane.width,
      y: box.top + (0.5 - seen.y / 2) * box.height * pane.height,
    };
  }

  /** Renders one picture of any size at a time of the take, apart from what is on the page. */
  picture(
    width: number,
    height: number,
    time: number,
    overlay: Overlay,
    frame: (canvas: HTMLCanvasElement) => void,
  ): void {
    const { show } = this;
    const was = { ...show };
    const helper = this.gizmo.getHelper();
    const helped = helper.visible;
    helper.visible = false;
    Object.assign(show, { time, overlay, spacing: false, selected: null, obstacle: -1 });
    this.stage.resize(width, height, 1, true);
    this.ghostKey = "";
    this.draw();
    frame(this.canvas);
    Object.assign(show, was);
    helper.visible = helped;
    this.ghostKey = "";
    this.stage.resize(this.canvas.clientWidth, this.canvas.clientHeight);
    this.invalidate();
  }

  pause(): void {
    this.running = false;
  }
  resume(): void {
    this.running = true;
    this.last = performance.now();
    this.invalidate();
  }
}
