#!/usr/bin/env bash
# What must not change unawares: exit code, state hash and answer of the scenarios in tests/determinism/answers.csv.
#   tests/scripts/answers.sh PROGRAM SOURCE_DIR            compares, exit code 1 when one differs
#   tests/scripts/answers.sh PROGRAM SOURCE_DIR --write    writes the list anew: say in the commit what changed and why
# A hash is one of positions, velocities and contact forces: the same binary gives it on any x86-64, with any threads.
set -euo pipefail
program=$1
cd "$2"
list=tests/determinism/answers.csv
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# COMMAND,SCENARIO -> exit code,state hash,answer
answer() {
    local out=() code=0 json
    [ "$1" = run ] && out=(-o "$scratch/history.csv" --force)
    json=$("$program" "$1" "$2" "${out[@]}" --json --quiet --threads 1 </dev/null 2>/dev/null) || code=$?
    field() { grep -oE "\"$1\": *[^,}]*" <<<"$json" | head -n 1 | sed 's/^[^:]*: *//; s/"//g'; }
    local figure
    case $1 in
        critical-angle) figure="$(field status) $(field critical_angle_deg)" ;;
        safety-factor) figure="$(field status) $(field safety_factor)" ;;
        *) figure="$(field steps) steps" ;;
    esac
    printf '%s,%s,%s\n' "$code" "$(field state_hash)" "$figure"
}

differ=0 count=0
while IFS=, read -r command scenario expected; do
    [ "$command" = command ] && { echo "$command,$scenario,$expected" >"$scratch/list"; continue; }
    found=$(answer "$command" "$scenario")
    echo "$command,$scenario,$found" >>"$scratch/list"
    count=$((count + 1))
    [ "$found" = "$expected" ] && continue
    differ=$((differ + 1))
    printf '%s %s: was %s, is %s\n' "$command" "$scenario" "$expected" "$found"
done <"$list"
[ "${3-}" = --write ] && cp "$scratch/list" "$list"
echo "$count answers, $differ differ"
[ "$differ" -eq 0 ] || [ "${3-}" = --write ]
