# tap.sh - the few words of Test Anything Protocol that a shell test needs; read it with  . "$srcdir/tests/tap.sh"
#
#   ok NAME COMMAND...        the command exits with 0
#   fails NAME COMMAND...     the command exits with something else, and is not killed by a signal
#   is GOT WANTED NAME        two strings are equal
#   like GOT PATTERN NAME     a string matches an extended regular expression
#   note TEXT                 a remark, for the log
#   skip REASON [COUNT]       claims that cannot be tried here
#   skip_all REASON           the whole test cannot be tried here; ends it
#   bail_out REASON           something the test cannot do without is missing; ends it
#   done_testing              the plan, last
#
# What a command prints is shown in the log when the claim fails.

tap_count=0
tap_failed=0

tap_result() # STATUS NAME
{
    tap_count=$((tap_count + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $tap_count - $2"
    else
        tap_failed=$((tap_failed + 1))
        echo "not ok $tap_count - $2"
    fi
    return "$1"
}

note()
{
    printf '%s\n' "$*" | sed 's/^/# /'
}

tap_run() # COMMAND...; its status, and what it printed in tap_output
{
    tap_output=$("$@" 2>&1) && tap_status=0 || tap_status=$?
}

ok()
{
    tap_name=$1
    shift
    tap_run "$@"
    [ $tap_status -eq 0 ] && tap_result 0 "$tap_name" && return
    tap_result 1 "$tap_name" || note "$* : exit status $tap_status
$tap_output"
    return 1
}

fails()
{
    tap_name=$1
    shift
    tap_run "$@"
    [ $tap_status -ne 0 ] && [ $tap_status -lt 128 ] && tap_result 0 "$tap_name" && return
    tap_result 1 "$tap_name" || note "$* : exit status $tap_status
$tap_output"
    return 1
}

is()
{
    [ "$1" = "$2" ] && tap_result 0 "$3" && return
    tap_result 1 "$3" || note "got:    $1
wanted: $2"
    return 1
}

like()
{
    printf '%s\n' "$1" | grep -Eq -- "$2" && tap_result 0 "$3" && return
    tap_result 1 "$3" || note "got:    $1
wanted: a match of $2"
    return 1
}

skip()
{
    tap_left=${2:-1}
    while [ "$tap_left" -gt 0 ]; do
        tap_count=$((tap_count + 1))
        tap_left=$((tap_left - 1))
        echo "ok $tap_count # SKIP $1"
    done
}

skip_all()
{
    echo "1..0 # SKIP $1"
    exit 0
}

bail_out()
{
    echo "Bail out! $1"
    exit 1
}

done_testing()
{
    echo "1..$tap_count"
    [ "$tap_failed" -eq 0 ]
}
