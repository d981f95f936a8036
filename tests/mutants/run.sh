#!/usr/bin/env bash
# Proves that the tests notice what they must: breaks the program in one way after the other, each a row of mutants.list, builds,
# runs the tests that are expected to fail, and puts the program back.
#   tests/mutants/run.sh                 every mutant, each with its own tests up to the first that notices it
#   tests/mutants/run.sh --tested        the same just after the suite passed: unbroken tests are not run again
#   tests/mutants/run.sh barrier memo    mutants whose names contain one of these texts
#   tests/mutants/run.sh --all [NAME...] each mutant with the whole suite (ctest --preset tests): hours
#   tests/mutants/run.sh --for SECONDS   at least three, and as many as begin within SECONDS, just after the suite passed: in an order by the
#                                        commit's hash; mutants that recompile much are passed over
#   tests/mutants/run.sh --check         only looks whether every mutant's text is found; builds nothing
# Exit code: 0 every mutant is noticed; 1 one is not; 2 a text is not found exactly once, a build or an unbroken test fails, or the
# working tree has changes. Needs the build folder of `cmake --preset tests`. STRATA_BUILD names another one, STRATA_JOBS limits
# the compilers that run at once. The files are changed in place and put back, with what was built from them, however the script ends;
# after a kill -9: git checkout -- . && rm -rf BUILD.unbroken
set -euo pipefail
cd "$(dirname "$0")/../.."

build=${STRATA_BUILD:-build} jobs=${STRATA_JOBS:-$(nproc)} longest_test=900
least=3 most_compiles=12  # of --for; a compile takes up to 10 s of CPU
log=$(mktemp -d)
unbroken=$build.unbroken
touched=()

# Links to objects, archives and programs, which a build replaces, and copies of the rest, which it may change in place. Putting a
# mutant back then compiles nothing.
keep_build() {
    rm -rf "$unbroken"
    cp -al "$build" "$unbroken"
    find "$unbroken" -type f ! -name '*.o' ! -name '*.a' ! -perm -u+x -exec cp -p {} {}.copy \; -exec mv {}.copy {} \;
}

# Files get their times back as well, or the build would take them for changed ones.
restore() {
    [ ${#touched[@]} -gt 0 ] || return 0
    local file
    for file in "${touched[@]}"; do mv "$log/sources/$file" "$file"; done
    touched=()
    [ -d "$unbroken" ] || return 0
    while read -r file; do
        rm "$build/$file"
        [ ! -e "$unbroken/$file" ] || cp -p "$unbroken/$file" "$build/$file"
    done < <(find "$build" -type f -newer "$log/applied" -printf '%P\n')
}
trap 'restore; rm -rf "$log" "$unbroken"' EXIT
trap 'exit 130' INT TERM HUP

fatal() { printf '%s\n' "$*" >&2; exit 2; }

# The list as arrays: a mutant's edits and tests are lines of its element.
names=() edits=() tests=()
read_list() {
    local line last file old=''
    while IFS= read -r line; do
        last=$((${#names[@]} - 1))
        case $line in
            '' | '#'*) ;;
            'mutant '*) names+=("${line#mutant }") edits+=('') tests+=('') ;;
            'file '*) file=${line#file } ;;
            '- '*)
                [ -z "$old" ] || fatal "mutants.list: nothing replaces '$old'"
                old=${line#- }
                ;;
            '+ '*)
                [ -n "$old" ] || fatal "mutants.list: '$line' replaces nothing"
                edits[last]+="$file"$'\t'"$old"$'\t'"${line#+ }"$'\n' old=''
                ;;
            'test '*) tests[last]+="${line#test }"$'\n' ;;
            *) fatal "mutants.list: '$line' is none of mutant, file, -, +, test" ;;
        esac
    done <tests/mutants/mutants.list
}

is_asked_for() {
    [ ${#asked[@]} -eq 0 ] && return
    local part
    for part in "${asked[@]}"; do [[ $1 != *"$part"* ]] || return 0; done
    return 1
}

# apply INDEX [dry]: makes the mutant's edits; fails where a text is not in its file exactly once.
apply() {
    local file old new text rest
    [ "${2:-}" = dry ] || touch "$log/applied"
    while IFS=$'\t' read -r file old new; do
        [ -f "$file" ] || { echo "${names[$1]}: there is no $file" >&2; return 1; }
        if [ "$(grep -cF -e "$old" -- "$file")" != 1 ]; then
            echo "${names[$1]}: '$old' is not in $file exactly once" >&2
            return 1
        fi
        [ "${2:-}" = dry ] && continue
        text=$(<"$file")
        rest=${text#*"$old"}
        if [ ! -e "$log/sources/$file" ]; then
            mkdir -p "$log/sources/$(dirname "$file")"
            cp -p "$file" "$log/sources/$file"
            touched+=("$file")
        fi
        printf '%s%s%s\n' "${text%%"$old"*}" "$new" "$rest" >"$file"
    done <<<"${edits[$1]%$'\n'}"
}

# build_programs NAME...: quiet unless it fails.
build_programs() { nice cmake --build "$build" -j "$jobs" --target "$@" >"$log/build" 2>&1; }

programs_of() { cut -d' ' -f1 <<<"${tests[$1]%$'\n'}" | sort -u; }

# run_test PROGRAM FILTER: 0 it passes, 1 it fails, 2 the filter finds none. Prints the first test that fails; adds the CPU seconds to
# $log/cpu.
run_test() {
    local status=0
    local TIMEFORMAT='%U %S'
    { time GTEST_FAIL_FAST=1 timeout "$longest_test" nice "$build/$1" --gtest_filter="$2" >"$log/test" 2>&1 || status=$?; } 2>>"$log/cpu"
    if grep -q '^\[==========\] 0 tests' "$log/test"; then
        echo "$1 has no test $2"
        return 2
    fi
    [ $status -ne 0 ] || return 0
    sed -n 's/^\[  FAILED  \] \([^ ,]*\).*(.*ms)$/\1/p' "$log/test" | head -n 1 | grep . || echo "$1 ends with $status"
    return 1
}

# until_noticed INDEX: builds and runs one test after the other up to the first that fails. As run_test; 3 if it does not build.
until_noticed() {
    local program filter status
    while read -r program filter; do
        build_programs "$program" </dev/null || return 3
        status=0
        run_test "$program" "$filter" </dev/null || status=$?
        [ $status -eq 0 ] || return $status
    done <<<"${tests[$1]%$'\n'}"
}

# The chosen mutants in an order that is another one for every commit.
shuffled() {
    local seed
    seed=$((16#$(git rev-parse --short=7 HEAD | cut -c1-7)))
    printf '%s\n' "${chosen[@]}" | awk -v seed="$seed" 'BEGIN { srand(seed) } { printf "%.9f %s\n", rand(), $0 }' | sort | cut -d' ' -f2
}

# How many sources the mutant's first test program compiles.
compiles_of() { cmake --build "$build" --target "$(cut -d' ' -f1 <<<"${tests[$1]}" | head -n 1)" -- -n | grep -c 'Building CXX' || true; }

run_suite() {
    local status=0
    build_programs all || return 3
    nice ctest --preset tests >"$log/test" 2>&1 || status=$?
    [ $status -eq 0 ] && return
    { grep -oE '\[  FAILED  \] [^ ,]+' "$log/test" | awk '!seen[$4]++ { print $4 }'; grep -oE '[^ ]+ \(Failed\)' "$log/test"; } |
        head -n 4 | tr '\n' ' '
    return 1
}

cpu_seconds() { awk '{ sum += $1 + $2 } END { printf "%.1f", sum }' "$log/cpu"; }

build_unbroken() {
    mapfile -t programs < <([ $all = yes ] && echo all || for i in "${chosen[@]}"; do programs_of "$i"; done | sort -u)
    build_programs "${programs[@]}" || { tail -n 20 "$log/build" >&2; fatal "the program does not build before anything is broken"; }
}

# The tests must pass before anything is broken, or they would notice everything.
expect_unbroken_tests_to_pass() {
    local program filter failing
    while read -r program filter; do
        failing=$(run_test "$program" "$filter" </dev/null) || fatal "$program $filter: fails before anything is broken: $failing"
    done < <(for i in "${chosen[@]}"; do printf '%s' "${tests[$i]}"; done | sort -u)
}

all=no check=no tested=no limit='' asked=()
while [ $# -gt 0 ]; do
    case $1 in
        --all) all=yes ;;
        --check) check=yes ;;
        --tested) tested=yes ;;
        --for) tested=yes limit=${2:?--for asks for seconds}; shift ;;
        -*) sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2 ;;
        *) asked+=("$1") ;;
    esac
    shift
done

read_list
chosen=()
for i in "${!names[@]}"; do is_asked_for "${names[$i]}" && chosen+=("$i"); done
[ ${#chosen[@]} -gt 0 ] || fatal "no mutant has a name like that"
found=yes
for i in "${chosen[@]}"; do apply "$i" dry || found=no; done
[ $found = yes ] || exit 2
[ $check = yes ] && { echo "${#chosen[@]} mutants, each found once"; exit 0; }
[ -z "$(git status --porcelain --untracked-files=no)" ] || fatal "the working tree has changes; commit or stash them first"
[ -z "$limit" ] || mapfile -t chosen < <(shuffled)
build_unbroken
[ $all = yes ] || [ $tested = yes ] || expect_unbroken_tests_to_pass
keep_build

SECONDS=0
result=0  # 1 once a mutant lives, 2 once something is wrong with the list or the build
tried=0 passed_over=0
printf '%-42s %7s  %s\n' mutant 'CPU s' 'noticed by'
for i in "${chosen[@]}"; do
    [ -z "$limit" ] || [ $tried -lt $least ] || [ $SECONDS -lt "$limit" ] || break
    apply "$i" || exit 2
    if [ -n "$limit" ] && [ "$(compiles_of "$i")" -gt $most_compiles ]; then
        restore
        passed_over=$((passed_over + 1))
        continue
    fi
    tried=$((tried + 1))
    : >"$log/cpu"
    status=0
    noticed=$(if [ $all = yes ]; then run_suite; else until_noticed "$i"; fi) || status=$?
    restore
    case $status in
        0) noticed='NOT NOTICED' result=$((result > 1 ? result : 1)) ;;
        2) result=2 ;;
        3)
            cp "$log/build" "${TMPDIR:-/tmp}/strata_mutant_build.log"
            noticed="DOES NOT BUILD (${TMPDIR:-/tmp}/strata_mutant_build.log)" result=2
            ;;
    esac
    printf '%-42s %7s  %s\n' "${names[$i]}" "$(cpu_seconds)" "$noticed"
done
printf '%s of %s mutants in %s s' $tried ${#names[@]} $SECONDS
[ -z "$limit" ] || printf ', chosen by commit %s; %s passed over, because they compile more than %s sources' "$(git rev-parse --short=12 HEAD)" $passed_over $most_compiles
printf '\n'
exit $result
