#!/usr/bin/env bash
# Writes .glb files and has them judged by the Khronos validator and by three.js, against the pose table.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/node.sh
if ! [ tests/gltf/node_modules/.package-lock.json -nt tests/gltf/package-lock.json ]; then
  echo "install: npm packages of tests/gltf"
  npm ci --prefix tests/gltf --no-audit --no-fund --silent
fi
folder=build/gltf
mkdir -p "$folder"
for scene in scenes/figures/1-bouncing-ball.json scenes/figures/3-soft-cylinder.json scenes/hello.json; do
  name=$folder/$(basename "$scene" .json)
  build/release/elastoon simulate "$scene" --fps 30 -o "$name.glb" -o "$name.csv" > /dev/null
  node tests/gltf/validate.mjs "$name.glb" "$name.csv"
done
