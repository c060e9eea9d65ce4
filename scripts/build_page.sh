#!/usr/bin/env bash
# Builds a page of web/ with all that it needs, where something changed: the WebAssembly module, the npm package, the page.
# Usage: build_page.sh studio|game
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/node.sh
page=web/$1
package=web/package

install_packages() {
  [ "$1/node_modules/.package-lock.json" -nt "$1/package-lock.json" ] && return
  echo "install: npm packages of $1"
  npm ci --prefix "$1" --no-audit --no-fund --silent
}
# newer_than FILE PATH...: whether anything there is newer than the file.
newer_than() {
  local built=$1
  shift
  ! [ -e "$built" ] || [ -n "$(find "$@" -newer "$built" -type f -not -path '*/node_modules/*' -not -path '*/generated/*' -print -quit)" ]
}

scripts/build.sh wasm
install_packages $package
if newer_than $package/dist/index.js $package/src $package/scripts $package/package.json build/wasm/elastoon.wasm; then
  npm run --prefix $package --silent build
fi
install_packages "$page"
if newer_than "$page/dist/index.html" "$page/src" "$page/public" "$page/index.html" "$page/vite.config.ts" web/stage/src scenes \
  apps/game $package/dist/index.js build/wasm/squashout.wasm; then
  echo "build: $page"
  (cd "$page" && npx tsc -p . && npx vite build --logLevel error)
fi
