// Timelines and curves: any time, both ways, and the check figures of docs/model.md.
import assert from "node:assert/strict";
import { test } from "node:test";
import Elastoon, { BodyDesc, type ElastoonError, ImpactCurve, ObstacleDesc, Scene, stretchAtSpeed, styleNamed, Timeline, World } from "elastoon";

await Elastoon.init();

function worldWithBall(): World {
  const world = new World();
  world.createObstacle(ObstacleDesc.plane());
  world.createBody(BodyDesc.ball(0.5).setTranslation(0, 3, 0).setLinvel(1, 0, 0));
  return world;
}

test("a timeline gives the matrices that the world had, back from the end", () => {
  const world = worldWithBall();
  const timeline = new Timeline(world);
  const seen: { time: number; matrices: number[] }[] = [];
  for (let i = 0; i < 200; ++i) {
    world.step();
    timeline.capture();
    seen.push({ time: world.time, matrices: [...world.matrices] });
  }
  assert.equal(timeline.captures, 200);
  for (const { time, matrices } of seen.reverse()) {
    const again = timeline.matricesAt(time);
    matrices.forEach((value, i) => assert.ok(Math.abs(value - again[i]!) < 1e-6));
  }
  const [body] = world.bodies();
  const { poses, velocities } = timeline.motionOf(body!, [0.1, 0.2]);
  assert.ok(Math.abs(velocities[1]!.y + 9.81 * 0.2) < 1e-9 && poses[0]!.position.y > poses[1]!.position.y);
  assert.deepEqual(timeline.events().map((event) => event.type).slice(0, 2), ["impact", "release"]);
  assert.equal(timeline.events(1)[0]!.type, "release");
  timeline.cut(0);
  assert.equal(timeline.events().length, 0);
  timeline.dispose();
  timeline.dispose();
  assert.throws(() => timeline.capture(), /timeline/);
});

test("an empty world has a timeline too", () => {
  const timeline = new Timeline(new World());
  assert.equal(timeline.matricesAt(0).length, 0);
  assert.deepEqual(timeline.events(), []);
});

test("a timeline's events outlive their bodies", () => {
  const world = worldWithBall();
  const timeline = new Timeline(world);
  for (let i = 0; i < 120; ++i) {
    if (i === 90) world.removeBody(world.bodies()[0]!);
    world.step();
    timeline.capture();
  }
  const body = timeline.events()[0]!.body;
  assert.equal(body.index, 0);
  assert.equal(body.isValid(), false);
  assert.throws(() => body.shape, (error: ElastoonError) => error.code === "bad id");
  timeline.dispose();
  world.dispose();
});

test("the curve of an impact", () => {
  const style = { squash_law: "paper" } as const;
  const curve = new ImpactCurve(style, { length: 1, speedIn: 14.007, speedOut: 7.0035 });
  const close = (value: number, right: number) => assert.ok(Math.abs(value - right) < 1e-4, `${value}, not ${right}`);
  close(curve.stretchIn, 1.5835);
  close(curve.stretchMid, 0.6041);
  close(curve.timeIn, 0.1098);
  close(curve.timeOut, 0.1812);
  close(curve.at([-1, curve.timeIn, 9])[1]!, curve.stretchMid);
  close(stretchAtSpeed("paper", 0), 1);
  assert.equal(styleNamed("jelly").squash_law, "bounded");
  assert.throws(() => new ImpactCurve({}, { length: 0, speedIn: 1, speedOut: 1 }), /length/);
});

test("where a scene's obstacle is at a time", () => {
  const scene = Scene.parse({ elastoon: 1, shapes: { box: { type: "box", size: [1, 1, 1] } },
    obstacles: [{ shape: "box", position: [0, 1, 0], path: [{ time: 1, position: [0, 3, 0] }] }] });
  assert.ok(Math.abs(scene.obstacleFrame(0, 0.5).position.y - 2) < 1e-12);
  assert.throws(() => scene.obstacleFrame(1, 0), /fewer/);
});
