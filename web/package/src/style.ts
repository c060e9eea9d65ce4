// Styles: by name, or parameter by parameter, as scene files have them.
import { type Core, core, ElastoonError } from "./core.js";
import { layout } from "./generated/layout.js";
import { styleParameters, type StyleName, type StyleParameters } from "./generated/styles.js";

/** A style's name, or the parameters that differ from the default, or from those of `base`. */
export type StyleLike = StyleName | (Partial<StyleParameters> & { base?: StyleName });

/** Writes the style to a struct at `at`, which is no scratch memory. */
export function writeStyle(c: Core, at: number, style: StyleLike): void {
  const given = typeof style === "string" ? { base: style } : style;
  if (given.base === undefined) c.plain("elastoonDefaultStyle", at);
  else c.call("elastoonNamedStyle", c.putText(given.base), at);
  for (const [name, value] of Object.entries(given)) {
    if (name === "base" || value === undefined) continue;
    const row = styleParameters.find((parameter) => parameter.name === name);
    if (row === undefined) throw new ElastoonError("bad argument", `${name}: there is no style parameter of this name`);
    let number = Number.NaN;
    if (typeof value === "number" && row.choices.length === 0) number = value;
    else if (value === "auto" && row.may_be_derived) number = -1;
    else if (row.choices.includes(String(value))) number = row.choices.indexOf(String(value));
    const words = row.choices.length > 0 ? row.choices : row.may_be_derived ? ["auto", "a number"] : ["a number"];
    if (Number.isNaN(number)) {
      throw new ElastoonError("bad argument", `${name}: must be ${words.join(" or ")}, is ${String(value)}`);
    }
    c.call("elastoonStyleSet", at, c.putText(name), number);
  }
}

/** All parameters of a style that comes with the library. */
export function styleNamed(name: StyleName): StyleParameters {
  const c = core();
  writeStyle(c, c.definition, name);
  return readStyle(c, c.definition);
}

export function readStyle(c: Core, at: number): StyleParameters {
  const style: Record<string, number | string> = {};
  const bytes = c.u8.slice(at, at + layout.Style.size);
  const own = c.allocate(layout.Style.size + 8);
  c.u8.set(bytes, own);
  for (const row of styleParameters) {
    c.call("elastoonStyleGet", own, c.putText(row.name), own + layout.Style.size);
    const value = c.f64(own + layout.Style.size);
    style[row.name] = row.choices[value] ?? (row.may_be_derived && value === -1 ? "auto" : value);
  }
  c.free(own);
  return style as unknown as StyleParameters;
}
