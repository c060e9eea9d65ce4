// Keeps three.js objects in step with a world: "elastoon/three". Needs three, and no framework.
import { BufferAttribute, BufferGeometry, type InstancedMesh, type Matrix4, type Object3D } from "three";
import type { Body } from "./body.js";
import type { Shape } from "./shape.js";
import type { World } from "./world.js";

/** A geometry of the shape, in its frame. Smooth: for round shapes; flat, the default for boxes and hulls: every face has its
 *  own normals. */
export function geometryOf(shape: Shape, flat = shape.kind === "box" || shape.kind === "hull"): BufferGeometry {
  const smooth = new BufferGeometry();
  smooth.setAttribute("position", new BufferAttribute(shape.vertices(), 3));
  smooth.setIndex(new BufferAttribute(shape.triangles(), 1));
  const geometry = flat ? smooth.toNonIndexed() : smooth;
  geometry.computeVertexNormals();
  return geometry;
}

/** The body's matrix among a world's, as 16 numbers of a Matrix4, from `at` on. */
function widen(matrices: Float32Array, index: number, into: { [place: number]: number }, at: number): void {
  const from = 12 * index;
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 3; ++row) {
      into[at + 4 * column + row] = matrices[from + 3 * column + row] ?? 0;
    }
    into[at + 4 * column + 3] = column === 3 ? 1 : 0;
  }
}

/** Says which objects show which bodies, and moves them: `update()` once a frame, after the step.
 *
 *  Normals come out right under the stretch: three takes an Object3D's from the inverse transpose of its matrix, and an
 *  instance's from its columns' lengths, which is the same where the columns are at right angles, as here. */
export class ThreeBinding {
  private readonly objects = new Map<Object3D, Body>();
  private readonly meshes = new Map<InstancedMesh, readonly Body[]>();

  constructor(readonly world: World) {}

  /** The object, whose parent must stand at the world's origin, follows the body from now on. */
  bind(object: Object3D, body: Body): this {
    object.matrixAutoUpdate = false;
    this.objects.set(object, body);
    return this;
  }
  /** Instance i follows bodies[i]; an instance whose body was removed is not drawn. */
  bindInstances(mesh: InstancedMesh, bodies: readonly Body[]): this {
    if (bodies.length > mesh.instanceMatrix.count) {
      throw new RangeError(`the mesh has room for ${mesh.instanceMatrix.count} instances, not for ${bodies.length}`);
    }
    mesh.count = bodies.length;
    mesh.frustumCulled = false; // its instances are about to leave the sphere that three computes once
    this.meshes.set(mesh, bodies);
    return this;
  }
  unbind(object: Object3D): this {
    this.objects.delete(object);
    this.meshes.delete(object as InstancedMesh);
    return this;
  }

  update(): void {
    const matrices = this.world.matrices;
    for (const [object, body] of this.objects) {
      if (!this.world.has(body)) {
        object.visible = false;
        continue;
      }
      const matrix: Matrix4 = object.matrix;
      widen(matrices, body.index, matrix.elements, 0);
      object.matrixWorldNeedsUpdate = true;
    }
    for (const [mesh, bodies] of this.meshes) {
      const array = mesh.instanceMatrix.array;
      bodies.forEach((body, i) => {
        if (this.world.has(body)) widen(matrices, body.index, array, 16 * i);
        else array.fill(0, 16 * i, 16 * i + 16);
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
  }
}
