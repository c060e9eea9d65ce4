// The current style as source code for one's own program.
import type { StyleParameters } from "elastoon";
import { briefStyle } from "../core/edit.js";

/** In C++ angles are in radians, and choices are enums. */
const inRadians: ReadonlySet<string> = new Set(["reversal_rate", "rest_slope", "grazing_angle"]);
const enums: Readonly<Record<string, string>> = {
  squash_law: "SquashLaw",
  impact_easing: "ImpactEasing",
  corner_rule: "CornerRule",
};

const capital = (word: string) => word.charAt(0).toUpperCase() + word.slice(1);
const double = (value: number) => (Number.isInteger(value) ? `${value}.0` : String(value));

export function cppSnippet(style: StyleParameters): string {
  const rows = Object.entries(briefStyle(style)).map(([key, value]) => {
    if (typeof value !== "number") {
      return value === "auto"
        ? `style.${key} = elastoon::kDerived;`
        : `style.${key} = elastoon::${enums[key]}::${capital(value)};`;
    }
    return inRadians.has(key)
      ? `style.${key} = ${Number(((value * Math.PI) / 180).toPrecision(12))}; // ${value} degrees`
      : `style.${key} = ${double(value)};`;
  });
  return ["#include <elastoon/style.h>", "", "elastoon::Style style;", ...rows, ""].join("\n");
}

export function tsSnippet(style: StyleParameters): string {
  const rows = Object.entries(briefStyle(style)).map(([key, value]) => `  ${key}: ${JSON.stringify(value)},`);
  return [
    'import { BodyDesc } from "elastoon";',
    "",
    "const body = BodyDesc.ball(0.5).setStyle({",
    ...rows,
    "});",
    "",
  ].join("\n");
}

export function jsonSnippet(name: string, style: StyleParameters): string {
  return `"styles": { ${JSON.stringify(name)}: ${JSON.stringify(briefStyle(style))} }`;
}
