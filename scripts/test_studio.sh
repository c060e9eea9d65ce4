#!/usr/bin/env bash
# Tests of the studio: its logic, its size, and the page in Chromium. Pictures of every view are left in build/studio/.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/node.sh
most_bytes=1000000
scripts/build_page.sh studio
mkdir -p build/studio
pictures=$(realpath build/studio)
cd web/studio
npx vitest run > "$pictures/vitest.txt" 2>&1 || { tail -n 60 "$pictures/vitest.txt" >&2; exit 1; }
echo "studio: $(sed 's/\x1b\[[0-9;]*m//g' "$pictures/vitest.txt" | sed -n 's/^ *Tests *//p') of its logic"
size=$(find dist -type f -exec gzip -9 -c {} \; | wc -c)
echo "studio: $size bytes gzipped, with all that is loaded later"
[ "$size" -le $most_bytes ] || { echo "studio: more than $most_bytes bytes gzipped" >&2; exit 1; }
node test/browser/main.mjs "$(command -v chromium)" "$pictures"
