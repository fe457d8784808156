#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Breaks one line of the code at a time and looks whether the tests notice.
#
#   scripts/mutate.sh [--draw N] [--id ID] [--check] [--jobs N] [--help]
#
# tests/mutants/mutants.tsv has the mutants; build/test is built first. Nothing in the tree changes.
set -euo pipefail
# shellcheck source=scripts/dependencies.sh
source "$(dirname "${BASH_SOURCE[0]}")/dependencies.sh"

case " $* " in
    *" --check "* | *" --help "* | *" -h "*) ;;
    *)
        install_packages "${build_packages[@]}" "${test_packages[@]}"
        build_preset test
        ;;
esac
cd "$project_root"
exec /usr/bin/env python3 -B scripts/mutate.py --jobs "$(build_jobs)" "$@"
