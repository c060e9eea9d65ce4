#!/usr/bin/env bash
# clang-tidy over the sources that changed since they last passed (with their headers): .clang-tidy says the checks.
# --paths: also those that follow all paths through a function (clang-analyzer), which take most of the time; the tests' own
# run theirs, under sanitizers.
set -euo pipefail
export paths=${1:-}
case $paths in '' | --paths) ;; *)
  echo "lint: unknown argument $paths; it takes --paths" >&2
  exit 2
  ;;
esac
cd "$(dirname "$0")/.."
passed=build/lint
mkdir -p "$passed"
# A file is linted again when it, a header that it reads, or the checks change: ninja knows who reads what.
root=$(pwd)
declare -A read_by sum_of
for build in bench clang; do
  while read -r source dependency; do
    read_by[$source]+=" $dependency"
  done < <(ninja -C "build/$build" -t deps | awk -v root="$root/" '
    /^[^ ]/ { source = "" }
    /^ / && index($1, root) == 1 {
      path = substr($1, length(root) + 1)
      if (path ~ /^build\//) next
      if (source == "") source = path
      print source, path
    }')
done
while read -r sum file; do
  sum_of[$file]=$sum
done < <(git ls-files '*.h' '*.cpp' | xargs sha256sum)
checks=$(cat .clang-tidy CMakeLists.txt <(echo "$paths") | sha256sum)
todo=()
while IFS= read -r file; do
  sums=$checks
  for dependency in ${read_by[$file]:-$file}; do
    sums+=${sum_of[$dependency]:-}
  done
  stamp=$passed/$(printf '%s %s' "$file" "$sums" | sha256sum | cut -c1-32)
  [ -e "$stamp" ] || todo+=("$file" "$stamp")
done < <(git ls-files 'src/*.cpp' 'apps/*.cpp' 'tests/*.cpp' 'bench/*.cpp')
echo "lint: $((${#todo[@]} / 2)) files"
[ ${#todo[@]} -eq 0 ] && exit 0
printf '%s\0' "${todo[@]}" | xargs -0 -n 2 -P "$(nproc)" bash -c '
  build=build/clang
  # g++ builds the benchmark, with an option that clang does not know.
  [[ $0 == bench/* ]] && build=build/bench
  options=(--extra-arg=-Wno-unknown-warning-option --quiet --warnings-as-errors="*")
  [[ $paths != --paths || $0 == tests/* ]] && options+=("--checks=-clang-analyzer-*")
  if clang-tidy-19 -p "$build" "${options[@]}" "$0" > "$1.log" 2>&1; then
    rm -f "$1.log"; touch "$1"
  else
    grep -E "(warning|error):" "$1.log" | sort -u; rm -f "$1.log"; exit 1
  fi'
