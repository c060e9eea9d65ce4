// The scenes that come with the page: those of the repository, and one that is made here.
import { styleNames } from "elastoon";
import { palette } from "./edit.js";
import { sceneText, type SceneBody, type SceneFile } from "./take.js";

const files = import.meta.glob(
  ["../../../../scenes/*.json", "../../../../scenes/contacts/*.json", "../../../../scenes/figures/*.json"],
  { query: "?raw", import: "default", eager: true },
) as Record<string, string>;

export interface GalleryScene {
  readonly id: string;
  readonly title: string;
  readonly note: string;
  readonly group: "Play" | "The paper's figures" | "Contacts" | "Many";
  /** Made when it is asked for. */
  readonly text: () => string;
}

function fileText(name: string): string {
  const text = files[`../../../../scenes/${name}.json`];
  if (text === undefined) throw new Error(`there is no scene ${name}`);
  return text;
}

/** The first thing that a visitor sees. */
function welcome(): string {
  const scene: SceneFile = {
    elastoon: 1,
    name: "Throw the ball",
    duration: 8,
    shapes: {
      ball: { type: "sphere", radius: 0.5 },
      block: { type: "box", size: [1.6, 1, 2.4] },
      low: { type: "box", size: [1.6, 0.5, 2.4] },
    },
    styles: { bouncy: { restitution: 0.78, max_stretch: 2, min_squash: 0.45, stretch_rate: 0.16, rest_speed: 0.5 } },
    bodies: [
      {
        name: "ball",
        shape: "ball",
        style: "bouncy",
        position: [-4.2, 3.4, 0],
        velocity: [2.1, 3.4, 0],
        color: "#e4572e",
      },
    ],
    obstacles: [
      { name: "floor", type: "plane", normal: [0, 1, 0], offset: 0 },
      { name: "step", shape: "low", position: [2.2, 0.25, 0], color: "#8fb3c4" },
      { name: "block", shape: "block", position: [3.8, 0.5, 0], color: "#5f93ab" },
      { name: "back wall", type: "plane", normal: [-1, 0, 0], offset: -7.5 },
      { name: "left wall", type: "plane", normal: [1, 0, 0], offset: -7.5 },
    ],
    camera: { eye: [0.5, 3.2, 13.4], target: [0, 2.2, 0], fov: 30 },
  };
  return sceneText(scene);
}

function presets(): string {
  const bodies = styleNames.map((style, i): SceneBody => ({
    name: style,
    shape: "ball",
    style,
    position: [1.25 * (i - (styleNames.length - 1) / 2), 4, 0],
    color: palette[i % palette.length]!,
  }));
  return sceneText({
    elastoon: 1,
    name: "Presets side by side",
    duration: 6,
    shapes: { ball: { type: "sphere", radius: 0.45 } },
    bodies,
    obstacles: [{ name: "floor", type: "plane", normal: [0, 1, 0], offset: 0 }],
    camera: { eye: [0, 3.4, 22], target: [0, 2.2, 0], fov: 30 },
  });
}

/** Bodies that rain on a field of pegs, in rows. */
function rain(count: number): string {
  const across = Math.ceil(Math.sqrt(count * 1.6));
  const styles = ["jelly", "rubber-ball", "super-ball", "water-balloon", "beach-ball"];
  const shapes = ["ball", "box", "can"];
  const bodies = Array.from({ length: count }, (_, i): SceneBody => ({
    shape: shapes[i % shapes.length]!,
    style: styles[i % styles.length]!,
    color: palette[i % palette.length]!,
    position: [(i % across) - across / 2, 4 + ((i * 7919) % 97) / 7, Math.floor(i / across) - count / across / 2],
    velocity: [((i * 31) % 17) / 8 - 1, 0, ((i * 57) % 13) / 6 - 1],
  }));
  const [columns, rows] = count > 500 ? [6, 4] : [3, 2];
  const pegs = Array.from({ length: columns * rows }, (_, i) => ({
    shape: "peg",
    color: "#8fb3c4",
    position: [
      (((i % columns) - (columns - 1) / 2) * across) / (columns + 0.5),
      0,
      ((Math.floor(i / columns) - (rows - 1) / 2) * across) / (columns + 1),
    ] as const,
  }));
  return sceneText({
    elastoon: 1,
    name: `Rain: ${count} bodies`,
    duration: 10,
    shapes: {
      ball: { type: "sphere", radius: 0.3 },
      box: { type: "box", size: [0.6, 0.4, 0.4] },
      can: { type: "cylinder", radius: 0.2, length: 0.6 },
      peg: { type: "sphere", radius: 1.6 },
    },
    bodies,
    obstacles: [{ name: "floor", type: "plane", normal: [0, 1, 0], offset: 0 }, ...pegs],
    camera: { eye: [0, across * 0.55, across * 1.1], target: [0, 2, 0], fov: 35 },
  });
}

function fromFile(id: string, title: string, group: GalleryScene["group"], note: string): GalleryScene {
  return { id, title, group, note, text: () => fileText(id) };
}

export const gallery: readonly GalleryScene[] = [
  { id: "welcome", title: "Throw the ball", group: "Play", note: "A ball, two blocks, two walls", text: welcome },
  fromFile("hello", "Five solids", "Play", "They drop, squash, and hop to rest"),
  fromFile("stairs", "Stairs", "Play", "A ball and a can on their way down"),
  fromFile("pachinko", "Pachinko", "Play", "Balls among pins"),
  { id: "presets", title: "Presets side by side", group: "Play", note: "One drop, all styles", text: presets },
  fromFile("figures/1-bouncing-ball", "Figure 1", "The paper's figures", "The bouncing ball"),
  fromFile("figures/2-stiff-cylinder", "Figure 2", "The paper's figures", "A cylinder, light and stiff"),
  fromFile("figures/3-soft-cylinder", "Figure 3", "The paper's figures", "The same, soft and heavy"),
  fromFile("figures/5-angled-cylinder", "Figure 5", "The paper's figures", "A cylinder strikes at an angle"),
  fromFile("figures/6-left-corner", "Figure 6, left", "The paper's figures", "Into the corner, and back"),
  fromFile("figures/6-right-corner", "Figure 6, right", "The paper's figures", "Wall first, then floor"),
  fromFile("figures/7-floor-then-wall", "Figure 7", "The paper's figures", "Floor, then wall"),
  fromFile("contacts/corner", "Corner of a room", "Contacts", "A can meets two walls"),
  fromFile("contacts/slide", "Slide", "Contacts", "Along a table and off its edge"),
  fromFile("contacts/skip", "Skips", "Contacts", "Grazing touches"),
  fromFile("contacts/press", "Press", "Contacts", "A plate comes down and lets go"),
  fromFile("contacts/rest", "Coming to rest", "Contacts", "The last hops"),
  { id: "pile", title: "Rain, 200", group: "Many", note: "Bodies among domes", text: () => rain(200) },
  { id: "rain", title: "Rain, 2000", group: "Many", note: "For a graphics card", text: () => rain(2000) },
];
