#!/usr/bin/env bash
# Builds the fuzz targets (clang, address and undefined-behaviour sanitizers) and runs each. Usage: fuzz.sh [SECONDS]
# SECONDS for each target, default 20. Findings go to build/fuzz/findings; what widens the coverage is kept in
# build/fuzz/corpus, beside the seeds in fuzz/corpus.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-20}
case $seconds in '' | *[!0-9]*)
  echo "fuzz: SECONDS must be a whole number, is \"$seconds\"" >&2
  exit 2
  ;;
esac
out=build/fuzz
mkdir -p "$out/findings" "$out/objects"
flags=(-std=c++20 -O1 -g1 -ffp-contract=off -fno-omit-frame-pointer -fsanitize=address,undefined
  -fno-sanitize-recover=all -Wno-deprecated-declarations -Iinclude -Isrc -Itests)
ccache=$(command -v ccache || true)

objects=()
: > "$out/sources"
for source in src/*.cpp; do
  object=$out/objects/$(basename "$source" .cpp).o
  objects+=("$object")
  printf '%s\0%s\0' "$source" "$object" >> "$out/sources"
done
echo "fuzz: building $(find src -name '*.cpp' | wc -l) sources and the targets"
xargs -0 -n 2 -P "${FUZZ_JOBS:-$(nproc)}" bash -c '
  '"$ccache"' clang++-19 '"${flags[*]}"' -fsanitize=fuzzer-no-link -c "$0" -o "$1"' < "$out/sources"

failed=0
for target in fuzz/*_fuzz.cpp; do
  name=$(basename "$target" _fuzz.cpp)
  clang++-19 "${flags[@]}" -fsanitize=fuzzer "$target" "${objects[@]}" -o "$out/$name"
  mkdir -p "$out/corpus/$name"
  log=$out/$name.log
  echo "fuzz: $name for $seconds s"
  if timeout -k 10 $((seconds + 60)) "$out/$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -use_value_profile=1 -verbosity=1 -print_final_stats=1 -artifact_prefix="$out/findings/$name-" \
    "$out/corpus/$name" "fuzz/corpus/$name" > "$log" 2>&1; then
    awk '/stat::number_of_executed_units/ { print "fuzz: '"$name"' ran", $2, "inputs, no findings" }' "$log"
  else
    echo "fuzz: $name FAILED; the input is in $out/findings, the log in $log:" >&2
    grep -E "ERROR|SUMMARY|runtime error|_fuzz:|Test unit written" "$log" >&2 || tail -n 5 "$log" >&2
    failed=1
  fi
done
exit $failed
