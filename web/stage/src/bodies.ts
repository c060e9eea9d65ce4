// Bodies as instances: those of one shape and pattern are drawn in one call, from a world's list of matrices.
import { type Shape } from "elastoon";
import { geometryOf } from "elastoon/three";
import {
  type BufferGeometry,
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  type Object3D,
  type Raycaster,
  SphereGeometry,
  Vector3,
} from "three";
import { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { addOccluder, type Occluders } from "./occlusion.js";
import { patterned, type PatternName } from "./patterns.js";

export interface BodyLook {
  /** Its place in the list of matrices: item `index` is 12 numbers. */
  readonly index: number;
  readonly shape: Shape;
  /** sRGB. */
  readonly color: number;
  readonly pattern: PatternName;
  /** Drawn instead of the shape, in the shape's frame: a mesh that was brought. */
  readonly object?: Object3D;
}

interface Batch {
  readonly mesh: InstancedMesh;
  readonly looks: readonly BodyLook[];
  readonly half: readonly [number, number, number];
}

export function halfExtents(shape: Shape): [number, number, number] {
  return [shape.extents.x / 2, shape.extents.y / 2, shape.extents.z / 2];
}

/** The shape to be looked at: round where it is meant to be round, and less so among `count` of its kind. */
export function displayGeometry(shape: Shape, count = 1): BufferGeometry {
  if (shape.kind === "sphere") {
    const cuts = count > 400 ? 14 : count > 60 ? 24 : 48;
    return new SphereGeometry(shape.length / 2, cuts, Math.ceil(cuts / 1.5)).rotateZ(-Math.PI / 2);
  }
  if (shape.kind === "box" || shape.kind === "hull") return geometryOf(shape, true);
  return toCreasedNormals(geometryOf(shape, false).toNonIndexed(), 0.7);
}

/** The body's matrix as 16 numbers of a Matrix4, from `to` on. Written out: it runs for every body in every frame. */
function widen(matrices: ArrayLike<number>, index: number, into: { [place: number]: number }, to: number): void {
  const m = matrices as Float32Array;
  const at = 12 * index;
  const there = at + 12 <= m.length;
  into[to] = there ? m[at]! : 0;
  into[to + 1] = there ? m[at + 1]! : 0;
  into[to + 2] = there ? m[at + 2]! : 0;
  into[to + 3] = 0;
  into[to + 4] = there ? m[at + 3]! : 0;
  into[to + 5] = there ? m[at + 4]! : 0;
  into[to + 6] = there ? m[at + 5]! : 0;
  into[to + 7] = 0;
  into[to + 8] = there ? m[at + 6]! : 0;
  into[to + 9] = there ? m[at + 7]! : 0;
  into[to + 10] = there ? m[at + 8]! : 0;
  into[to + 11] = 0;
  into[to + 12] = there ? m[at + 9]! : 0;
  into[to + 13] = there ? m[at + 10]! : 0;
  into[to + 14] = there ? m[at + 11]! : 0;
  into[to + 15] = 1;
}

/** Draws bodies. `group` is to be put in a scene, at its origin. */
export class BodyViews {
  readonly group = new Group();
  private batches: Batch[] = [];
  private single: BodyLook[] = [];
  private highlighted = -1;

  constructor(
    private readonly cream: number,
    private readonly options: { opacity?: number; shadows?: boolean } = {},
  ) {}

  /** Takes these bodies from now on. `copies` is how often each may be drawn (see `place`). */
  set(looks: readonly BodyLook[], copies = 1): void {
    this.clear();
    const sorted = new Map<string, BodyLook[]>();
    const shapes = new Map<Shape, number>();
    for (const look of looks) {
      if (look.object !== undefined) {
        look.object.matrixAutoUpdate = false;
        this.group.add(look.object);
        this.single.push(look);
        continue;
      }
      if (!shapes.has(look.shape)) shapes.set(look.shape, shapes.size);
      const key = `${shapes.get(look.shape)} ${look.pattern}`;
      sorted.set(key, [...(sorted.get(key) ?? []), look]);
    }
    for (const of_kind of sorted.values()) {
      const { shape, pattern } = of_kind[0]!;
      const half = halfExtents(shape);
      const material = patterned(pattern, half, this.cream, this.options);
      const mesh = new InstancedMesh(
        displayGeometry(shape, of_kind.length * copies),
        material,
        of_kind.length * copies,
      );
      mesh.castShadow = mesh.receiveShadow = this.options.shadows ?? true;
      mesh.frustumCulled = false;
      const color = new Color();
      for (let i = 0; i < mesh.count; ++i) mesh.setColorAt(i, color.setHex(of_kind[i % of_kind.length]!.color));
      mesh.count = copies === 1 ? of_kind.length : 0;
      this.batches.push({ mesh, looks: of_kind, half });
      this.group.add(mesh);
    }
  }

  /** Moves all to their places in the list, once a frame. */
  update(matrices: ArrayLike<number>): void {
    for (const { mesh, looks } of this.batches) {
      const array = mesh.instanceMatrix.array;
      looks.forEach((look, i) => widen(matrices, look.index, array, 16 * i));
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null;
    }
    for (const { object, index } of this.single) {
      if (object === undefined) continue;
      widen(matrices, index, object.matrix.elements, 0);
      object.matrixWorldNeedsUpdate = true;
    }
  }

  /** Draws every body once for each list: ghosts. */
  place(lists: readonly ArrayLike<number>[]): void {
    for (const { mesh, looks } of this.batches) {
      const array = mesh.instanceMatrix.array;
      let at = 0;
      for (const matrices of lists) {
        for (const look of looks) {
          if (16 * (at + 1) <= array.length) widen(matrices, look.index, array, 16 * at++);
        }
      }
      mesh.count = at;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** Adds those that are nearest to `center` to what darkens, at most `most`. */
  occlude(occluders: Occluders, matrices: ArrayLike<number>, most: number, center: Vector3): void {
    if (most === 0) return;
    const near: { distance: number; at: number; half: readonly number[] }[] = [];
    for (const { looks, half } of this.batches) {
      for (const { index } of looks) {
        const at = 12 * index;
        const distance = Math.hypot(
          (matrices[at + 9] ?? 0) - center.x,
          (matrices[at + 10] ?? 0) - center.y,
          (matrices[at + 11] ?? 0) - center.z,
        );
        near.push({ distance, at, half });
      }
    }
    for (const { index, shape } of this.single) near.push({ distance: 0, at: 12 * index, half: halfExtents(shape) });
    if (near.length > most) near.sort((a, b) => a.distance - b.distance);
    for (const { at, half } of near.slice(0, most)) addOccluder(occluders, matrices, at, half);
  }

  /** Index of the body that the ray meets first, or -1. */
  pick(ray: Raycaster): number {
    let [best, found] = [Infinity, -1];
    for (const { mesh, looks } of this.batches) {
      mesh.computeBoundingSphere();
      const hit = ray.intersectObject(mesh)[0];
      if (hit !== undefined && hit.distance < best) {
        [best, found] = [hit.distance, looks[hit.instanceId ?? 0]?.index ?? -1];
      }
    }
    for (const { object, index } of this.single) {
      const hit = object === undefined ? undefined : ray.intersectObject(object, true)[0];
      if (hit !== undefined && hit.distance < best) [best, found] = [hit.distance, index];
    }
    return found;
  }

  /** Lights one body up; -1: none. */
  highlight(index: number): void {
    if (index === this.highlighted) return;
    this.highlighted = index;
    const color = new Color();
    for (const { mesh, looks } of this.batches) {
      looks.forEach((look, i) => {
        color.setHex(look.color);
        mesh.setColorAt(i, look.index === index ? color.offsetHSL(0, 0.05, 0.08) : color);
      });
      if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
    }
  }

  matrixOf(matrices: ArrayLike<number>, index: number): Matrix4 {
    const matrix = new Matrix4();
    widen(matrices, index, matrix.elements, 0);
    return matrix;
  }

  /** Gives back what the graphics card holds. */
  clear(): void {
    for (const { mesh } of this.batches) {
      mesh.geometry.dispose();
      (mesh.material as { dispose(): void }).dispose();
      mesh.dispose();
    }
    this.group.clear();
    this.batches = [];
    this.single = [];
    this.highlighted = -1;
  }
}
