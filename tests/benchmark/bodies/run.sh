#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Questions to two bodies (collision, distance, all pairs, screws) against FCL and Bullet: a dragon against itself and
# against another part, of 128 and of 512 voxels.
#
#   tests/benchmark/bodies/run.sh [ROUNDS]
#
#   ROUNDS  that contenders take turns (5)
#
# Objects are read from the folder SPHERETREE_DATA. FCL and Bullet are installed first, if they are missing.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# shellcheck source=scripts/dependencies.sh
source "$here/../../../scripts/dependencies.sh"

case "${1:-}" in
    -h | --help)
        sed -n '3,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
        exit 0
        ;;
esac
install_packages "${build_packages[@]}" libbenchmark-dev libfcl-dev libbullet-dev
build_preset benchmark spheretree_benchmark_bodies
find_data
for voxels in 128 512; do
    for other in dragon fandisk; do
        "$project_root/build/benchmark/bin/spheretree_benchmark_bodies" \
            "$SPHERETREE_DATA/vol/dragon-$voxels.vol" "$SPHERETREE_DATA/vol/$other-$voxels.vol" normal "${1:-5}"
    done
done
