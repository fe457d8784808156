#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs tests and command lines with clang's sanitizers compiled in.
#
#   scripts/sanitize.sh           command lines that reach every reader, every kernel and every kind of tree,
#                                 under the address and undefined-behaviour sanitizers: some minutes
#   scripts/sanitize.sh all       all tests under these
#   scripts/sanitize.sh threads   all tests under the thread sanitizer
set -euo pipefail
# shellcheck source=scripts/dependencies.sh
source "$(dirname "${BASH_SOURCE[0]}")/dependencies.sh"

use_sanitizer_options
export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1"

# The same lines as a user's. They stop at the first report.
run_lines() {
    local program="$project_root/build/asan-quick/bin/vdb_spheretree" data="$project_root/tests/data/0.1"
    local line packed work
    work="$(mktemp -d)"
    # shellcheck disable=SC2064 # this folder, whatever the variable holds then
    trap "rm -rf '$work'" EXIT
    (
        cd "$work"
        write_meshes
        for packed in "$data"/*.vdb.gz; do gunzip -c "$packed" >"$(basename "$packed" .gz)"; done
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

# TBB's library hands tasks from thread to thread, which the thread sanitizer does not see in a library that
# is not compiled with it: it would report each as a race. So TBB is built anew, from the sources of the
# package that is installed, and found first by what is built here; other programs that tests run keep their own.
use_sanitized_tbb() {
    local folder="$project_root/build/tsan-tbb" apt
    if [ ! -d "$folder/built" ]; then
        say "building TBB with the thread sanitizer in build/tsan-tbb"
        rm -rf "$folder"
        mkdir -p "$folder/lists/partial"
        echo "deb-src http://deb.debian.org/debian $(. /etc/os-release && echo "$VERSION_CODENAME") main" \
            >"$folder/sources.list"
        apt=(apt-get -q -o "Dir::Etc::sourcelist=$folder/sources.list" -o Dir::Etc::sourceparts=-
            -o "Dir::State::lists=$folder/lists")
        "${apt[@]}" update >&2
        (cd "$folder" && "${apt[@]}" source --download-only onetbb >&2 && tar xf onetbb_*.orig.tar.*)
        cmake -S "$folder"/oneTBB-* -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ \
            -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread -DTBB_TEST=OFF \
            -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF >&2
        cmake --build "$folder/build" --target tbb -j "$(build_jobs)" >&2
        mkdir "$folder/built"
        cp -P "$folder"/build/*/libtbb.so* "$folder/built"
    fi
    export SPHERETREE_CMAKE_ARGUMENTS="${SPHERETREE_CMAKE_ARGUMENTS:-} -DCMAKE_BUILD_RPATH=$folder/built"
}

install_packages "${build_packages[@]}" "${test_packages[@]}" "${clang_packages[@]}"
case "${1:-chosen}" in
    chosen)
        build_preset asan-quick vdb_spheretree
        run_lines
        ;;
    all | threads)
        preset=asan
        if [ "$1" = threads ]; then
            preset=tsan
            use_sanitized_tbb
        fi
        build_preset "$preset"
        find_data
        cd "$project_root"
        ctest --preset "$preset" -j "$(build_jobs)" </dev/null
        ;;
    *)
        sed -n '3,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
        ;;
esac
