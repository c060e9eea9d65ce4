#!/usr/bin/env bash
# Builds the golden runner for arm64 and runs it in the emulator: the hashes must be those of x86-64. Nothing is run again
# while the runner, the hashes and the scenes are those that passed.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh arm64 elastoon_golden
runner=build/arm64/tests/golden/elastoon_golden
golden=tests/golden/hashes.txt
passed=build/arm64/passed
now=$( (sha256sum "$runner" "$golden"; find scenes -name '*.json' -print0 | sort -z | xargs -0 sha256sum) | sha256sum)
if [ "$(cat "$passed" 2> /dev/null)" = "$now" ]; then
  echo "arm64: unchanged since it passed"
  exit 0
fi
emulator=(qemu-aarch64)
[ "$(uname -m)" = aarch64 ] && emulator=()
out=build/arm64/golden.txt
if ! "${emulator[@]}" "$runner" "$golden" scenes > "$out"; then
  grep -E 'DIFFERS|are met' "$out" >&2
  exit 1
fi
echo "arm64: $(tail -n 1 "$out")"
echo "$now" > "$passed"
