// Rain, as of scripts/bench.sh, in Node: this package, rapier, and a native program, in ns for each body and step with its
// matrix read. The native program must end with the same hash. Rapier has the same 258-vertex hulls, as Bullet has in the
// native benchmark; and once more its own boxes and balls, which have fewer corners to search, or none.
// Usage: node web/bench/rain.mjs [BODIES] [--check]
// --check: ends with 1 where WebAssembly takes over twice native's time, or rapier with its balls less than ten times ours.
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
const runs = 3;

let state = 41;
const uniform = (low, high) => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return low + ((high - low) * state) / 2 ** 32;
};

function makeRain() {
  const half = Math.max(8, Math.sqrt(count));
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

/** ns for each body and step: the best of some runs, as the machine is not ours alone. */
function measure(make, times = runs) {
  let best = Infinity;
  let end;
  for (let run = 0; run < times; ++run) {
    const { step, done } = make();
    for (let i = 0; i < warm; ++i) step();
    const start = process.hrtime.bigint();
    for (let i = 0; i < steps; ++i) step();
    best = Math.min(best, Number(process.hrtime.bigint() - start) / steps / count);
    end = done();
  }
  return { best, end };
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
    done: () => world.free(),
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
const natives = Array.from({ length: runs }, () =>
  execFileSync(`${folder}/native`, [`${folder}/rain.json`, warm, steps], { encoding: "utf8" }).trim().split(" "));
const native = Math.min(...natives.map(([time]) => Number(time)));
const wasm = measure(() => ours(scene));
const vertices = Shape.ball(0.5).vertices();
const ball = () => RAPIER.ColliderDesc.ball(0.5);
const hulls = measure(() => rapier(scene, () => RAPIER.ColliderDesc.convexHull(vertices)), 1).best;
const boxes = measure(() => rapier(scene, () => RAPIER.ColliderDesc.cuboid(0.5, 0.5, 0.5))).best;
const balls = measure(() => rapier(scene, ball)).best;
const together = measure(() => rapier(scene, ball, true)).best;

const row = (name, time) => console.log(`${name.padEnd(44)} ${time.toFixed(0).padStart(6)} ns a body and step`);
console.log(`rain, ${count} bodies, Node ${process.versions.node}`);
row("elastoon, native", native);
row(`elastoon, WebAssembly (${(wasm.best / native).toFixed(2)} of native)`, wasm.best);
const beside = (name, time) => row(`rapier, ${name} (${(time / wasm.best).toFixed(1)} of ours)`, time);
beside("the same hulls", hulls);
beside("boxes", boxes);
beside("balls", balls);
beside("balls that meet each other", together);
const same = natives.every(([, hash]) => hash === wasm.end);
console.log(same ? `hash ${wasm.end}, the native program's too` : `hash ${wasm.end}, but the native program's is ${natives[0][1]}`);
const met = !process.argv.includes("--check") || (wasm.best <= 2 * native && together >= 10 * wasm.best);
process.exit(same && met ? 0 : 1);
