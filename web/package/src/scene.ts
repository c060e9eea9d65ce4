// Scene files, read by the library's own reader: the same messages, the same bits.
import { core, type Id, type Vector } from "./core.js";
import { layout } from "./generated/layout.js";
import { type Frame, readFrame } from "./obstacle.js";
import { World } from "./world.js";

/** From where a scene wants to be seen. */
export interface Camera {
  eye: Vector;
  target: Vector;
  /** Vertical, degrees. */
  fov: number;
}

/** A scene file that was read. `stage()` makes worlds of it, as often as you like. */
export class Scene {
  readonly name: string;
  /** s */
  readonly duration: number;
  readonly gravity: Readonly<Vector>;
  readonly camera: Readonly<Camera> | null;
  private readonly id: Id;
  private readonly counts: { readonly bodies: number; readonly obstacles: number };
  private alive = true;

  /** Reads a scene's text, or what JSON.parse made of it. Throws "bad data" that says where and what would be right;
   *  `file` names it in such messages. */
  static parse(scene: string | object, file = ""): Scene {
    return new Scene(typeof scene === "string" ? scene : JSON.stringify(scene), file);
  }

  private constructor(text: string, file: string) {
    const c = core();
    this.id = c.withBytes(new TextEncoder().encode(text), (at, size) => {
      const out = c.take(layout.Scene.size);
      c.call("elastoonSceneParse", at, size, c.putText(file), out);
      return c.id(out);
    });
    const f = layout.SceneInfo;
    const info = c.take(f.size);
    c.call("elastoonSceneInfo", c.putId(this.id), info);
    this.name = c.text(c.u32(info));
    this.duration = c.f64(info + f.duration);
    this.gravity = c.vector(info + f.gravity);
    this.counts = { bodies: c.u32(info + f.body_count), obstacles: c.u32(info + f.obstacle_count) };
    const eye = c.vector(info + f.camera_eye);
    const target = c.vector(info + f.camera_target);
    this.camera = c.u8[info + f.has_camera] === 0 ? null : { eye, target, fov: c.f64(info + f.camera_fov_degrees) };
  }

  /** A new world with all of the scene; its bodies and obstacles have their names and colours. */
  stage(): World {
    const c = core();
    const out = c.take(layout.World.size);
    c.call("elastoonSceneStage", c.putId(this.id), out);
    const world = new World(undefined, c.id(out));
    world.adopt();
    world.bodies().forEach((body, i) => {
      if (i < this.counts.bodies) this.describe(body, "elastoonSceneBody", i, layout.SceneBody);
    });
    world.obstacles().forEach((obstacle, i) => {
      if (i < this.counts.obstacles) this.describe(obstacle, "elastoonSceneObstacle", i, layout.SceneObstacle);
    });
    return world;
  }

  /** Where obstacle `index`, in the scene's order, is `time` s after the scene was staged. */
  obstacleFrame(index: number, time: number): Frame {
    const c = core();
    const out = c.take(layout.ObstacleFrame.size);
    c.call("elastoonSceneObstacleFrame", c.putId(this.id), index, time, out);
    return readFrame(c, out);
  }

  /** Gives its memory back. Worlds that it staged go on. */
  dispose(): void {
    if (!this.alive) return;
    this.alive = false;
    core().call("elastoonSceneDestroy", core().putId(this.id));
  }

  private describe(thing: { name: string; color: Readonly<Vector> | undefined }, call: string, index: number,
    fields: { readonly size: number; readonly name: number; readonly color: number }): void {
    const c = core();
    const out = c.take(fields.size);
    c.call(call, c.putId(this.id), index, out);
    thing.color = c.vector(out + fields.color);
    thing.name = c.text(c.u32(out + fields.name));
  }
}
