// Makes src/generated/ from the WebAssembly modules themselves: the binary, where the fields of the structs lie, and the
// types of styles from the library's own parameter table. Usage: node scripts/generate.mjs [FOLDER OF THE MODULES]
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const modules = resolve(process.argv[2] ?? join(here, "../../build/wasm"));
const out = join(here, "src/generated");
const dist = join(here, "dist");
rmSync(dist, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
mkdirSync(dist, { recursive: true });
const head = "// Made by scripts/generate.mjs. Do not edit.\n";

const stub = { wasi_snapshot_preview1: { fd_close: () => 0, fd_seek: () => 0, fd_write: () => 0 } };
function load(file) {
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(join(modules, file))), stub);
  exports._initialize();
  const words = () => new Uint32Array(exports.memory.buffer);
  const text = (at) => {
    const bytes = new Uint8Array(exports.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  };
  return { exports, words, text };
}

function writeLayout() {
  const { exports, words, text } = load("elastoon_layout.wasm");
  const structs = new Map();
  for (let at = exports.elastoonLayout() / 4; words()[at] !== 0; at += 3) {
    const [name, offset, size] = words().subarray(at, at + 3);
    const [struct, field] = text(name).replace(/^Elastoon/, "").split(".");
    if (field === undefined) structs.set(struct, [`size: ${size}`]);
    else structs.get(struct).push(`${field}: ${offset}`);
  }
  const rows = [...structs].map(([name, entries]) => `  ${name}: { ${entries.join(", ")} },\n`);
  writeFileSync(join(out, "layout.ts"), `${head}/** Byte offsets of the C interface's structs. */
export const layout = {\n${rows.join("")}} as const;\n`);
}

/** Rows of the parameter table as the C interface tells them. */
function readStyles() {
  const { exports, words, text } = load("elastoon.wasm");
  const at = exports.malloc(128);
  const parameters = [];
  for (let i = 0; i < exports.elastoonStyleParameterCount(); ++i) {
    exports.elastoonStyleParameter(i, at);
    const [name, symbol, unit, meaning, choices] = [...words().subarray(at / 4, at / 4 + 5)].map(text);
    const [minimum, maximum, default_value] = new Float64Array(exports.memory.buffer, (at + 24) & ~7, 3);
    const may_be_derived = new Uint8Array(exports.memory.buffer)[at + 48] !== 0;
    parameters.push({ name, symbol, unit, meaning, choices: choices === "" ? [] : choices.split(","), minimum, maximum,
      default_value, may_be_derived });
  }
  const named = [];
  for (let i = 0; i < exports.elastoonNamedStyleCount(); ++i) {
    exports.elastoonNamedStyleInfo(i, at, at + 4);
    named.push({ name: text(words()[at / 4]), description: text(words()[at / 4 + 1]) });
  }
  return { parameters, named };
}

function writeStyles() {
  const { parameters, named } = readStyles();
  const fields = parameters.map((p) => {
    const type = p.choices.length ? p.choices.map((c) => `"${c}"`).join(" | ") : p.may_be_derived ? 'number | "auto"' : "number";
    const range = p.choices.length ? `Default "${p.choices[p.default_value]}".`
      : `${p.minimum} to ${p.maximum}${p.unit && ` ${p.unit}`}, default ${p.may_be_derived ? '"auto"' : Number(p.default_value.toPrecision(12))}.`;
    return `  /** ${p.meaning}. ${range} */\n  ${p.name}: ${type};\n`;
  });
  writeFileSync(join(out, "styles.ts"), `${head}
/** How a body moves. The names and units are those of scene files: angles in degrees. */
export interface StyleParameters {\n${fields.join("")}}

/** The styles that come with the library. */
export type StyleName = ${named.map((n) => `"${n.name}"`).join(" | ")};

export const styleNames: readonly StyleName[] = ${JSON.stringify(named.map((n) => n.name))};

/** What each of them is like, in a line. */
export const styleDescriptions: Readonly<Record<StyleName, string>> =
  ${JSON.stringify(Object.fromEntries(named.map((n) => [n.name, n.description])), null, 2)};

export interface StyleParameterInfo {
  readonly name: keyof StyleParameters;
  /** As the documentation writes it; may be empty. */
  readonly symbol: string;
  /** Empty for a pure number. */
  readonly unit: string;
  readonly meaning: string;
  /** The words that it may be; empty for a number. */
  readonly choices: readonly string[];
  readonly minimum: number;
  readonly maximum: number;
  /** -1 where it is derived; the index of a choice. */
  readonly default_value: number;
  /** Takes "auto". */
  readonly may_be_derived: boolean;
}

/** The parameter table: for sliders. */
export const styleParameters: readonly StyleParameterInfo[] = ${JSON.stringify(parameters, null, 2)};
`);
}

function writeBinary() {
  const bytes = readFileSync(join(modules, "elastoon.wasm"));
  writeFileSync(join(out, "binary.ts"), `${head}/** elastoon.wasm, gzipped, in base64. */
export const binary =\n  "${gzipSync(bytes, { level: 9 }).toString("base64")}";\n`);
  copyFileSync(join(modules, "elastoon.wasm"), join(dist, "elastoon.wasm"));
}

writeLayout();
writeStyles();
writeBinary();
