# Bash completion of talus. What can be completed is read from `talus --help` and `talus COMMAND --help` each time, so
# it is never behind the program. Installed as share/bash-completion/completions/talus; by hand: source this file.

# Commands (without an argument) or options of a command, one a line.
_talus_words() {
    if [ $# -eq 1 ]; then
        "$1" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p'
        set -- "$1" ""
    fi
    "$1" ${2:+"$2"} --help 2>/dev/null | sed -n '/^Options:/,/^$/s/^  \(-[^ ]*\).*/\1/p' | tr ',' '\n'
}

_talus() {
    local program=${COMP_WORDS[0]} current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_talus_words "$program")" -- "$current")
        return
    fi
    case $previous in
        -o | --output | --out | --stereonet) mapfile -t COMPREPLY < <(compgen -f -- "$current"); return ;;
        --points) mapfile -t COMPREPLY < <(compgen -W "vertex quarter corner" -- "$current"); return ;;
        --net) mapfile -t COMPREPLY < <(compgen -W "equal-area equal-angle" -- "$current"); return ;;
        --contours) mapfile -t COMPREPLY < <(compgen -W "fisher circle none" -- "$current"); return ;;
        --view)
            [ "${COMP_WORDS[1]}" = kinematics ] && mapfile -t COMPREPLY < <(compgen -W "poles intersections" -- "$current")
            return ;;
    esac
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_talus_words "$program" "${COMP_WORDS[1]}")" -- "$current")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
    fi
}

complete -o filenames -F _talus talus
