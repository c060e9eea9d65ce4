// What the pages of this project share to draw a world with three.js. Taken in by their Vite builds as sources.
export { type BodyLook, BodyViews, displayGeometry, halfExtents } from "./bodies.js";
export { Boing, type Hit, voiceOf } from "./boing.js";
export { type ObstacleLook, ObstacleViews } from "./obstacles.js";
export { addOccluder, kMostOccluders, makeOccluders, type Occluders } from "./occlusion.js";
export { patterned, type PatternName, patternNames } from "./patterns.js";
export { capability, type Capability, Governor, qualities, type Quality } from "./quality.js";
export { kWholePane, type Pane, Stage, type StageOptions } from "./stage.js";
export { systemTheme, type Theme, type ThemeName, themes } from "./theme.js";
