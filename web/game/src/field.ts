// The field: its plate and walls, the light, and a camera that fits it between the page's bars.
import { Color, DirectionalLight, Mesh, MeshBasicMaterial, MeshStandardMaterial, Object3D, Shape, ShapeGeometry,
  Vector3 } from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import type { Capability } from "../../stage/src/quality.ts";
import { Stage } from "../../stage/src/stage.ts";
import type { Sizes } from "./engine.ts";
import { palette } from "./looks.ts";

const kWall = 0.34;
const kBelow = 0.35; // of the field that is seen under the paddle's foot, m
const kDepth = 1.3;
const kPlateZ = -0.7;

function roundedPlate(half: number, bottom: number, top: number, radius: number): ShapeGeometry {
  const shape = new Shape();
  shape.moveTo(-half, bottom);
  shape.lineTo(half, bottom);
  shape.lineTo(half, top - radius);
  shape.quadraticCurveTo(half, top, half - radius, top);
  shape.lineTo(-half + radius, top);
  shape.quadraticCurveTo(-half, top, -half, top - radius);
  shape.closePath();
  return new ShapeGeometry(shape, 8);
}

export class Field {
  readonly stage: Stage;
  private width = 1;
  private height = 1;
  private bars = { top: 0, bottom: 0 };
  private distance = 10;
  private middle = 8;

  constructor(canvas: HTMLCanvasElement, private readonly sizes: Sizes, capability: Capability,
    onContext: (lost: boolean) => void) {
    this.stage = new Stage(canvas, { theme: "dark", capability, onContext });
    const { scene } = this.stage;
    scene.background = new Color(palette.page);
    this.stage.camera.fov = 24;
    this.stage.setBounds(new Vector3(0, sizes.ceiling / 2, 0), sizes.ceiling * 0.62);
    const add = (object: Object3D) => scene.add(object);
    // The stage's sun stands high for floors; here the plate is a wall, and shadows are to stay near what casts them.
    const sun = scene.children.find((child) => child instanceof DirectionalLight);
    sun?.position.set(-0.4, 0.62, 1).multiplyScalar(sizes.ceiling).add(new Vector3(0, sizes.ceiling / 2, 0));
    const front = new DirectionalLight(0xfff6ea, 0.7);
    front.position.set(-3, sizes.ceiling * 0.6, 30);
    front.target.position.set(0, sizes.ceiling / 2, 0);
    add(front);
    add(front.target);
    const plate = new Mesh(roundedPlate(sizes.halfWidth, kBelow - 0.6, sizes.ceiling, 0.5),
      new MeshStandardMaterial({ color: palette.plate, roughness: 0.95 }));
    plate.position.z = kPlateZ;
    plate.receiveShadow = true;
    add(plate);
    this.addDots(add);
    const wall = new MeshStandardMaterial({ color: palette.wall, roughness: 0.8 });
    const bar = (w: number, h: number, x: number, y: number) => {
      const mesh = new Mesh(new RoundedBoxGeometry(w, h, kDepth, 4, 0.14), wall);
      mesh.position.set(x, y, -0.05);
      mesh.castShadow = mesh.receiveShadow = true;
      add(mesh);
    };
    const tall = sizes.ceiling + kWall - kBelow + 0.3;
    for (const side of [-1, 1]) {
      bar(kWall, tall, side * (sizes.halfWidth + kWall / 2), sizes.ceiling + kWall - tall / 2);
    }
    bar(2 * sizes.halfWidth + 2 * kWall, kWall, 0, sizes.ceiling + kWall / 2);
  }

  /** Faint dots: they tell how fast things go. */
  private addDots(add: (object: Object3D) => void): void {
    const material = new MeshBasicMaterial({ color: palette.wall, transparent: true, opacity: 0.35 });
    const dot = new ShapeGeometry(new Shape().absarc(0, 0, 0.045, 0, 2 * Math.PI), 6);
    for (let y = 0.5; y < this.sizes.ceiling; y += 1.5) {
      for (let x = -4.5; x <= 4.5; x += 1.5) {
        const mesh = new Mesh(dot, material);
        mesh.position.set(x, y, kPlateZ + 0.01);
        add(mesh);
      }
    }
  }

  /** CSS pixels; `top` and `bottom` are kept for the page's bars. */
  resize(width: number, height: number, bars: { top: number; bottom: number }): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.bars = bars;
    this.stage.resize(width, height);
    const wide = 2 * (this.sizes.halfWidth + kWall) + 0.3;
    const tall = this.sizes.ceiling + kWall - kBelow + 0.2;
    const free = Math.max(100, this.height - bars.top - bars.bottom);
    const unit = Math.max(tall / free, wide / this.width); // m a pixel
    // What is in front of the middle plane looks larger.
    this.distance = (unit * this.height) / (2 * Math.tan((this.stage.camera.fov * Math.PI) / 360)) + kDepth / 2;
    const spare = free * unit - tall;
    const field_middle = kBelow + tall / 2 - 0.1;
    this.middle = field_middle + ((bars.top - bars.bottom) / 2) * unit - Math.max(0, spare) * 0.5 * (this.width < 600
      ? -0.55 : 0);
  }

  /** Where on the page a point of the field is, CSS pixels. */
  toPage(x: number, y: number): { x: number; y: number } {
    const at = new Vector3(x, y, 0).project(this.stage.camera);
    return { x: ((at.x + 1) / 2) * this.width, y: ((1 - at.y) / 2) * this.height };
  }
  /** x of the field's middle plane under a page's x. */
  toField(page_x: number): number {
    return (page_x / this.width - 0.5) * this.metresAcross;
  }
  get metresAcross(): number {
    const tall = 2 * this.distance * Math.tan((this.stage.camera.fov * Math.PI) / 360);
    return (tall * this.width) / this.height;
  }
  /** The field's left and right on the page. */
  get sides(): { left: number; right: number } {
    return { left: this.toPage(-this.sizes.halfWidth, 1).x, right: this.toPage(this.sizes.halfWidth, 1).x };
  }
  get free(): { top: number; bottom: number } {
    return this.bars;
  }

  render(offset: { x: number; y: number }): void {
    const { camera } = this.stage;
    camera.position.set(offset.x, this.middle + offset.y, this.distance);
    camera.lookAt(offset.x * 0.6, this.middle + offset.y * 0.6, 0);
    this.stage.render();
  }
}
