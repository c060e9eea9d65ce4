// Small pictures of takes as outlines: a strobe of what moves, seen from the scene's camera. Sharp at any size, in the
// theme's colours.
import { PerspectiveCamera, Vector3 } from "three";
import type { Shape } from "elastoon";
import { Player } from "./player.js";
import { durationOf, kStepsPerSecond, type Take } from "./take.js";

export interface Outline {
  /** Of an SVG path, in a box of `width` by `height`. */
  readonly d: string;
  /** Empty: the theme's for obstacles. */
  readonly color: string;
  readonly opacity: number;
}

export interface Thumb {
  readonly width: number;
  readonly height: number;
  /** From the back to the front. */
  readonly outlines: readonly Outline[];
  /** y of the floor, if there is one. */
  readonly floor: number | null;
}

type Flat = readonly [number, number];

/** Convex hull in the plane, by Andrew's chain. */
function hullOf(points: Flat[]): Flat[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (list: Flat[]): Flat[] => {
    const out: Flat[] = [];
    for (const p of list) {
      while (out.length > 1) {
        const [a, b] = [out.at(-2)!, out.at(-1)!];
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    out.pop();
    return out;
  };
  return [...chain(sorted), ...chain(sorted.reverse())];
}

export interface ThumbOptions {
  readonly width: number;
  readonly height: number;
  /** s of the motion, and between two ghosts. */
  readonly seconds: number;
  readonly every: number;
}

const kMostBodies = 60;
const kMostOutlines = 420;

export function thumbOf(take: Take, options: ThumbOptions): Thumb {
  const { width, height } = options;
  const player = new Player(take);
  const seconds = Math.min(options.seconds, durationOf(take));
  player.ensure(Math.ceil(seconds * kStepsPerSecond), 400);
  const camera = new PerspectiveCamera(35, width / height, 0.1, 1000);
  const wanted = player.scene.camera;
  const bodies = player.bodies.slice(0, kMostBodies);
  const end = Math.min(seconds, player.recordedTime);
  if (wanted !== null) {
    camera.fov = wanted.fov * 1.06;
    camera.position.set(wanted.eye.x, wanted.eye.y, wanted.eye.z);
    camera.lookAt(wanted.target.x, wanted.target.y, wanted.target.z);
  } else {
    const [center, radius] = middle(player, end);
    camera.position.copy(center).add(new Vector3(0.1, 0.3, 2.9).multiplyScalar(radius));
    camera.lookAt(center);
  }
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  const vertices = new Map<Shape, Float32Array>();
  const project = (shape: Shape, place: (point: Vector3) => Vector3): string => {
    if (!vertices.has(shape)) vertices.set(shape, shape.vertices());
    const list = vertices.get(shape)!;
    const every = Math.max(Math.floor(list.length / 3 / 90), 1);
    const points: Flat[] = [];
    const point = new Vector3();
    for (let i = 0; i < list.length; i += 3 * every) {
      const seen = place(point.set(list[i]!, list[i + 1]!, list[i + 2]!)).project(camera);
      points.push([(0.5 + seen.x / 2) * width, (0.5 - seen.y / 2) * height]);
    }
    return `M${hullOf(points)
      .map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`)
      .join("L")}Z`;
  };
  const outlines: Outline[] = [];
  let floor: number | null = null;
  player.world.obstacles().forEach((obstacle, i) => {
    const { position, rotation } = player.scene.obstacleFrame(i, 0);
    if (obstacle.shape === null) {
      const normal = obstacle.planeNormal();
      if (normal.y > 0.99) floor = (0.5 - new Vector3(0, position.y, 0).project(camera).y / 2) * height;
      return;
    }
    outlines.push({
      color: "",
      opacity: 1,
      d: project(obstacle.shape, (point) => point.applyQuaternion(rotation as never).add(position as Vector3)),
    });
  });
  const times = Array.from({ length: Math.max(Math.floor(end / options.every), 1) + 1 }, (_, i) =>
    Math.min(i * options.every, end),
  );
  const every = Math.max(Math.ceil((times.length * bodies.length) / kMostOutlines), 1);
  times
    .filter((_, i) => i % every === 0)
    .forEach((time, i, all) => {
      const matrices = player.matricesAt(time).slice();
      for (const { body, color } of bodies) {
        const at = 12 * body.index;
        if (matrices[at + 3] === undefined || (matrices[at] === 0 && matrices[at + 1] === 0 && matrices[at + 2] === 0))
          continue;
        const m = (k: number) => matrices[at + k]!;
        outlines.push({
          color: `#${color.toString(16).padStart(6, "0")}`,
          opacity: 0.35 + (0.65 * (i + 1)) / all.length,
          d: project(body.shape, (p) =>
            p.set(
              m(0) * p.x + m(3) * p.y + m(6) * p.z + m(9),
              m(1) * p.x + m(4) * p.y + m(7) * p.z + m(10),
              m(2) * p.x + m(5) * p.y + m(8) * p.z + m(11),
            ),
          ),
        });
      }
    });
  player.dispose();
  return { width, height, outlines, floor };
}

function middle(player: Player, end: number): [Vector3, number] {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = low.clone().negate();
  for (let i = 0; i <= 8; ++i) {
    const matrices = player.matricesAt((end * i) / 8);
    for (const { body } of player.bodies) {
      const at = 12 * body.index + 9;
      if (at + 2 >= matrices.length) continue;
      const point = new Vector3(matrices[at], matrices[at + 1], matrices[at + 2]);
      low.min(point);
      high.max(point);
    }
  }
  if (!Number.isFinite(low.x)) return [new Vector3(0, 1, 0), 4];
  return [low.clone().add(high).multiplyScalar(0.5), Math.max(low.distanceTo(high) / 2, 1.5)];
}
