#!/usr/bin/env bash
# Writes tests/golden/hashes.txt anew, for a change of the motion that is meant. Then look at the pictures, and say in the
# commit why the bits changed.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh release elastoon_program
golden=tests/golden/hashes.txt
{
  head -n 1 "$golden"
  sed 1d "$golden" | while read -r scene fps _; do
    hash=$(build/release/elastoon simulate "scenes/$scene" --fps "$fps" | sed -n 's/.*hash=//p')
    echo "$scene $fps $hash"
  done
} > "$golden.new"
mv "$golden.new" "$golden"
