#!/usr/bin/env bash
# The completion offers every command and every option of --help, and nothing else. Usage: completion.sh TALUS SOURCE_DIR
set -euo pipefail
talus=$1
# shellcheck source=/dev/null
source "$2/tools/completion/talus.bash"

offered() {  # offered WORD... : what is offered for the last word
    COMP_WORDS=("$talus" "$@")
    COMP_CWORD=$#
    _talus
    printf '%s\n' "${COMPREPLY[@]}" | sort -u
}
# By other means than the completion's: whatever looks like an option at the start of a line.
options_of() { "$talus" "$@" --help | grep -oE '^  -[-a-zA-Z0-9,]+' | tr -d ' ' | tr ',' '\n' | grep -E '^-' | sort -u; }

commands=$("$talus" --help | awk '/^Subcommands:/ { on = 1; next } /^$/ { on = 0 } on && /^  [a-z]/ { print $1 }' | sort)
[ "$(wc -w <<<"$commands")" -ge 6 ]
[ "$(offered '' | grep -v '^-')" = "$commands" ]
[ "$(offered '-')" = "$(options_of)" ]
for command in $commands; do
    [ "$(offered "$command" '-')" = "$(options_of "$command")" ] || { echo "options of $command differ"; exit 1; }
    grep -qx -- --json <<<"$(offered "$command" '--j')"
done
[ "$(offered critical-an)" = critical-angle ]
echo "completion offers $(wc -w <<<"$commands") commands and all their options"
