#!/usr/bin/env bash
# Builds the fuzz targets (clang, address and undefined-behaviour sanitizers) and runs each. Usage: fuzz.sh [SECONDS]
# [TARGET...]. SECONDS for each target, default 20; targets are the names of fuzz/*_fuzz.cpp, default all. Findings go to
# build/fuzz/findings; what widens the coverage is kept in build/fuzz/corpus, beside the seeds in fuzz/corpus.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-20}
case $seconds in '' | *[!0-9]*)
  echo "fuzz: SECONDS must be a whole number, is \"$seconds\"" >&2
  exit 2
  ;;
esac
shift || true
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for source in fuzz/*_fuzz.cpp; do targets+=("$(basename "$source" _fuzz.cpp)"); done
fi
for name in "${targets[@]}"; do
  if ! [ -f "fuzz/${name}_fuzz.cpp" ]; then
    echo "fuzz: there is no target $name" >&2
    exit 2
  fi
done
out=build/fuzz
mkdir -p "$out/findings" "$out/objects"
flags=(-std=c++20 -O1 -g1 -ffp-contract=off -fno-omit-frame-pointer -fsanitize=address,undefined
  -fno-sanitize-recover=all -Wno-deprecated-declarations -Iinclude -Isrc -Iapps/cli -Itests -Ifuzz -I"$out")
# assimp is not sanitized, and not what is looked at: see fuzz/mesh_fuzz.cpp.
libraries=(-Wl,--as-needed -lassimp -lfmt)
cmake -D FOLDER=scenes/styles -D OUTPUT="$out/style_table.inc" -P scripts/style_table.cmake
ccache=$(command -v ccache || true)
shared=$(ls -t include/elastoon/*.h src/*.h apps/cli/*.h tests/*.h fuzz/*.h scenes/styles/*.json scripts/fuzz.sh |
  head -n 1)

# Whether the file is newer than what it is made of; any header counts.
fresh() {
  local made=$1 part
  shift
  for part in "$shared" "$@"; do
    [ "$made" -nt "$part" ] || return 1
  done
}

objects=()
todo=()
for source in src/*.cpp apps/cli/{mesh_file,mesh_assimp,isolated,progress}.cpp fuzz/*_fuzz.cpp; do
  object=$out/objects/${source//\//-}.o
  case $source in fuzz/*) ;; *) objects+=("$object") ;; esac
  fresh "$object" "$source" || todo+=("$source" "$object")
done
if [ ${#todo[@]} -gt 0 ]; then
  echo "fuzz: building $((${#todo[@]} / 2)) sources"
  printf '%s\0' "${todo[@]}" | xargs -0 -n 2 -P "${FUZZ_JOBS:-$(nproc)}" bash -c '
    '"$ccache"' clang++-19 '"${flags[*]}"' -fsanitize=fuzzer-no-link -c "$0" -o "$1"'
fi
archive=$out/sources.a
if ! fresh "$archive" "${objects[@]}"; then
  rm -f "$archive"
  ar rcs "$archive" "${objects[@]}"
fi

failed=0
for name in "${targets[@]}"; do
  object=$out/objects/fuzz-${name}_fuzz.cpp.o
  fresh "$out/$name" "$archive" "$object" ||
    clang++-19 "${flags[@]}" -fuse-ld=lld -fsanitize=fuzzer "$object" "$archive" "${libraries[@]}" -o "$out/$name"
  mkdir -p "$out/corpus/$name"
  log=$out/$name.log
  echo "fuzz: $name for $seconds s"
  if timeout -k 10 $((seconds + 60)) "$out/$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -use_value_profile=1 -verbosity=1 -print_final_stats=1 -artifact_prefix="$out/findings/$name-" \
    "$out/corpus/$name" "fuzz/corpus/$name" > "$log" 2>&1; then
    awk '/stat::number_of_executed_units/ { print "fuzz: '"$name"' ran", $2, "inputs, no findings" }' "$log"
  else
    echo "fuzz: $name FAILED; the input is in $out/findings, the log in $log:" >&2
    grep -aE "ERROR|SUMMARY|runtime error|elastoon_fuzz:|Test unit written" "$log" >&2 || tail -n 5 "$log" >&2
    failed=1
  fi
done
exit $failed
