#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The manual page of a command, from its -help: make_man.sh PROGRAM > vdb_spheretree.1
set -eu
version=$("$1" -version)
help=$("$1" -help)
examples=$("$1" -examples)
# A blank line ends the grammar, after which each action has a paragraph: its line at the margin, its
# options indented by four, and what goes on indented by more.
cat << EOF
.TH VDB_SPHERETREE 1 "" "$(echo "$version" | cut -d' ' -f1,2)" "User commands"
.ad l
.SH NAME
vdb_spheretree \- sphere-trees of OpenVDB grids
.SH SYNOPSIS
.B vdb_spheretree
.RI \-action " " [ option=value " ...]"
.RI [ \-action " ...]"
EOF
printf '%s\n' "$help" | awk '
    function roff(text) {
        gsub(/\\/, "\\e", text); gsub(/-/, "\\-", text)
        if (text ~ /^[.'"'"']/) text = "\\&" text
        gsub(/\|/, "|\\:", text)       # a list of choices may be cut behind a bar,
        sub(/\|\\:$/, "|\\:\\c", text) # and goes on in the next line where -help has cut it
        return text
    }
    NR <= 2 { next }
    /^Usage:/ { print ".SH DESCRIPTION"; next }
    /^-/ {
        if (!inActions++) print ".SH ACTIONS"
        split($0, words, " ")
        print ".SS " roff(words[1])
        sub(/^[^ ]+ */, ""); if ($0 != "") print roff($0)
        next
    }
    /^    ([a-z_]+=|\.[a-z])/ {
        split($0, words, " ")
        print ".TP"; print ".B " roff(words[1])
        sub(/^ *[^ ]+ */, ""); if ($0 != "") print roff($0)
        next
    }
    /^$/ { next }
    { sub(/^ +/, ""); print roff($0) }
'
echo '.SH EXAMPLES'
printf '%s\n' "$examples" | awk '
    function roff(text) { gsub(/\\/, "\\e", text); gsub(/-/, "\\-", text); return text }
    /^ / { if (!inCode) { print ".RS"; print ".nf" }; inCode = 1; print roff(substr($0, 3)); next }
    { if (inCode) { print ".fi"; print ".RE" }; inCode = 0; print ".PP"; print roff($0) }
    END { if (inCode) { print ".fi"; print ".RE" } }
'
cat << EOF
.SH VERSION
$version
EOF
