#!/usr/bin/env bash
# Builds the library with fused multiply-add and looks that no golden hash is met: else the hashes would prove nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "$(uname -m)" != x86_64 ] || ! grep -qw fma /proc/cpuinfo; then
  echo "contracted: skipped, this processor has no fused multiply-add of x86-64"
  exit 0
fi
scripts/build.sh contracted elastoon_golden
out=build/contracted/golden.txt
code=0
build/contracted/tests/golden/elastoon_golden tests/golden/hashes.txt scenes > "$out" || code=$?
if [ "$code" -ne 1 ] || ! grep -q DIFFERS "$out"; then
  tail -n 3 "$out" >&2
  echo "contracted: with fused multiply-add some hash should differ, and the runner end with 1; it ended with $code" >&2
  exit 1
fi
echo "contracted: $(grep -c DIFFERS "$out") of $(grep -cv 'golden hashes' "$out") golden hashes differ, as they must"
