#!/usr/bin/env bash
# Guards a renderer: compares every capture and image below one folder with that of the same name below another.
#   guard.sh GOLDEN NEW OUT [OPTION...]      options are those of `strata diff`
# For a.strata (.exr, .png) OUT gets a.strata.xml (JUnit) and, where it differs or warns, a.strata.html: what differs, with pictures.
# Those of an earlier run are removed. Exit code: 0 all pass, 1 one does not, 2 one is missing, new or cannot be compared, or OUT
# cannot be written. STRATA names the program.
set -euo pipefail
trap 'exit 130' INT TERM

[ $# -ge 3 ] || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
strata=${STRATA:-strata} golden=$1 new=$2 out=$3
shift 3
for folder in "$golden" "$new"; do
    [ -d "$folder" ] || { echo "$folder is no folder" >&2; exit 2; }
done
mkdir -p -- "$out" && : >"$out/guard.tried" && rm -- "$out/guard.tried" || { echo "$out cannot be written" >&2; exit 2; }
golden=$(realpath -- "$golden") new=$(realpath -- "$new") out=$(realpath -- "$out")
find "$out" -regextype posix-extended -type f -iregex '.*\.(strata|exr|png)\.(html|xml|txt|err)' -delete

code=0 compared=0
# tell WORST NAME WORDS
tell() {
    printf '%-40q %s\n' "$2" "$3"
    [ "$1" -le "$code" ] || code=$1
}

escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/"/\&quot;/g' <<<"$1"; }

# unusable NAME WORDS: what has no comparison is an error in JUnit, too.
unusable() {
    mkdir -p -- "$out/$(dirname -- "$1")"
    cat >"$out/$1.xml" <<XML
<?xml version="1.0" encoding="UTF-8"?>
<testsuites><testsuite name="$(escaped "$1")" tests="1" failures="0" errors="1">
<testcase classname="guard" name="$(escaped "$1")"><error message="$(escaped "$2")"/></testcase></testsuite></testsuites>
XML
    tell 2 "$1" "$2"
}

# names FOLDER: files below it but hidden ones, each ended by a null.
names() { (cd -- "$1" && find . -type f -not -path '*/.*' -printf '%P\0' | sort -z); }

while IFS= read -r -d '' name; do
    result=0
    case ${name,,} in
        *.strata | *.exr | *.png) ;;
        *) unusable "$name" "is no capture, .exr or .png"; continue ;;
    esac
    if [ ! -e "$new/$name" ]; then
        unusable "$name" "is missing in the new folder"
        continue
    fi
    mkdir -p -- "$out/$(dirname -- "$name")"
    compared=$((compared + 1))
    "$strata" diff "$golden/$name" "$new/$name" --junit "$out/$name.xml" -o "$out/$name.html" "$@" \
        >"$out/$name.txt" 2>"$out/$name.err" || result=$?
    said=$(tail -n 1 "$out/$name.err")
    case $result in
        0)
            if tail -n 1 "$out/$name.txt" | grep -q '^WARNING'; then
                tell 0 "$name" "passes with a warning; see $out/$name.html"
            else
                rm -f -- "$out/$name.html"
                tell 0 "$name" "passes"
            fi
            ;;
        1) tell 1 "$name" "$said; see $out/$name.html" ;;
        130) exit 130 ;;
        *) unusable "$name" "exit code $result: $said" ;;
    esac
done < <(names "$golden")
while IFS= read -r -d '' name; do
    [ -e "$golden/$name" ] || unusable "$name" "has no golden one; to accept it: cp $(printf '%q %q' "$new/$name" "$golden/$name")"
done < <(names "$new")
[ "$compared" -gt 0 ] || tell 2 "$golden" "holds nothing to compare"
exit "$code"
