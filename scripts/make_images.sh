#!/usr/bin/env bash
# Makes the pictures of the README and docs/ with the program itself.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh release elastoon_program
program=build/release/elastoon
images=docs/images
mkdir -p "$images"

# 256 colours are enough for these pictures, and a third of the bytes.
shrink() {
  local picture
  local filter="split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer:bayer_scale=4"
  for picture in "$@"; do
    ffmpeg -v error -y -i "$picture" -vf "$filter" "$picture.small.png"
    mv "$picture.small.png" "$picture"
  done
}

"$program" render scenes/hello.json -o "$images/hello.gif" --size 480x270 --fps 20 --frames 0:90
"$program" render scenes/figures/1-bouncing-ball.json --strobe -o "$images/bouncing-ball.png" --size 960x540 --samples 64
"$program" figures -o "$images" --no-video --plots --samples 64
rm -f "$images"/figure-1-*.png "$images"/figure-4-*.pdf "$images"/figure-4-*.png

contacts=scenes/contacts
"$program" render $contacts/corner.json --sheet 6x4 --fps 24 --frames 7:31 -o "$images/corner.png" --size 1280x560 \
  --samples 64
"$program" render $contacts/press.json --sheet 6x5 --fps 24 --frames 50:110 -o "$images/press.png" --size 1280x640 \
  --samples 64
"$program" render $contacts/skip.json --strobe -o "$images/skip.png" --size 960x360 --samples 64
"$program" render $contacts/slide.json --strobe -o "$images/slide.png" --size 960x420 --samples 64

for file in scenes/styles/*.json; do
  name=$(basename "$file" .json)
  "$program" render scenes/styles-stage.json --style "$name" --strobe -o "$images/style-$name.png" --size 640x240 \
    --samples 64
  "$program" render scenes/styles-impact.json --style "$name" --sheet 16x1 --fps 24 --frames 19:35 \
    -o "$images/style-$name-impact.png" --size 1280x104 --samples 64
done
"$program" render scenes/contacts/rest.json --sheet 6x5 --fps 24 --frames 8:38 -o "$images/rest.png" --size 1280x560 --samples 64
"$program" render scenes/stairs.json --strobe -o "$images/stairs.png" --size 960x540
"$program" render scenes/pachinko.json --strobe -o "$images/pachinko.png" --size 960x540 --samples 16
shrink "$images"/{style-*,figure-[5678]-*,corner,press,skip,slide,rest,stairs,pachinko}.png
