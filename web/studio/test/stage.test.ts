// The stage's rules without a picture: quality steps, sounds; and the studio's axes and code.
import Elastoon, { styleNames } from "elastoon";
import { Governor, qualities, voiceOf } from "stage";
import { execFileSync } from "node:child_process";
import { fileURLToPath } from "node:url";
import { beforeAll, describe, expect, test } from "vitest";
import { styleOf } from "../src/core/edit.ts";
import { ticks, tickText } from "../src/core/scale.ts";
import { cppSnippet, jsonSnippet, tsSnippet } from "../src/keep/snippet.ts";
import { fileStem } from "../src/keep/save.ts";

beforeAll(() => Elastoon.init());

describe("quality", () => {
  const feed = (governor: Governor, ms: number, frames: number) => {
    let changes = 0;
    for (let i = 0; i < frames; ++i) changes += governor.frame(ms) ? 1 : 0;
    return changes;
  };
  test("stays where frames are quick", () => {
    const governor = new Governor(0);
    expect(feed(governor, 16.7, 2000)).toBe(0);
    expect(governor.level).toBe(0);
  });
  test("goes down step by step where they are slow, to the last and no further", () => {
    const governor = new Governor(0);
    feed(governor, 40, 40);
    expect(governor.level).toBe(1);
    feed(governor, 40, 1000);
    expect(governor.level).toBe(qualities.length - 1);
  });
  test("goes down two at a time where they are very slow", () => {
    const governor = new Governor(0);
    feed(governor, 400, 12);
    expect(governor.level).toBe(2);
  });
  test("a step up that had to be taken back is not tried again", () => {
    const governor = new Governor(2);
    let changes = 0;
    // Quick at level 2 and below, slow above.
    for (let i = 0; i < 20_000; ++i) changes += governor.frame(governor.level < 2 ? 30 : 8) ? 1 : 0;
    expect(governor.level).toBe(2);
    expect(changes).toBe(2);
  });
  test("a pause is no slow frame, and a held quality stays", () => {
    const governor = new Governor(0);
    expect(governor.frame(60_000)).toBe(false);
    expect(feed(new Governor(1, true), 500, 500)).toBe(0);
  });
  test("each step asks for no more than the one before", () => {
    for (let i = 1; i < qualities.length; ++i) {
      const [before, now] = [qualities[i - 1]!, qualities[i]!];
      expect(now.pixelRatio).toBeLessThanOrEqual(before.pixelRatio);
      expect(now.shadowMap).toBeLessThanOrEqual(before.shadowMap);
      expect(now.occluders).toBeLessThanOrEqual(before.occluders);
    }
  });
});

test("harder is louder, larger is lower, softer wobbles more; all within what may be heard", () => {
  const hit = { speed: 5, length: 1, squash: 0.6, duration: 0.2 };
  expect(voiceOf({ ...hit, speed: 9 }).volume).toBeGreaterThan(voiceOf(hit).volume);
  expect(voiceOf({ ...hit, length: 4 }).pitch).toBeLessThan(voiceOf(hit).pitch);
  expect(voiceOf({ ...hit, squash: 0.2 }).wobble).toBeGreaterThan(voiceOf(hit).wobble);
  for (const speed of [-1, 0, 1e9]) {
    for (const length of [1e-9, 1e9]) {
      const { pitch, volume, seconds } = voiceOf({ speed, length, squash: -3, duration: 1e9 });
      expect(pitch).toBeGreaterThanOrEqual(40);
      expect(pitch).toBeLessThanOrEqual(900);
      expect(volume).toBeLessThanOrEqual(0.5);
      expect(seconds).toBeLessThanOrEqual(1);
    }
  }
});

test("axes have round numbers within the range", () => {
  expect(ticks(0, 8, 4)).toEqual([0, 2, 4, 6, 8]);
  expect(ticks(0.11, 0.29, 4)).toEqual([0.15, 0.2, 0.25]);
  expect(ticks(1, 1, 4)).toEqual([1]);
  expect(tickText(0.30000000000000004)).toBe("0.3");
});

test("the C++ code compiles, for every style", () => {
  const programs = styleNames.map((name) => {
    const [head, ...body] = cppSnippet(styleOf({ scene: { elastoon: 1 }, inputs: [] }, name)).split("\n");
    expect(head).toBe("#include <elastoon/style.h>");
    return `void ${name.replace(/-/g, "_")}() {\n${body.join("\n")}}\n`;
  });
  const source = `#include <elastoon/style.h>\n${programs.join("")}`;
  const include = fileURLToPath(new URL("../../../include", import.meta.url));
  execFileSync("g++", ["-std=c++20", "-fsyntax-only", "-Wall", "-Werror", "-I", include, "-x", "c++", "-"], { input: source });
});

test("the other code is what it says", () => {
  const style = styleOf({ scene: { elastoon: 1 }, inputs: [] }, "jelly");
  expect(tsSnippet(style)).toContain(`min_squash: ${style.min_squash}`);
  expect(JSON.parse(`{ ${jsonSnippet('my "style"', style)} }`).styles['my "style"'].min_squash).toBe(style.min_squash);
});

test("file names hold nothing but letters, digits and hyphens", () => {
  expect(fileStem("../../Throw <the> ball!")).toBe("throw-the-ball");
  expect(fileStem(undefined)).toBe("elastoon");
});
