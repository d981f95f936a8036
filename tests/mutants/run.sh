#!/usr/bin/env bash
# Proves that the tests notice what they must: breaks the program in one way after the other, each a row of mutants.list, builds,
# runs the tests that are expected to fail, and puts the program back.
#   tests/mutants/run.sh                 every mutant, each with its own tests
#   tests/mutants/run.sh barrier memo    mutants whose names contain one of these texts
#   tests/mutants/run.sh --all [NAME...] each mutant with the whole suite (ctest --preset tests): hours
#   tests/mutants/run.sh --for SECONDS   at least three, and as many as begin within SECONDS: in an order by the commit's hash, each with
#                                        its tests up to the first that notices it; mutants that recompile much are passed over
#   tests/mutants/run.sh --check         only looks whether every mutant's text is found; builds nothing
# Exit code: 0 every mutant is noticed; 1 one is not; 2 a text is not found exactly once, a build or an unbroken test fails, or the
# working tree has changes. Needs the build folder of `cmake --preset tests`. STRATA_BUILD names another one, STRATA_JOBS limits
# the compilers that run at once. The files are changed in place, and git puts them back however the script ends; after a kill -9:
# git checkout -- .
set -euo pipefail
cd "$(dirname "$0")/../.."

build=${STRATA_BUILD:-build} jobs=${STRATA_JOBS:-$(nproc)} longest_test=900
least=3 most_compiles=12  # of --for; a compile takes up to 10 s of CPU
log=$(mktemp -d)
touched=()

restore() {
    [ ${#touched[@]} -eq 0 ] || git checkout --quiet -- "${touched[@]}"
    touched=()
}
trap 'restore; rm -rf "$log"' EXIT
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
    while IFS=$'\t' read -r file old new; do
        [ -f "$file" ] || { echo "${names[$1]}: there is no $file" >&2; return 1; }
        if [ "$(grep -cF -e "$old" -- "$file")" != 1 ]; then
            echo "${names[$1]}: '$old' is not in $file exactly once" >&2
            return 1
        fi
        [ "${2:-}" = dry ] && continue
        text=$(<"$file")
        rest=${text#*"$old"}
        touched+=("$file")
        printf '%s%s%s\n' "${text%%"$old"*}" "$new" "$rest" >"$file"
    done <<<"${edits[$1]%$'\n'}"
}

# build_programs NAME...: quiet unless it fails.
build_programs() { nice cmake --build "$build" -j "$jobs" --target "$@" >"$log/build" 2>&1; }

programs_of() { cut -d' ' -f1 <<<"${tests[$1]%$'\n'}" | sort -u; }

# run_tests LINES: 0 all pass, 1 some fail, 2 a filter finds none. Prints the first that fail; adds the CPU seconds to $log/cpu.
run_tests() {
    local program filter status failed='' noticed=0
    local TIMEFORMAT='%U %S'
    while read -r program filter; do
        status=0
        { time timeout "$longest_test" nice "$build/$program" --gtest_filter="$filter" >"$log/test" 2>&1 || status=$?; } 2>>"$log/cpu"
        if grep -q '^\[==========\] 0 tests' "$log/test"; then
            echo "$program has no test $filter"
            return 2
        fi
        [ $status -eq 0 ] && continue
        noticed=1
        failed+=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*(.*ms)$/\1/p' "$log/test" | head -n 2 | tr '\n' ' ')
        grep -q '^\[  FAILED  \]' "$log/test" || failed+="$program ends with $status "
    done <<<"${1%$'\n'}"
    echo "${failed% }"
    return $noticed
}

# until_noticed INDEX: builds and runs one test after the other up to the first that fails. As run_tests; 3 if it does not build.
until_noticed() {
    local line status
    while read -r line; do
        build_programs "${line%% *}" </dev/null || return 3
        status=0
        run_tests "$line" </dev/null || status=$?
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
    nice ctest --preset tests >"$log/test" 2>&1 || status=$?
    [ $status -eq 0 ] && return
    { grep -oE '\[  FAILED  \] [^ ,]+' "$log/test" | awk '!seen[$4]++ { print $4 }'; grep -oE '[^ ]+ \(Failed\)' "$log/test"; } |
        head -n 4 | tr '\n' ' '
    return 1
}

cpu_seconds() { awk '{ sum += $1 + $2 } END { printf "%.1f", sum }' "$log/cpu"; }

# The tests must pass before anything is broken, or they would notice everything.
expect_unbroken_tests_to_pass() {
    local i failing programs=()
    for i in "${chosen[@]}"; do mapfile -t -O ${#programs[@]} programs < <(programs_of "$i"); done
    mapfile -t programs < <(printf '%s\n' "${programs[@]}" | sort -u)
    build_programs "${programs[@]}" || { tail -n 20 "$log/build" >&2; fatal "the program does not build before anything is broken"; }
    for i in "${chosen[@]}"; do
        failing=$(run_tests "${tests[$i]}") || fatal "${names[$i]}: fails before anything is broken: $failing"
    done
}

all=no check=no limit='' asked=()
while [ $# -gt 0 ]; do
    case $1 in
        --all) all=yes ;;
        --check) check=yes ;;
        --for) limit=${2:?--for asks for seconds}; shift ;;
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
if [ -n "$limit" ]; then
    # Their tests have just passed in the suite.
    mapfile -t chosen < <(shuffled)
elif [ $all = no ]; then
    expect_unbroken_tests_to_pass
fi

SECONDS=0
result=0  # 1 once a mutant lives, 2 once something is wrong with the list or the build
done=() passed_over=0
printf '%-42s %7s  %s\n' mutant 'CPU s' 'noticed by'
for i in "${chosen[@]}"; do
    [ -z "$limit" ] || [ ${#done[@]} -lt $least ] || [ $SECONDS -lt "$limit" ] || break
    apply "$i" || exit 2
    if [ -n "$limit" ] && [ "$(compiles_of "$i")" -gt $most_compiles ]; then
        restore
        passed_over=$((passed_over + 1))
        continue
    fi
    done+=("$i")
    : >"$log/cpu"
    status=0
    if [ -n "$limit" ]; then
        noticed=$(until_noticed "$i") || status=$?
    else
        mapfile -t targets < <([ $all = yes ] && echo all || programs_of "$i")
        if ! build_programs "${targets[@]}"; then
            status=3
        elif [ $all = yes ]; then
            noticed=$(run_suite) || status=$?
        else
            noticed=$(run_tests "${tests[$i]}") || status=$?
        fi
    fi
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
# The build folder is left as the restored files are.
mapfile -t targets < <([ $all = yes ] && echo all || for i in "${done[@]}"; do programs_of "$i"; done | sort -u)
build_programs "${targets[@]}" || result=2
printf '%s of %s mutants in %s s' ${#done[@]} ${#names[@]} $SECONDS
[ -z "$limit" ] || printf ', chosen by commit %s; %s passed over, because they compile more than %s sources' "$(git rev-parse --short=12 HEAD)" $passed_over $most_compiles
printf '\n'
exit $result
