#!/usr/bin/env bash
# Tests of the game's page: recorded plays in WebAssembly, the build's size, and the page in Chromium. Pictures are left in
# build/game/.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/node.sh
most_bytes=500000
scripts/build_page.sh game
mkdir -p build/game
size=$(find web/game/dist -type f -exec gzip -9 -c {} \; | wc -c)
echo "game: $size bytes gzipped"
[ "$size" -le $most_bytes ] || { echo "game: more than $most_bytes bytes gzipped" >&2; exit 1; }
node web/game/test/golden_node.mjs
node web/game/test/browser.mjs "$(command -v chromium)" build/game
