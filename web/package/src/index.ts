// The package's interface. `await Elastoon.init()` first.
import { core, start, type WasmSource } from "./core.js";

export { Body, BodyDesc, type Phase, type PhaseKind, type Pose } from "./body.js";
export { ElastoonError, type ErrorCode, type Rotation, type Vector, type WasmSource } from "./core.js";
export type { ElastoonEvent, ImpactEvent, ReleaseEvent, StateEvent } from "./event.js";
export { styleDescriptions, styleNames, styleParameters } from "./generated/styles.js";
export type { StyleName, StyleParameterInfo, StyleParameters } from "./generated/styles.js";
export { type Frame, Obstacle, ObstacleDesc, type PathKey } from "./obstacle.js";
export { ImpactCurve, type ImpactInput, stretchAtSpeed } from "./model.js";
export { Recording } from "./recording.js";
export { type Camera, Scene } from "./scene.js";
export { Shape, type ShapeKind } from "./shape.js";
export { type StyleLike, styleNamed } from "./style.js";
export { Timeline } from "./timeline.js";
export { World } from "./world.js";

export const Elastoon = {
  /** Loads the WebAssembly module, once. Without a source, the one that is packed in: works in browsers, workers and Node. */
  init(source?: WasmSource): Promise<void> {
    return start(source);
  },
  /** The library's version, as "0.1.0". */
  get version(): string {
    const c = core();
    const out = c.take(12);
    c.plain("elastoonVersion", out);
    return [c.u32(out), c.u32(out + 4), c.u32(out + 8)].join(".");
  },
} as const;

export default Elastoon;
