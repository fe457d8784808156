#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the fuzz targets (clang, address and undefined-behaviour sanitizers) and runs them in turn.
#
#   scripts/fuzz.sh MINUTES [TARGET...]    minutes for each target; all of them, or those named:
#                                          vdb vol longvol npy raw nrrd detached nii niigz png pgm stack
#                                          obj off ply stl gltf glb csv json poses bodies points rays config
#                                          line settings text expression
#
# Inputs that found something new are kept in build/asan/fuzz/corpus/TARGET, findings in
# build/asan/fuzz/findings/TARGET. Exit code: 0, or 1 if there are findings. A run goes on after a finding,
# with the time that is left.
set -euo pipefail
# shellcheck source=scripts/dependencies.sh
source "$(dirname "${BASH_SOURCE[0]}")/dependencies.sh"
all_targets=(vdb vol longvol npy raw nrrd detached nii niigz png pgm stack obj off ply stl gltf glb csv
    json poses bodies points rays config line settings text expression)
most_findings=10 # of one target in one run: they are alike, as a rule

usage() {
    sed -n '3,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    exit "$1"
}

# longest_of TARGET: bytes of an input. Samples of .vdb are longer than the others.
longest_of() {
    case "$1" in
    vdb) echo 200000 ;;
    *) echo 4096 ;;
    esac
}

# run_once TARGET SECONDS LOG: true if it ended without a finding.
run_once() {
    local target="$1" corpus="$folder/corpus/$1" findings="$folder/findings/$1" seeds=()
    mkdir -p "$corpus" "$findings"
    for seed in "$folder/seeds/$target" "$project_root/tests/fuzz/seeds/$target"; do
        if [ -d "$seed" ]; then seeds+=("$seed"); fi
    done
    "$programs/spheretree_fuzz_$target" "$corpus" "${seeds[@]}" \
        -max_total_time="$2" -max_len="$(longest_of "$target")" -timeout=20 \
        -rss_limit_mb=2048 -malloc_limit_mb=1024 -print_final_stats=1 \
        -artifact_prefix="$findings/" </dev/null >"$3" 2>&1
}

# run_target TARGET: one line on it; true if it has no finding.
run_target() {
    local target="$1" start="$SECONDS" left number=0 inputs=0 log
    mkdir -p "$folder/logs"
    while left=$((seconds - (SECONDS - start))) && [ "$left" -gt 0 ]; do
        log="$folder/logs/$target.$number.log"
        if run_once "$target" "$left" "$log"; then
            inputs=$((inputs + $(executed "$log")))
            break
        fi
        inputs=$((inputs + $(executed "$log")))
        number=$((number + 1))
        if [ "$number" -ge "$most_findings" ]; then break; fi
    done
    local spent=$((SECONDS - start))
    printf '%-10s %10d inputs in %5d s, %7d a second, %d findings\n' "$target" "$inputs" "$spent" \
        $((inputs / (spent > 0 ? spent : 1))) "$number"
    if [ "$number" -gt 0 ]; then
        echo "  findings: $folder/findings/$target   reports: $folder/logs/$target.*.log"
        return 1
    fi
}

# executed LOG: how many inputs a run has tried.
executed() {
    awk '/^stat::number_of_executed_units:/ { n = $2 } /^#[0-9]+/ { last = substr($1, 2) }
        END { print (n ? n : last) + 0 }' "$1"
}

case "${1:-}" in
-h | --help) usage 0 ;;
'' | *[!0-9]*) usage 2 >&2 ;;
esac
use_sanitizer_options

seconds=$(($1 * 60))
shift
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then targets=("${all_targets[@]}"); fi
for target in "${targets[@]}"; do
    if [[ " ${all_targets[*]} " != *" $target "* ]]; then fail "there is no target '$target'"; fi
done

folder="$project_root/build/asan/fuzz"
programs="$project_root/build/asan/bin"
install_packages "${build_packages[@]}" clang
build_preset asan spheretree_fuzzers
"$programs/spheretree_fuzz_seeds" "$folder/seeds" "$project_root/scripts/sanitizers/lines.txt"
status=0
for target in "${targets[@]}"; do
    run_target "$target" || status=1
done
exit "$status"
