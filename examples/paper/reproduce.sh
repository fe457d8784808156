#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Redraws the experiments of the paper (A. Broutta, D. Coeurjolly, I. Sivignon, "Hierarchical
# Discrete Medial Axis for Sphere-Tree Construction", IWCIA 2009) for volumes of your own:
# Figure 5, Figure 6, and a page that says where the paper's claims hold.
#
#   examples/paper/reproduce.sh [--up X,Y,Z] [--size PIXELS] DIR [OUTPUT]
#
#   DIR        a folder of .vol, .longvol and .vdb files, or one such file
#   OUTPUT     a folder to make, or to make anew (build/paper)
#   --up       the direction that stands upright in pictures (0,0,1)
#   --size     pixels a side of each picture (480)
#
# The program is built first, unless the variable VDB_SPHERETREE names one.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# shellcheck source=scripts/dependencies.sh
source "$here/../../scripts/dependencies.sh"
factors=(2 3 4)
up=0,0,1
size=480

usage() {
    sed -n '6,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit "$1"
}

parse_arguments() {
    local number='-?([0-9]+\.?[0-9]*|\.[0-9]+)'
    while [[ "${1:-}" == -* ]]; do
        case "$1" in
            -h | --help) usage 0 ;;
            --up | --size) if [ $# -lt 2 ]; then usage 2; fi ;;
            *) usage 2 ;;
        esac
        if [ "$1" = --up ]; then up="$2"; else size="$2"; fi
        shift 2
    done
    if [ $# -lt 1 ] || [ $# -gt 2 ] || [ -z "$1" ] || [[ "${2:-}" == -* ]]; then usage 2; fi
    if ! [[ "$up" =~ ^$number,$number,$number$ ]] || [[ ! "$up" =~ [1-9] ]]; then usage 2; fi
    if ! [[ "$size" =~ ^[1-9][0-9]{1,3}$ ]]; then usage 2; fi
    source_path="$1"
    output="${2:-$project_root/build/paper}"
}

# The volumes, the smallest file first: files[].
find_volumes() {
    files=()
    if [ -f "$source_path" ] && [ -r "$source_path" ]; then
        files=("$(cd "$(dirname "$source_path")" && pwd)/$(basename "$source_path")")
        return
    fi
    if [ ! -d "$source_path" ] || [ ! -r "$source_path" ]; then
        fail "cannot read '$source_path'"
    fi
    local folder entry
    folder="$(cd "$source_path" && pwd)"
    while IFS= read -r -d '' entry; do
        files+=("${entry#* }")
    done < <(find "$folder" -maxdepth 1 -xtype f \
        \( -iname '*.vol' -o -iname '*.longvol' -o -iname '*.vdb' \) -printf '%s ' -print0 |
        LC_ALL=C sort -z -n)
    if [ ${#files[@]} -eq 0 ]; then
        fail "no .vol, .longvol or .vdb file in '$source_path'"
    fi
}

# Only a page of our own is ever replaced.
check_output() {
    if [ -e "$output" ] && [ ! -d "$output" ]; then fail "'$output' is not a folder"; fi
    if [ -d "$output" ] && [ -n "$(ls -A "$output")" ] &&
        ! grep -qs 'name="generator" content="reproduce.sh"' "$output/index.html"; then
        fail "'$output' holds something else: name another folder, or empty it"
    fi
    output="$(realpath -m -- "$output")"
    mkdir -p "$(dirname "$output")"
}

prepare_programs() {
    prepare_drawing
    if ! program="$(command -v "$program")"; then
        fail "VDB_SPHERETREE: '$VDB_SPHERETREE' is not a program"
    fi
    program="$(cd "$(dirname "$program")" && pwd)/$(basename "$program")"
}

run() { "$program" -quiet "$@" </dev/null >&2; }

# A name for a folder, and for the command, to which commas and more mean something.
name_of() {
    local stem="${1##*/}" name number=2
    stem="${stem%.*}"
    name="${stem//[^A-Za-z0-9._-]/_}"
    name="${name/#[.-]/_}"
    stem="$name"
    while [ -e "$work/page/$name" ]; do
        name="$stem-$number"
        number=$((number + 1))
    done
    printf '%s\n' "$name"
}

# build_trees VOLUME STATS: nine trees, each checked against its object.
build_trees() {
    local factor kind settings rc
    for factor in "${factors[@]}"; do
        for kind in reversible paper extended; do
            case "$kind" in
                reversible) settings=(tree=reversible scale=tight) ;;
                paper) settings=(tree=reversible scale=paper) ;;
                extended) settings=(tree=extended) ;;
            esac
            local tree="$work/trees/$kind-$factor"
            rc=0
            run -read "$1" -spheretree "${settings[@]}" "factor=$factor" padding=voxels topology=0 \
                -check -stats "json=$2/$kind-$factor.json" -write "$tree.vdb" "$tree.csv" || rc=$?
            case "$rc" in
                0) ;;
                3 | 137) return "$rc" ;; # refused: damaged, or too large for this machine
                6) fail "$1: the $kind tree with f = $factor is wrong; please report it" ;;
                *) fail "$1: the $kind tree with f = $factor could not be made" ;;
            esac
        done
    done
}

# draw_pictures VOLUME FOLDER STATS: the object, and every level of two trees, from the same
# direction.
draw_pictures() {
    local kind level eye lookat pictures
    local common=("up=$up" "width=$size" "height=$size" keep=1)
    "${python[@]}" "$here/camera.py" "$work/trees/reversible-2.csv" "$work/trees/extended-2.csv" \
        "$3/reversible-2.json" "$up" >"$3/cameras.txt"
    while read -r level _ eye lookat; do
        if [ "$level" -eq 0 ]; then
            run -read "$1" -write "$2/object.png" "eye=$eye" "lookat=$lookat" "${common[@]}"
        fi
    done <"$3/cameras.txt"
    for kind in reversible extended; do
        pictures=()
        while read -r level _ eye lookat; do
            if ! grep -q "^$level," "$work/trees/$kind-2.csv"; then continue; fi
            pictures+=(-write "$2/$kind-level$level.png" "level=$level" color=parent "eye=$eye"
                "lookat=$lookat" "${common[@]}")
        done <"$3/cameras.txt"
        run -read "$work/trees/$kind-2.vdb" "${pictures[@]}"
    done
}

process() {
    local name folder stats link
    name="$(name_of "$1")"
    folder="$work/page/$name"
    stats="$work/stats/$name"
    say "$name: nine trees"
    link="$work/$name.${1##*.}"
    ln -s "$1" "$link"
    mkdir "$folder" "$stats"
    if ! build_trees "$link" "$stats"; then
        say "$name is left out: the program refused it"
        rm -r "$folder" "$stats"
        left_out+=("${1##*/}")
        return
    fi
    say "$name: pictures"
    draw_pictures "$link" "$folder" "$stats"
    names+=("$name")
}

publish() {
    chmod "$(printf '%o' $((0777 & ~$(umask))))" "$work/page"
    trap '' INT TERM
    if [ -d "$output" ]; then mv "$output" "$work/old"; fi
    if mv "$work/page" "$output"; then return; fi
    if [ -d "$work/old" ]; then mv "$work/old" "$output"; fi
    fail "cannot write '$output'"
}

parse_arguments "$@"
find_volumes
check_output
prepare_programs

work="$(mktemp -d "$(dirname "$output")/.paper.XXXXXX")"
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
mkdir "$work/page" "$work/stats" "$work/trees"
say "${#files[@]} volume(s), the smallest file first"
names=()
left_out=()
for file in "${files[@]}"; do process "$file"; done
if [ ${#names[@]} -eq 0 ]; then fail "the program refused every volume"; fi

say "figures and pages"
export MPLCONFIGDIR="$work/matplotlib" # no files in a home folder
mkdir "$MPLCONFIGDIR"
"${python[@]}" "$here/figures.py" "$work/page" "$work/stats" "${names[@]}"
"${python[@]}" "$here/pages.py" "$work/page" "$work/stats" "${names[@]}" -- "${left_out[@]}"
publish
printf '\nThe figures, and what became of the claims:\n  %s/index.html\n  %s/summary.md\n' \
    "$output" "$output"
if [ ${#left_out[@]} -gt 0 ]; then fail "left out: ${left_out[*]}"; fi
