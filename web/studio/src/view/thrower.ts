// Throwing: pull a body back on a rubber band, see where it will fly, let go.
import { World } from "elastoon";
import { Plane, type Raycaster, Vector3, type Camera } from "three";
import type { PlayedBody, Player } from "../core/player.js";
import type { Triple } from "../core/take.js";
import type { Band } from "./previews.js";

/** m/s for each m that the band is pulled. */
const kSpeedPerPull = 5;
const kMostSpeed = 60;
/** How far ahead the path is shown, s, and the time between its dots. */
const kAhead = 1.6;
const kDotEvery = 1 / 30;

export interface Aim {
  readonly name: string;
  readonly position: Triple;
  readonly velocity: Triple;
}

export class Thrower {
  private readonly scratch = new World();
  private held: { played: PlayedBody; from: Vector3; plane: Plane; size: number } | null = null;
  private velocity = new Vector3();

  constructor(private readonly band: Band) {}

  get aiming(): boolean {
    return this.held !== null;
  }
  get speed(): number {
    return this.velocity.length();
  }

  /** Takes hold of a body of the player's world, which stands at the moment of the throw. */
  begin(player: Player, played: PlayedBody, camera: Camera): void {
    this.scratch.restore(player.world.snapshot());
    const { x, y, z } = played.body.translation();
    const from = new Vector3(x, y, z);
    // Upright and facing the camera, so that a scene that plays in a plane stays in it.
    const facing = camera.getWorldDirection(new Vector3());
    facing.y = 0;
    if (facing.lengthSq() < 0.02) facing.set(0, 0, 1);
    facing.normalize();
    for (const axis of [new Vector3(0, 0, 1), new Vector3(1, 0, 0)]) {
      if (Math.abs(facing.dot(axis)) > 0.85) facing.copy(axis);
    }
    const { extents } = played.body.shape;
    this.held = {
      played,
      from,
      plane: new Plane().setFromNormalAndCoplanarPoint(facing, from),
      size: Math.max(extents.x, extents.y, extents.z) / 2,
    };
    this.velocity.set(0, 0, 0);
  }

  /** The finger is at the ray. */
  pull(ray: Raycaster): void {
    if (this.held === null) return;
    const { from, plane, size } = this.held;
    const to = ray.ray.intersectPlane(plane, new Vector3());
    if (to === null) return;
    const pull = to.clone().sub(from);
    const longest = kMostSpeed / kSpeedPerPull;
    if (pull.length() > longest) pull.setLength(longest);
    to.copy(from).add(pull);
    this.velocity.copy(pull).multiplyScalar(pull.length() < 0.3 * size ? 0 : -kSpeedPerPull);
    const { path, contact } = this.predict();
    this.band.show(from, to, size, path, contact);
  }

  private predict(): { path: Vector3[]; contact: { point: Vector3; normal: Vector3 } | null } {
    const { played } = this.held!;
    const body = this.scratch.bodies().find((other) => other.index === played.body.index);
    if (body === undefined) return { path: [], contact: null };
    body.setLinvel({ x: this.velocity.x, y: this.velocity.y, z: this.velocity.z });
    const delays = Array.from({ length: Math.round(kAhead / kDotEvery) }, (_, i) => (i + 1) * kDotEvery);
    const path = body.predictPoses(delays).map(({ position: { x, y, z } }) => new Vector3(x, y, z));
    const first = body.predictEvents(kAhead).find((event) => event.type === "impact");
    const contact =
      first === undefined
        ? null
        : {
            point: new Vector3(first.point.x, first.point.y, first.point.z),
            normal: new Vector3(first.normal.x, first.normal.y, first.normal.z),
          };
    return { path, contact };
  }

  /** Lets go. Null where the band was hardly pulled: that was a click. */
  release(): Aim | null {
    const held = this.held;
    this.cancel();
    if (held === null || this.velocity.lengthSq() === 0) return null;
    const { x, y, z } = held.from;
    return {
      name: held.played.name,
      position: [x, y, z],
      velocity: [this.velocity.x, this.velocity.y, this.velocity.z],
    };
  }
  cancel(): void {
    this.held = null;
    this.band.hide();
  }
}
