#!/usr/bin/env bash
# Makes the pictures of the README and docs/ with the program itself.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh release elastoon_program
program=build/release/elastoon
images=docs/images
mkdir -p "$images"
"$program" render scenes/hello.json -o "$images/hello.gif" --size 480x270 --fps 20 --frames 0:90
"$program" render scenes/figures/1-bouncing-ball.json --strobe -o "$images/bouncing-ball.png" --size 960x540 --samples 64
"$program" figures -o "$images" --no-video --plots --samples 64
rm -f "$images"/figure-1-*.png "$images"/figure-4-*.pdf "$images"/figure-4-*.png
