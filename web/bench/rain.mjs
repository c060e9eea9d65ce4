// Rain, as of scripts/bench.sh, in Node: this package, rapier, and a native program, in ns for each body and step with its
// matrix read. The native program must end with the same hash, and all bodies must stay inside. Rapier has the same
// 258-vertex hulls, as Bullet has in the native benchmark; and once more its own boxes and balls, which have fewer corners to
// search, or none. All take turns: a ratio is the median of the rounds'.
// Usage: node web/bench/rain.mjs [BODIES] [--check]
// --check: ends with 1 where WebAssembly takes over twice native's time, or rapier with its boxes less than ten times ours.
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../..");
const require = createRequire(`${root}/web/package/package.json`);
const { Elastoon, Scene, Shape } = await import(pathToFileURL(`${root}/web/package/dist/index.js`));
const RAPIER = await import(pathToFileURL(require.resolve("@dimforge/rapier3d-simd-compat").replace(/\.cjs$/, ".mjs")));
const count = Number(process.argv[2]?.match(/^\d+$/)?.[0] ?? 5000);
const warm = 120;
const steps = 240;
const runs = 5;

let state = 41;
const uniform = (low, high) => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return low + ((high - low) * state) / 2 ** 32;
};

function makeRain() {
  const obstacles = [{ type: "plane", normal: [0, 1, 0], offset: 0 }];
  for (const normal of [[1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1]]) obstacles.push({ type: "plane", normal, offset: -half });
  const across = Math.max(1, Math.trunc((2 * half) / 8));
  for (let i = 0; i < across; ++i) {
    for (let j = 0; j < across; ++j) {
      obstacles.push({ shape: "box", position: [-half + 8 * (i + 0.5), 2.5, -half + 8 * (j + 0.5)],
        rotation: [uniform(-0.15, 0.15), 0, uniform(-0.15, 0.15), 1] });
    }
  }
  const reach = half - 1.5;
  const bodies = Array.from({ length: count }, () => ({ shape: "ball", style: "bouncing",
    position: [uniform(-reach, reach), uniform(5, 15), uniform(-reach, reach)],
    velocity: [uniform(-2, 2), uniform(-2, 2), uniform(-2, 2)] }));
  return { elastoon: 1, shapes: { ball: { type: "sphere", radius: 0.5 }, box: { type: "box", size: [3, 0.8, 3] } },
    styles: { bouncing: { restitution: 1, max_stretch: 1.6 } }, obstacles, bodies };
}

/** ns for each body and step of one run, and what it ended with. */
function measure({ step, done }) {
  for (let i = 0; i < warm; ++i) step();
  const start = process.hrtime.bigint();
  for (let i = 0; i < steps; ++i) step();
  const time = Number(process.hrtime.bigint() - start) / steps / count;
  return { time, end: done() };
}

const half = Math.max(8, Math.sqrt(count));
/** Bodies are where they may be: above the floor, and between the walls. */
function requireInside(name, positions) {
  const out = positions.filter(([x, y, z]) => y < 0 || Math.abs(x) > half || Math.abs(z) > half).length;
  if (out > 0) throw new Error(`${name}: ${out} of ${positions.length} bodies have left the room`);
}

function ours(scene) {
  const world = Scene.parse(scene).stage();
  let sum = 0;
  return {
    step() {
      world.step(1 / 60);
      sum += world.matrices[0];
    },
    done() {
      requireInside("elastoon", Array.from({ length: count }, (_, i) => world.matrices.slice(12 * i + 9, 12 * i + 12)));
      const hash = world.stateHash();
      world.dispose();
      return hash;
    },
  };
}

/** Bodies of that collider; `each_other`: they meet each other too, which ours do not. */
function rapier(scene, collider, each_other = false) {
  const world = new RAPIER.World({ x: 0, y: -9.81, z: 0 });
  world.timestep = 1 / 60;
  const solid = (desc) => desc.setRestitution(1).setFriction(0).setCollisionGroups(0x00010002);
  for (const { type, normal, offset, position, rotation } of scene.obstacles) {
    if (type === "plane") {
      const [x, y, z] = normal;
      const size = [1, 2, 3].map((_, i) => (Math.abs(normal[i]) > 0 ? 1 : 200));
      world.createCollider(solid(RAPIER.ColliderDesc.cuboid(...size)).setTranslation(x * (offset - 1), y * (offset - 1), z * (offset - 1)));
    } else {
      const length = Math.hypot(...rotation);
      const [x, y, z, w] = rotation.map((part) => part / length);
      world.createCollider(solid(RAPIER.ColliderDesc.cuboid(1.5, 0.4, 1.5)).setTranslation(...position).setRotation({ x, y, z, w }));
    }
  }
  const bodies = scene.bodies.map(({ position, velocity }) => {
    const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(...position).setLinvel(...velocity).setCanSleep(false));
    const groups = each_other ? 0x00020003 : 0x00020001;
    world.createCollider(collider().setRestitution(1).setFriction(0).setCollisionGroups(groups), body);
    return body;
  });
  let sum = 0;
  return {
    step() {
      world.step();
      for (const body of bodies) sum += body.translation().y + body.rotation().w;
    },
    done() {
      requireInside("rapier", bodies.map((body) => Object.values(body.translation())));
      world.free();
    },
  };
}

await Elastoon.init();
await RAPIER.init();
const scene = makeRain();
const folder = `${root}/build/bench_web`;
mkdirSync(folder, { recursive: true });
writeFileSync(`${folder}/rain.json`, JSON.stringify(scene));
execFileSync("gcc", ["-O2", "-D_GNU_SOURCE", "-std=c11", `-I${root}/include`, `${here}/native.c`, `${root}/build/release/libelastoon.a`,
  "-lstdc++", "-lm", "-o", `${folder}/native`]);
const vertices = Shape.ball(0.5).vertices();
const ball = () => RAPIER.ColliderDesc.ball(0.5);
const contenders = {
  native() {
    const [time, end] = execFileSync(`${folder}/native`, [`${folder}/rain.json`, warm, steps], { encoding: "utf8" }).trim().split(" ");
    return { time: Number(time), end };
  },
  wasm: () => measure(ours(scene)),
  boxes: () => measure(rapier(scene, () => RAPIER.ColliderDesc.cuboid(0.5, 0.5, 0.5))),
  balls: () => measure(rapier(scene, ball)),
  together: () => measure(rapier(scene, ball, true)),
};
const rounds = Array.from({ length: runs }, () =>
  Object.fromEntries(Object.entries(contenders).map(([name, run]) => [name, run()])));
// One round is enough, and long: they are a hundred times slower.
const hulls = measure(rapier(scene, () => RAPIER.ColliderDesc.convexHull(vertices))).time;

const median = (values) => values.toSorted((a, b) => a - b)[Math.trunc(values.length / 2)];
const time = (name) => median(rounds.map((round) => round[name].time));
const ratio = (name, to) => median(rounds.map((round) => round[name].time / round[to].time));
const row = (name, ns) => console.log(`${name.padEnd(48)} ${ns.toFixed(0).padStart(6)} ns a body and step`);
console.log(`rain, ${count} bodies, Node ${process.versions.node}`);
row("elastoon, native", time("native"));
row(`elastoon, WebAssembly (${ratio("wasm", "native").toFixed(2)} of native)`, time("wasm"));
row(`rapier, the same hulls (${(hulls / time("wasm")).toFixed(1)} of ours)`, hulls);
row(`rapier, boxes (${ratio("boxes", "wasm").toFixed(1)} of ours)`, time("boxes"));
row(`rapier, balls (${ratio("balls", "wasm").toFixed(1)} of ours)`, time("balls"));
row(`rapier, balls that meet each other (${ratio("together", "wasm").toFixed(1)} of ours)`, time("together"));
const { end } = rounds[0].wasm;
const other = rounds.flatMap(({ native, wasm }) => [native.end, wasm.end]).find((hash) => hash !== end);
console.log(other === undefined ? `hash ${end}, the native program's too` : `hash ${end}, but one run's is ${other}`);
const met = !process.argv.includes("--check") || (ratio("wasm", "native") <= 2 && ratio("boxes", "wasm") >= 10);
process.exit(other === undefined && met ? 0 : 1);
