#!/usr/bin/env bash
# Runs the golden scenes on two threads under the thread sanitizer: no data race, and the same hashes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh tsan elastoon_golden
out=build/tsan/golden.txt
if ! TSAN_OPTIONS=halt_on_error=1 build/tsan/tests/golden/elastoon_golden tests/golden/hashes.txt scenes 2 > "$out" 2>&1; then
  grep -E 'DIFFERS|WARNING|data race|are met|elastoon_golden:' "$out" | head -n 20 >&2
  exit 1
fi
echo "threads: $(tail -n 1 "$out")"
