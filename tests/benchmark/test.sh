#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The test of run.sh, with a tiny object and no look at the times: test.sh PROGRAM FOLDER
set -euo pipefail
run="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/run.sh"
export SPHERETREE_BENCHMARK="$1"
folder="$2"
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

wrong() { printf 'test.sh: %s\n' "$*" >&2; exit 1; }
# expect CODE TEXT ARGUMENT...: run.sh ends with CODE and says TEXT.
expect() {
    local code="$1" text="$2" rc=0
    shift 2
    "$run" --benchmark_min_time=0 --json=numbers.json "$@" >said.txt 2>&1 || rc=$?
    if [ "$rc" -ne "$code" ]; then cat said.txt; wrong "$* ends with $rc, not $code"; fi
    if ! grep -q -- "$text" said.txt; then cat said.txt; wrong "$* does not say '$text'"; fi
}

expect 0 '% of copy' --objects=gyroid-1000,gyroid-4000
stages=(read-vdb object-mask layout distance distance-int32 distance+power+medial labels-kept topology
    pyramid dag extended errors points write-points read-points take-points)
for stage in "${stages[@]}"; do
    for object in gyroid-1000 gyroid-4000; do
        grep -Eq "^$object +[0-9.]+  ${stage//+/[+]} +1( +[-0-9.]+){4}$" said.txt ||
            { cat said.txt; wrong "no line of $stage of $object"; }
    done
    grep -Eq "^gyroid +${stage//+/[+]} +1 +-?[0-9.]+ +2 " said.txt ||
        { cat said.txt; wrong "no growth of $stage"; }
done

python3 - "${stages[@]}" <<'END'
import json
import sys

numbers = json.load(open("numbers.json", encoding="utf-8"))
assert numbers["machine"]["threads"] >= 1
for stage in sys.argv[1:]:
    rows = [m for m in numbers["measurements"] if m["stage"] == stage and m["threads"] == 1]
    assert [m["object"] for m in rows] == ["gyroid-1000", "gyroid-4000"], stage
    for m in rows:
        assert m["family"] == "gyroid" and m["runs"] >= 1
        assert 900 <= m["voxels"] <= 4400 and m["leaves"] > 1
        assert m["seconds"] > 0 and m["copy_seconds"] > 0
        assert abs(m["of_copy"] * m["seconds"] / m["copy_seconds"] - 1) < 1e-6
        assert m["peak_bytes"] is None or m["peak_bytes"] >= 0
    growth = [g for g in numbers["growth"] if g["stage"] == stage and g["threads"] == 1]
    assert len(growth) == 1 and growth[0]["sizes"] == 2, stage
END

expect 0 'ball-2000 ' --objects=ball-2000 --benchmark_filter=layout/threads:1
if grep -q topology said.txt; then wrong "the filter lets topology pass"; fi
expect 2 "unknown argument '--fast'" --fast
expect 1 "no object 'missing'" --objects=missing
expect 1 'voxels' --objects=gyroid-1
expect 1 'no stage' --objects=ball-2000 --benchmark_filter=nothing
echo "all fine"
