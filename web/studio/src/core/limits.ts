// What files and links may ask of this page: they come from strangers. Beyond these a message says so.

export const limits = {
  /** Characters of a scene or take. */
  text: 4_000_000,
  /** Characters of a link's packed part. */
  link: 200_000,
  bodies: 5000,
  obstacles: 2000,
  /** Points of all hulls together. */
  points: 20_000,
  /** s */
  duration: 600,
  inputs: 2000,
  /** Bytes of a mesh file. */
  mesh: 40_000_000,
} as const;

/** What is wrong with what a visitor brought: said as it is. */
export class InputError extends Error {
  constructor(message: string) {
    super(message);
    this.name = "InputError";
  }
}
