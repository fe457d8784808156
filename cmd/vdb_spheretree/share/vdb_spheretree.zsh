#compdef vdb_spheretree
# SPDX-License-Identifier: Apache-2.0
# Completion of vdb_spheretree in zsh. What there is to complete is what -help of the command itself lists, so
# this never falls behind it.

local program=$words[1] action= word name
for word in ${words[2,CURRENT-1]}; do
    [[ $word == -[a-z]* ]] && action=${word##*-}
done

case $PREFIX in
-*)
    compadd -- ${(f)"$($program -help brief=1 2> /dev/null | sed -n 's/^\(-[A-Za-z0-9]*\).*/\1/p')"}
    ;;
*=*)
    name=${PREFIX%%=*}
    local -a choices
    choices=(${(s:|:)"$($program -help $action 2> /dev/null | tr '\n' ' ' | tr -s ' ' |
        sed -n "s/| /|/g; s/.* $name= \([^=]*\)\[\([a-z0-9|-]*\)\].*/\2/p")"})
    compset -P '*='
    if (( $#choices )); then compadd -- $choices; else _files; fi
    ;;
*)
    case $action in
    help | h)
        compadd -- ${(f)"$($program -help brief=1 2> /dev/null | sed -n 's/^-\([A-Za-z0-9]*\).*/\1/p')"}
        ;;
    ?*)
        compadd -S '' -- ${(f)"$($program -help $action 2> /dev/null | sed -n 's/^    \([a-z_]*=\).*/\1/p')"}
        ;;
    esac
    case $action in
    read | i | write | o | config | c | stats | files | each | collide | distance | raycast | contains) _files ;;
    esac
    ;;
esac
