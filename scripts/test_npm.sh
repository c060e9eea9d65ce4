#!/usr/bin/env bash
# Tests of the npm package: its own, and a fresh Vite project that installs what `npm pack` makes. After test_wasm.sh, which
# builds it.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/node.sh
package=web/package
out=build/npm
mkdir -p "$out"
out=$(realpath "$out")
npx --prefix $package tsc -p $package/tsconfig.test.json
node --test $package/build/test/ > "$out/tests.txt" || { grep -A 20 '^not ok' "$out/tests.txt" >&2; exit 1; }
echo "npm: $(sed -n 's/^# pass //p' "$out/tests.txt") tests passed"
tarball=$(cd $package && npm pack --silent --pack-destination "$out")
tar tzf "$out/$tarball" | sort > "$out/packed.txt"
for file in README.md dist/index.d.ts dist/three.js dist/elastoon.wasm; do
  grep -qx "package/$file" "$out/packed.txt" || { echo "npm: $file is not packed" >&2; exit 1; }
done
! grep -E 'node_modules|/test/|/src/' "$out/packed.txt" || { echo "npm: these should not be packed" >&2; exit 1; }
echo "npm: $tarball, $(wc -c < "$out/$tarball") bytes"
node $package/test/fresh_project.mjs "$out/$tarball" "$out/fresh" "$(command -v chromium)"
