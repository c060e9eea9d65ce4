// What the things of the game look like: colours, and the signs on the blocks' faces.
import { CanvasTexture, SRGBColorSpace, type Texture } from "three";
import type { BlockKind } from "./engine.ts";

export const palette = {
  page: 0x1b2533,
  plate: 0x35486a,
  wall: 0x566b8c,
  ball: 0xff6f4d,
  cream: 0xfff1dc,
  paddle: 0xf7f1e5,
  paddleStripe: 0x2fb5a5,
  spark: 0xffd27a,
} as const;

/** Of plain blocks, by row from the top. */
export const rowColors = [0xf49aa8, 0xf7b58a, 0xf6cf7a, 0xa9d68c, 0x7fcfc2, 0x84b9ec, 0xb3a1ea, 0xe39ad0] as const;

export const blockColors: Record<BlockKind, number> = {
  plain: 0x84b9ec,
  tough: 0x9aa9bd,
  jelly: 0x5fd08a,
  moving: 0xf6cf7a,
  explosive: 0x5b4f66,
  ball: 0x9fd8f4,
  wide: 0xb3a1ea,
  heart: 0xf2748c,
  stone: 0x7d8896,
};

export const blockNames: Record<BlockKind, { name: string; does: string }> = {
  plain: { name: "Plain", does: "pops at a touch" },
  tough: { name: "Tin", does: "takes two" },
  jelly: { name: "Jelly", does: "takes two, throws back faster" },
  moving: { name: "Rover", does: "goes to and fro" },
  explosive: { name: "Bomb", does: "takes its neighbours along" },
  ball: { name: "Egg", does: "lets another ball out" },
  wide: { name: "Stretcher", does: "widens the paddle" },
  heart: { name: "Heart", does: "one more life" },
  stone: { name: "Stone", does: "stays" },
};

const kSign = 192; // pixels across a block's face

type Draw = (c: CanvasRenderingContext2D, w: number, h: number) => void;

const dark = "rgba(28, 34, 48, 0.62)";
const light = "rgba(255, 255, 255, 0.85)";

function arrow(c: CanvasRenderingContext2D, x: number, y: number, way: number, size: number): void {
  c.beginPath();
  c.moveTo(x + way * size, y);
  c.lineTo(x - way * size * 0.3, y - size * 0.9);
  c.lineTo(x - way * size * 0.3, y + size * 0.9);
  c.closePath();
  c.fill();
}

function rivets(c: CanvasRenderingContext2D, w: number, h: number): void {
  c.fillStyle = "rgba(255, 255, 255, 0.75)";
  for (const x of [0.1, 0.9]) {
    for (const y of [0.2, 0.8]) {
      c.beginPath();
      c.arc(x * w, y * h, 0.06 * h, 0, 7);
      c.fill();
    }
  }
}

const signs: Partial<Record<BlockKind | "cracked", Draw>> = {
  tough: (c, w, h) => {
    rivets(c, w, h);
    c.strokeStyle = "rgba(255, 255, 255, 0.4)";
    c.lineWidth = 5;
    c.strokeRect(0.2 * w, 0.3 * h, 0.6 * w, 0.4 * h);
  },
  cracked: (c, w, h) => {
    rivets(c, w, h);
    c.strokeStyle = dark;
    c.lineWidth = 6;
    c.lineJoin = "round";
    c.beginPath();
    for (const [i, [x, y]] of [[0.32, 0], [0.42, 0.3], [0.36, 0.5], [0.52, 0.68], [0.46, 1]].entries()) {
      c[i === 0 ? "moveTo" : "lineTo"](x! * w, y! * h);
    }
    c.moveTo(0.36 * w, 0.5 * h);
    c.lineTo(0.2 * w, 0.62 * h);
    c.moveTo(0.42 * w, 0.3 * h);
    c.lineTo(0.66 * w, 0.2 * h);
    c.lineTo(0.8 * w, 0.34 * h);
    c.stroke();
  },
  jelly: (c, w, h) => {
    c.fillStyle = "rgba(255, 255, 255, 0.55)";
    c.beginPath();
    c.ellipse(0.22 * w, 0.28 * h, 0.12 * w, 0.1 * h, -0.2, 0, 7);
    c.ellipse(0.4 * w, 0.22 * h, 0.03 * w, 0.05 * h, 0, 0, 7);
    c.fill();
    c.strokeStyle = "rgba(20, 70, 45, 0.6)";
    c.lineWidth = 7;
    c.lineCap = "round";
    c.beginPath();
    for (let i = 0; i <= 24; ++i) {
      c[i === 0 ? "moveTo" : "lineTo"]((0.24 + 0.52 * i / 24) * w, (0.64 + 0.1 * Math.sin(i * 0.95)) * h);
    }
    c.stroke();
  },
  moving: (c, w, h) => {
    c.fillStyle = dark;
    arrow(c, 0.3 * w, 0.5 * h, -1, 0.2 * h);
    arrow(c, 0.7 * w, 0.5 * h, 1, 0.2 * h);
    c.fillRect(0.38 * w, 0.46 * h, 0.24 * w, 0.08 * h);
  },
  wide: (c, w, h) => {
    c.fillStyle = light;
    c.beginPath();
    c.roundRect(0.3 * w, 0.42 * h, 0.4 * w, 0.18 * h, 8);
    c.fill();
    arrow(c, 0.17 * w, 0.51 * h, -1, 0.17 * h);
    arrow(c, 0.83 * w, 0.51 * h, 1, 0.17 * h);
  },
  heart: (c, w, h) => {
    c.fillStyle = light;
    c.beginPath();
    c.moveTo(0.5 * w, 0.8 * h);
    c.bezierCurveTo(0.2 * w, 0.5 * h, 0.36 * w, 0.1 * h, 0.5 * w, 0.34 * h);
    c.bezierCurveTo(0.64 * w, 0.1 * h, 0.8 * w, 0.5 * h, 0.5 * w, 0.8 * h);
    c.fill();
  },
  stone: (c, w, h) => {
    c.fillStyle = "rgba(0, 0, 0, 0.16)";
    for (const [x, y, r] of [[0.2, 0.3, 0.09], [0.72, 0.62, 0.12], [0.48, 0.36, 0.06], [0.3, 0.74, 0.06],
      [0.86, 0.24, 0.05]]) {
      c.beginPath();
      c.ellipse(x! * w, y! * h, r! * h * 1.3, r! * h, 0.3, 0, 7);
      c.fill();
    }
  },
};

/** The sign of a kind on a clear ground; undefined where it has none. */
export function drawSign(kind: BlockKind | "cracked", width: number, height: number): HTMLCanvasElement | undefined {
  const draw = signs[kind];
  if (draw === undefined) return undefined;
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d")!;
  draw(context, width, height);
  return canvas;
}

export function signTexture(kind: BlockKind | "cracked", aspect: number): Texture | undefined {
  const canvas = drawSign(kind, kSign, Math.round(kSign / aspect));
  if (canvas === undefined) return undefined;
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 4;
  return texture;
}

export const css = (color: number) => `#${color.toString(16).padStart(6, "0")}`;
