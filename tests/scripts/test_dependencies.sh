#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Which packages tests/run.sh installs, and npm among them where nodejs brings none. Programs of a folder stand for apt's
# and CMake's.
set -euo pipefail
run=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../run.sh")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir tools
for tool in bash dirname env id awk nproc ln; do ln -s "$(command -v "$tool")" tools; done
failed=0

# program NAME LINE
program() {
    printf '#!%s\n%s\n' "$BASH" "$2" > "tools/$1"
    chmod +x "tools/$1"
}

program dpkg-query "exit 1" # nothing is installed
program cmake ":"
program ctest ":"
program sudo 'exec "$@"'
# shellcheck disable=SC2016
program apt-get 'case " $* " in
*" update "*) exit ;;
*" npm "*) [ "$NPM" != refused ] || exit 100 ;;
*" nodejs "*) [ "$NPM" != inside ] || ln -s "$BASH" "$FOLDER/tools/npm" ;;
esac
echo "$*" >> "$FOLDER/log"'

# expect NPM COUNT [LAST]: apt has installed COUNT times, lastly, after all else, LAST.
expect() {
    local log
    rm -f tools/npm
    : > log
    FOLDER=$folder NPM=$1 PATH=$folder/tools bash "$run" > said 2>&1 || { echo "$1: exit code $?" >&2 && failed=1; }
    log=$(sed 's/.*--no-install-recommends //' log)
    if [ "$(wc -l <<< "$log")" != "$2" ] || [[ " $(head -n 1 <<< "$log") " != *" nodejs "* ]] ||
        [[ " $(head -n 1 <<< "$log") " == *" npm "* ]] || [ "$(sed -n 2p <<< "$log")" != "${3-}" ]; then
        printf '%s: installed was\n%s\n' "$1" "$log" >&2
        failed=1
    fi
}

expect apart 2 npm # a package of its own, as in Debian
expect inside 1    # of nodejs, which then excludes that package
expect refused 1   # the tests run without it
grep -q "no npm" said || { echo "that npm is missing is not said" >&2 && failed=1; }
exit $failed
