// The package in Node: bodies, events, views, errors, snapshots.
import assert from "node:assert/strict";
import { test } from "node:test";
import Elastoon, { BodyDesc, ElastoonError, ObstacleDesc, Shape, styleNames, styleParameters, World } from "elastoon";

test("before init every call says what is missing", () => {
  assert.throws(() => new World(), (error: ElastoonError) => error.code === "not ready" && /init/.test(error.message));
});

test("init may be called again", async () => {
  await Promise.all([Elastoon.init(), Elastoon.init()]);
  assert.match(Elastoon.version, /^\d+\.\d+\.\d+$/);
});

function worldWithFloor(): World {
  const world = new World({ x: 0, y: -9.81, z: 0 });
  world.createObstacle(ObstacleDesc.plane({ x: 0, y: 1, z: 0 }, 0).setName("floor"));
  return world;
}

const refusedAs = (code: string, words: RegExp) => (error: unknown) =>
  error instanceof ElastoonError && error.code === code && words.test(error.message);

test("a ball falls, squashes, and comes to rest", () => {
  const world = worldWithFloor();
  const ball = world.createBody(BodyDesc.ball(0.5).setTranslation(0, 2, 0).setLinvel(1, 0, 0).setUserData({ mine: 1 }));
  const seen = new Map<string, number>();
  let squash = 1;
  for (let i = 0; i < 900; ++i) {
    world.step(1 / 60);
    squash = Math.min(squash, ball.pose().stretch);
    for (const event of world.events()) {
      seen.set(event.type, (seen.get(event.type) ?? 0) + 1);
      assert.equal(event.body, ball);
      assert.equal(event.other?.name, "floor");
      assert.ok(Math.abs(event.normal.y - 1) < 1e-12);
      if (event.type === "impact" && seen.get("impact") === 1) {
        assert.ok(event.stretchMid < event.stretchIn && event.timeIn > 0 && event.timeOut > 0 && event.speed > 5);
      }
    }
    assert.equal(world.events(), world.events());
  }
  assert.ok((seen.get("impact") ?? 0) >= 2);
  assert.equal(seen.get("rest"), 1);
  assert.ok(squash < 0.99);
  assert.equal(ball.phase().kind, "rest");
  assert.deepEqual(ball.userData, { mine: 1 });
  assert.ok(Math.abs(world.time - 15) < 1e-9);
  world.dispose();
  world.dispose();
  assert.throws(() => world.step(), refusedAs("bad id", /world/));
  assert.throws(() => ball.pose(), refusedAs("bad id", /body/));
});

test("matrices are a view, follow the pose, and free slots are zero", () => {
  const world = worldWithFloor();
  const bodies = [0, 2, 4].map((x) => world.createBody(BodyDesc.capsule(0.2, 1).setTranslation(x, 3, 0).setLinvel(0, -9, 2)));
  world.removeBody(bodies[1]!);
  world.step(0.1);
  const matrices = world.matrices;
  assert.equal(matrices, world.matrices);
  assert.equal(matrices.length, 36);
  assert.deepEqual([...matrices.subarray(12, 24)], new Array(12).fill(0));
  const pose = bodies[2]!.pose();
  const m = matrices.subarray(12 * bodies[2]!.index, 12 * bodies[2]!.index + 12);
  assert.ok(Math.abs(m[9]! - pose.position.x) + Math.abs(m[10]! - pose.position.y) < 1e-6);
  assert.ok(Math.abs(Math.hypot(m[0]!, m[1]!, m[2]!) - pose.stretch) < 1e-6);
  assert.ok(pose.stretch > 1.1);
  const n = world.normalMatrices().subarray(18, 27);
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) {
      const dot = m[3 * i]! * n[3 * j]! + m[3 * i + 1]! * n[3 * j + 1]! + m[3 * i + 2]! * n[3 * j + 2]!;
      assert.ok(Math.abs(dot - (i === j ? 1 : 0)) < 1e-6);
    }
  }
  const before = matrices[34]!;
  world.step(0.1);
  assert.notEqual(world.matrices[34], before);
  world.dispose();
});

test("many bodies, also when the memory grows under the views", () => {
  const world = worldWithFloor();
  const shape = Shape.ball(0.1);
  for (let i = 0; i < 4000; ++i) world.createBody(new BodyDesc(shape).setTranslation(i % 60, 1 + i / 600, i / 60));
  const before = world.matrices;
  const others = Array.from({ length: 200 }, (_, i) => Shape.ball(1 + i, 32));
  assert.equal(before.length, 0, "the memory has grown: the old view is gone");
  assert.equal(world.matrices.length, 48000);
  world.step();
  assert.equal(world.bodies().length, 4000);
  assert.ok(Number.isFinite(world.matrices[47999]));
  others.forEach((other) => other.dispose());
  world.dispose();
});

test("bad input is refused with a code and a text, and harms nothing", () => {
  const world = worldWithFloor();
  const ball = world.createBody(BodyDesc.ball(0.5).setTranslation(0, 2, 0));
  assert.throws(() => world.createBody(BodyDesc.ball(0.5)), refusedAs("refused", /inside/));
  assert.throws(() => Shape.ball(Number.NaN), refusedAs("bad argument", /radius/));
  assert.throws(() => Shape.hull([0, 0, 0, 1, 0, 0, 0, 1, 0]), refusedAs("bad argument", /./));
  assert.throws(() => world.step(-1), refusedAs("bad argument", /dt/));
  assert.throws(() => ball.setLinvel({ x: Number.NaN, y: 0, z: 0 }), refusedAs("bad argument", /velocity/));
  assert.throws(() => ball.setTranslation({ x: 0, y: 0, z: 0 }), refusedAs("refused", /inside/));
  assert.throws(() => ball.setStyle({ friction: -1 }), refusedAs("bad argument", /friction/));
  assert.throws(() => ball.setStyle({ squash_law: "steel" as "paper" }), refusedAs("bad argument", /bounded or paper/));
  assert.throws(() => ball.setStyle({ bounce: 1 } as object), refusedAs("bad argument", /bounce/));
  assert.throws(() => ball.setStyle("concrete" as "jelly"), refusedAs("bad argument", /concrete/));
  assert.throws(() => world.restore(new Uint8Array(10)), refusedAs("bad data", /./));
  const dead = Shape.ball(1);
  dead.dispose();
  dead.dispose();
  assert.throws(() => world.createBody(new BodyDesc(dead)), refusedAs("bad id", /shape/));
  world.removeBody(ball);
  assert.equal(ball.isValid(), false);
  assert.throws(() => world.removeBody(ball), refusedAs("bad id", /body/));
  world.step();
  world.dispose();
});

test("styles: every parameter of the table can be set and read", () => {
  const world = worldWithFloor();
  const body = world.createBody(BodyDesc.box(1, 1, 1).setTranslation(0, 5, 0).setStyle("jelly"));
  assert.ok(styleNames.includes("jelly"));
  for (const row of styleParameters) {
    const value = row.choices.length > 0 ? row.choices[1]! : row.maximum;
    body.setStyle({ [row.name]: value });
    const read = body.style()[row.name];
    if (typeof value === "number") assert.ok(Math.abs(Number(read) / value - 1) < 1e-9, `${row.name} ${String(read)}`);
    else assert.equal(read, value);
  }
  body.setStyle({ base: "jelly", rest_speed: "auto", friction: 0.123 });
  assert.equal(body.style().rest_speed, "auto");
  assert.equal(body.style().friction, 0.123);
  world.dispose();
});

test("snapshots go on to the bit, predictions come true", () => {
  const world = worldWithFloor();
  const ball = world.createBody(BodyDesc.cone(0.5, 1).setTranslation(0, 3, 0).setLinvel(1, 2, 0).setName("cone"));
  world.step(0.3);
  const bytes = world.snapshot(true);
  const predicted = ball.predictPoses([0.25, 0.5]);
  const coming = ball.predictEvents(2);
  world.step(0.5);
  assert.deepEqual(ball.pose(), predicted[1]);
  const hash = world.stateHash();
  world.restore(bytes);
  assert.equal(world.bodies()[0], ball);
  world.step(0.5);
  assert.equal(world.stateHash(), hash);
  world.restore(bytes);
  world.step(2);
  assert.deepEqual(world.events().map((event) => event.type), coming.map((event) => event.type));
  const other = new World();
  other.restore(bytes);
  assert.equal(other.bodies().length, 1);
  assert.equal(other.bodies()[0]!.shape.kind, "cone");
  other.step(0.5);
  assert.equal(other.stateHash(), hash);
  other.dispose();
  world.dispose();
});

test("events name bodies that were removed before the step that tells of them", () => {
  const world = worldWithFloor();
  const ball = world.createBody(BodyDesc.ball(0.5).setTranslation(0, 0.6, 0));
  while (ball.phase().kind !== "rest") world.step();
  world.obstacleNamed("floor")!.setPose({ x: 0, y: -3, z: 0 });
  world.removeBody(ball);
  world.step();
  const [event] = world.events();
  assert.equal(event!.type, "wake");
  assert.equal(event!.body, ball);
  assert.equal(event!.body.isValid(), false);
  world.step();
  assert.equal(world.events().length, 0);
  world.dispose();
});

test("obstacles move, follow paths, and let go", () => {
  const world = worldWithFloor();
  const lift = world.createObstacle(
    ObstacleDesc.box(2, 1, 2).setTranslation(0, 5, 0).setPath([{ time: 1, position: { x: 0, y: 6, z: 0 } }])
      .setUserData("up"));
  world.step(0.5);
  assert.ok(Math.abs(lift.frame().position.y - 5.5) < 1e-12);
  lift.setPose({ x: 0, y: 4, z: 0 });
  assert.equal(lift.frame().position.y, 4);
  lift.moveTo({ x: 0, y: 8, z: 0 }, 2);
  assert.equal(lift.frame().linvel.y, 2);
  lift.setMotion({ x: 1, y: 0, z: 0 });
  assert.equal(lift.frame().linvel.x, 1);
  assert.deepEqual(world.obstacles()[0]!.planeNormal(), { x: 0, y: 1, z: 0 });
  assert.equal(lift.userData, "up");
  assert.equal(world.obstacleNamed("floor")!.userData, undefined);
  assert.throws(() => lift.moveTo({ x: 0, y: 0, z: 0 }, 0), refusedAs("bad argument", /./));
  world.removeObstacle(lift);
  assert.equal(world.obstacles().length, 1);
  world.gravity = { x: 0, y: -5, z: 0 };
  assert.equal(world.gravity.y, -5);
  world.dispose();
});
