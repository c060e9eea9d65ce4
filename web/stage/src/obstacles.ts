// Planes and solids. Planes are drawn as large sheets that fade into the backdrop and are seen from their free side
// only.
import { type Rotation, type Shape, type Vector } from "elastoon";
import {
  Color,
  DoubleSide,
  FrontSide,
  Group,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  PlaneGeometry,
  Quaternion,
  type Raycaster,
  Vector3,
} from "three";
import { displayGeometry } from "./bodies.js";
import { darkened, type Occluders } from "./occlusion.js";
import type { Theme } from "./theme.js";

export interface ObstacleLook {
  /** Null: a plane. */
  readonly shape: Shape | null;
  /** Of a plane, in its frame. */
  readonly normal: Readonly<Vector>;
  /** sRGB; undefined: the theme's. */
  readonly color?: number | undefined;
  /** Where it is and how it is turned, to begin with. */
  readonly position: Readonly<Vector>;
  readonly rotation: Readonly<Rotation>;
}

const sheetDeclare = /* glsl */ `
uniform vec3 uCenter;
uniform float uReach;
uniform vec3 uGrid;
float gridLine(vec2 p, float every) {
  vec2 cell = abs(fract(p / every - 0.5) - 0.5) * every;
  vec2 width = fwidth(p) * 0.8;
  vec2 line = 1.0 - smoothstep(vec2(0.0), width, cell);
  float fade = 1.0 - clamp(max(width.x, width.y) * 6.0 / every, 0.0, 1.0);
  return max(line.x, line.y) * fade;
}
varying vec2 vSheet;
`;
const sheetColor = /* glsl */ `
  float lines = max(gridLine(vSheet, 1.0) * 0.35, gridLine(vSheet, 5.0) * 0.7);
  diffuseColor.rgb = mix(diffuseColor.rgb, uGrid, lines);
  diffuseColor.a *= 1.0 - smoothstep(0.35, 1.0, distance(vStagePoint, uCenter) / uReach);
`;

/** Draws obstacles. `group` is to be put in a scene, at its origin. */
export class ObstacleViews {
  readonly group = new Group();
  private readonly meshes: Mesh[] = [];
  private looks: readonly ObstacleLook[] = [];

  /** `reach` and `center`: how far planes are to be seen. */
  set(looks: readonly ObstacleLook[], theme: Theme, occluders: Occluders, center: Vector3, reach: number): void {
    this.clear();
    this.looks = looks;
    for (const look of looks) {
      const mesh =
        look.shape === null ? this.sheet(look, theme, occluders, center, reach) : this.solid(look, theme, occluders);
      mesh.receiveShadow = true;
      this.meshes.push(mesh);
      this.group.add(mesh);
      this.move(this.meshes.length - 1, look.position, look.rotation);
    }
  }

  private solid(look: ObstacleLook, theme: Theme, occluders: Occluders): Mesh {
    const material = new MeshStandardMaterial({ color: look.color ?? theme.solid, roughness: 0.85, metalness: 0 });
    darkened(material, occluders);
    const mesh = new Mesh(displayGeometry(look.shape!), material);
    mesh.castShadow = true;
    return mesh;
  }

  private sheet(look: ObstacleLook, theme: Theme, occluders: Occluders, center: Vector3, reach: number): Mesh {
    // Walls stand against the light and before the backdrop: they glow a little and let it through.
    const wall = Math.abs(look.normal.y) < 0.7;
    const material = new MeshStandardMaterial({
      color: look.color ?? theme.floor,
      roughness: 0.95,
      transparent: true,
      side: FrontSide,
      opacity: wall ? 0.55 : 1,
      userData: { glow: wall ? 0.35 : 0 },
    });
    material.emissive.setHex(look.color ?? theme.floor);
    material.emissiveIntensity = wall ? 0.35 : 0;
    darkened(material, occluders, {
      declare: sheetDeclare,
      color: sheetColor,
      key: "sheet",
      uniforms: {
        uCenter: { value: center.clone() },
        uReach: { value: reach },
        uGrid: { value: new Color(theme.grid) },
      },
    });
    const compile = material.onBeforeCompile.bind(material);
    material.onBeforeCompile = (shader, renderer) => {
      compile(shader, renderer);
      shader.vertexShader = `varying vec2 vSheet;\n${shader.vertexShader}`.replace(
        "#include <begin_vertex>",
        "#include <begin_vertex>\n  vSheet = position.xy;",
      );
    };
    const mesh = new Mesh(new PlaneGeometry(2 * reach, 2 * reach), material);
    mesh.renderOrder = -1;
    return mesh;
  }

  /** Puts one where it is now. */
  move(index: number, position: Readonly<Vector>, rotation: Readonly<Rotation>): void {
    const mesh = this.meshes[index];
    const look = this.looks[index];
    if (mesh === undefined || look === undefined) return;
    mesh.position.set(position.x, position.y, position.z);
    mesh.quaternion.set(rotation.x, rotation.y, rotation.z, rotation.w);
    if (look.shape !== null) return;
    const normal = new Vector3(look.normal.x, look.normal.y, look.normal.z).normalize();
    mesh.quaternion.multiply(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), normal));
  }

  object(index: number): Object3D | undefined {
    return this.meshes[index];
  }

  /** Index of the obstacle that the ray meets first, and how far; -1: none. Solids alone where `planes` is false. */
  pick(ray: Raycaster, planes = true): { index: number; distance: number; point: Vector3 | null } {
    const candidates = this.meshes.filter((_, i) => planes || this.looks[i]?.shape !== null);
    const hit = ray.intersectObjects(candidates, false)[0];
    if (hit === undefined) return { index: -1, distance: Infinity, point: null };
    return { index: this.meshes.indexOf(hit.object as Mesh), distance: hit.distance, point: hit.point };
  }

  /** Marks one: selected, or refused. */
  mark(index: number, color: number | null): void {
    this.meshes.forEach((mesh, i) => {
      const material = mesh.material as MeshStandardMaterial;
      const glow = (material.userData["glow"] as number | undefined) ?? 0;
      const marked = i === index && color !== null;
      material.emissive.copy(material.color);
      if (marked) material.emissive.setHex(color);
      material.emissiveIntensity = marked ? 0.35 : glow;
      material.side = this.looks[i]?.shape === null ? FrontSide : DoubleSide;
    });
  }

  clear(): void {
    for (const mesh of this.meshes) {
      mesh.geometry.dispose();
      (mesh.material as MeshStandardMaterial).dispose();
    }
    this.meshes.length = 0;
    this.group.clear();
  }
}
