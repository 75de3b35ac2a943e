#!/bin/bash
# lint.sh - format, static analysis of C and C++, shell scripts, and the manners of patches; called by `make lint`.
#
# Environment: CLANG_FORMAT, CLANG_TIDY (commands), flags (compiler flags for the headers of others).

set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

status=0

complain()
{
    printf 'lint: %s\n' "$*" >&2
    status=1
}

need()
{
    command -v "$1" >/dev/null && return
    complain "$1 is not installed: ./bootstrap --lint installs it"
    return 1
}

mapfile -t sources < <(find src tests bench \( -name '*.c' -o -name '*.cpp' \) 2>/dev/null | sort)
mapfile -t headers < <(find src tests bench -name '*.h' 2>/dev/null | sort)
mapfile -t scripts < <(find bootstrap .ci/run build-aux tests scenes bench -type f \
    \( -name '*.sh' -o -name bootstrap -o -name run \) ! -name tap-driver.sh 2>/dev/null | sort)

# ---- format ----

if need "$CLANG_FORMAT"; then
    "$CLANG_FORMAT" --dry-run -Werror "${sources[@]}" "${headers[@]}" || complain 'see above; `make format` does it'
fi

long=$(grep -nE '^.{121,}$' "${sources[@]}" "${headers[@]}" "${scripts[@]}" Makefile.am configure.ac) &&
    complain "lines of more than 120 columns:
$long"
loose=$(grep -nE '[[:blank:]]$' "${sources[@]}" "${headers[@]}" "${scripts[@]}" Makefile.am configure.ac) &&
    complain "white space at the end of lines:
$loose"

# ---- static analysis ----

analyse() # FILE
{
    local standard=-std=gnu11

    [ "${1##*.}" = cpp ] && standard=-std=gnu++17
    # shellcheck disable=SC2086 # flags are a list of words
    "$CLANG_TIDY" --quiet "$1" -- $standard -Isrc -Itests $flags 2>/dev/null
}
export -f analyse

if need "$CLANG_TIDY"; then
    printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'analyse "$1"' analyse ||
        complain "$CLANG_TIDY has found something"
fi

if need cppcheck; then
    cppcheck --quiet --std=c11 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
        -j "$(nproc)" --suppress=missingIncludeSystem --suppress=unknownMacro --suppress=arrayIndexThenCheck \
        -Isrc -Itests "${sources[@]}" ||
        complain 'cppcheck has found something'
fi

if need shellcheck; then
    shellcheck --severity=warning --external-sources --source-path=SCRIPTDIR/.. \
        --exclude=SC1007,SC1090,SC1091,SC2010,SC2034,SC2154,SC2238 --shell=bash "${scripts[@]}" ||
        complain 'shellcheck has found something'
fi

# ---- patches: 0001-one-idea.patch, a header that says why, listed in series ----

if [ -d patches ]; then
    number=0
    while read -r patch; do
        number=$((number + 1))
        case $patch in
            "$(printf %04d "$number")"-*.patch) ;;
            *) complain "patches/series: $patch is number $number, and its name should say so" ;;
        esac
        [ -f "patches/$patch" ] || { complain "patches/series names $patch, which does not exist" && continue; }
        header=$(sed '/^---\( \|$\)/,$d' "patches/$patch")
        for field in Subject Signed-off-by Upstream; do
            grep -q "^$field: " <<<"$header" || complain "patches/$patch: its header has no \`$field:'"
        done
    done < <(sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' patches/series)
    for patch in patches/*.patch; do
        grep -q "^${patch#patches/}" patches/series || complain "$patch is not in patches/series"
    done
fi

exit $status
