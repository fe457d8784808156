#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The test of reproduce.sh, with small volumes and pictures: test.sh PROGRAM FOLDER
# Exit code 77 (skipped) where there is no matplotlib.
set -euo pipefail
reproduce="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/reproduce.sh"
export VDB_SPHERETREE="$1"
folder="$2"
if ! /usr/bin/python3 -c 'import matplotlib' 2>/dev/null; then
    echo "skipped: /usr/bin/python3 has no matplotlib (apt-get install python3-matplotlib)"
    exit 77
fi
rm -rf "$folder"
mkdir -p "$folder/volumes" "$folder/none" "$folder/mine"
cd "$folder"

wrong() { printf 'test.sh: %s\n' "$*" >&2; exit 1; }
# expect CODE TEXT ARGUMENT...: reproduce.sh ends with CODE and says TEXT.
expect() {
    local code="$1" text="$2" rc=0
    shift 2
    "$reproduce" "$@" >said.txt 2>&1 || rc=$?
    if [ "$rc" -ne "$code" ]; then cat said.txt; wrong "$* ends with $rc, not $code"; fi
    if ! grep -q -- "$text" said.txt; then cat said.txt; wrong "$* does not say '$text'"; fi
}

# A ball with an arm in 16^3 voxels, and a name that means something to the command.
/usr/bin/python3 - 'volumes/a, b=c.vol' <<'END'
import sys
n = 16
inside = lambda x, y, z: (x - 6) ** 2 + (y - 7) ** 2 + (z - 8) ** 2 < 30 or (y == 7 and 7 < z < 10)
data = bytes(inside(x, y, z) for z in range(n) for y in range(n) for x in range(n))
head = f"X: {n}\nY: {n}\nZ: {n}\nVoxel-Size: 1\nAlpha-Color: 0\nInt-Endian: 0123\n" \
       "Voxel-Endian: 0\nVersion: 2\n.\n"
open(sys.argv[1], "wb").write(head.encode() + data)
END

expect 0 'The figures' --size 24 volumes page
for file in index.html summary.md a__b_c/{figure5,tradeoff}.{svg,png} \
    a__b_c/{figure6,object}.png; do
    [ -s "page/$file" ] || wrong "$file is missing"
done
/usr/bin/python3 - page/index.html page/summary.md <<'END'
import pathlib, re, sys
for page in map(pathlib.Path, sys.argv[1:]):
    links = re.findall(r'(?:href|src)="([^"]*)"|\]\(([^)]*)\)', page.read_text(encoding="utf-8"))
    links = [a or b for a, b in links]
    broken = [link for link in links if not (page.parent / link).is_file()]
    if len(links) < 10 or broken:
        sys.exit(f"{page}: {len(links)} links, of which lead nowhere: {broken}")
END
grep -q "<td>fewer levels<" page/index.html || wrong "no verdicts"

cp -r page first
cp 'volumes/a, b=c.vol' volumes/a__b_c.vol # would have the same folder
printf 'no volume' >volumes/broken.vol
expect 1 'left out: broken.vol' --size 24 --up 0,1,0 volumes page
[ -s page/a__b_c-2/figure6.png ] || wrong "the second volume of one name is missing"
grep -q 'broken.vol' page/index.html || wrong "the page does not say what is left out"
expect 0 'The figures' --size 24 'volumes/a, b=c.vol' page
diff -r first page || wrong "the same input gives another page"

expect 1 'the program refused every volume' volumes/broken.vol page
expect 1 'no .vol, .longvol or .vdb file' none page
expect 1 'cannot read' missing page
touch mine/precious
expect 1 'holds something else' volumes mine
expect 2 'DIR' --unknown volumes page
expect 2 'DIR'
expect 2 'DIR' --up 0,0,0 volumes page
expect 2 'DIR' --size big volumes page
VDB_SPHERETREE=/missing/program expect 1 'is not a program' volumes other
diff -r first page || wrong "a failure has touched the page"
[ "$(find . -maxdepth 1 -name '.paper*' | wc -l)" -eq 0 ] || wrong "temporary files are left"
[ ! -e other ] || wrong "a failure has left something"
[ -e mine/precious ] || wrong "a failure has taken something"
echo "all fine"
