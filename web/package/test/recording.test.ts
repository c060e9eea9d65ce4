// Recordings: every kind of input comes back to the bit, and what is damaged or gone is refused.
import assert from "node:assert/strict";
import { test } from "node:test";
import Elastoon, { type Body, BodyDesc, ElastoonError, type Obstacle, ObstacleDesc, Recording, Shape, World } from "elastoon";

await Elastoon.init();

const refusedAs = (code: string, words: RegExp) => (error: unknown) =>
  error instanceof ElastoonError && error.code === code && words.test(error.message);
const steps = 90;

/** What the user does before step i, and how often: all twelve kinds of input are among it. */
class User {
  private steered = false;
  private lift: Obstacle | undefined;
  private readonly bodies: Body[] = [];
  readonly kinds = new Set<string>();
  count = 0;

  constructor(private readonly world: World) {}

  private done(kind: string): void {
    this.kinds.add(kind);
    ++this.count;
  }
  act(i: number): void {
    const [, second] = this.bodies;
    if (i === 0) {
      const ball = BodyDesc.ball(0.5).setLinvel(0, -3, 0);
      this.bodies.push(this.world.createBody(ball.setTranslation(0, 2, 0)), this.world.createBody(ball.setTranslation(3, 4, 0)));
      this.done("createBody");
      this.done("createBody");
    } else if (i === 3) {
      this.lift = this.world.createObstacle(ObstacleDesc.box(2, 0.5, 2).setTranslation(6, 1, 0)
        .setPath([{ time: 1, position: { x: 6, y: 3, z: 0 } }]));
      this.done("createObstacle");
    } else if (i === 5) {
      second!.setStyle("jelly");
      this.done("setStyle");
      second!.setLinvel({ x: 1, y: 4, z: -1 });
      this.done("setLinvel");
    } else if (i === 10) {
      second!.setTranslation({ x: 6, y: 6, z: 0 });
      this.done("setTranslation");
    } else if (i === 15) {
      this.lift!.moveTo({ x: 6, y: 2, z: 0.5 }, 0.5);
      this.done("moveTo");
    } else if (i === 20) {
      this.lift!.setMotion({ x: 0, y: 0.5, z: 0 }, { x: 0, y: 0.3, z: 0 });
      this.done("setMotion");
    } else if (i === 40) {
      this.lift!.setPose({ x: 5.8, y: 1.5, z: 0 });
      this.done("setPose");
    } else if (i === 50) {
      this.world.gravity = { x: 1, y: -12, z: 0 };
      this.done("gravity");
    } else if (i === 70) {
      this.world.removeObstacle(this.lift!);
      this.done("removeObstacle");
    } else if (i === steps) {
      this.world.removeBody(second!);
      this.done("removeBody");
    }
    if (!this.steered && this.bodies[0]!.phase().kind === "impact") {
      this.bodies[0]!.steerImpact({ x: 2, y: 5, z: 1 });
      this.steered = true;
      this.done("steerImpact");
    }
  }
}

/** A play from its second moment on, with the hash before each step, without its inputs, and the one at the end. */
function recordPlay(): { bytes: Uint8Array; hashes: string[]; inputs: number } {
  const world = new World();
  world.createObstacle(ObstacleDesc.plane());
  world.step(0.25);
  const recording = new Recording(world);
  const user = new User(world);
  const hashes: string[] = [];
  for (let i = 0; i <= steps; ++i) {
    hashes.push(world.stateHash());
    user.act(i);
    if (i < steps) world.step(i % 5 === 0 ? 1 / 30 : 1 / 60);
  }
  hashes[steps] = world.stateHash();
  assert.throws(() => world.createBody(BodyDesc.ball(1)), refusedAs("refused", /inside/));
  assert.throws(() => world.step(-1), refusedAs("bad argument", /dt/));
  assert.deepEqual([user.kinds.size, recording.inputs, recording.steps, recording.isLive], [12, user.count, steps, true]);
  world.dispose();
  assert.equal(recording.isLive, false);
  const bytes = recording.bytes();
  recording.dispose();
  recording.dispose();
  assert.throws(() => recording.bytes(), refusedAs("bad id", /recording/));
  return { bytes, hashes, inputs: user.count };
}

test("a play with every kind of input comes back, step by step and at once", () => {
  const { bytes, hashes, inputs } = recordPlay();
  const recording = Recording.fromBytes(bytes);
  assert.deepEqual([recording.steps, recording.inputs, recording.world, recording.isLive], [steps, inputs, null, false]);
  const world = recording.start();
  for (let i = 0; i < steps; ++i) {
    assert.equal(world.stateHash(), hashes[i], `before step ${i}`);
    recording.replay(world, i, i + 1);
  }
  assert.equal(world.bodies().length, 2);
  recording.replay(world, steps);
  assert.equal(world.stateHash(), hashes[steps]);
  assert.equal(world.bodies().length, 1);
  assert.equal(world.obstacles().length, 1);
  assert.equal(recording.start(world), world);
  assert.equal(world.bodies().length, 0);
  recording.replay(world);
  assert.equal(world.stateHash(), hashes[steps]);
  assert.deepEqual(recording.bytes(), bytes);
  recording.dispose();
  world.step();
  world.dispose();
});

test("events of a replay name its bodies, those too that it then removes", () => {
  const world = new World();
  world.createObstacle(ObstacleDesc.plane());
  const recording = new Recording(world);
  const ball = world.createBody(BodyDesc.ball(0.5).setTranslation(0, 1, 0).setLinvel(0, -9, 0));
  world.step(0.2);
  const seen = world.events().map((event) => `${event.type} ${event.body.index}`);
  assert.ok(seen.length > 0);
  world.removeBody(ball);
  const again = recording.start(new World());
  recording.replay(again);
  assert.equal(again.bodies().length, 0);
  assert.deepEqual(again.events().map((event) => `${event.type} ${event.body.index}`), seen);
  assert.equal(again.events()[0]!.body.isValid(), false);
  const part = recording.start(new World());
  recording.replay(part, 0, 1);
  recording.replay(part, 1);
  assert.equal(part.events()[0]!.body.index, 0);
  for (const each of [recording, again, part, world]) each.dispose();
});

test("a recorded world goes back by rewind, and another way from there", () => {
  const world = new World();
  world.createObstacle(ObstacleDesc.plane());
  const recording = new Recording(world);
  const ball = world.createBody(BodyDesc.ball(0.5).setTranslation(0, 3, 0));
  let before: Uint8Array = new Uint8Array();
  for (let i = 0; i < 20; ++i) {
    if (i === 8) before = world.snapshot();
    if (i === 12) ball.setLinvel({ x: 5, y: 0, z: 0 });
    world.step();
  }
  assert.throws(() => world.restore(before), refusedAs("refused", /being recorded/));
  assert.throws(() => recording.rewind(21, before), refusedAs("bad argument", /step/));
  assert.throws(() => recording.rewind(8, before.subarray(1)), refusedAs("bad data", /./));
  assert.throws(() => new Recording(world), refusedAs("refused", /being recorded/));
  recording.rewind(8, before);
  assert.deepEqual([recording.steps, recording.inputs], [8, 1]);
  ball.setLinvel({ x: 0, y: 7, z: 2 });
  for (let i = 8; i < 20; ++i) world.step();
  const again = recording.start();
  recording.replay(again);
  assert.equal(again.stateHash(), world.stateHash());
  assert.throws(() => recording.start(world), refusedAs("refused", /being recorded/));
  assert.throws(() => recording.replay(world), refusedAs("refused", /being recorded/));
  recording.dispose();
  world.restore(before);
  for (const each of [again, world]) each.dispose();
});

test("damaged bytes, and worlds that went another way, are refused", () => {
  const { bytes } = recordPlay();
  for (let size = 0; size < bytes.length; size += 37) {
    assert.throws(() => Recording.fromBytes(bytes.subarray(0, size)), refusedAs("bad data", /recording/));
  }
  for (let i = 0; i < bytes.length; i += 7) {
    const flipped = bytes.slice();
    flipped[i]! ^= 1 << (i % 8);
    assert.throws(() => Recording.fromBytes(flipped), refusedAs("bad data", /recording/));
  }
  const recording = Recording.fromBytes(bytes);
  const other = new World();
  other.createObstacle(ObstacleDesc.plane());
  other.createBody(new BodyDesc(Shape.ball(0.5)).setTranslation(9, 3, 0));
  assert.throws(() => recording.replay(other), refusedAs("refused", /step 0, addBody/));
  assert.equal(other.bodies().length, 2, "it stays where it came to");
  assert.throws(() => recording.replay(other, steps + 1), refusedAs("bad argument", /from/));
  assert.throws(() => recording.rewind(0, other.snapshot()), refusedAs("refused", /no world/));
  other.dispose();
  assert.throws(() => recording.replay(other), refusedAs("bad id", /world/));
  assert.throws(() => new Recording(other), refusedAs("bad id", /world/));
  recording.dispose();
});
