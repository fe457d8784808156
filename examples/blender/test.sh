#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Opens a small tree in Blender, and counts what it draws: test.sh PROGRAM FOLDER. Exit code 77: no Blender here.
set -euo pipefail
program="$(realpath "$1")"
folder="$2"
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
if ! command -v blender >/dev/null; then
    echo "no Blender here (Debian: apt-get install blender)"
    exit 77
fi
mkdir -p "$folder"
cd "$folder"
rm -f picture.png
"$program" -quiet -generate menger voxels=8000 -spheretree spheres=200,30,4,1 quality=fast -write tree.csv
blender -b -noaudio --factory-startup --python "$here/test_import.py" -- tree.csv "$PWD/picture.png" \
    >blender.txt 2>&1 </dev/null || { cat blender.txt >&2; exit 1; }
grep -q "all spheres are there" blender.txt || { cat blender.txt >&2; exit 1; }
test -s picture.png
# A file that is none is an error of its own, and Blender's exit code says so.
if blender -b -noaudio --factory-startup --python "$here/import_spheretree.py" -- "$here/test.sh" \
    >wrong.txt 2>&1 </dev/null; then
    echo "a file that is no table was taken" >&2
    exit 1
fi
grep -q "no table of a sphere-tree" wrong.txt
