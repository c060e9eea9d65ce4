#!/usr/bin/env bash
# Configures and builds a preset where something changed. Usage: build.sh PRESET [TARGET...]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! [ -f "build/$preset/build.ninja" ]; then
  echo "build: configuring $preset"
  cmake --preset "$preset" > "$log" 2>&1 || { cat "$log" >&2; exit 1; }
fi
# The generator looks for new files by itself; without work to do this takes well under a second.
if ! cmake --build "build/$preset" --target "${@:-all}" > "$log" 2>&1; then
  grep -vE '^\[[0-9]+/[0-9]+\]' "$log" >&2
  exit 1
fi
grep -q 'no work to do' "$log" || echo "build: $preset, $(grep -cE '^\[[0-9]+/[0-9]+\]' "$log") steps"
