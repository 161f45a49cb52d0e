#!/usr/bin/env bash
# Whether the hardening of a release build took effect: check.sh SPINCAT [MPI-PLUGIN ...]
set -euo pipefail

command -v readelf > /dev/null || { echo "skipped: there is no readelf (Debian: binutils)"; exit 77; }
failures=0

# expect FILE WHAT PATTERN READELF-OPTIONS...: the pattern is in readelf's output.
expect() {
  local file=$1 what=$2 pattern=$3
  shift 3
  # Counted, and not -q: readelf would end by a closed pipe.
  if [ "$(readelf --wide "$@" "$file" 2> /dev/null | grep -Ec -- "$pattern")" != 0 ]; then
    echo "ok      $(basename "$file"): $what"
  else
    echo "MISSING $(basename "$file"): $what"
    failures=$((failures + 1))
  fi
}

for file in "$@"; do
  expect "$file" "position-independent" 'Type:[[:space:]]+DYN' --file-header
  expect "$file" "tables of addresses are read-only" 'GNU_RELRO' --program-headers
  expect "$file" "all addresses are found at the start" 'BIND_NOW|FLAGS_1.*NOW' --dynamic
  expect "$file" "the stack holds no code" 'GNU_STACK.*RW[[:space:]]' --program-headers
  expect "$file" "protected stacks" '__stack_chk_fail' --dyn-syms
done
expect "$1" "a program" 'FLAGS_1.*PIE' --dynamic
expect "$1" "checked copies" '__[a-z]+_chk(@|$)' --dyn-syms
if [ "$(uname -m)" = x86_64 ]; then
  # Libraries without the mark take it from the whole program, so the code itself is looked at.
  jumps=$(objdump -d --no-show-raw-insn "$1" | grep -c 'endbr64' || true)
  functions=$(readelf --wide --syms "$1" 2> /dev/null | grep -c ' FUNC ' || true)
  echo "        $(basename "$1"): $jumps marked targets of jumps, $functions named functions"
  [ "$jumps" -gt 1000 ] || { echo "MISSING $(basename "$1"): marked targets of jumps"; failures=$((failures + 1)); }
  # A frame of several pages is taken page by page, and each page is touched: nothing else does that.
  probes=$(objdump -d --no-show-raw-insn "$1" | grep -A 1 -E 'sub +\$0x1000,%rsp' | grep -cE 'orq? +\$0x0,\(%rsp\)' || true)
  echo "        $(basename "$1"): $probes places where large frames of the stack are touched page by page"
  [ "$probes" -gt 0 ] || { echo "MISSING $(basename "$1"): large frames that cannot jump over a guard page"; failures=$((failures + 1)); }
fi
exit $((failures > 0))
