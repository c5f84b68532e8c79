#!/usr/bin/env bash
# What must not change unawares, of the scenarios in tests/determinism/answers.csv: exit code, state hash and steps of a
# run; exit code, status and bracket of a search.
#   tests/scripts/answers.sh PROGRAM SOURCE_DIR            compares, exit code 1 when one differs
#   tests/scripts/answers.sh PROGRAM SOURCE_DIR --write    writes the list anew: say in the commit what changed and why
# A hash is one of positions, velocities and contact forces: the same binary gives it on any x86-64, with any threads.
# A bracket is the same when it contains the one in the list, or its ends are within 0.2 % of it.
set -euo pipefail
program=$1
cd "$2"
list=tests/determinism/answers.csv
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# COMMAND,SCENARIO -> exit code,state hash,answer
answer() {
    local command=("$1" "$2" --json --quiet --threads 1) code=0 json
    [ "$1" = run ] && command+=(-o "$scratch/history.csv" --force)
    [ "$1" = run ] || command+=(--no-interval --no-upper-bound)
    json=$("$program" "${command[@]}" </dev/null 2>/dev/null | tr -d '\n') || code=$?
    field() { grep -oE "\"$1\": *[^,}]*" <<<"$json" | head -n 1 | sed 's/^[^:]*: *//; s/"//g'; }
    if [ "$1" = run ]; then
        printf '%s,%s,%s steps\n' "$code" "$(field state_hash)" "$(field steps)"
    else
        local bracket
        bracket=$(grep -oE '"bracket(_deg)?": *\[[^]]*\]' <<<"$json" | head -n 1 | sed 's/.*\[ *//; s/ *\]//; s/, */ /')
        printf '%s,,%s %s\n' "$code" "$(field status)" "$bracket"
    fi
}

# Two answers of a search, "STATUS LOW HIGH" -> whether they are the same
same_bracket() {
    awk -v was="$1" -v is="$2" '
        function close_to(a, b, width) { return a == b || (a != "null" && b != "null" && (a - b) ^ 2 <= width ^ 2) }
        BEGIN {
            split(was, w, " "); split(is, i, " ")
            if (w[1] != i[1]) exit 1
            if (w[2] == "null" || w[3] == "null") width = 0.002 * (w[2] == "null" ? w[3] : w[2])
            else width = 0.001 * (w[2] + w[3])
            contains = w[2] != "null" && w[3] != "null" && i[2] <= w[2] && i[3] >= w[3]
            exit !(contains || (close_to(w[2], i[2], width) && close_to(w[3], i[3], width)))
        }'
}

differ=0 count=0
while IFS=, read -r command scenario code hash expected; do
    [ "$command" = command ] && { echo "$command,$scenario,$code,$hash,$expected" >"$scratch/list"; continue; }
    found=$(answer "$command" "$scenario")
    echo "$command,$scenario,$found" >>"$scratch/list"
    count=$((count + 1))
    [ "$found" = "$code,$hash,$expected" ] && continue
    [ "$command" != run ] && [ "${found%%,*}" = "$code" ] && same_bracket "$expected" "${found##*,}" && continue
    differ=$((differ + 1))
    printf '%s %s: was %s, is %s\n' "$command" "$scenario" "$code,$hash,$expected" "$found"
done <"$list"
[ "${3-}" = --write ] && cp "$scratch/list" "$list"
echo "$count answers, $differ differ"
[ "$differ" -eq 0 ] || [ "${3-}" = --write ]
