#!/usr/bin/env bash
# Installs the library into empty prefixes, shared and static, and builds examples/minimal against them by find_package and
# by pkg-config, and from the sources by add_subdirectory; looks what the library shows and needs; makes the packages.
set -euo pipefail
cd "$(dirname "$0")/.."
out=build/install
rm -rf "$out"
mkdir -p "$out"
out=$(realpath "$out")
log=$out/log.txt
fail() {
  tail -n 30 "$log" >&2
  echo "install test: $1" >&2
  exit 1
}
# Builds the example with these options of CMake and runs both of its programs, which must tell the same.
build_example() {
  local name=$1
  shift
  cmake -S examples/minimal -B "$out/$name" -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER=g++ \
    -D CMAKE_CXX_COMPILER_LAUNCHER=ccache "$@" > "$log" 2>&1 || fail "$name: cmake"
  cmake --build "$out/$name" >> "$log" 2>&1 || fail "$name: build"
  same "$name" "$out/$name/minimal" "$out/$name/minimal_c"
}
# The same motion, by whatever way it was built.
same() {
  local name=$1 program
  shift
  for program in "$@"; do
    "$program" > "$out/now.txt" 2> "$log" || fail "$name: $program fails"
    [ -e "$out/motion.txt" ] || cp "$out/now.txt" "$out/motion.txt"
    cmp -s "$out/now.txt" "$out/motion.txt" || fail "$name: $program tells another motion"
  done
}

scripts/build.sh package
scripts/build.sh release elastoon
cmake --install build/package --prefix "$out/before" > "$log" 2>&1 || fail "cmake --install"
mv "$out/before" "$out/shared" # an installed tree can be moved
cmake --install build/release --prefix "$out/static" --component development > "$log" 2>&1 || fail "cmake --install"

library=$(find "$out/shared" -name libelastoon.so)
folder=$(dirname "$library")
soname=$(readelf -d "$library" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')
[[ $soname =~ ^libelastoon\.so\.[0-9]+(\.[0-9]+)?$ ]] && [ -e "$folder/$soname" ] || fail "the soname is $soname"
needed=$(readelf -d "$library" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p' | grep -vE '^(libstdc\+\+|libm|libgcc_s|libc|ld-linux.*)\.so' || true)
[ -z "$needed" ] || fail "the library needs $needed at run time"

# Every function of the C interface is there; of C++ what the headers declare, and nothing of what is inside.
nm -D --defined-only "$library" | awk '{ print $3 }' | sort > "$out/shown.txt"
sed -n 's/^ELASTOON_API .*\(elastoon[A-Z][A-Za-z0-9]*\)(.*/\1/p' include/elastoon/elastoon.h | sort > "$out/declared.txt"
missing=$(comm -13 "$out/shown.txt" "$out/declared.txt")
[ -z "$missing" ] && [ "$(wc -l < "$out/declared.txt")" -gt 60 ] || fail "not in the library: $missing"
for hidden in closestPoints advanceBody c_interface JsonReader nlohmann; do
  ! grep -q "$hidden" "$out/shown.txt" || fail "the library shows its inside: $(grep -m 1 "$hidden" "$out/shown.txt")"
done
foreign=$(nm -DC --defined-only "$library" | awk '$2 == "T"' | grep -v elastoon | head -n 1 || true)
[ -z "$foreign" ] || fail "the library shows $foreign"

build_example shared_example -D CMAKE_PREFIX_PATH="$out/shared"
build_example static_example -D CMAKE_PREFIX_PATH="$out/static"
build_example source_example -D ELASTOON_SOURCE="$PWD" -D ELASTOON_SCENE=OFF
! grep -q nlohmann_json_DIR "$out/source_example/CMakeCache.txt" || fail "without scenes, nlohmann-json is not to be looked for"

export PKG_CONFIG_PATH=$folder/pkgconfig
read -ra flags < <(pkg-config --cflags --libs elastoon)
gcc -std=c11 -pedantic examples/minimal/minimal.c "${flags[@]}" -Wl,-rpath,"$folder" -o "$out/by_pkg_config"
same pkg-config "$out/by_pkg_config"
PKG_CONFIG_PATH=$(dirname "$(find "$out/static" -name elastoon.pc)")
read -ra flags < <(pkg-config --static --cflags --libs elastoon)
gcc -std=c11 -pedantic examples/minimal/minimal.c "${flags[@]}" -o "$out/by_static_pkg_config"
same "static pkg-config" "$out/by_static_pkg_config"
[ "$(pkg-config --modversion elastoon)" = "$(sed -n 's/^project(elastoon VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)" ] ||
  fail "pkg-config tells another version"

cpack --config build/package/CPackConfig.cmake -B "$out/packages" > "$log" 2>&1 || fail "cpack"
root=$out/root
maintainer=$(sed -n 's/^ELASTOON_PACKAGE_CONTACT:STRING=//p' build/package/CMakeCache.txt)
for package in libelastoon[0-9]* libelastoon-dev elastoon; do
  # shellcheck disable=SC2086
  file=$(ls "$out"/packages/${package}_*.deb) || fail "there is no package $package"
  [[ $maintainer == *@* && $(dpkg-deb -f "$file" Maintainer) == "$maintainer" ]] || fail "$package names another maintainer"
  dpkg-deb -f "$file" Depends > "$out/depends.txt"
  case $package in
    libelastoon-dev) grep -q 'libelastoon[0-9.]* (= .*libglm-dev' "$out/depends.txt" || fail "$package: $(cat "$out/depends.txt")" ;;
    elastoon) grep -q 'libelastoon[0-9.]* (=.*libembree' "$out/depends.txt" || fail "$package: $(cat "$out/depends.txt")" ;;
    *) grep -q 'libstdc++6' "$out/depends.txt" || fail "$package: $(cat "$out/depends.txt")" ;;
  esac
  dpkg-deb -x "$file" "$root"
done
LD_LIBRARY_PATH=$(dirname "$(find "$root" -name "$soname")") "$root/usr/bin/elastoon" simulate \
  "$root/usr/share/elastoon/scenes/hello.json" > "$out/hello.txt" 2> "$log" || fail "the packaged program fails"
grep -q "hash=$(awk '$1 == "hello.json" && $2 == 60 { print $3 }' tests/golden/hashes.txt)" "$out/hello.txt" ||
  fail "the packaged program meets another hash"
echo "install: shared, static, by sources and pkg-config; $(wc -l < "$out/declared.txt") C functions; $(ls "$out"/packages/*.deb | wc -l) packages"
