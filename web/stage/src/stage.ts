// The renderer with its light, shadows, backdrop and quality steps: what every page of this project draws its world on.
import {
  Color,
  DirectionalLight,
  HemisphereLight,
  NeutralToneMapping,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { makeOccluders, type Occluders } from "./occlusion.js";
import { type Capability, Governor, qualities, type Quality } from "./quality.js";
import { type Theme, type ThemeName, themes } from "./theme.js";

export interface StageOptions {
  readonly theme: ThemeName;
  readonly capability: Capability;
  /** Of `qualities`, to stay with; undefined: what the renderer is fast enough for. */
  readonly quality?: number | undefined;
  /** Called when the graphics context is lost, and when it is back. */
  readonly onContext?: (lost: boolean) => void;
}

/** A part of the picture, shares of its width and height from the top left; `draw` says what is seen there. */
export interface Pane {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
  readonly draw?: () => void;
}

export const kWholePane: Pane = { x: 0, y: 0, width: 1, height: 1 };

export class Stage {
  readonly renderer: WebGLRenderer;
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(35, 1, 0.05, 2000);
  readonly occluders: Occluders = makeOccluders();
  readonly governor: Governor;
  private readonly hemisphere = new HemisphereLight();
  private readonly sun = new DirectionalLight();
  private themeName: ThemeName;
  private size = { width: 1, height: 1, ratio: 1, exact: false };
  private center = new Vector3(0, 1, 0);
  private radius = 6;
  private lost = false;
  private readonly canvas: HTMLCanvasElement;

  constructor(canvas: HTMLCanvasElement, options: StageOptions) {
    this.canvas = canvas;
    this.themeName = options.theme;
    const fixed = options.quality !== undefined;
    this.governor = new Governor(options.quality ?? (options.capability.software ? 3 : 0), fixed);
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: !options.capability.software || fixed,
      powerPreference: "high-performance",
    });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.info.autoReset = false;
    this.sun.castShadow = true;
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.02;
    this.sun.shadow.radius = 4;
    this.sun.shadow.intensity = 0.62;
    this.scene.add(this.hemisphere, this.sun, this.sun.target);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.lost = true;
      options.onContext?.(true);
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.lost = false;
      options.onContext?.(false);
    });
    this.setTheme(options.theme);
    this.applyQuality();
  }

  get theme(): Theme {
    return themes[this.themeName];
  }
  get quality(): Quality {
    return qualities[this.governor.level]!;
  }

  setTheme(name: ThemeName): void {
    this.themeName = name;
    const { horizon, sky, floor, ambient, sun } = this.theme;
    this.scene.background = new Color(horizon);
    this.hemisphere.color
      .setHex(name === "dark" ? 0xdde5f7 : 0xffffff)
      .lerp(new Color(sky), name === "dark" ? 0.1 : 0.2);
    this.hemisphere.groundColor.setHex(floor).lerp(new Color(0x9a8c7a), 0.25);
    this.hemisphere.intensity = ambient;
    this.sun.color.setHex(0xfff3e2);
    this.sun.intensity = sun;
  }

  /** CSS pixels. `exact`: that many pixels, whatever the quality: for pictures that are kept. */
  resize(width: number, height: number, ratio = globalThis.devicePixelRatio ?? 1, exact = false): void {
    this.size = { width: Math.max(width, 1), height: Math.max(height, 1), ratio, exact };
    this.applySize();
  }

  /** What the light has to reach: the middle and the radius of the action. */
  setBounds(center: Vector3, radius: number): void {
    this.center = center.clone();
    this.radius = Math.max(radius, 0.5);
    this.sun.target.position.copy(center);
    this.sun.position.copy(center).add(new Vector3(-0.45, 1.25, 0.75).multiplyScalar(this.radius * 1.6));
    const camera = this.sun.shadow.camera;
    camera.left = camera.bottom = -this.radius * 1.15;
    camera.right = camera.top = this.radius * 1.15;
    camera.near = this.radius * 0.1;
    camera.far = this.radius * 5;
    camera.updateProjectionMatrix();
  }
  get bounds(): { center: Vector3; radius: number } {
    return { center: this.center.clone(), radius: this.radius };
  }

  /** Watches how fast frames come, and steps the quality down where they do not. True where it changed. */
  watch(elapsed: number): boolean {
    const changed = this.governor.frame(elapsed);
    if (changed) this.applyQuality();
    return changed;
  }
  setLevel(level: number): void {
    this.governor.level = Math.min(Math.max(level, 0), qualities.length - 1);
    this.applyQuality();
  }

  private applySize(): void {
    const { ratio, exact } = this.size;
    this.renderer.setPixelRatio(exact ? ratio : Math.min(ratio, this.quality.pixelRatio));
    this.renderer.setSize(this.size.width, this.size.height, false);
  }
  private applyQuality(): void {
    const { shadowMap } = this.quality;
    const was = this.sun.castShadow;
    this.renderer.shadowMap.enabled = this.sun.castShadow = shadowMap > 0;
    if (shadowMap > 0 && this.sun.shadow.mapSize.x !== shadowMap) {
      this.sun.shadow.mapSize.set(shadowMap, shadowMap);
      this.sun.shadow.map?.dispose();
      this.sun.shadow.map = null;
    }
    if (was !== this.sun.castShadow) {
      this.scene.traverse((object) => {
        const material = (object as { material?: { needsUpdate: boolean } }).material;
        if (material !== undefined) material.needsUpdate = true;
      });
    }
    this.applySize();
  }

  /** Draws the panes; each with the camera's view, widened or narrowed to its form. */
  render(panes: readonly Pane[] = [kWholePane]): void {
    if (this.lost) return;
    const { width, height } = this.size;
    this.renderer.info.reset();
    this.renderer.setScissorTest(panes.length > 1);
    for (const pane of panes) {
      const [w, h] = [pane.width * width, pane.height * height];
      const bottom = height - pane.y * height - h;
      this.renderer.setViewport(pane.x * width, bottom, w, h);
      this.renderer.setScissor(pane.x * width, bottom, w, h);
      this.camera.aspect = w / Math.max(h, 1);
      this.camera.updateProjectionMatrix();
      pane.draw?.();
      this.renderer.render(this.scene, this.camera);
    }
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, width, height);
  }

  get isLost(): boolean {
    return this.lost;
  }
  get drawCalls(): number {
    return this.renderer.info.render.calls;
  }

  dispose(): void {
    this.renderer.dispose();
    this.canvas.remove();
  }
}
