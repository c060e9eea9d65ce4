// Bits that fly off what is hit, and rings that spread: a pool of each, moved in the page's own time.
import { Color, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshBasicMaterial, MeshStandardMaterial, Quaternion,
  RingGeometry,
  Vector3 } from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";

const kBits = 360, kRings = 24;
const kFall = 16; // m/s^2

interface Bit {
  position: Vector3;
  velocity: Vector3;
  turn: Quaternion;
  spin: Vector3;
  size: number;
  age: number;
  life: number;
}

interface Ring {
  x: number;
  y: number;
  age: number;
  size: number;
}

/** How many bits a hit throws off: more with its speed, m/s. */
export function bitsOf(speed: number): number {
  return Math.round(Math.min(10, 0.5 * Math.max(0, speed - 3)));
}

export class Particles {
  readonly group = new Group();
  private readonly bits: Bit[] = [];
  private readonly rings: Ring[] = [];
  private readonly bitMesh: InstancedMesh;
  private readonly ringMesh: InstancedMesh;
  private next = 0;
  private nextRing = 0;
  private readonly matrix = new Matrix4();
  private readonly scale = new Vector3();
  private readonly color = new Color();

  constructor() {
    this.bitMesh = new InstancedMesh(new RoundedBoxGeometry(1, 1, 1, 2, 0.25),
      new MeshStandardMaterial({ roughness: 0.6 }), kBits);
    this.ringMesh = new InstancedMesh(new RingGeometry(0.86, 1, 48), new MeshBasicMaterial({ transparent: true,
      opacity: 0.5,
      depthWrite: false }), kRings);
    for (const mesh of [this.bitMesh, this.ringMesh]) {
      mesh.instanceMatrix.setUsage(DynamicDrawUsage);
      mesh.frustumCulled = false;
      mesh.count = 0;
      this.group.add(mesh);
    }
  }

  burst(x: number, y: number, color: number, count: number, speed: number, way: { x: number; y: number } = { x: 0,
    y: 0 }): void {
    for (let i = 0; i < count; ++i) {
      const angle = Math.random() * 2 * Math.PI;
      const fast = speed * (0.35 + 0.65 * Math.random());
      const bit: Bit = {
        position: new Vector3(x + 0.35 * (Math.random() - 0.5), y + 0.25 * (Math.random() - 0.5), 0.5 * Math.random()),
        velocity: new Vector3(Math.cos(angle) * fast + way.x * speed, Math.sin(angle) * fast + way.y * speed,
          fast * (0.3 + 0.5 * Math.random())),
        turn: new Quaternion().random(),
        spin: new Vector3().randomDirection().multiplyScalar(9 * Math.random()),
        size: 0.07 + 0.13 * Math.random(),
        age: 0,
        life: 0.45 + 0.4 * Math.random(),
      };
      this.bits[this.next] = bit;
      this.bitMesh.setColorAt(this.next, this.color.setHex(color));
      this.next = (this.next + 1) % kBits;
    }
    if (count > 0 && this.bitMesh.instanceColor !== null) this.bitMesh.instanceColor.needsUpdate = true;
  }

  ring(x: number, y: number, color: number, size: number): void {
    this.rings[this.nextRing] = { x, y, size, age: 0 };
    this.ringMesh.setColorAt(this.nextRing, this.color.setHex(color));
    this.nextRing = (this.nextRing + 1) % kRings;
    if (this.ringMesh.instanceColor !== null) this.ringMesh.instanceColor.needsUpdate = true;
  }

  clear(): void {
    this.bits.length = this.rings.length = this.next = this.nextRing = 0;
  }

  update(elapsed: number): void {
    const turn = new Quaternion();
    this.bits.forEach((bit, i) => {
      bit.age += elapsed;
      bit.velocity.y -= kFall * elapsed;
      bit.position.addScaledVector(bit.velocity, elapsed);
      const speed = bit.spin.length();
      if (speed > 0) bit.turn.premultiply(turn.setFromAxisAngle(bit.spin.clone().normalize(), speed * elapsed));
      const left = Math.max(0, 1 - bit.age / bit.life);
      this.bitMesh.setMatrixAt(i, this.matrix.compose(bit.position, bit.turn,
        this.scale.setScalar(bit.size * Math.sqrt(left))));
    });
    this.bitMesh.count = this.bits.length;
    this.bitMesh.instanceMatrix.needsUpdate = true;
    this.rings.forEach((ring, i) => {
      const kLife = 0.35;
      ring.age += elapsed;
      const share = Math.min(1, ring.age / kLife);
      const size = share < 1 ? ring.size * (0.3 + 0.7 * Math.sqrt(share)) : 0;
      this.ringMesh.setMatrixAt(i, this.matrix.makeScale(size, size, size).setPosition(ring.x, ring.y, 0.55
        - 0.02 * i));
    });
    this.ringMesh.count = this.rings.length;
    this.ringMesh.instanceMatrix.needsUpdate = true;
  }
}
