#!/usr/bin/env bash
# Builds the WebAssembly module and the npm package around it, looks at its size, imports and exports, and runs the golden
# scenes in Node, and in Chromium in a page and in a worker: the hashes must be those of native programs.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/node.sh
most_bytes=200000
scripts/build.sh wasm
package=web/package
if ! [ $package/node_modules/.package-lock.json -nt $package/package-lock.json ]; then
  echo "install: npm packages of $package"
  npm ci --prefix $package --no-audit --no-fund --silent
fi
npm run --prefix $package --silent build

size=$(gzip -9 -c build/wasm/elastoon.wasm | wc -c)
echo "wasm: $(wc -c < build/wasm/elastoon.wasm) bytes, $size gzipped"
[ "$size" -le $most_bytes ] || { echo "wasm: more than $most_bytes bytes gzipped" >&2; exit 1; }
node --input-type=module -e '
  import { readFileSync } from "node:fs";
  const module = new WebAssembly.Module(readFileSync("build/wasm/elastoon.wasm"));
  const names = (list) => list.map(({ name }) => name).sort().join(" ");
  const header = readFileSync("include/elastoon/elastoon.h", "utf8");
  const declared = [...header.matchAll(/^ELASTOON_API [^(]*\b(elastoon\w+)\(/gm)].map(([, name]) => ({ name }));
  const exported = names(WebAssembly.Module.exports(module).filter(({ name }) => name.startsWith("elastoon")));
  if (exported !== names(declared)) throw new Error("the module exports other functions than the header declares");
  const imported = names(WebAssembly.Module.imports(module));
  if (imported !== "fd_close fd_seek fd_write") throw new Error(`the module imports ${imported}`);'

node $package/test/golden_node.mjs
node $package/test/golden_browser.mjs "$(command -v chromium)"
