#!/usr/bin/env bash
# Whether a program of a release build is hardened: `hardening.sh PROGRAM`. Position-independent, tables of the loader
# read-only once it has bound everything, no executable stack, canaries, checked copies, landing pads at its functions.
set -euo pipefail
program=$1
fail() { echo "$program: $1" >&2; exit 1; }
has() { grep -q "$2" <<<"$1"; }

header=$(readelf -hW "$program") segments=$(readelf -lW "$program") dynamic=$(readelf -dW "$program")
symbols=$(readelf --dyn-syms -W "$program")
has "$header" "Type: *DYN" || fail "is not position-independent"
has "$segments" "GNU_RELRO" || fail "has tables of the loader that stay writable"
has "$dynamic" "BIND_NOW\|Flags:.*NOW" || fail "binds functions late"
has "$segments" "GNU_STACK.* RW " || fail "has an executable stack"
has "$symbols" "__stack_chk_fail" || fail "has no canaries"
has "$symbols" "_chk@\|_chk " || fail "has no checked copies"
landings=$(objdump -d --no-show-raw-insn "$program" | grep -c endbr64 || true)
[ "$landings" -gt 1000 ] || fail "has $landings landing pads, expected one at each function that is called by address"
echo "$program: hardened, $landings landing pads"
