#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The completion and the manual page know every action and option of -help: test_share.sh FOLDER PROGRAM
set -euo pipefail
share=$(realpath "$1") program=$(realpath "$2")
# shellcheck source=/dev/null
source "$share/vdb_spheretree.bash"
failed=0

fail() {
    echo "$1" >&2
    failed=1
}

# What is offered after the words of a line, the last of them begun.
offered() {
    COMP_LINE="vdb_spheretree $1"
    COMP_POINT=${#COMP_LINE}
    # As bash does it, '=' ends a word.
    read -ra COMP_WORDS <<< "${COMP_LINE//=/ = }"
    [[ $COMP_LINE == *" " ]] && COMP_WORDS+=("")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    COMPREPLY=()
    _vdb_spheretree "$program" "${COMP_WORDS[COMP_CWORD]}" ""
    echo "${COMPREPLY[*]}"
}

expect() {
    local line=$1 words=$2 got
    got=$(offered "$line")
    [ "$got" = "$words" ] || fail "after '$line': '$got' and not '$words'"
}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
touch apple.vdb
expect "-spheret" "-spheretree"
expect "-read apple.vdb -spheretree qual" "quality="
expect "-read apple.vdb -spheretree quality=" "normal fast best"
expect "-read apple.vdb -spheretree quality=f" "fast"
expect "-read apple.vdb -spheretree side=i" "inner"
expect "-read app" "apple.vdb"
expect "-write fov" "fov="
expect "-write a.ply format=ply" "ply ply-ascii"
expect "-help spheretr" "spheretree"
expect "-read apple.vdb -spheretree padding=" "apple.vdb" # no choices: anything
actions=$("$program" -help brief=1 | grep -o '^-[a-z0-9]*')
[ "$(offered "-" | tr ' ' '\n')" = "$actions" ] || fail "not all actions are offered"

# The same questions to zsh, whose own functions for offering words are replaced by ones that print them.
if command -v zsh > /dev/null; then
    in_zsh() {
        zsh -fc 'compadd() { [ "$1" != -S ] || shift 2; [ "$1" != -- ] || shift; print -rn -- "$* " }
            compset() { : }; _files() { print -rn -- FILES }
            program=$1 line=$2; shift 2
            words=("$program" ${(s: :)line}); [[ $line == *" " ]] && words+=("")
            CURRENT=$#words PREFIX=${words[-1]}
            source '"$share/vdb_spheretree.zsh"'' zsh "$program" "$1"
    }
    expect_in_zsh() {
        local got
        got=" $(in_zsh "$1") "
        [[ $got == *" $2 "* ]] || fail "zsh, after '$1': '$got' lacks '$2'"
    }
    expect_in_zsh "-sphe" "-spheretree"
    expect_in_zsh "-read apple.vdb -spheretree qual" "quality="
    expect_in_zsh "-read apple.vdb -spheretree quality=" "normal fast best"
    expect_in_zsh "-read app" "FILES"
    expect_in_zsh "-help sph" "spheretree"
fi

# Which actions take files: these, as both shells know. (A program that lists no options leaves the files alone.)
takes_files=" read i write o config c stats files each collide distance raycast contains "
for action in ${actions//-/} i o c; do
    files=
    [[ $takes_files != *" $action "* ]] || files=apple.vdb
    program=true expect "-$action app" "$files"
    if command -v zsh > /dev/null; then
        got=$(program=true in_zsh "-$action app")
        [[ "${files:+FILES}" == "${got// /}" ]] || fail "zsh, after '-$action app': '$got', where bash offers '$files'"
    fi
done

page=$("$share/make_man.sh" "$program")
for action in $actions; do
    grep -q "^\.SS \\\\$action" <<< "$page" || fail "the page lacks $action"
    for option in $("$program" -help "${action#-}" | sed -n 's/^    \([a-z_]*=\).*/\1/p'); do
        grep -q "^\.B $option\$" <<< "$page" || fail "the page lacks $option"
    done
done
if command -v groff > /dev/null; then
    warnings=$(groff -man -Tascii -P-cbou -ww <<< "$page" 2>&1 > text)
    [ -z "$warnings" ] || fail "groff: $warnings"
    grep -q "quality=" text || fail "the page loses quality="
fi
exit $failed
