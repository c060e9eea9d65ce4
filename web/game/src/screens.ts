// The page's dialogs and its bar: what is open, what they show. Knows nothing of the rules.
import { type BlockKind, blockKinds } from "./engine.ts";
import { blockColors, blockNames, css, drawSign, palette } from "./looks.ts";
import { loadScores, type Options } from "./store.ts";

export type ScreenName = "title" | "help" | "options" | "scores" | "paused" | "over" | "trouble";

export const element = <T extends HTMLElement = HTMLElement>(id: string) => document.getElementById(id) as T;

const toggles: { key: keyof Options; name: string; tells: string }[] = [
  { key: "sound", name: "Sound", tells: "springs, pops and a bang" },
  { key: "gravity", name: "Gravity", tells: "balls fly in arcs; from the next game on" },
  { key: "hitStop", name: "Hit-stop", tells: "a blink of stillness at a hard hit" },
  { key: "shake", name: "Camera shake", tells: "a little, at a hard hit" },
  { key: "particles", name: "Bits and trails", tells: "what flies off, what follows the ball" },
  { key: "reducedMotion", name: "Reduced motion", tells: "none of the three above, and still menus" },
];

const icons = {
  pause: `<path d="M8 5v14M16 5v14" stroke="currentColor" stroke-width="3.4" stroke-linecap="round"/>`,
  sound: `<path d="M4 9.5v5h3.5L12 19V5L7.5 9.5Z" fill="currentColor"/><path fill="none"
    d="M15.5 9a4 4 0 0 1 0 6M18 6.5a8 8 0 0 1 0 11" stroke="currentColor" stroke-width="2" stroke-linecap="round"/>`,
  silent: `<path d="M4 9.5v5h3.5L12 19V5L7.5 9.5Z" fill="currentColor"/><path d="m16 9.5 5 5m0-5-5 5" fill="none"
    stroke="currentColor" stroke-width="2" stroke-linecap="round"/>`,
};
const svg = (icon: keyof typeof icons) => `<svg viewBox="0 0 24 24" aria-hidden="true">${icons[icon]}</svg>`;

/** A block as it looks, for the help. */
function blockPicture(kind: BlockKind): HTMLCanvasElement {
  const [width, height] = [144, 78];
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  const c = canvas.getContext("2d")!;
  const round = kind === "explosive" || kind === "ball";
  c.fillStyle = css(blockColors[kind]);
  c.beginPath();
  if (round) c.arc(width / 2, height / 2 + 4, 32, 0, 7);
  else c.roundRect(4, 4, width - 8, height - 8, 18);
  c.fill();
  if (kind === "ball") {
    c.fillStyle = css(palette.ball);
    c.beginPath();
    c.arc(width / 2, height / 2 + 4, 17, 0, 7);
    c.fill();
  } else if (kind === "explosive") {
    c.strokeStyle = "#d8c49a";
    c.lineWidth = 6;
    c.beginPath();
    c.moveTo(width / 2 + 8, 14);
    c.quadraticCurveTo(width / 2 + 12, 2, width / 2 + 30, 6);
    c.stroke();
    c.fillStyle = "rgba(255,255,255,0.3)";
    c.beginPath();
    c.arc(width / 2 - 10, height / 2 - 8, 8, 0, 7);
    c.fill();
  }
  const sign = drawSign(kind, width - 16, height - 12);
  if (sign !== undefined) c.drawImage(sign, 8, 6);
  return canvas;
}

export class Screens {
  private readonly open: ScreenName[] = [];

  constructor(private readonly does: (what: string) => void, private readonly options: Options,
    private readonly changed: (key: keyof Options) => void) {
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-do]")) {
      button.addEventListener("click", () => does(button.dataset["do"]!));
    }
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-open]")) {
      button.addEventListener("click", () => this.show(button.dataset["open"] as ScreenName));
    }
    for (const dialog of document.querySelectorAll("dialog")) {
      dialog.addEventListener("cancel", (event) => {
        event.preventDefault();
        this.escape();
      });
    }
    document.querySelectorAll<HTMLElement>(".logo span").forEach((letter, i) => letter.style.setProperty("--i",
      String(i)));
    element("pause").innerHTML = svg("pause");
    this.fillKinds();
    this.fillToggles();
  }

  get top(): ScreenName | undefined {
    return this.open.at(-1);
  }
  show(name: ScreenName): void {
    if (name === "scores") this.fillScores();
    if (name === "options") this.fillToggles();
    if (this.top !== undefined) element<HTMLDialogElement>(this.top).close();
    this.open.push(name);
    element<HTMLDialogElement>(name).showModal();
  }
  back(): void {
    const name = this.open.pop();
    if (name !== undefined) element<HTMLDialogElement>(name).close();
    if (this.top !== undefined) element<HTMLDialogElement>(this.top).showModal();
  }
  closeAll(): void {
    if (this.top !== undefined) element<HTMLDialogElement>(this.top).close();
    this.open.length = 0;
  }
  private escape(): void {
    if (this.top === "paused") this.does("resume");
    else if (this.top !== undefined && !["title", "over", "trouble"].includes(this.top)) this.back();
  }

  private fillKinds(): void {
    element("kinds").replaceChildren(...blockKinds.map((kind) => {
      const item = document.createElement("li");
      const text = document.createElement("span");
      text.append(blockNames[kind].name);
      const does = document.createElement("small");
      does.textContent = blockNames[kind].does;
      text.append(does);
      item.append(blockPicture(kind), text);
      return item;
    }));
  }
  private fillToggles(): void {
    element("toggles").replaceChildren(...toggles.map(({ key, name, tells }) => {
      const label = document.createElement("label");
      label.className = "toggle";
      const text = document.createElement("span");
      text.append(name);
      const small = document.createElement("small");
      small.textContent = tells;
      text.append(small);
      const box = document.createElement("input");
      box.type = "checkbox";
      box.setAttribute("role", "switch");
      box.name = key;
      box.checked = this.options[key];
      box.addEventListener("change", () => {
        this.options[key] = box.checked;
        this.changed(key);
      });
      label.append(text, box);
      return label;
    }));
  }
  fillScores(newest = -1): void {
    const scores = loadScores();
    if (scores.length === 0) {
      element("table").textContent = "None yet. Yours could be the first.";
      return;
    }
    const table = document.createElement("table");
    table.innerHTML = `<thead><tr><th scope="col"><span class="unseen">Place</span></th><th scope="col">Name</th>
      <th scope="col">Level</th><th scope="col">Score</th></tr></thead><tbody></tbody>`;
    table.tBodies[0]!.append(...scores.map((score, i) => {
      const row = document.createElement("tr");
      row.className = i === newest ? "new" : "";
      for (const text of [i + 1, score.name, `${score.level}${score.gravity ? " ↓" : ""}`, score.score]) {
        row.insertCell().textContent = String(text);
      }
      return row;
    }));
    element("table").replaceChildren(table);
  }

  showSound(on: boolean): void {
    const button = element("mute");
    button.innerHTML = svg(on ? "sound" : "silent");
    button.setAttribute("aria-pressed", String(on));
  }
  showLives(lives: number): void {
    const box = element("lives");
    box.setAttribute("aria-label", `${lives} ${lives === 1 ? "life" : "lives"}`);
    box.replaceChildren(...Array.from({ length: Math.max(3, lives) }, (_, i) => {
      const dot = document.createElement("i");
      dot.className = i < lives ? "" : "gone";
      return dot;
    }));
  }

  private bannerTimer = 0;
  /** A few words in the middle for some seconds; 0: until the next. */
  banner(large: string, small = "", seconds = 1.6): void {
    const box = element("banner");
    clearTimeout(this.bannerTimer);
    if (large === "") {
      box.classList.remove("shown");
      return;
    }
    const strong = document.createElement("b");
    strong.textContent = large;
    box.replaceChildren(strong, small);
    box.classList.add("shown");
    if (seconds > 0) this.bannerTimer = window.setTimeout(() => box.classList.remove("shown"), 1000 * seconds);
  }
  /** Points that rise from where they were made. */
  popup(text: string, x: number, y: number, big: boolean, still: boolean): void {
    const box = element("popups");
    if (box.childElementCount > 12) box.firstElementChild?.remove();
    const span = document.createElement("span");
    span.textContent = text;
    span.className = big ? "big" : "";
    box.append(span);
    const at = (rise: number, size: number) => `translate(${x}px, ${y - rise}px) translate(-50%, -50%) scale(${size})`;
    const animation = span.animate(still ? [{ transform: at(0, 1), opacity: 1 }, { transform: at(0, 1), opacity: 0 }] :
      [{ transform: at(0, 0.5), opacity: 0 }, { transform: at(14, 1.25), opacity: 1, offset: 0.18 },
        { transform: at(20, 1), opacity: 1, offset: 0.6 }, { transform: at(34, 0.9), opacity: 0 }],
    { duration: 750, easing: "ease-out" });
    animation.onfinish = () => span.remove();
  }
}
