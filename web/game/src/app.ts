// The course of the page: attract mode, play, pause, end; what the rules tell becomes picture, sound and text.
import type { Capability } from "../../stage/src/quality.ts";
import { Controls } from "./controls.ts";
import { type Engine, type Game, type GameEvent, kStep, type PlayInput, type State } from "./engine.ts";
import { Field } from "./field.ts";
import { Juice } from "./juice.ts";
import { blockColors, palette, rowColors } from "./looks.ts";
import { bitsOf, Particles } from "./particles.ts";
import { element, Screens } from "./screens.ts";
import { Sound } from "./sound.ts";
import { addScore, isBest, lastName, loadOptions, type Options, reach, reached, saveOptions } from "./store.ts";
import { Things } from "./things.ts";

export type Mode = "attract" | "playing" | "paused" | "over";

const kLongestFrame = 0.1; // s: after a pause of the browser the game goes on where it was
const kTopRow = 15.2, kRowPitch = 0.64;

const anySeed = () => crypto.getRandomValues(new Uint32Array(1))[0]!;

export class App {
  mode: Mode = "attract";
  /** The bot plays in the player's place: for tests. */
  bot = false;
  readonly options: Options = loadOptions();
  private game: Game;
  private state: State;
  private readonly field: Field;
  private readonly things: Things;
  private readonly particles = new Particles();
  private readonly juice = new Juice();
  private readonly sound = new Sound();
  private readonly screens: Screens;
  private readonly controls: Controls;
  private left = 0; // s not yet stepped
  private last = 0;
  private barred = { width: 0, height: 0 };
  private readonly names: readonly string[];

  constructor(private readonly engine: Engine, canvas: HTMLCanvasElement, capability: Capability) {
    this.names = engine.levelNames;
    this.game = this.attractGame();
    this.state = this.game.state;
    this.field = new Field(canvas, engine.sizes, capability, (lost) => {
      if (lost) this.pause();
    });
    this.things = new Things(engine.sizes);
    this.field.stage.scene.add(this.things.group, this.particles.group);
    this.screens = new Screens((what) => void this.does(what), this.options, (key) => this.optionChanged(key));
    const app = this;
    this.controls = new Controls(element("surface"), {
      toField: (x) => this.field.toField(x),
      get metresPerPixel() { return app.field.metresAcross / innerWidth; },
      halfWidth: engine.sizes.halfWidth,
      get paddleX() { return app.state.paddleX; },
      get playing() { return app.mode === "playing"; },
      pause: () => this.pause(),
      mute: () => this.toggleSound(),
    });
    element("pause").addEventListener("click", () => this.pause());
    element("mute").addEventListener("click", () => this.toggleSound());
    element<HTMLFormElement>("best").addEventListener("submit", (event) => this.keepScore(event));
    addEventListener("resize", () => this.resize());
    document.addEventListener("visibilitychange", () => document.hidden && this.pause());
    addEventListener("blur", () => this.pause());
    this.screens.showSound(this.options.sound);
    document.body.classList.toggle("moves", !this.options.reducedMotion);
    this.resize();
    this.showTitle();
  }

  private attractGame(): Game {
    const seed = anySeed();
    return this.engine.create(seed, this.options.gravity, seed % this.names.length, 0.96);
  }
  private take(game: Game): void {
    this.game.destroy();
    this.game = game;
    this.state = game.state;
    this.left = 0;
    this.particles.clear();
    this.juice.calm();
    this.controls.forget();
  }

  get snapshot(): State {
    return this.game.state;
  }
  get hash(): string {
    return this.game.hash;
  }
  get recording(): string {
    return this.game.recording;
  }

  // What the buttons do.
  private async does(what: string): Promise<void> {
    if (what === "play" || what === "again") {
      await this.sound.setOn(this.options.sound);
      this.start(what === "play" ? Number(element<HTMLSelectElement>("from").value) : 0);
    } else if (what === "resume") this.resume();
    else if (what === "back") this.screens.back();
    else if (what === "leave") this.showTitle();
  }
  start(level: number, seed = anySeed()): void {
    this.take(this.engine.create(seed, this.options.gravity, level));
    this.mode = "playing";
    this.screens.closeAll();
    this.resize();
    this.showBar(true);
  }
  pause(): void {
    if (this.mode !== "playing") return;
    this.mode = "paused";
    this.controls.forget();
    this.screens.show("paused");
    document.body.classList.remove("hides-pointer");
  }
  resume(): void {
    if (this.mode !== "paused") return;
    this.screens.closeAll();
    this.mode = "playing";
  }
  private showTitle(): void {
    this.mode = "attract";
    this.take(this.attractGame());
    this.showBar(false);
    this.screens.banner("");
    const select = element<HTMLSelectElement>("from");
    const most = Math.min(reached(), this.names.length - 1);
    select.replaceChildren(...this.names.slice(0, most + 1).map((name, i) => new Option(`${i + 1}  ${name}`,
      String(i))));
    select.value = String(most);
    element("title").classList.toggle("fresh", most === 0);
    select.parentElement!.hidden = most === 0;
    this.screens.closeAll();
    this.screens.show("title");
  }
  private end(): void {
    this.mode = "over";
    const { score, level, stage } = this.state;
    element("over-name").textContent = stage === "won" ? "You popped them all!" : "Game over";
    const place = `level ${level + 1} of ${this.names.length}: ${this.names[level]}`;
    element("result").textContent = `${score} points, ${place}.`;
    const best = isBest(score);
    element("best").hidden = !best;
    element<HTMLInputElement>("name").value = lastName();
    this.screens.banner("");
    this.screens.show("over");
    if (best) element("name").focus();
  }
  private keepScore(event: Event): void {
    event.preventDefault();
    const name = element<HTMLInputElement>("name").value.trim();
    if (name === "") return;
    const { score, level, gravity } = this.state;
    const place = addScore({ name, score, level: level + 1, gravity, date: new Date().toISOString().slice(0, 10) });
    element("best").hidden = true;
    this.screens.show("scores");
    this.screens.fillScores(place);
  }
  toggleSound(): void {
    this.options.sound = !this.options.sound;
    this.optionChanged("sound");
  }
  private optionChanged(key: keyof Options): void {
    saveOptions(this.options);
    if (key === "sound") {
      void this.sound.setOn(this.options.sound);
      this.screens.showSound(this.options.sound);
    }
    document.body.classList.toggle("moves", !this.options.reducedMotion);
    if (key === "gravity" && this.mode === "attract") this.take(this.attractGame());
  }

  private showBar(shown: boolean): void {
    element("hud").hidden = !shown;
    this.resize();
    this.updateBar();
  }
  private updateBar(): void {
    const { score, lives, level, combo } = this.state;
    element("score").textContent = String(score);
    element("combo").textContent = combo > 1 ? `×${combo}` : "";
    element("level").textContent = `${level + 1} · ${this.names[level]}`;
    this.screens.showLives(lives);
  }
  private resize(): void {
    const hud = element("hud").hidden ? 12 : 3.4 * parseFloat(getComputedStyle(document.documentElement).fontSize) + 4;
    // A thumb's room under the paddle.
    const bottom = innerWidth < innerHeight && matchMedia("(pointer: coarse)").matches ? Math.min(110,
      innerHeight * 0.13) : 10;
    this.field.resize(innerWidth, innerHeight, { top: hud, bottom });
    this.barred = { width: innerWidth, height: innerHeight };
    this.field.render({ x: 0, y: 0 });
    const { left, right } = this.field.sides;
    element("hud").style.setProperty("--field-width", `${Math.round(right - left + 30)}px`);
  }

  // The course of time.
  frame(now: number): void {
    const elapsed = Math.min(Math.max((now - this.last) / 1000, 0), kLongestFrame);
    const watched = now - this.last;
    this.last = now;
    if (this.barred.width !== innerWidth || this.barred.height !== innerHeight) this.resize();
    const goes = this.mode === "playing" || (this.mode === "attract" && !this.options.reducedMotion);
    if (goes) this.pass(this.juice.pass(elapsed));
    this.particles.update(this.mode === "paused" ? 0 : elapsed);
    this.things.update(this.game, Math.min(1, this.left / kStep), goes ? elapsed : 0, this.hasBits);
    if (this.field.stage.watch(watched)) this.resize();
    this.field.render(this.hasShake ? this.juice.offset : { x: 0, y: 0 });
    document.body.classList.toggle("hides-pointer", this.mode === "playing" && this.state.stage === "playing");
  }
  /** Lets the game go on for so many seconds. */
  pass(seconds: number): void {
    this.left += seconds;
    while (this.left >= kStep && (this.mode === "playing" || this.mode === "attract")) {
      this.left -= kStep;
      this.step();
    }
  }
  private step(): void {
    if (this.mode === "attract" || this.bot) this.game.stepBot();
    else {
      const input: PlayInput = this.controls.input();
      this.game.step(input);
      this.controls.taken();
    }
    const events = this.game.events();
    if (events.length > 0 || this.game.state.stage !== this.state.stage) {
      this.state = this.game.state;
      for (const event of events) this.tell(event);
      this.updateBar();
    } else if (this.mode === "playing") {
      this.state = this.game.state;
    }
    if (this.state.stage === "lost" || this.state.stage === "won") {
      if (this.mode === "attract") this.take(this.attractGame());
      else this.end();
    }
  }

  private get hasBits(): boolean {
    return this.options.particles && !this.options.reducedMotion;
  }
  private get hasShake(): boolean {
    return this.options.shake && !this.options.reducedMotion;
  }
  private jolt(speed: number, weight: number): void {
    const stops = this.options.hitStop && !this.options.reducedMotion && this.mode === "playing";
    this.juice.hit(speed, weight, this.hasShake, stops);
  }
  private colorOf(event: GameEvent): number {
    if (event.block !== "plain") return blockColors[event.block];
    return rowColors[Math.max(0, Math.round((kTopRow - event.y) / kRowPitch)) % rowColors.length]!;
  }

  private tell(event: GameEvent): void {
    const { kind, x, y, speed } = event;
    const plays = this.mode === "playing";
    const bits = (color: number, count: number, fast: number, way = { x: 0, y: 0 }) => {
      if (this.hasBits) this.particles.burst(x, y, color, count, fast, way);
    };
    const away = { x: event.normalX * 0.7, y: event.normalY * 0.7 };
    const note = (name: string, large: boolean) => {
      const at = this.field.toPage(x, y);
      if (plays) this.screens.popup(name, at.x, at.y, large, this.options.reducedMotion);
    };
    switch (kind) {
      case "levelBegun":
        if (plays) {
          const hint = event.value === 0 ? "Click, tap or press Space" : `Level ${event.value + 1}`;
          this.screens.banner(this.names[event.value]!, hint, 2.4);
        }
        if (plays && !this.bot) reach(event.value);
        break;
      case "launched":
        this.screens.banner("");
        if (plays) this.sound.hit(9);
        break;
      case "wallHit":
        bits(palette.wall, Math.round(bitsOf(speed) / 3), 3, away);
        if (plays) this.sound.hit(speed * 0.5);
        break;
      case "paddleHit":
        bits(palette.cream, bitsOf(speed), 4.5, away);
        this.jolt(speed, 0.5);
        if (plays) this.sound.hit(speed);
        break;
      case "blockHit":
        bits(this.colorOf(event), bitsOf(speed), 4, away);
        this.jolt(speed, event.block === "stone" ? 1.1 : 0.9);
        if (plays) this.sound.hit(speed, event.block);
        break;
      case "popped":
        bits(this.colorOf(event), 14, 5.5);
        if (this.hasBits) this.particles.ring(x, y, this.colorOf(event), 1);
        note(this.state.combo > 1 ? `${event.value}` : String(event.value), this.state.combo >= 4);
        if (plays) this.sound.pop(this.state.combo);
        break;
      case "exploded":
        bits(palette.spark, 26, 9);
        bits(0xff8a4c, 12, 6);
        if (this.hasBits) this.particles.ring(x, y, palette.spark, 2.4);
        this.jolt(26, 1.8);
        if (plays) this.sound.boom();
        break;
      case "ballLost":
        bits(palette.ball, 10, 5, { x: 0, y: 1 });
        break;
      case "lifeLost":
        this.jolt(20, 1);
        if (plays) {
          this.sound.lost();
          if (event.value > 0) this.screens.banner(event.value === 1 ? "Last ball" : `${event.value} balls left`, "",
            1.4);
        }
        break;
      case "ballAdded":
        note("Another ball!", true);
        if (plays) this.sound.gift();
        break;
      case "widened":
        note("Wide!", true);
        if (plays) this.sound.gift();
        break;
      case "lifeGained":
        note("+1 life", true);
        if (plays) this.sound.gift();
        break;
      case "levelCleared":
        if (plays) {
          this.screens.banner("Level cleared", `${this.state.score} points`, 1.9);
          this.sound.fanfare();
        }
        break;
      default:
        break;
    }
  }
}
