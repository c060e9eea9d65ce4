// Changes of a take, each of which makes a new one.
import { styleNamed, type StyleName, styleNames, styleParameters, type StyleParameters } from "elastoon";
import {
  durationOf,
  freshName,
  kStepsPerSecond,
  type SceneBody,
  type SceneObstacle,
  type SceneShape,
  type SceneStyle,
  type Take,
  type TakeInput,
  type Triple,
  withInput,
} from "./take.js";

/** Colours of new bodies, in turn: the reader's own. */
export const palette = ["#e4572e", "#1778a5", "#f2af29", "#2a9d7c", "#9658a6", "#d64976"] as const;

/** All bodies of the take, those that come in later too. Unnamed ones of the scene have the names that the reader
 *  gives. */
export function bodiesOf(take: Take): readonly SceneBody[] {
  return [
    ...(take.scene.bodies ?? []),
    ...take.inputs.filter((input) => input.kind === "arrival").map((input) => input.body),
  ];
}

const isNamed = (name: string): name is StyleName => (styleNames as readonly string[]).includes(name);
const shortened = (value: number | string) => (typeof value === "number" ? Number(value.toPrecision(10)) : value);

export function defaultStyle(): StyleParameters {
  const rows = styleParameters.map((row) => [
    row.name,
    row.choices.length > 0
      ? row.choices[row.default_value]
      : row.may_be_derived
        ? "auto"
        : shortened(row.default_value),
  ]);
  return Object.fromEntries(rows) as unknown as StyleParameters;
}

/** All parameters of a style of the scene, of the library's, or the default. */
export function styleOf(take: Take, name: string | undefined): StyleParameters {
  const own = name === undefined ? undefined : take.scene.styles?.[name];
  if (own !== undefined) return { ...defaultStyle(), ...own };
  if (name === undefined || !isNamed(name)) return defaultStyle();
  const rows = Object.entries(styleNamed(name)).map(([key, value]) => [key, shortened(value)]);
  return Object.fromEntries(rows) as unknown as StyleParameters;
}

/** The style with only what differs from the default: as a file has it. */
export function briefStyle(style: StyleParameters): SceneStyle {
  const usual = defaultStyle();
  return Object.fromEntries(
    Object.entries(style).filter(([key, value]) => usual[key as keyof StyleParameters] !== value),
  );
}

function withBodies(take: Take, change: (body: SceneBody, index: number) => SceneBody): Take {
  const count = take.scene.bodies?.length ?? 0;
  let arrived = 0;
  return {
    scene: { ...take.scene, ...(take.scene.bodies && { bodies: take.scene.bodies.map(change) }) },
    inputs: take.inputs.map((input) =>
      input.kind === "arrival"
        ? { ...input, body: { ...change(input.body, count + arrived++), name: input.body.name } }
        : input,
    ),
  };
}

/** Gives bodies a style by its name. */
export function assignStyle(take: Take, indices: ReadonlySet<number>, style: string): Take {
  return withBodies(take, (body, i) => (indices.has(i) ? { ...body, style } : body));
}

/** Sets all parameters of the style that this body has; others that have the same style follow. */
export function setStyle(take: Take, index: number, style: StyleParameters): Take {
  const name = bodiesOf(take)[index]?.style;
  if (name !== undefined) {
    return { ...take, scene: { ...take.scene, styles: { ...take.scene.styles, [name]: briefStyle(style) } } };
  }
  const fresh = freshName([...Object.keys(take.scene.styles ?? {}), ...styleNames], "my style");
  const with_style = {
    ...take,
    scene: { ...take.scene, styles: { ...take.scene.styles, [fresh]: briefStyle(style) } },
  };
  return assignStyle(with_style, new Set([index]), fresh);
}
export function setParameter(take: Take, index: number, key: keyof StyleParameters, value: number | string): Take {
  return setStyle(take, index, { ...styleOf(take, bodiesOf(take)[index]?.style), [key]: value });
}
/** Whether the scene has changed a style that the library has by this name. */
export function overrides(take: Take, name: string | undefined): boolean {
  return name !== undefined && isNamed(name) && take.scene.styles?.[name] !== undefined;
}
/** Back to the library's own style of this name. */
export function dropOverride(take: Take, name: string): Take {
  const styles = Object.fromEntries(Object.entries(take.scene.styles ?? {}).filter(([key]) => key !== name));
  return { ...take, scene: { ...take.scene, styles } };
}

/** The name of a shape of this kind and size, which is added where the scene has none. */
function withShape(take: Take, shape: SceneShape): [Take, string] {
  const shapes = take.scene.shapes ?? {};
  const text = JSON.stringify(shape);
  const known = Object.entries(shapes).find(([, other]) => JSON.stringify(other) === text);
  if (known !== undefined) return [take, known[0]];
  const name = freshName(Object.keys(shapes), shape.type);
  return [{ ...take, scene: { ...take.scene, shapes: { ...shapes, [name]: shape } } }, name];
}

export interface NewBody {
  readonly shape: SceneShape;
  readonly position: Triple;
  readonly velocity?: Triple;
  readonly style?: string;
  readonly name?: string;
}

/** Adds a body at a step: at the start it belongs to the scene, later it comes in. `names`: all that are taken. */
export function addBody(
  take: Take,
  step: number,
  body: NewBody,
  names: Iterable<string>,
): { take: Take; name: string } {
  const [with_shape, shape] = withShape(take, body.shape);
  const name = freshName(names, body.name ?? shape.replace(/ \d+$/, ""));
  const made: SceneBody & { name: string } = {
    name,
    shape,
    style: body.style ?? "rubber-ball",
    position: body.position,
    ...(body.velocity && { velocity: body.velocity }),
    color: palette[bodiesOf(take).length % palette.length]!,
  };
  if (step === 0) {
    const bodies = [...(with_shape.scene.bodies ?? []), made];
    return { take: { ...with_shape, scene: { ...with_shape.scene, bodies } }, name };
  }
  return { take: extended(withInput(with_shape, { kind: "arrival", step, body: made }), step), name };
}

export function addObstacle(take: Take, obstacle: SceneObstacle, shape?: SceneShape): Take {
  const [with_shape, name] = shape === undefined ? [take, undefined] : withShape(take, shape);
  const made: SceneObstacle = { ...obstacle, ...(name !== undefined && { shape: name }) };
  return { ...with_shape, scene: { ...with_shape.scene, obstacles: [...(take.scene.obstacles ?? []), made] } };
}
export function changeObstacle(take: Take, index: number, change: Partial<SceneObstacle>): Take {
  const obstacles = (take.scene.obstacles ?? []).map((obstacle, i) =>
    i === index ? { ...obstacle, ...change } : obstacle,
  );
  return { ...take, scene: { ...take.scene, obstacles } };
}
export function removeObstacle(take: Take, index: number): Take {
  const obstacles = (take.scene.obstacles ?? []).filter((_, i) => i !== index);
  return { ...take, scene: { ...take.scene, obstacles } };
}

/** Removes a body, `index` among all of them, and what was done to it. */
export function removeBody(take: Take, index: number, name: string): Take {
  const count = take.scene.bodies?.length ?? 0;
  const bodies = take.scene.bodies?.filter((_, i) => i !== index);
  const inputs = take.inputs.filter((input) =>
    input.kind === "throw" ? input.body !== name : index < count || input.body.name !== name,
  );
  return { scene: { ...take.scene, ...(bodies && { bodies }) }, inputs };
}

export function changeBody(take: Take, index: number, change: Partial<SceneBody>): Take {
  return withBodies(take, (body, i) => (i === index ? { ...body, ...change } : body));
}

/** Long enough to see what comes of something that is done at this step. */
export function extended(take: Take, step: number): Take {
  const needed = Math.min(Math.ceil(step / kStepsPerSecond + 4), 120);
  return durationOf(take) >= needed ? take : { ...take, scene: { ...take.scene, duration: needed } };
}
export function throwBody(take: Take, input: TakeInput): Take {
  return extended(withInput(take, input), input.step);
}
