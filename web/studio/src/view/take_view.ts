// What is drawn of one take: its bodies, their ghosts, its obstacles. Two of them stand side by side in a comparison.
import {
  type BodyLook,
  BodyViews,
  halfExtents,
  type ObstacleLook,
  ObstacleViews,
  type PatternName,
  type Stage,
} from "stage";
import { Group, type Object3D, Raycaster, Vector3 } from "three";
import type { Player } from "../core/player.js";
import type { SceneFile } from "../core/take.js";

/** Most ghosts, bodies times times. */
const kMostGhosts = 2400;

/** Meshes that were brought, by the name of the shape that stands for them. */
export type BroughtMeshes = ReadonlyMap<string, Object3D>;

export interface Looks {
  readonly pattern: PatternName;
  readonly meshes: BroughtMeshes;
}

const hexOf = (color: string | undefined): number | undefined =>
  color === undefined ? undefined : Number.parseInt(color.slice(1), 16);

export class TakeView {
  readonly group = new Group();
  readonly bodies: BodyViews;
  readonly ghosts: BodyViews;
  readonly obstacles = new ObstacleViews();
  private moving: number[] = [];
  private shown = -1;
  private ghostCopies = 0;
  private looks: readonly BodyLook[] = [];

  constructor(
    private readonly stage: Stage,
    readonly player: Player,
    private readonly options: Looks,
  ) {
    this.bodies = new BodyViews(stage.theme.cream);
    this.ghosts = new BodyViews(stage.theme.cream, { opacity: 0.3, shadows: false });
    this.group.add(this.obstacles.group, this.ghosts.group, this.bodies.group);
    stage.scene.add(this.group);
    this.setObstacles();
  }

  /** To be called after the stage's bounds or theme changed. */
  setObstacles(): void {
    const scene: SceneFile = this.player.take.scene;
    const { center, radius } = this.stage.bounds;
    const obstacles = this.player.world.obstacles();
    const looks = (scene.obstacles ?? []).map((from_file, i): ObstacleLook => {
      const frame = this.player.scene.obstacleFrame(i, 0);
      const shape = obstacles[i]?.shape ?? null;
      const normal = shape === null ? obstacles[i]!.planeNormal() : { x: 0, y: 1, z: 0 };
      return { shape, normal, color: hexOf(from_file.color), position: frame.position, rotation: frame.rotation };
    });
    this.moving = (scene.obstacles ?? []).flatMap((from_file, i) =>
      from_file.path !== undefined || from_file.velocity !== undefined || from_file.angular_velocity !== undefined
        ? [i]
        : [],
    );
    this.obstacles.set(looks, this.stage.theme, this.stage.occluders, center, Math.max(radius * 3.2, 8));
  }

  /** Bodies may have come in since the last time. */
  private refresh(): void {
    const { bodies, take } = this.player;
    if (bodies.length === this.shown) return;
    this.shown = bodies.length;
    const shape_names = [
      ...(take.scene.bodies ?? []),
      ...take.inputs.flatMap((input) => (input.kind === "arrival" ? [input.body] : [])),
    ].map((body) => body.shape);
    this.looks = bodies.map(({ body, color }, i): BodyLook => {
      const template = this.options.meshes.get(shape_names[i] ?? "");
      return {
        index: body.index,
        shape: body.shape,
        color,
        pattern: this.options.pattern,
        ...(template && { object: new Group().add(template.clone()) }),
      };
    });
    this.bodies.set(this.looks);
    this.ghostCopies = 0;
  }

  show(time: number): void {
    this.refresh();
    this.bodies.update(this.player.matricesAt(time));
    for (const i of this.moving) {
      const frame = this.player.scene.obstacleFrame(i, Math.min(Math.max(time, 0), 1e6));
      this.obstacles.move(i, frame.position, frame.rotation);
    }
  }

  /** Ghosts at these times; none: none. */
  showGhosts(times: readonly number[]): void {
    const solid = this.looks.filter((look) => look.object === undefined);
    const most = Math.max(Math.floor(kMostGhosts / Math.max(solid.length, 1)), 0);
    const every = Math.max(Math.ceil(times.length / Math.max(most, 1)), 1);
    const kept = times.filter((_, i) => i % every === 0);
    if (kept.length === 0 || most === 0) {
      this.ghosts.place([]);
      return;
    }
    if (this.ghostCopies < kept.length) {
      this.ghostCopies = Math.min(Math.max(kept.length, 16), most);
      this.ghosts.set(solid, Math.max(this.ghostCopies, 2));
    }
    this.ghosts.place(kept.map((time) => this.player.matricesAt(time).slice()));
  }

  /** Before this take is drawn: what lies under its bodies gets dark. */
  occlude(time: number, focus: Vector3): void {
    const occluders = this.stage.occluders;
    occluders.count = 0;
    this.bodies.occlude(occluders, this.player.matricesAt(time), this.stage.quality.occluders, focus);
  }

  /** The body under the ray, unless something stands before it. */
  pickBody(ray: Raycaster): number {
    const index = this.bodies.pick(ray);
    return index;
  }

  /** The middle and the radius of all that happens, as far as it is known. */
  bounds(end: number): { center: Vector3; radius: number } {
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = low.clone().negate();
    const point = new Vector3();
    const add = (x: number, y: number, z: number, r: number) => {
      low.min(point.set(x - r, y - r, z - r));
      high.max(point.set(x + r, y + r, z + r));
    };
    for (let i = 0; i <= 24; ++i) {
      const matrices = this.player.matricesAt((Math.min(end, this.player.recordedTime) * i) / 24);
      for (const { body } of this.player.bodies) {
        const at = 12 * body.index;
        if (at + 11 >= matrices.length || (matrices[at] === 0 && matrices[at + 1] === 0 && matrices[at + 2] === 0))
          continue;
        add(matrices[at + 9]!, matrices[at + 10]!, matrices[at + 11]!, Math.max(...halfExtents(body.shape)));
      }
    }
    this.player.world.obstacles().forEach((obstacle, i) => {
      if (obstacle.shape === null) return;
      const { position } = this.player.scene.obstacleFrame(i, 0);
      add(position.x, position.y, position.z, Math.min(obstacle.shape.boundingRadius, 12) * 0.8);
    });
    if (!Number.isFinite(low.x)) return { center: new Vector3(0, 1, 0), radius: 6 };
    const radius = Math.min(Math.max(low.distanceTo(high) / 2, 1), 5000);
    return { center: low.add(high).multiplyScalar(0.5), radius };
  }

  dispose(): void {
    this.stage.scene.remove(this.group);
    this.bodies.clear();
    this.ghosts.clear();
    this.obstacles.clear();
  }
}
