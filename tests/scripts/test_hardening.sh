#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Says which guards of SPHERETREE_HARDENING a built program lacks.
#
#   test_hardening.sh PROGRAM
set -euo pipefail
program="$1"
headers="$(readelf --wide --file-header --program-headers --dynamic "$program")"
symbols="$(readelf --wide --dyn-syms "$program")"
missing=0

# expect TEXT PATTERN WHAT
expect() {
    if ! grep --quiet --extended-regexp "$2" <<<"$1"; then
        echo "$program: $3 is missing" >&2
        missing=1
    fi
}

expect "$headers" 'Type: +DYN ' "a position-independent executable"
expect "$headers" 'FLAGS_1.*\bPIE\b' "the mark of an executable, not a library"
expect "$headers" 'GNU_RELRO' "read-only relocations"
expect "$headers" 'FLAGS.*\bBIND_NOW\b|FLAGS_1.*\bNOW\b' "relocation at start, without which RELRO is partial"
expect "$symbols" '__stack_chk_fail' "the stack protector"
expect "$symbols" '__[a-z]+_chk@' "a checked call of the C library"
if grep --quiet --extended-regexp 'GNU_STACK.* RWE ' <<<"$headers"; then
    echo "$program: its stack is executable" >&2
    missing=1
fi
exit "$missing"
