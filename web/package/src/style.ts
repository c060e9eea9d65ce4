// Styles: by name, or parameter by parameter, as scene files have them.
import { type Core, ElastoonError } from "./core.js";
import { layout } from "./generated/layout.js";
import { styleParameters, type StyleName, type StyleParameters } from "./generated/styles.js";

/** A style's name, or the parameters that differ from the default, or from those of `base`. */
export type StyleLike = StyleName | (Partial<StyleParameters> & { base?: StyleName });

/** Writes the style to a struct at `at`, which is no scratch memory. */
export function writeStyle(core: Core, at: number, style: StyleLike): void {
  const given = typeof style === "string" ? { base: style } : style;
  if (given.base === undefined) core.plain("elastoonDefaultStyle", at);
  else core.call("elastoonNamedStyle", core.putText(given.base), at);
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
    core.call("elastoonStyleSet", at, core.putText(name), number);
  }
}

export function readStyle(core: Core, at: number): StyleParameters {
  const style: Record<string, number | string> = {};
  const bytes = core.u8.slice(at, at + layout.Style.size);
  const own = core.allocate(layout.Style.size + 8);
  core.u8.set(bytes, own);
  for (const row of styleParameters) {
    core.call("elastoonStyleGet", own, core.putText(row.name), own + layout.Style.size);
    const value = core.f64(own + layout.Style.size);
    style[row.name] = row.choices[value] ?? (row.may_be_derived && value === -1 ? "auto" : value);
  }
  core.free(own);
  return style as unknown as StyleParameters;
}
