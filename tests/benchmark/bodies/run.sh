#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Questions to two bodies (collision, distance, all pairs, screws) against FCL and Bullet: dragon-128 and dragon-512.
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
        sed -n '3,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
        exit 0
        ;;
esac
install_packages "${build_packages[@]}" libbenchmark-dev libfcl-dev libbullet-dev
build_preset benchmark spheretree_benchmark_bodies
find_data
for object in dragon-128 dragon-512; do
    file="$SPHERETREE_DATA/vol/$object.vol"
    "$project_root/build/benchmark/bin/spheretree_benchmark_bodies" "$file" "$file" normal "${1:-5}"
done
