// The take as an animated .glb: every body a node whose position, turn and scale are keyed. Opened by Blender,
// three.js, engines.
import { displayGeometry } from "stage";
import {
  AnimationClip,
  Color,
  Group,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  PlaneGeometry,
  Quaternion,
  QuaternionKeyframeTrack,
  Vector3,
  VectorKeyframeTrack,
} from "three";
import { GLTFExporter } from "three/examples/jsm/exporters/GLTFExporter.js";
import type { Player } from "../core/player.js";
import { durationOf, kStepsPerSecond } from "../core/take.js";

/** Keys a second. */
const kRate = 60;
const kMostBodies = 300;

export class TooMuchError extends Error {}

export async function glbOf(player: Player, meshes: ReadonlyMap<string, Object3D>): Promise<Uint8Array> {
  if (player.bodies.length > kMostBodies) {
    throw new TooMuchError(`A .glb of ${player.bodies.length} bodies would be too large; ${kMostBodies} are possible.`);
  }
  const end = durationOf(player.take);
  player.ensure(Math.ceil(end * kStepsPerSecond));
  const times = Array.from({ length: Math.floor(end * kRate) + 1 }, (_, i) => i / kRate);
  const root = new Group();
  root.name = player.scene.name || "take";
  const tracks: (VectorKeyframeTrack | QuaternionKeyframeTrack)[] = [];
  const all = [
    ...(player.take.scene.bodies ?? []),
    ...player.take.inputs.flatMap((input) => (input.kind === "arrival" ? [input.body] : [])),
  ];
  player.bodies.forEach((played, i) => {
    const material = new MeshStandardMaterial({ color: new Color(played.color), roughness: 0.5 });
    const template = meshes.get(all[i]?.shape ?? "");
    const node =
      template === undefined
        ? new Mesh(displayGeometry(played.body.shape), material)
        : new Group().add(template.clone());
    // Track names know no dots.
    node.name = `${played.name.replace(/[^\w -]/g, "_")}_${i + 1}`;
    root.add(node);
    const { poses } = player.motionOf(played.body, times);
    const positions = poses.flatMap(({ position: { x, y, z } }) => [x, y, z]);
    const scales = poses.flatMap(({ stretch }, k) =>
      times[k]! * kStepsPerSecond < played.since
        ? [0, 0, 0]
        : [stretch, 1 / Math.sqrt(stretch), 1 / Math.sqrt(stretch)],
    );
    const last = new Quaternion();
    const turns = poses.flatMap(({ rotation: { x, y, z, w } }, k) => {
      const turn = new Quaternion(x, y, z, w);
      // The nearer of the two quaternions, so that nothing spins between keys.
      if (k > 0 && last.dot(turn) < 0) turn.set(-x, -y, -z, -w);
      last.copy(turn);
      return [turn.x, turn.y, turn.z, turn.w];
    });
    node.position.fromArray(positions);
    node.quaternion.fromArray(turns);
    node.scale.fromArray(scales.slice(0, 3));
    tracks.push(
      new VectorKeyframeTrack(`${node.name}.position`, times, positions),
      new QuaternionKeyframeTrack(`${node.name}.quaternion`, times, turns),
      new VectorKeyframeTrack(`${node.name}.scale`, times, scales),
    );
  });
  player.world.obstacles().forEach((obstacle, i) => {
    const from_file = player.take.scene.obstacles?.[i];
    const frame = player.scene.obstacleFrame(i, 0);
    const material = new MeshStandardMaterial({ color: from_file?.color ?? "#b8b2a8", roughness: 0.9 });
    const node = new Mesh(
      obstacle.shape === null ? new PlaneGeometry(40, 40) : displayGeometry(obstacle.shape),
      material,
    );
    node.name = `${(from_file?.name ?? "obstacle").replace(/[^\w -]/g, "_")}_obstacle_${i + 1}`;
    node.position.copy(frame.position as Vector3);
    node.quaternion.set(frame.rotation.x, frame.rotation.y, frame.rotation.z, frame.rotation.w);
    if (obstacle.shape === null) {
      const { x, y, z } = obstacle.planeNormal();
      node.quaternion.multiply(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(x, y, z)));
    } else if (
      from_file?.path !== undefined ||
      from_file?.velocity !== undefined ||
      from_file?.angular_velocity !== undefined
    ) {
      const frames = times.map((time) => player.scene.obstacleFrame(i, time));
      tracks.push(
        new VectorKeyframeTrack(
          `${node.name}.position`,
          times,
          frames.flatMap(({ position: { x, y, z } }) => [x, y, z]),
        ),
        new QuaternionKeyframeTrack(
          `${node.name}.quaternion`,
          times,
          frames.flatMap(({ rotation: { x, y, z, w } }) => [x, y, z, w]),
        ),
      );
    }
    root.add(node);
  });
  const clip = new AnimationClip("take", end, tracks);
  const made = await new GLTFExporter().parseAsync(root, { binary: true, animations: [clip] });
  return new Uint8Array(made as ArrayBuffer);
}
