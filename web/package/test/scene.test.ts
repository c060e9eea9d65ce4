// Scenes through the library's own reader: the golden hashes of native programs, names and colours, messages.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import Elastoon, { ElastoonError, Scene } from "elastoon";

const root = new URL("../../../../", import.meta.url);
const sceneText = (name: string) => readFileSync(new URL(`scenes/${name}`, root), "utf8");
await Elastoon.init();

test("a scene has its names, colours and camera", () => {
  const json = JSON.parse(sceneText("hello.json")) as { name: string; bodies: { name: string }[] };
  const scene = Scene.parse(json);
  const world = scene.stage();
  assert.equal(scene.name, json.name);
  assert.deepEqual(world.bodies().map((body) => body.name), json.bodies.map((body) => body.name));
  assert.ok(world.bodies().every((body) => body.color !== undefined && body.color.x <= 1));
  assert.ok(world.obstacles().length > 0 && world.obstacles()[0]!.color !== undefined);
  assert.equal(world.bodyNamed(json.bodies[0]!.name), world.bodies()[0]);
  scene.dispose();
  world.step(0.5);
  assert.ok(world.time === 0.5);
  world.dispose();
  assert.throws(() => scene.stage(), (error: ElastoonError) => error.code === "bad id");
});

test("bodies of one shape share it", () => {
  const scene = Scene.parse(sceneText("pachinko.json"));
  const [one, other] = [scene.stage(), scene.stage()];
  assert.ok(one.bodies().length > 3);
  assert.equal(new Set([...one.bodies(), ...other.bodies()].map((body) => body.shape)).size, 1);
  one.dispose();
  other.dispose();
  scene.dispose();
});

test("mistakes are told with their place", () => {
  const wrong = (text: string, words: RegExp) =>
    assert.throws(() => Scene.parse(text, "my.json"), (error: ElastoonError) =>
      error.code === "bad data" && words.test(error.message));
  wrong('{"elastoon": 1, "bodeis": []}', /my\.json.*bodeis.*bodies/);
  wrong('{"elastoon": 1,', /my\.json.*line 1/);
  wrong('{"elastoon": 1, "duration": 1e999}', /too large/);
  wrong("[".repeat(100000), /nested|valid|object/);
  wrong('{"elastoon": 1, "shapes": {"a": {"type": "mesh", "file": "a.obj"}}}', /mesh files cannot be read here/);
});
