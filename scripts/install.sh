#!/usr/bin/env bash
# Installs the Debian packages that are missing, and says so; silent and quick when none is.
# Usage: install.sh run|test|bench|web
set -euo pipefail

packages=(g++ cmake ninja-build ccache pkg-config libglm-dev nlohmann-json3-dev libcli11-dev libfmt-dev libembree-dev
  libtinygltf-dev libassimp-dev libcairo2-dev libtbb-dev libgtest-dev libqhull-dev ffmpeg)
# The WebAssembly module, and what pages are built with.
web=(clang-19 lld-19 libclang-rt-19-dev-wasm32 wasi-libc libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 llvm-19
  binaryen)
command -v node > /dev/null || web+=(nodejs)
command -v npm > /dev/null || web+=(npm)
if [ "${1:-run}" = web ]; then
  packages=(g++ cmake ninja-build ccache pkg-config libglm-dev nlohmann-json3-dev "${web[@]}")
elif [ "${1:-run}" = test ]; then
  packages+=("${web[@]}" clang-format-19 clang-tidy-19 libclang-rt-19-dev chromium)
  # To see that arm64 has the same bits; on arm64 it is the machine's own compiler.
  [ "$(dpkg --print-architecture)" = arm64 ] || packages+=(g++-aarch64-linux-gnu qemu-user)
fi
# What the benchmark compares with.
[[ ${1:-run} =~ ^(test|bench)$ ]] && packages+=(libfcl-dev libbullet-dev libccd-dev)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${db:Status-Status}\n' "$package" 2> /dev/null | grep -qx installed || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null || ! sudo -n true 2> /dev/null && ! [ -t 0 ]; then
    echo "install: needs root or sudo once, for: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "install: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! "${as_root[@]}" apt-get update > "$log" 2>&1 ||
  ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" \
    >> "$log" 2>&1; then
  echo "install: apt-get failed (is there a network?): $(grep -E '^(E|W|Err)' "$log" | tail -n 1)" >&2
  exit 1
fi
