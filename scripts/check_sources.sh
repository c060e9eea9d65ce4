#!/usr/bin/env bash
# Looks through the sources of the library and of the game's rules, and the build's files, for what gives other bits on other
# machines (docs/determinism.md). Usage: check_sources.sh [FILE...], default all of these.
# First it plants a line of each kind and looks that it is found.
set -euo pipefail
cd "$(dirname "$0")/.."

# Kinds of lines: what they are, and an expression for the code without its comments. Of libm, sqrt, fabs, floor and
# nextafter are exact everywhere.
declare -A code=(
  [libm]='(?<![\w.>:])(?:(?:std)?::|__builtin_)?(?:a?(?:sin|cos|tan)h?|atan2|exp[2]?|expm1|log(?:10|2|1p|b)?|pow|cbrt|hypot|fma|fmod|modf|remainder|remquo|l{0,2}round|l{0,2}rint|nearbyint|ceil|trunc|erfc?|[lt]gamma|ldexp|frexp|ilogb|scalbl?n|fdim|lerp)[fl]?\s*\('
  ['glm beyond arithmetic']='glm::(?!(?:abs|conjugate|cross|dot|length|mat3_cast|max|min|normalize|dmat[234]|dquat|dvec[234])\b)|<glm/gtx/'
  ['unordered container or hash of the library']='\bunordered_|\bstd::hash\b'
  ['random numbers']='<random>|\brandom_device\b|\bmt19937|\b(?:std::|::)?(?:s?rand|[dlms]rand48|random)\s*\(|_distribution\b'
  [clock]='<chrono>|<ctime>|<time\.h>|\bchrono::|\bgettimeofday\b|\bclock(?:_gettime)?\s*\(|\btime\s*\(\s*(?:NULL|nullptr|0|&)'
  ['order that is not fixed']='\bstd::(?:nth_element|partial_sort|partition|shuffle|sample|reduce|transform_reduce|execution)\b|\bthis_thread\b'
  ['order of addresses']='\b(?:map|set|less|greater)<\s*(?:const\s+)?(?:[\w:]+\s*(?:const\s*)?\*|\w*Ptr\b|std::(?:shared|unique)_ptr)|\bu?intptr_t\b|\bowner_(?:less|before)\b|\.get\(\)\s*[<>]\s*\w+\.get\(\)'
  ['number of another width']='\blong\s+double\b|\b_?_[Ff]loat(?:16|80|128)\b'
  ['option of the compiler']='#\s*pragma\s+(?!once\b)|\b_Pragma\b|\b__attribute__\b|\[\[(?:gnu|clang)::'
  ['instructions of one machine']='\w+intrin\.h|<arm_|\b_mm\d*_|\basm\b'
)
build='-Ofast|-ffast-math|-funsafe-math|-fassociative-math|-freciprocal-math|-ffinite-math|-fno-signed-zeros|-mfpmath|-march|-mcpu|-mfma|-mavx|-ffp-contract=(?:fast|on)|-flto'

# What may stand there after all: file, the line's text, the reason.
excepted() {
  case $1:$2 in
    # The build that must differ: scripts/test_contracted.sh.
    CMakePresets.json:*'"CMAKE_CXX_FLAGS": "-mfma"'*) return 0 ;;
    # What a shared library shows.
    include/elastoon/export.h:*'__attribute__((visibility("default")))') return 0 ;;
    # Wider registers without fused operations, and the one body of both ways: tests/matrix_table_test.cpp holds them to
    # poseAt(), to the bit.
    src/*_lanes.cpp:*'[[gnu::target("avx2")]]'* | src/*lanes.*:*'[[gnu::always_inline]]'*) return 0 ;;
    # Works nothing out.
    src/prefetch.h:*'[[gnu::always_inline]]'*) return 0 ;;
    # How many of them at a time; held likewise.
    src/flight_lanes.cpp:*'_Pragma("clang loop vectorize_width(4) interleave_count(1)")') return 0 ;;
    # Move numbers about or compare them, work nothing out.
    src/matrix_table.cpp:*'using Four [[gnu::vector_size(16)]] = float;') return 0 ;;
    src/obstacle_tree.cpp:*'using Four'*'[[gnu::vector_size(16)]] = '*) return 0 ;;
    src/support_table.h:*'using Two [[gnu::vector_size(16)]] = double;') return 0 ;;
    *) return 1 ;;
  esac
}

# Lines of a file, "FILE:LINE: KIND: TEXT"; 1 where there are any.
look() {
  local file=$1 shown=${2:-$1} found=0 kind line
  local -A expressions
  case $shown in
    *.h | *.cpp) for kind in "${!code[@]}"; do expressions[$kind]=${code[$kind]}; done ;;
    *) expressions=(['option of the compiler']=$build) ;;
  esac
  for kind in "${!expressions[@]}"; do
    while IFS= read -r line; do
      excepted "$shown" "${line#*:}" && continue
      echo "$shown:${line%%:*}: $kind: ${line#*:}"
      found=1
    done < <(sed -E 's,(^|[^:])//.*,\1,' "$file" | grep -nP -e "${expressions[$kind]}")
  done
  return $found
}

planted=$(mktemp)
trap 'rm -f "$planted"' EXIT
expect() {
  local name=$1 wanted=$2 text=$3 got=found
  echo "$text" > "$planted"
  look "$planted" "$name" > /dev/null && got=passed
  [ "$got" = "$wanted" ] && return
  echo "check_sources: this line should be $wanted in $name, is $got: $text" >&2
  exit 1
}
while IFS= read -r text; do expect planted.cpp found "$text"; done << 'END'
double a = std::sin(x);
double a = sinf(x);
double a = cosl (x);
return ::atan2(y, x);
double a = 2.0*acos(x);
double a = std::pow(x, 2.0), b = 0.0;
double a = std::hypot(x, y) + std::cbrt(z);
double a = std::fma(x, y, z);
double a = __builtin_fma(x, y, z);
double a = std::fmod(x, 1.0);
long a = std::lround(x) + std::llrint(y);
Quat q = glm::angleAxis(angle, axis);
Quat q = glm::slerp(a, b, t);
double a = glm::acos(x);
#include <glm/gtx/norm.hpp>
std::unordered_map<int, int> map;
auto h = std::hash<double>{}(x);
int i = rand() % 3;
std::random_device device;
auto now = std::chrono::steady_clock::now();
auto now = time(nullptr);
std::nth_element(a, b, c);
double a = std::reduce(begin, end);
std::map<const Shape*, int> order;
std::set<ShapePtr> shapes;
std::set<std::shared_ptr<Shape>> shapes;
if (a.get() < b.get()) {
long double sum = 0.0;
#pragma GCC optimize("fast-math")
__attribute__((optimize("Ofast"))) double f();
#include <immintrin.h>
END
while IFS= read -r text; do expect planted.cpp passed "$text"; done << 'END'
double a = std::sqrt(x) + std::fabs(y) + std::floor(z);
double a = detSinCos(x).sin + detAtan2(y, x) + detAcos(z);
// as std::sin(x) would
#pragma once
double a = glm::dot(x, y) / glm::length(z);
std::map<BodyId, const Track*> by_id;
double time(double dt), b = world.time();
double kMost = exponent(x) + turn.log(x);
END
while IFS= read -r text; do expect CMakeLists.txt found "$text"; done << 'END'
target_compile_options(elastoon PRIVATE -ffast-math)
set(CMAKE_CXX_FLAGS "-O3 -march=native")
target_compile_options(elastoon PRIVATE -ffp-contract=fast)
END
expect CMakeLists.txt passed 'target_compile_options(elastoon PUBLIC -ffp-contract=off)'

files=("$@")
if [ ${#files[@]} -eq 0 ]; then
  rules=(apps/game/{balls,blocks,bot,game,level,paddle,play,response,view}.cpp apps/game/*.h)
  files=(src/*.cpp src/*.h include/elastoon/*.h "${rules[@]}" CMakeLists.txt CMakePresets.json cmake/*.cmake)
fi
failed=0
for file in "${files[@]}"; do look "$file" >&2 || failed=1; done
[ $failed -eq 0 ] || { echo "check_sources: docs/determinism.md says what is allowed instead" >&2; exit 1; }
echo "sources: ${#files[@]} files, nothing forbidden"
