// A mesh file as a body: its convex hull collides, the mesh itself is drawn, in the hull's frame.
import { Shape } from "elastoon";
import { Box3, Group, type Mesh, type Object3D, Quaternion, Vector3 } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { InputError } from "../core/limits.js";
import type { SceneShape } from "../core/take.js";

/** Sizes that are left as they are, m; others are brought to one. */
const kSmallest = 0.15;
const kLargest = 6;
const kMostHullPoints = 160;
const kMostVertices = 1_000_000;

export interface BroughtMesh {
  readonly name: string;
  readonly shape: SceneShape;
  /** In the shape's frame. */
  readonly object: Object3D;
  readonly note: string;
}

async function parse(bytes: Uint8Array, ending: string): Promise<Object3D> {
  if (ending === "obj") return new OBJLoader().parse(new TextDecoder().decode(bytes));
  const loader = new GLTFLoader();
  // Only what is in the file itself: nothing is fetched.
  loader.manager.setURLModifier((url) => (/^(data|blob):/.test(url) ? url : "data:,"));
  const gltf = await loader.parseAsync(bytes.buffer as ArrayBuffer, "");
  return gltf.scene;
}

function pointsOf(object: Object3D): Float64Array {
  const points: number[] = [];
  const point = new Vector3();
  object.updateMatrixWorld(true);
  object.traverse((node) => {
    const mesh = node as Mesh;
    const positions = mesh.isMesh ? mesh.geometry.getAttribute("position") : undefined;
    if (positions === undefined) return;
    if (points.length / 3 + positions.count > kMostVertices) {
      throw new InputError(`the mesh has more than ${kMostVertices} vertices`);
    }
    for (let i = 0; i < positions.count; ++i) {
      mesh.getVertexPosition(i, point).applyMatrix4(mesh.matrixWorld);
      if (Number.isFinite(point.x + point.y + point.z)) points.push(point.x, point.y, point.z);
    }
  });
  return Float64Array.from(points);
}

/** The points that lie furthest out in directions all around. */
function furthest(points: Float64Array, most: number): Float64Array {
  const kept = new Set<number>();
  const golden = Math.PI * (3 - Math.sqrt(5));
  for (let k = 0; k < most; ++k) {
    const y = 1 - (2 * (k + 0.5)) / most;
    const r = Math.sqrt(1 - y * y);
    const [x, z] = [Math.cos(golden * k) * r, Math.sin(golden * k) * r];
    let [best, at] = [-Infinity, 0];
    for (let i = 0; i < points.length; i += 3) {
      const along = points[i]! * x + points[i + 1]! * y + points[i + 2]! * z;
      if (along > best) [best, at] = [along, i];
    }
    kept.add(at);
  }
  return Float64Array.from([...kept].flatMap((i) => [points[i]!, points[i + 1]!, points[i + 2]!]));
}

export async function readMesh(bytes: Uint8Array, ending: string, file: string): Promise<BroughtMesh> {
  const source = await parse(bytes, ending);
  let points = pointsOf(source);
  if (points.length < 12) throw new InputError("there is no mesh in it: four points at least are needed");
  const size = new Box3().setFromArray(points).getSize(new Vector3());
  const largest = Math.max(size.x, size.y, size.z);
  if (!(largest > 0)) throw new InputError("all of its points are in one place");
  const scale = largest < kSmallest || largest > kLargest ? 1 / largest : 1;
  // A body's axis is x, and lies along its way: what is below in the mesh leads when it falls, and it stands when it
  // rests.
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, -1, 0), new Vector3(1, 0, 0));
  const point = new Vector3();
  for (let i = 0; i < points.length; i += 3) {
    point.fromArray(points, i).multiplyScalar(scale).applyQuaternion(turn).toArray(points, i);
  }
  points = furthest(points, Math.min(1200, Math.max(Math.round(1e8 / points.length), 200)));
  let hull = Shape.hull(points);
  let vertices = Float64Array.from(hull.vertices());
  if (vertices.length / 3 > kMostHullPoints) {
    hull = Shape.hull(furthest(points, kMostHullPoints));
    vertices = Float64Array.from(hull.vertices());
  }
  // The hull's own points are about its centroid; the mesh is moved by as much.
  const { x, y, z } = hull.centroidOfInput;
  const object = new Group();
  const placed = new Group().add(source);
  placed.scale.setScalar(scale);
  placed.quaternion.copy(turn);
  placed.position.set(-x, -y, -z);
  object.add(placed);
  object.traverse((node) => {
    node.castShadow = node.receiveShadow = true;
  });
  const list = Array.from({ length: vertices.length / 3 }, (_, i) =>
    [0, 1, 2].map((k) => Number(vertices[3 * i + k]!.toFixed(5))),
  );
  const name = file.replace(/\.\w+$/, "").slice(0, 40) || "mesh";
  const scaled = scale === 1 ? "" : ` It was ${largest.toPrecision(3)} m large and is 1 m now.`;
  return {
    name,
    object,
    shape: { type: "hull", points: list },
    note: `${name}: its hull of ${list.length} points collides, the mesh is drawn.${scaled}`,
  };
}
