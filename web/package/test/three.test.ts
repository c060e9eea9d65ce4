// elastoon/three: matrices and normals against the world's own.
import assert from "node:assert/strict";
import { test } from "node:test";
import Elastoon, { BodyDesc, ObstacleDesc, Shape, World } from "elastoon";
import { geometryOf, ThreeBinding } from "elastoon/three";
import { InstancedMesh, Matrix3, Matrix4, Mesh, MeshBasicMaterial, Vector3 } from "three";

await Elastoon.init();

/** As three's vertex shader turns an instance's normal. */
function instanceNormal(matrix: Matrix4, normal: Vector3): Vector3 {
  const columns = [new Vector3(), new Vector3(), new Vector3()] as const;
  matrix.extractBasis(...columns);
  const scaled = normal.clone().divide(new Vector3(...columns.map((column) => column.lengthSq())));
  return scaled.applyMatrix3(new Matrix3().setFromMatrix4(matrix)).normalize();
}

test("objects and instances follow, with the right normals", () => {
  const world = new World();
  world.createObstacle(ObstacleDesc.plane());
  const shape = Shape.capsule(0.3, 1.2);
  const bodies = [0, 3, 6].map((x) => world.createBody(new BodyDesc(shape).setTranslation(x, 4, 0).setLinvel(2, -8, 1)));
  const geometry = geometryOf(shape);
  const mesh = new InstancedMesh(geometry, new MeshBasicMaterial(), 4);
  const single = new Mesh(geometry, new MeshBasicMaterial());
  const binding = new ThreeBinding(world).bindInstances(mesh, bodies).bind(single, bodies[1]!);
  for (let i = 0; i < 20; ++i) {
    world.step();
    binding.update();
    const normals = world.normalMatrices();
    single.updateMatrixWorld();
    bodies.forEach((body, index) => {
      const matrix = new Matrix4();
      mesh.getMatrixAt(index, matrix);
      const position = new Vector3().setFromMatrixPosition(matrix);
      assert.ok(position.distanceTo(new Vector3().copy(body.translation())) < 1e-5);
      const exact = new Matrix3().fromArray(normals, 9 * body.index);
      const normal = new Vector3(0.36, 0.48, 0.8);
      const expected = normal.clone().applyMatrix3(exact).normalize();
      assert.ok(instanceNormal(matrix, normal).distanceTo(expected) < 1e-5);
      // A normal that turned as a point does would be wrong here: the test can fail.
      if (i === 19) assert.ok(normal.clone().transformDirection(matrix).distanceTo(expected) > 0.01);
      if (index !== 1) return;
      const object = new Matrix3().getNormalMatrix(single.matrixWorld);
      assert.ok(normal.clone().applyMatrix3(object).normalize().distanceTo(expected) < 1e-5);
    });
  }
  world.removeBody(bodies[1]!);
  binding.update();
  assert.equal(single.visible, false);
  assert.deepEqual([...mesh.instanceMatrix.array.slice(16, 32)], new Array(16).fill(0));
  assert.throws(() => binding.bindInstances(mesh, [...bodies, ...bodies]), RangeError);
  world.dispose();
});

test("a shape's geometry is closed, outward, and within its extents", () => {
  for (const shape of [Shape.ball(1), Shape.box(1, 2, 3), Shape.cone(1, 2)]) {
    const geometry = geometryOf(shape, false);
    geometry.computeBoundingBox();
    const size = geometry.boundingBox!.getSize(new Vector3());
    assert.ok(size.distanceTo(new Vector3().copy(shape.extents)) < 1e-5);
    const [vertices, triangles] = [shape.vertices(), shape.triangles()];
    let volume = 0;
    for (let i = 0; i < triangles.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromArray(vertices, 3 * triangles[i + k]!)) as [Vector3, Vector3, Vector3];
      volume += a.dot(b.cross(c)) / 6;
    }
    assert.ok(Math.abs(volume / shape.volume - 1) < 1e-5);
    const flat = geometryOf(shape, true);
    assert.equal(flat.getAttribute("position")!.count, triangles.length);
  }
});
