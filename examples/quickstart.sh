#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a clone to a sphere-tree: installs what is missing, builds a release, and runs it on FILE, or on
# a teapot of its own.
#
#   examples/quickstart.sh [FILE]      FILE: .vdb, .vol, .longvol, or a mesh (.obj .ply .stl ...)
set -euo pipefail
# shellcheck source=scripts/dependencies.sh
source "$(dirname "${BASH_SOURCE[0]}")/../scripts/dependencies.sh"

if [ $# -gt 1 ] || [[ "${1:-}" == -* ]]; then
    printf 'usage: %s [FILE]\n' "$0" >&2
    exit 2
fi
file="${1:-}"
if [ $# -eq 1 ]; then
    if [ ! -f "$file" ] || [ ! -r "$file" ]; then fail "cannot read the file '$file'"; fi
    file="$(cd "$(dirname "$file")" && pwd)/$(basename "$file")"
fi

install_packages "${build_packages[@]}"
build_preset release

bin="$project_root/build/release/bin"
results="$project_root/build/quickstart"
mkdir -p "$results"
if [ -z "$file" ]; then
    file="$results/teapot.obj"
    say "sample object: $file"
    "$bin/teapot" "$file" </dev/null
fi

to_level_set=()
case "${file,,}" in
    *.vdb | *.vol | *.longvol) ;;
    *) to_level_set=(-mesh2ls dim=256) ;;
esac
name="$(basename "$file" | tr ',=' '__')" # a comma or an equals sign means something to the command
name="$results/${name%.*}"

say "running vdb_spheretree"
(set -x && "$bin/vdb_spheretree" -read "$file" "${to_level_set[@]}" \
    -spheretree tree=tight quality=fast -stats \
    -write "$name.spheretree.vdb" "$name.spheretree.csv" </dev/null)

printf '\nThe sphere-tree of %s:\n  %s   VDB points\n  %s   table\nThe program: %s\n' \
    "$file" "$name.spheretree.vdb" "$name.spheretree.csv" "$bin/vdb_spheretree"
