#!/usr/bin/env bash
# clang-tidy over the sources that changed since they last passed (with their headers): .clang-tidy says the checks.
set -euo pipefail
cd "$(dirname "$0")/.."
passed=build/lint
mkdir -p "$passed"
# A file is linted again when it, any header, or the checks change.
shared=$(git ls-files -z '*.h' .clang-tidy CMakeLists.txt | xargs -0 sha256sum | sha256sum | cut -c1-16)
todo=()
while IFS= read -r file; do
  stamp=$passed/$(printf '%s %s' "$shared" "$(sha256sum "$file")" | sha256sum | cut -c1-32)
  [ -e "$stamp" ] || todo+=("$file" "$stamp")
done < <(git ls-files 'src/*.cpp' 'apps/*.cpp' 'tests/*.cpp' 'bench/*.cpp')
echo "lint: $((${#todo[@]} / 2)) files"
[ ${#todo[@]} -eq 0 ] && exit 0
printf '%s\0' "${todo[@]}" | xargs -0 -n 2 -P "$(nproc)" bash -c '
  build=build/clang
  # g++ builds the benchmark, with an option that clang does not know.
  [[ $0 == bench/* ]] && build=build/bench
  options=(--extra-arg=-Wno-unknown-warning-option --quiet --warnings-as-errors="*")
  # Following all paths takes most of the time; the tests run theirs, under sanitizers.
  [[ $0 == tests/* ]] && options+=("--checks=-clang-analyzer-*")
  if clang-tidy-19 -p "$build" "${options[@]}" "$0" > "$1.log" 2>&1; then
    rm -f "$1.log"; touch "$1"
  else
    grep -E "(warning|error):" "$1.log" | sort -u; rm -f "$1.log"; exit 1
  fi'
