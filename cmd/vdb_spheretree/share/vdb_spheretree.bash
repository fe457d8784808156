# SPDX-License-Identifier: Apache-2.0
# Completion of vdb_spheretree in bash. What there is to complete is what -help of the command itself
# lists, so this never falls behind it.

# Prints the words for the action $1 (without dashes) of the command $2: all actions if it is empty,
# else the options of that action.
_vdb_spheretree_words() {
    local help
    help=$("$2" -help ${1:+"$1"} brief=$([ -n "$1" ] && echo 0 || echo 1) 2> /dev/null) || return
    if [ -z "$1" ]; then
        sed -n 's/^\(-[A-Za-z0-9]*\).*/\1/p' <<< "$help"
    else
        sed -n 's/^    \([a-z_]*=\).*/\1/p' <<< "$help"
    fi
}

# Prints the choices of option $2 of the action $1 of the command $3.
_vdb_spheretree_choices() {
    "$3" -help "$1" 2> /dev/null | tr '\n' ' ' | tr -s ' ' |
        sed -n "s/| /|/g; s/.* $2= \([^=]*\)\[\([a-z0-9|-]*\)\].*/\2/p" | tr '|' '\n'
}

_vdb_spheretree() {
    local line=${COMP_LINE:0:COMP_POINT} action= i word
    word=${line##*[[:space:]]}
    COMPREPLY=()
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case ${COMP_WORDS[i]} in
        -[a-z]*) action=${COMP_WORDS[i]##*-} ;;
        esac
    done
    case $word in
    -*) mapfile -t COMPREPLY < <(compgen -W "$(_vdb_spheretree_words "" "$1")" -- "$word") ;;
    *=*)
        # bash takes '=' for the end of a word, so only what is behind it is completed.
        mapfile -t COMPREPLY < <(compgen -W \
            "$(_vdb_spheretree_choices "$action" "${word%%=*}" "$1")" -- "${word#*=}")
        [ ${#COMPREPLY[@]} -gt 0 ] || mapfile -t COMPREPLY < <(compgen -f -- "${word#*=}")
        ;;
    *)
        [ -z "$action" ] || mapfile -t COMPREPLY < <(compgen -W \
            "$(_vdb_spheretree_words "$action" "$1")" -- "$word")
        case $action in
        help | h) mapfile -t COMPREPLY < <(compgen -W \
            "$(_vdb_spheretree_words "" "$1" | tr -d -)" -- "$word") ;;
        read | i | write | o | config | c | stats | files | each | collide | distance | raycast | contains)
            local files
            mapfile -t files < <(compgen -f -- "$word")
            COMPREPLY+=("${files[@]}")
            ;;
        esac
        ;;
    esac
    case ${COMPREPLY[0]-} in
    *=) compopt -o nospace 2> /dev/null ;;
    esac
}

complete -o filenames -F _vdb_spheretree vdb_spheretree
