#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How many spheres for which error? Builds trees of every kind of one object, and draws their Hamming
# errors against the numbers of their spheres.
#
#   examples/tight/compare.sh [--trees KIND,...] [--spheres N,...] [--times] OBJECT [OUTPUT]
#
#   OBJECT     a .vol, .longvol or .vdb file
#   OUTPUT     the start of the names of the files to make: OUTPUT.png, .svg and .csv
#              (build/tight/NAME)
#   --trees    of alone, best, normal, fast, miniball, extended, reversible (all). alone: quality=best,
#              with a tree for each number of spheres; this one and best take minutes
#   --spheres  of the levels of tight trees, falling (512,256,128,64,32,16,8)
#   --times    draw what the trees took, too: seconds against the mean of the levels' errors
#
# The program is built first, unless the variable VDB_SPHERETREE names one.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# shellcheck source=scripts/dependencies.sh
source "$here/../../scripts/dependencies.sh"
trees=alone,best,normal,fast,miniball,extended,reversible
spheres=512,256,128,64,32,16,8
times=()

usage() {
    sed -n '6,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit "$1"
}

parse_arguments() {
    while [[ "${1:-}" == -* ]]; do
        case "$1" in
            -h | --help) usage 0 ;;
            --times)
                times=(--times)
                shift
                continue
                ;;
            --trees | --spheres) if [ $# -lt 2 ]; then usage 2; fi ;;
            *) usage 2 ;;
        esac
        if [ "$1" = --trees ]; then trees="$2"; else spheres="$2"; fi
        shift 2
    done
    if [ $# -lt 1 ] || [ $# -gt 2 ] || [ -z "$1" ]; then usage 2; fi
    if ! [[ "$trees" =~ ^[a-z]+(,[a-z]+)*$ && "$spheres" =~ ^[0-9]+(,[0-9]+)*$ ]]; then usage 2; fi
    object="$1"
    if [ ! -f "$object" ] || [ ! -r "$object" ]; then fail "cannot read '$object'"; fi
    name="${object##*/}"
    name="${name%.*}"
    output="$(realpath -m -- "${2:-$project_root/build/tight/$name}")"
}

# settings_of KIND SPHERES: the options of -spheretree that make a kind of tree: settings[].
settings_of() {
    case "$1" in
        alone) settings=(tree=tight quality=best "spheres=$2") ;;
        fast | normal | best) settings=(tree=tight "quality=$1" "spheres=$2") ;;
        miniball) settings=(tree=extended center=miniball) ;;
        extended | reversible) settings=("tree=$1") ;;
        *) usage 2 ;;
    esac
}

parse_arguments "$@"
IFS=, read -r -a kinds <<<"$trees"
for kind in "${kinds[@]}"; do settings_of "$kind" "$spheres"; done
prepare_drawing
mkdir -p "$(dirname "$output")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
ln -s "$(realpath -- "$object")" "$work/object.${object##*.}" # commas mean something to the command

for kind in "${kinds[@]}"; do
    say "$name: $kind"
    counts=("$spheres")
    if [ "$kind" = alone ]; then IFS=, read -r -a counts <<<"$spheres"; fi
    for count in "${counts[@]}"; do
        settings_of "$kind" "$count"
        "$program" -quiet -read "$work/object.${object##*.}" -spheretree "${settings[@]}" topology=0 \
            -stats "json=$work/$kind.$count.json" </dev/null >&2
    done
done
"${python[@]}" "$here/curve.py" "${times[@]}" "$name" "$output" "$work" "${kinds[@]}"
say "the curve: $output.png, .svg and .csv"
