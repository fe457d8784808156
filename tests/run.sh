#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds the program and its tests, and runs all of them.
#
#   tests/run.sh [ctest arguments]     for example: tests/run.sh -R SphereTree
set -euo pipefail
if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
    sed -n '3,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    exit 0
fi
# shellcheck source=scripts/dependencies.sh
source "$(dirname "${BASH_SOURCE[0]}")/../scripts/dependencies.sh"

install_packages "${build_packages[@]}" "${test_packages[@]}" "${reader_packages[@]}" "${browser_packages[@]}"
install_npm
build_preset test

find_data
ctest --test-dir "$project_root/build/test" -j2 --output-on-failure "$@" </dev/null
