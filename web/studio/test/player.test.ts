// The time line: what is scrubbed to is what was played, to the bit, and what the command line says.
import Elastoon from "elastoon";
import { readFileSync } from "node:fs";
import { beforeAll, expect, test } from "vitest";
import { Player } from "../src/core/player.ts";
import { frameTimes, spacingTicks, spanAround } from "../src/core/spacing.ts";
import { durationOf, readTake, type Take } from "../src/core/take.ts";

beforeAll(() => Elastoon.init());

const file = (name: string) => readFileSync(new URL(`../../../scenes/${name}`, import.meta.url), "utf8");

/** Scenes of the gallery with throws and arrivals. */
function takes(): [string, Take][] {
  const stairs = readTake(file("stairs.json"));
  const hello = readTake(file("hello.json"));
  return [
    [
      "stairs, thrown",
      {
        ...stairs,
        inputs: [
          { kind: "throw", step: 47, body: "ball", position: [-3, 5, 0], velocity: [4, 6, 0] },
          { kind: "throw", step: 100, body: "can", position: [0, 4, 0], velocity: [-2, 3, 0] },
        ],
      },
    ],
    [
      "hello, joined",
      {
        ...hello,
        inputs: [
          {
            kind: "arrival",
            step: 31,
            body: { name: "late", shape: Object.keys(hello.scene.shapes!)[0]!, position: [0, 9, 0] },
          },
          { kind: "throw", step: 90, body: "late", position: [0, 5, 1], velocity: [0, -9, 0] },
        ],
      },
    ],
    ["corner", readTake(file("contacts/corner.json"))],
    ["pachinko", readTake(file("pachinko.json"))],
  ];
}

test("a scrubbed-to state has the hash of the played one", () => {
  for (const [name, take] of takes()) {
    const played = new Player(take);
    const hashes: string[] = [];
    for (let step = 0; step <= 200; ++step) hashes.push(played.hashAt(step));
    const scrubbed = new Player(take);
    scrubbed.ensure(200);
    let seed = 7;
    for (let i = 0; i < 40; ++i) {
      seed = (seed * 1103515245 + 12345) % 2147483648;
      const step = seed % 201;
      expect(scrubbed.hashAt(step), `${name}, step ${step}`).toBe(hashes[step]);
    }
    expect(scrubbed.events().length).toBeGreaterThan(0);
    expect(scrubbed.refused).toEqual([]);
    played.dispose();
    scrubbed.dispose();
  }
});

test("what is shown between steps is what a world of finer steps is at", () => {
  const [, take] = takes()[2]!;
  const coarse = new Player(take);
  coarse.ensure(150);
  const { world } = new Player(take);
  for (let i = 0; i < 150; ++i) {
    world.step(1 / 60);
    const shown = coarse.matricesAt(world.time);
    world.matrices.forEach((value, at) => expect(Math.abs(value - shown[at]!)).toBeLessThan(1e-5));
  }
});

test("golden hashes: the studio shows what native programs work out", () => {
  const rows = file("../tests/golden/hashes.txt")
    .split("\n")
    .filter((line) => / 60 /.test(line));
  expect(rows.length).toBeGreaterThan(3);
  for (const row of rows) {
    const [name, , hash] = row.split(" ");
    const take = readTake(file(name!));
    const player = new Player(take);
    expect(player.hashAt(durationOf(take) * 60), name).toBe(hash);
    player.dispose();
  }
});

test("how much of the motion holds for another take", () => {
  const [, take] = takes()[0]!;
  const player = new Player(take);
  expect(player.sharesUpTo(take)).toBe(Infinity);
  expect(player.sharesUpTo({ ...take, inputs: take.inputs.slice(0, 1) })).toBe(100);
  expect(player.sharesUpTo({ ...take, scene: { ...take.scene, duration: 3 } })).toBe(Infinity);
  expect(player.sharesUpTo({ ...take, scene: { ...take.scene, gravity: [0, 0, 0] } })).toBe(0);
});

test("a player that goes on as another take is that take's player", () => {
  let seed = 3;
  const random = (below: number) => {
    seed = (seed * 1103515245 + 12345) % 2147483648;
    return seed % below;
  };
  let [, take] = takes()[1]!;
  const scene = take.scene;
  const going = new Player(take);
  const names = ["late", ...scene.bodies!.map((body) => body.name!)];
  for (let round = 0; round < 25; ++round) {
    going.ensure(40 + random(160));
    const step = 32 + random(120);
    const inputs = take.inputs.filter((input) => input.step < step || random(2) === 0);
    const body = inputs.some((input) => input.kind === "arrival") ? names[random(names.length)]! : names[1]!;
    const velocity = [random(9) - 4, random(9) - 4, 0] as const;
    const thrown = { kind: "throw", step, body, position: [random(5), 6 + random(4), 0], velocity } as const;
    take = { scene: { ...scene, duration: 5 + random(3) }, inputs: [...inputs.filter((input) => input.step < step), thrown] };
    expect(going.sharesUpTo(take)).toBeGreaterThan(0);
    going.goOnAs(take);
    const fresh = new Player(take);
    for (const at of [200, random(200), step + 1]) expect(going.hashAt(at), `round ${round}`).toBe(fresh.hashAt(at));
    going.ensure(200);
    fresh.ensure(200);
    const shown = (player: Player) => [...player.matricesAt(1.234)];
    expect(shown(going)).toEqual(shown(fresh));
    expect(going.events().map(({ time, type }) => [time, type])).toEqual(fresh.events().map(({ time, type }) => [time, type]));
    expect(going.bodies.map(({ name }) => name)).toEqual(fresh.bodies.map(({ name }) => name));
    fresh.dispose();
  }
});

test("a body that would come in inside an obstacle stays out, and that is told", () => {
  const [, take] = takes()[0]!;
  const player = new Player({
    ...take,
    inputs: [{ kind: "arrival", step: 5, body: { name: "stuck", shape: "ball", position: [0, -5, 0] } }],
  });
  player.ensure(20);
  expect(player.refused.join()).toMatch(/arrival at 0.08 s.*inside/);
  expect(player.bodies.map(({ name }) => name)).not.toContain("stuck");
});

test("spacing", () => {
  const ticks = spacingTicks([
    { x: 0, y: 0, z: 0 },
    { x: 1, y: 0, z: 0 },
    { x: 1, y: 3, z: 0 },
  ]);
  expect(ticks.map(({ share }) => share)).toEqual([0, 0.25, 1]);
  expect(frameTimes(1, 1.1)).toHaveLength(4);
  expect(frameTimes(0, 1)).toHaveLength(25);
  expect(spanAround([1, 2], 1.5, 6)).toEqual([1, 2]);
  expect(spanAround([1, 2], 0.5, 6)).toEqual([0, 1]);
  expect(spanAround([1, 2], 2, 6)).toEqual([2, 6]);
});
