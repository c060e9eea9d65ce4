#!/usr/bin/env bash
# Installs what is missing, builds the benchmark and runs it. Usage: bench.sh [OPTION...], as elastoon_bench --help says.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install.sh bench
scripts/build.sh bench elastoon_bench
exec build/bench/elastoon_bench "$@"
