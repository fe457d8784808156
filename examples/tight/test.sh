#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The test of compare.sh, with a small object: test.sh PROGRAM FOLDER
# Exit code 77 (skipped) where there is no matplotlib.
set -euo pipefail
compare="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/compare.sh"
export VDB_SPHERETREE="$1"
folder="$2"
if ! /usr/bin/python3 -c 'import matplotlib' 2>/dev/null; then
    echo "skipped: /usr/bin/python3 has no matplotlib (apt-get install python3-matplotlib)"
    exit 77
fi
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

wrong() { printf 'test.sh: %s\n' "$*" >&2; exit 1; }
# expect CODE TEXT ARGUMENT...: compare.sh ends with CODE and says TEXT.
expect() {
    local code="$1" text="$2" rc=0
    shift 2
    "$compare" "$@" >said.txt 2>&1 || rc=$?
    if [ "$rc" -ne "$code" ]; then cat said.txt; wrong "$* ends with $rc, not $code"; fi
    if ! grep -q -- "$text" said.txt; then cat said.txt; wrong "$* does not say '$text'"; fi
}

# A block with a step, which is no few balls, and a name that means something to the command.
/usr/bin/python3 - 'a,b.vol' <<'END'
import sys
n = 20
data = bytes(2 <= z < (9 if x < 10 else 17) for z in range(n) for y in range(n) for x in range(n))
head = f"X: {n}\nY: {n}\nZ: {n}\nVoxel-Size: 1\nAlpha-Color: 0\nInt-Endian: 0123\n" \
       "Voxel-Endian: 0\nVersion: 2\n.\n"
open(sys.argv[1], "wb").write(head.encode() + data)
END

expect 0 'the curve' --trees alone,normal,fast,extended --spheres 8,4 a,b.vol first/curve
for file in first/curve.{png,svg,csv}; do [ -s "$file" ] || wrong "$file is missing"; done
for kind in alone normal fast; do
    for spheres in 8 4; do
        grep -q "^$kind,$spheres," first/curve.csv || wrong "no $spheres spheres of $kind"
    done
done
expect 0 'the curve' --trees alone,normal,fast,extended --spheres 8,4 a,b.vol again/curve
diff -r first again || wrong "the same input gives another curve"

expect 0 'the curve' --times --trees normal,fast --spheres 8,4 a,b.vol times/curve
[ "$(wc -c <times/curve.png)" -gt "$(wc -c <first/curve.png)" ] || wrong "--times draws no more"

expect 1 'cannot read' missing.vol
expect 2 'OBJECT'
expect 2 'OBJECT' --unknown a,b.vol
expect 2 'OBJECT' --trees oak a,b.vol
expect 2 'OBJECT' --spheres many a,b.vol
echo "all fine"
