#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures every stage of every object: a table, the same as JSON, and a picture of it.
#
#   tests/benchmark/run.sh [ARGUMENT...]
#   tests/benchmark/run.sh --queries [ROUNDS]
#
#   ARGUMENT  of build/benchmark/bin/spheretree_benchmark, whose --help lists them; for example
#             --benchmark_filter='dragon-512|gyroid', --largest, or --json=FILE (build/benchmark/benchmark.json)
#
# With --queries, questions to trees are timed instead: to two bodies beside FCL and Bullet, and to one beside Embree.
#
# The picture is beside the JSON; without matplotlib there is none. Files are read from the folder
# SPHERETREE_DATA. The program is built first, unless the variable SPHERETREE_BENCHMARK names one.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# shellcheck source=scripts/dependencies.sh
source "$here/../../scripts/dependencies.sh"

if [ "${1:-}" = --queries ]; then
    "$here/bodies/run.sh" "${@:2}"
    "$here/embree/run.sh" "${@:2}"
    exit 0
fi
json="$project_root/build/benchmark/benchmark.json"
for argument in "$@"; do
    case "$argument" in
        -h | --help)
            sed -n '3,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
            exit 0
            ;;
        --json=?*) json="$(realpath -m -- "${argument#--json=}")" ;;
    esac
done

program="${SPHERETREE_BENCHMARK:-}"
if [ -z "$program" ]; then
    install_packages "${build_packages[@]}" libbenchmark-dev
    build_preset benchmark spheretree_benchmark
    program="$project_root/build/benchmark/bin/spheretree_benchmark"
fi
find_data
mkdir -p "$(dirname "$json")"
"$program" "$@" "--json=$json"
say "the same as JSON: $json"
if ! "${python[@]}" -c 'import matplotlib' 2>/dev/null; then
    say "no matplotlib, no picture (apt-get install python3-matplotlib)"
    exit 0
fi
"${python[@]}" "$project_root/examples/benchmark/rates.py" "$json" "${json%.json}.png"
say "the picture: ${json%.json}.png"
