#!/usr/bin/env bash
# Guards a renderer: compares every capture or image of one folder with that of the same name in another.
#   guard.sh GOLDEN NEW OUT [OPTION...]      options are those of `strata diff`
# For a.strata (or a.exr, a.png) OUT gets a.strata.xml (JUnit) and, where it differs, a.strata.html (what differs, with pictures).
# Exit code: 0 all pass, 1 one does not, 2 one is missing, new or cannot be compared. STRATA names the program.
set -euo pipefail

[ $# -ge 3 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
strata=${STRATA:-strata} golden=$1 new=$2 out=$3
shift 3
mkdir -p "$out"
shopt -s nullglob

code=0 compared=0
# tell WORST NAME WORDS
tell() {
    printf '%-40s %s\n' "$2" "$3"
    [ "$1" -le "$code" ] || code=$1
}

for file in "$golden"/*.strata "$golden"/*.exr "$golden"/*.png; do
    name=${file##*/}
    page=$out/$name.html
    if [ ! -e "$new/$name" ]; then
        tell 2 "$name" "missing in $new"
        continue
    fi
    compared=$((compared + 1)) result=0
    "$strata" diff "$file" "$new/$name" --junit "$out/$name.xml" -o "$page" "$@" >"$out/$name.txt" 2>"$out/$name.err" || result=$?
    case $result in
        0) rm -f "$page"; tell 0 "$name" "passes" ;;
        1) tell 1 "$name" "$(tail -n 1 "$out/$name.err"); see $page" ;;
        *) tell 2 "$name" "exit code $result: $(tail -n 1 "$out/$name.err")" ;;
    esac
done
for file in "$new"/*.strata "$new"/*.exr "$new"/*.png; do
    [ -e "$golden/${file##*/}" ] || tell 2 "${file##*/}" "has no golden one; to accept it: cp '$file' '$golden'"
done
[ "$compared" -gt 0 ] || tell 2 "$golden" "holds nothing to compare"
exit "$code"
