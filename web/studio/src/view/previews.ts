// What is drawn over the world: the rubber band with the path that is to come, and the places of the frames along a
// path.
import {
  CylinderGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  TorusGeometry,
  Vector3,
} from "three";

const kMostDots = 160;
const up = new Vector3(0, 1, 0);
const front = new Vector3(0, 0, 1);

function dots(color: number, opacity: number): InstancedMesh {
  const material = new MeshBasicMaterial({ color, transparent: true, opacity, depthTest: false });
  const mesh = new InstancedMesh(new SphereGeometry(1, 12, 8), material, kMostDots);
  mesh.count = 0;
  mesh.frustumCulled = false;
  mesh.renderOrder = 10;
  return mesh;
}

function place(mesh: InstancedMesh, points: readonly Vector3[], size: (index: number) => number): void {
  const matrix = new Matrix4();
  mesh.count = Math.min(points.length, kMostDots);
  for (let i = 0; i < mesh.count; ++i) {
    const s = size(i);
    mesh.setMatrixAt(i, matrix.makeScale(s, s, s).setPosition(points[i]!));
  }
  mesh.instanceMatrix.needsUpdate = true;
}

/** The rubber band: from the body to the finger, and where the body will fly. */
export class Band {
  readonly group = new Group();
  private readonly band: Mesh;
  private readonly knob: Mesh;
  private readonly ring: Mesh;
  private readonly path: InstancedMesh;

  constructor(color: number) {
    const material = new MeshBasicMaterial({ color, transparent: true, opacity: 0.9, depthTest: false });
    this.band = new Mesh(new CylinderGeometry(1, 1, 1, 12), material);
    this.knob = new Mesh(new SphereGeometry(1, 20, 14), material);
    this.ring = new Mesh(new TorusGeometry(1, 0.09, 10, 48), material);
    this.path = dots(color, 0.75);
    for (const mesh of [this.band, this.knob, this.ring]) mesh.renderOrder = 11;
    this.group.add(this.band, this.knob, this.ring, this.path);
    this.group.visible = false;
  }

  /** `size`: the body's radius; `contact`: the first touch, if there is one. */
  show(
    from: Vector3,
    to: Vector3,
    size: number,
    path: readonly Vector3[],
    contact: { point: Vector3; normal: Vector3 } | null,
  ): void {
    const along = to.clone().sub(from);
    const length = along.length();
    this.group.visible = true;
    this.band.visible = this.knob.visible = length > 1e-6;
    const thick = (size * 0.16) / Math.sqrt(1 + length / (3 * size));
    this.band.position.copy(from).addScaledVector(along, 0.5);
    this.band.scale.set(thick, Math.max(length, 1e-6), thick);
    if (length > 1e-6) this.band.quaternion.setFromUnitVectors(up, along.multiplyScalar(1 / length));
    this.knob.position.copy(to);
    this.knob.scale.setScalar(size * 0.24);
    place(this.path, path, (i) => size * 0.15 * Math.max(1 - i / (path.length + 12), 0.25));
    this.ring.visible = contact !== null;
    if (contact === null) return;
    this.ring.position.copy(contact.point).addScaledVector(contact.normal, size * 0.03);
    this.ring.quaternion.copy(new Quaternion().setFromUnitVectors(front, contact.normal));
    this.ring.scale.setScalar(size * 0.7);
  }
  hide(): void {
    this.group.visible = false;
  }
}

/** Dots where a body is on each frame of film. */
export class SpacingDots {
  readonly group = new Group();
  private readonly mesh: InstancedMesh;

  constructor(color: number) {
    this.mesh = dots(color, 0.9);
    this.group.add(this.mesh);
  }
  show(points: readonly Vector3[], size: number): void {
    place(this.mesh, points, () => size * 0.09);
  }
  hide(): void {
    this.mesh.count = 0;
  }
}
