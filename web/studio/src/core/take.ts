// A take: a scene file and what was done to it while it played. The studio's document; immutable, every change makes
// a new one.
import { Scene } from "elastoon";
import { InputError, limits } from "./limits.js";

export type Triple = readonly [number, number, number];
export type Quadruple = readonly [number, number, number, number];

export interface SceneBody {
  readonly name?: string;
  readonly shape: string;
  readonly style?: string;
  readonly position?: Triple;
  readonly velocity?: Triple;
  readonly rotation?: Quadruple;
  readonly color?: string;
}

export interface SceneObstacle {
  readonly name?: string;
  readonly type?: "plane";
  readonly normal?: Triple;
  readonly offset?: number;
  readonly shape?: string;
  readonly position?: Triple;
  readonly rotation?: Quadruple;
  readonly velocity?: Triple;
  readonly angular_velocity?: Triple;
  readonly path?: readonly { readonly time: number; readonly position?: Triple; readonly rotation?: Quadruple }[];
  readonly path_repeats?: boolean;
  readonly color?: string;
}

export type SceneShape = Readonly<Record<string, unknown>> & { readonly type: string };
export type SceneStyle = Readonly<Record<string, number | string>>;

/** A scene file, as docs/scene.md has it. Only what the library's reader took is one. */
export interface SceneFile {
  readonly elastoon: 1;
  readonly name?: string;
  readonly gravity?: Triple;
  readonly duration?: number;
  readonly shapes?: Readonly<Record<string, SceneShape>>;
  readonly styles?: Readonly<Record<string, SceneStyle>>;
  readonly bodies?: readonly SceneBody[];
  readonly obstacles?: readonly SceneObstacle[];
  readonly camera?: { readonly eye: Triple; readonly target: Triple; readonly fov?: number };
  readonly strobe?: Readonly<Record<string, unknown>>;
}

/** A body is put there and flies with this velocity from then on. */
export interface Throw {
  readonly kind: "throw";
  /** Steps of 1/60 s before it. */
  readonly step: number;
  readonly body: string;
  readonly position: Triple;
  readonly velocity: Triple;
}

/** A body comes in. */
export interface Arrival {
  readonly kind: "arrival";
  readonly step: number;
  readonly body: SceneBody & { readonly name: string };
}

export type TakeInput = Throw | Arrival;

export interface Take {
  readonly scene: SceneFile;
  /** By step. */
  readonly inputs: readonly TakeInput[];
}

export const kStepsPerSecond = 60;
export const kDefaultDuration = 6;

const isObject = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const countOf = (value: unknown): number => (Array.isArray(value) ? value.length : 0);

function parseJson(text: string, what: string): unknown {
  if (text.length > limits.text) {
    throw new InputError(`${what} has ${text.length} characters; the studio takes ${limits.text}`);
  }
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new InputError(`${what} is not JSON: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/** Refuses what would be too much for a page, before the library's reader is asked. */
function checkAmounts(scene: unknown, what: string): void {
  if (!isObject(scene)) throw new InputError(`${what}: a scene must be a JSON object: { "elastoon": 1, ... }`);
  const most = (count: number, limit: number, where: string) => {
    if (count > limit) throw new InputError(`${what}: ${where}: there are ${count}; the studio takes ${limit}`);
  };
  most(countOf(scene["bodies"]), limits.bodies, "/bodies");
  most(countOf(scene["obstacles"]), limits.obstacles, "/obstacles");
  const shapes = isObject(scene["shapes"]) ? Object.values(scene["shapes"]) : [];
  most(shapes.length, limits.bodies, "/shapes");
  const points = shapes.reduce<number>((sum, shape) => sum + (isObject(shape) ? countOf(shape["points"]) : 0), 0);
  most(points, limits.points, "/shapes (points of all hulls)");
  if (typeof scene["duration"] === "number" && scene["duration"] > limits.duration) {
    throw new InputError(`${what}: /duration: is ${scene["duration"]} s; the studio takes ${limits.duration} s`);
  }
}

function triple(value: unknown, where: string, most: number): Triple {
  const numbers = Array.isArray(value) ? value : [];
  if (numbers.length !== 3 || !numbers.every((n) => typeof n === "number" && Math.abs(n) <= most)) {
    throw new InputError(`${where}: must be three numbers within ${most}`);
  }
  return [numbers[0], numbers[1], numbers[2]];
}

function readInput(value: unknown, index: number, last_step: number): TakeInput {
  const where = `/inputs/${index}`;
  if (!isObject(value)) throw new InputError(`${where}: must be an object`);
  const { step, kind } = value;
  if (typeof step !== "number" || !Number.isInteger(step) || step < 0 || step > limits.duration * kStepsPerSecond) {
    throw new InputError(`${where}/step: must be a whole number from 0 to ${limits.duration * kStepsPerSecond}`);
  }
  if (step < last_step) throw new InputError(`${where}/step: inputs must be in the order of their steps`);
  const allow = (...keys: string[]) => {
    const unknown = Object.keys(value).find((key) => !keys.includes(key));
    if (unknown !== undefined) throw new InputError(`${where}/${unknown}: unknown key; known are ${keys.join(", ")}`);
  };
  if (kind === "throw") {
    allow("kind", "step", "body", "position", "velocity");
    if (typeof value["body"] !== "string") throw new InputError(`${where}/body: must be a body's name`);
    return {
      kind,
      step,
      body: value["body"],
      position: triple(value["position"], `${where}/position`, 1e6),
      velocity: triple(value["velocity"], `${where}/velocity`, 1e5),
    };
  }
  if (kind === "arrival") {
    allow("kind", "step", "body");
    if (!isObject(value["body"]) || typeof value["body"]["name"] !== "string") {
      throw new InputError(`${where}/body: must be a body with a name`);
    }
    return { kind, step, body: value["body"] as unknown as Arrival["body"] };
  }
  throw new InputError(`${where}/kind: must be "throw" or "arrival"`);
}

/** The bodies that come in later, as a scene of their own without obstacles: for the library's reader, and to be
 *  dressed. */
export function arrivalsScene(take: Take): SceneFile {
  const bodies = take.inputs.filter((input) => input.kind === "arrival").map((input) => input.body);
  const { shapes, styles } = take.scene;
  return { elastoon: 1, ...(shapes && { shapes }), ...(styles && { styles }), bodies };
}

function checkNames(take: Take): void {
  const scene = Scene.parse(take.scene);
  const world = scene.stage();
  const names = new Set(world.bodies().map((body) => body.name));
  world.dispose();
  scene.dispose();
  take.inputs.forEach((input, i) => {
    if (input.kind === "arrival") {
      if (names.has(input.body.name)) throw new InputError(`/inputs/${i}/body/name: "${input.body.name}" is taken`);
      names.add(input.body.name);
    } else if (!names.has(input.body)) {
      throw new InputError(`/inputs/${i}/body: there is no body "${input.body}"`);
    }
  });
}

/** Reads a scene file or a take. Throws an InputError or ElastoonError that says where and what would be right. */
export function readTake(text: string, what = "the file"): Take {
  const root = parseJson(text, what);
  if (!isObject(root) || !("take" in root)) {
    checkAmounts(root, what);
    Scene.parse(text, what).dispose();
    return { scene: root as unknown as SceneFile, inputs: [] };
  }
  if (root["take"] !== 1) throw new InputError(`${what}: /take: must be 1, the version of takes that this page reads`);
  const stray = Object.keys(root).find((key) => !["take", "scene", "inputs"].includes(key));
  if (stray !== undefined) throw new InputError(`${what}: /${stray}: unknown key; known are take, scene, inputs`);
  checkAmounts(root["scene"], what);
  Scene.parse(root["scene"] as object, what).dispose();
  const listed = root["inputs"] ?? [];
  if (!Array.isArray(listed)) throw new InputError(`${what}: /inputs: must be a list`);
  if (listed.length > limits.inputs) {
    throw new InputError(`${what}: /inputs: there are ${listed.length}; the studio takes ${limits.inputs}`);
  }
  const inputs: TakeInput[] = [];
  for (const [i, value] of listed.entries()) inputs.push(readInput(value, i, inputs.at(-1)?.step ?? 0));
  const take = { scene: root["scene"] as unknown as SceneFile, inputs };
  Scene.parse(arrivalsScene(take), `${what}, bodies that come in`).dispose();
  checkNames(take);
  return take;
}

function inlineJson(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(inlineJson).join(", ")}]`;
  if (!isObject(value)) return JSON.stringify(value);
  const rows = Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${inlineJson(item)}`);
  return rows.length === 0 ? "{}" : `{ ${rows.join(", ")} }`;
}

/** JSON that people can read: what is short stands on one line. */
export function prettyJson(value: unknown, indent = ""): string {
  const flat = inlineJson(value);
  if (typeof value !== "object" || value === null || flat.length + indent.length <= 110) return flat;
  const deeper = `${indent}  `;
  if (Array.isArray(value)) {
    return `[\n${value.map((item) => deeper + prettyJson(item, deeper)).join(",\n")}\n${indent}]`;
  }
  const rows = Object.entries(value).map(
    ([key, item]) => `${deeper}${JSON.stringify(key)}: ${prettyJson(item, deeper)}`,
  );
  return `{\n${rows.join(",\n")}\n${indent}}`;
}

export function sceneText(scene: SceneFile): string {
  return `${prettyJson(scene)}\n`;
}
/** The shortest file that holds all: a scene where nothing was done to it. */
export function takeText(take: Take): string {
  return take.inputs.length === 0
    ? sceneText(take.scene)
    : `${prettyJson({ take: 1, scene: take.scene, inputs: take.inputs })}\n`;
}

/** With an input more. What came after it does not hold any more: the motion goes another way. */
export function withInput(take: Take, input: TakeInput): Take {
  const kept = take.inputs.filter(
    (other) =>
      other.step < input.step ||
      (other.step === input.step && !(other.kind === "throw" && input.kind === "throw" && other.body === input.body)),
  );
  return { ...take, inputs: [...kept, input] };
}
export function durationOf(take: Take): number {
  return take.scene.duration ?? kDefaultDuration;
}
/** A name that neither the scene nor its inputs have. */
export function freshName(taken: Iterable<string>, stem: string): string {
  const names = new Set(taken);
  if (!names.has(stem)) return stem;
  for (let i = 2; ; ++i) if (!names.has(`${stem} ${i}`)) return `${stem} ${i}`;
}
