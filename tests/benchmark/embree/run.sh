#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Questions to one tree (rays, points, spheres of robots) against Embree: dragon-128 and dragon-512.
#
#   tests/benchmark/embree/run.sh [ROUNDS]
#
#   ROUNDS  that contenders take turns (15)
#
# Objects are read from the folder SPHERETREE_DATA. Embree is installed first, if it is missing.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# shellcheck source=scripts/dependencies.sh
source "$here/../../../scripts/dependencies.sh"

case "${1:-}" in
    -h | --help)
        sed -n '3,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
        exit 0
        ;;
esac
install_packages "${build_packages[@]}" libbenchmark-dev "${embree_packages[@]}"
build_preset benchmark vdb_spheretree spheretree_benchmark_embree
find_data
bin="$project_root/build/benchmark/bin"
folder="$project_root/build/benchmark/embree"
mkdir -p "$folder"
trees=()
for object in dragon-128 dragon-512; do
    for branching in 8 2; do
        tree="$folder/$object-$branching.vdb"
        "$bin/vdb_spheretree" -quiet -read "$SPHERETREE_DATA/vol/$object.vol" -spheretree quality=fast \
            branching="$branching" errors=0 topology=0 -write "$tree"
        trees+=("$tree")
    done
done
"$bin/spheretree_benchmark_embree" "${1:-15}" "${trees[@]}"
