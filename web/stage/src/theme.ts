// The stage's colours and lights, dark and light. Pages take their CSS from the same names.

export type ThemeName = "light" | "dark";

export interface Theme {
  /** The backdrop, from the top of the picture to its horizon, sRGB. */
  readonly sky: number;
  readonly horizon: number;
  readonly floor: number;
  readonly grid: number;
  /** A solid that names no colour. */
  readonly solid: number;
  readonly accent: number;
  readonly danger: number;
  /** The light parts of a pattern. */
  readonly cream: number;
  readonly ambient: number;
  readonly sun: number;
}

export const themes: Readonly<Record<ThemeName, Theme>> = {
  light: {
    sky: 0xeef1f6,
    horizon: 0xf7f4ee,
    floor: 0xf3eee4,
    grid: 0xcfc6b6,
    solid: 0xb8b2a8,
    accent: 0xd9480f,
    danger: 0xc92a2a,
    cream: 0xfff4e0,
    ambient: 1.55,
    sun: 2.5,
  },
  dark: {
    sky: 0x12151c,
    horizon: 0x1d222c,
    floor: 0x465066,
    grid: 0x65728e,
    solid: 0x7d889e,
    accent: 0xff8a4c,
    danger: 0xff6b6b,
    cream: 0xffedd2,
    ambient: 1.5,
    sun: 2.6,
  },
};

/** What the system asks for. */
export function systemTheme(): ThemeName {
  return globalThis.matchMedia?.("(prefers-color-scheme: dark)").matches === true ? "dark" : "light";
}
