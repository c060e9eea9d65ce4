#!/usr/bin/env bash
# Writes tests/golden/hashes.txt, apps/cli/bench_hashes.h and the game's recorded plays anew, for a change of the motion that is
# meant. Then look at the pictures, and say in the commit why the bits changed.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh release elastoon_program elastoon_game_program
golden=tests/golden/hashes.txt
{
  head -n 1 "$golden"
  sed 1d "$golden" | while read -r scene fps _; do
    hash=$(build/release/elastoon simulate "scenes/$scene" --fps "$fps" | sed -n 's/.*hash=//p')
    echo "$scene $fps $hash"
  done
} > "$golden.new"
mv "$golden.new" "$golden"
hashes=$(build/release/elastoon bench --seconds 0.01 | awk 'NF == 7 && $7 ~ /^[0-9a-f]+$/ {print $1, $7}')
echo "$hashes" | while read -r scene hash; do
  sed -i -E "s/(\"$scene\", [0-9]+, 0x)[0-9a-f]{16}/\1$hash/" apps/cli/bench_hashes.h
done

record="build/release/elastoon-game record"
$record --seed 2 --level 4 --skill 0.9 --seconds 60 -o tests/golden/game-flat.json
$record --seed 3 --level 6 --skill 0.9 --seconds 60 --gravity -o tests/golden/game-gravity.json
figure=scenes/figures/8-squashout
$record --levels $figure/levels.json --seed 2 --skill 1 --seconds 5.2 -o $figure/play.json
