#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy) on the lines that differ from the last landed commit, and on a source for each header that does.
#   tests/tidy.sh SECONDS    starts no file later than that: the order depends on the commit, so that every commit checks another part
# The landed commit is the merge base with the branch's upstream, else with origin/main. Where that is HEAD, or there is neither: what is
# not committed is checked, else what HEAD changed. Exit code 1: clang-tidy reports something in a line that differs.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=$1 build=build-tidy
head=$(git rev-parse HEAD)
base=$(git merge-base HEAD '@{upstream}' 2>/dev/null || git merge-base HEAD origin/main 2>/dev/null || echo "$head")
if [ "$base" = "$head" ] && git diff --quiet HEAD; then base=$(git rev-parse -q --verify HEAD~1 || true); fi
if [ -n "$base" ]; then
    mapfile -t differing < <(git diff --name-only --diff-filter=d "$base" -- '*.h' '*.cpp')
    against="differ from ${base:0:12}"
else
    mapfile -t differing < <(git ls-files '*.cpp')
    against="may be checked, because no commit lies before this one"
fi

# A header is checked through the source of its name, else through the first that includes it.
sources=()
for file in "${differing[@]}"; do
    source=$file
    if [ "${file##*.}" = h ]; then
        source=${file%.h}.cpp
        [ -f "$source" ] || source=$(git grep -lF "#include \"$file\"" -- '*.cpp' | head -n 1 || true)
    fi
    # The consumer of the installed package is a project of its own; the peer's shaders are compiled with its target alone.
    case $source in '' | tests/1_capture/consumer/* | tests/9_speed/peer/peer.cpp | docs/*) ;; *) sources+=("$source") ;; esac
done
mapfile -t sources < <(printf '%s\n' "${sources[@]}" | sort -u | awk -v seed=$((16#${head:0:7})) '
    BEGIN { srand(seed) }
    NF { printf "%.9f %s\n", rand(), $0 }' | sort | cut -d' ' -f2)
printf '== clang-tidy: %s files %s; %s sources\n' "${#differing[@]}" "$against" "${#sources[@]}" >&2
[ ${#sources[@]} -gt 0 ] || exit 0

cmake --preset tidy >/dev/null
ninja -C $build generated/capture_format/schema/capture_generated.h strata_ui_shaders >/dev/null

# Findings are reported in lines that differ alone; an empty filter lets all of the project through.
filter=
[ -z "$base" ] || filter=$(git diff -U0 --diff-filter=d "$base" -- '*.h' '*.cpp' | awk '
    /^\+\+\+ b\// { name = substr($0, 7) }
    /^@@ / {
        split(substr($3, 2), added, ",")
        count = added[2] == "" ? 1 : added[2]
        if (count > 0) lines[name] = lines[name] sprintf(",[%d,%d]", added[1], added[1] + count - 1)
    }
    END { for (name in lines) printf ",{\"name\":\"%s\",\"lines\":[%s]}", name, substr(lines[name], 2) }')
export deadline=$(($(date +%s) + seconds)) filter="${filter:+[${filter#,}]}" build
log=$(mktemp -d)
trap 'rm -rf "$log"' EXIT
export log
check() {
    [ "$(date +%s)" -lt "$deadline" ] || return 0
    echo "$1" >>"$log/checked"
    clang-tidy-16 --quiet -p "$build" --line-filter="$filter" "$1" >"$log/$$" 2>"$log/$$.errors" && return
    cat "$log/$$"
    grep error: "$log/$$.errors"
    return 1
}
export -f check
touch "$log/checked"
status=0
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -I SOURCE bash -c 'check SOURCE' || status=1
printf '== clang-tidy: %s of %s sources checked in %s s, %s\n' "$(wc -l <"$log/checked")" "${#sources[@]}" \
    $(($(date +%s) - deadline + seconds)) "$([ $status -eq 0 ] && echo 'nothing found' || echo 'findings above')" >&2
exit $status
