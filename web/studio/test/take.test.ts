// Takes, links and history: what is read comes back, what is hostile is refused with the place.
import Elastoon from "elastoon";
import { deflateSync, strToU8 } from "fflate";
import { beforeAll, describe, expect, test } from "vitest";
import { History } from "../src/core/history.ts";
import { limits } from "../src/core/limits.ts";
import { linkTo, packedIn, packTake, unpackTake } from "../src/core/link.ts";
import { freshName, prettyJson, readTake, type SceneFile, type Take, takeText, withInput } from "../src/core/take.ts";

beforeAll(() => Elastoon.init());

const scene: SceneFile = {
  elastoon: 1,
  name: 'A ball "quoted" <b>',
  duration: 4,
  shapes: { ball: { type: "sphere", radius: 0.5 } },
  styles: { soft: { min_squash: 0.3 } },
  bodies: [{ name: "b", shape: "ball", style: "soft", position: [0, 3, 0], color: "#e4572e" }],
  obstacles: [{ type: "plane", normal: [0, 1, 0] }],
};
const take: Take = {
  scene,
  inputs: [
    { kind: "throw", step: 30, body: "b", position: [0, 2, 0], velocity: [1, 2, 0] },
    { kind: "arrival", step: 60, body: { name: "c", shape: "ball", position: [2, 3, 0] } },
  ],
};
const base64url = (bytes: Uint8Array) => Buffer.from(bytes).toString("base64url");

describe("files", () => {
  test("a take comes back as it was", () => {
    expect(readTake(takeText(take))).toEqual(take);
    expect(readTake(takeText({ scene, inputs: [] }))).toEqual({ scene, inputs: [] });
  });
  test("a scene without inputs is a plain scene file", () => {
    expect(JSON.parse(takeText({ scene, inputs: [] }))).toEqual(scene);
  });
  test.each([
    ["{", /not JSON/],
    ["[]", /JSON object/],
    ["{}", /elastoon/],
    ['{"elastoon":1,"bodys":[]}', /bodies/],
    [JSON.stringify({ ...scene, bodies: [{ shape: "bal" }] }), /\/bodies\/0\/shape.*"ball"/],
    [JSON.stringify({ take: 2, scene }), /\/take/],
    [JSON.stringify({ take: 1, scene, input: [] }), /\/input: unknown/],
    [JSON.stringify({ take: 1, scene, inputs: {} }), /\/inputs: must be a list/],
    [JSON.stringify({ take: 1, scene, inputs: [{ kind: "boom", step: 1 }] }), /\/inputs\/0\/kind/],
    [JSON.stringify({ take: 1, scene, inputs: [{ ...take.inputs[0], step: -1 }] }), /\/inputs\/0\/step/],
    [JSON.stringify({ take: 1, scene, inputs: [{ ...take.inputs[0], velocity: [1e99, 0, 0] }] }), /velocity/],
    [JSON.stringify({ take: 1, scene, inputs: [{ ...take.inputs[0], body: "nobody" }] }), /no body "nobody"/],
    [JSON.stringify({ take: 1, scene, inputs: [take.inputs[1], take.inputs[0]] }), /order/],
    [JSON.stringify({ take: 1, scene, inputs: [{ ...take.inputs[1], body: { name: "b", shape: "ball" } }] }), /taken/],
    [
      JSON.stringify({ take: 1, scene, inputs: [{ ...take.inputs[1], body: { name: "c", shape: "x" } }] }),
      /come in.*shape/,
    ],
    [JSON.stringify({ ...scene, duration: 1e5 }), /\/duration/],
    [JSON.stringify({ ...scene, bodies: new Array(limits.bodies + 1).fill({ shape: "ball" }) }), /\/bodies: there are/],
    [`"${"x".repeat(limits.text)}"`, /characters/],
  ])("refused: %.60s", (text, words) => {
    expect(() => readTake(text)).toThrow(words);
  });
  test("JSON for people is the same JSON", () => {
    const value = { a: 'x": {,}', list: Array.from({ length: 60 }, (_, i) => ({ i, deep: [i, [i]] })), empty: {} };
    expect(JSON.parse(prettyJson(value))).toEqual(value);
    expect(prettyJson({ a: [1, 2] })).toBe('{ "a": [1, 2] }');
  });
});

describe("links", () => {
  test("a link holds the whole take", () => {
    const link = linkTo(take, "https://example.org/studio/?x#old");
    const packed = packedIn(new URL(link).hash);
    expect(packed).toBe(packTake(take));
    expect(readTake(unpackTake(packed!))).toEqual(take);
  });
  test("links that are damaged or too large are refused", () => {
    const packed = packTake(take);
    expect(() => unpackTake(`${packed}<`)).toThrow(/damaged/);
    expect(() => unpackTake(packed.slice(0, packed.length / 2))).toThrow(/damaged/);
    expect(() => unpackTake("a".repeat(limits.link + 1))).toThrow(/characters/);
    expect(() => unpackTake(base64url(strToU8("no deflate at all, is it?")))).toThrow(/damaged/);
    expect(() => unpackTake(base64url(deflateSync(new Uint8Array(limits.text + 1))))).toThrow(/larger/);
    expect(packedIn("#other")).toBeNull();
  });
});

test("an input ends what came after it", () => {
  const thrown = withInput(take, { kind: "throw", step: 45, body: "b", position: [0, 1, 0], velocity: [0, 0, 0] });
  expect(thrown.inputs.map((input) => input.step)).toEqual([30, 45]);
  const again = withInput(thrown, { kind: "throw", step: 45, body: "b", position: [0, 1, 0], velocity: [9, 0, 0] });
  expect(again.inputs).toHaveLength(2);
});

test("names are given once", () => {
  expect(freshName(["ball", "ball 2"], "ball")).toBe("ball 3");
  expect(freshName([], "ball")).toBe("ball");
});

test("undo takes a gesture back as a whole", () => {
  const history = new History(0);
  history.push(1);
  [2, 3, 4].forEach((value) => history.push(value, "slider"));
  history.settle();
  history.push(5, "slider");
  expect(history.undo() && history.value).toBe(4);
  expect(history.undo() && history.value).toBe(1);
  expect(history.redo() && history.value).toBe(4);
  history.push(9);
  expect(history.canRedo).toBe(false);
  expect([history.undo(), history.undo(), history.undo(), history.undo()]).toEqual([true, true, true, false]);
  expect(history.value).toBe(0);
});
