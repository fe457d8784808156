#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs tests and command lines with clang's sanitizers compiled in.
#
#   scripts/sanitize.sh           a chosen set, in some minutes: every reader, every kernel, every kind of tree
#   scripts/sanitize.sh all       all tests under the address and undefined-behaviour sanitizers
#   scripts/sanitize.sh threads   all tests under the thread sanitizer
set -euo pipefail
# shellcheck source=scripts/dependencies.sh
source "$(dirname "${BASH_SOURCE[0]}")/dependencies.sh"

export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1"
export LSAN_OPTIONS="suppressions=$project_root/scripts/sanitizers/leaks.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1"

# The same lines as a user's. They stop at the first report.
run_lines() {
    local program="$project_root/build/asan/bin/vdb_spheretree" data="$project_root/tests/data/0.1"
    local line work
    work="$(mktemp -d)"
    # shellcheck disable=SC2064 # this folder, whatever the variable holds then
    trap "rm -rf '$work'" EXIT
    (
        cd "$work"
        write_meshes
        while read -r line; do
            case "$line" in "" | \#*) continue ;; esac
            # shellcheck disable=SC2086 # words of a command line
            if ! "$program" -quiet ${line//@/$data} >out.txt 2>err.txt; then
                cat err.txt >&2
                fail "this line failed: vdb_spheretree -quiet $line"
            fi
        done <"$project_root/scripts/sanitizers/lines.txt"
    )
}

# A tetrahedron in each format that has a reader of ours.
write_meshes() {
    local points=("0 0 0" "8 0 0" "0 8 0" "0 0 8") faces=("0 2 1" "0 1 3" "0 3 2" "1 2 3") face corner
    {
        printf 'v %s\n' "${points[@]}"
        for face in "${faces[@]}"; do
            printf 'f'
            for corner in $face; do printf ' %d' $((corner + 1)); done
            printf '\n'
        done
    } >t.obj
    { printf 'OFF\n4 4 6\n'; printf '%s\n' "${points[@]}"; printf '3 %s\n' "${faces[@]}"; } >t.off
    {
        printf 'ply\nformat ascii 1.0\nelement vertex 4\n'
        printf 'property float %s\n' x y z
        printf 'element face 4\nproperty list uchar int vertex_indices\nend_header\n'
        printf '%s\n' "${points[@]}"
        printf '3 %s\n' "${faces[@]}"
    } >t.ply
    {
        printf 'solid t\n'
        for face in "${faces[@]}"; do
            printf 'facet normal 0 0 0\nouter loop\n'
            for corner in $face; do printf 'vertex %s\n' "${points[corner]}"; done
            printf 'endloop\nendfacet\n'
        done
        printf 'endsolid t\n'
    } >t.stl
}

install_packages "${build_packages[@]}" "${test_packages[@]}" "${clang_packages[@]}"
case "${1:-chosen}" in
    chosen)
        build_preset asan vdb_spheretree spheretree_test_kernel spheretree_test_store
        cd "$project_root/build/asan/bin"
        ./spheretree_test_kernel --gtest_brief=1 --gtest_filter='-*Exhaustive*:*Large*'
        ./spheretree_test_store --gtest_brief=1
        run_lines
        ;;
    all | threads)
        preset=asan
        if [ "$1" = threads ]; then preset=tsan; fi
        build_preset "$preset"
        find_data
        cd "$project_root"
        ctest --preset "$preset" -j "$(build_jobs)" </dev/null
        ;;
    *)
        sed -n '3,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
        ;;
esac
