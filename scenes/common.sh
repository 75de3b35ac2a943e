# common.sh - what the scripts that render scenes share; read by bunny.sh, figures.sh, references.sh, bench/run.sh and
# tests/scenes.sh.  They are called with, in the environment:
#
#   PREFENV POVRAY_PREFENV   the command and the renderer
#   PREFENV_DATA             folder of bunny.obj and hdri/
#   srcdir top_builddir      both absolute
#
# and die() is called, with one sentence, when something is wrong: the reader may define its own.

export LC_ALL=C

declare -F die >/dev/null || die()
{
    printf '%s: %s\n' "$(basename "$0" .sh)" "$*" >&2
    exit 1
}

for name in PREFENV POVRAY_PREFENV PREFENV_DATA srcdir top_builddir; do
    [ -n "${!name:-}" ] || die "$name is not set: call this through make"
done

# now: seconds, with a fraction
now()
{
    date +%s.%N
}

# seconds_since START [DIGITS]: the time since, with one digit after the point, or as many as asked for
seconds_since()
{
    awk -v start="$1" -v end="$(now)" -v digits="${2:-1}" 'BEGIN { printf "%.*f", digits, end - start }'
}

# newer TARGET INPUT...: does TARGET exist, and is it no older than any INPUT?
newer()
{
    local target=$1 input

    shift
    [ -f "$target" ] || return 1
    for input; do
        if [ "$input" -nt "$target" ] || [ ! -e "$input" ]; then return 1; fi
    done
}

# written TARGET COMMAND...: what the command prints becomes TARGET, whole or not at all, whoever else makes it in the
# meantime: `make -j` runs several of these scripts at once.
written()
{
    local target=$1 part=$1.$$.tmp

    shift
    (
        trap 'rm -f "$part"' EXIT
        trap 'exit 130' INT TERM HUP
        "$@" >"$part" && mv "$part" "$target"
    )
}

# make_mesh FOLDER: FOLDER/bunny_mesh.inc out of bunny.obj, if it is not there yet or out of date
make_mesh()
{
    local target=$1/bunny_mesh.inc script=$srcdir/scenes/obj2mesh.awk

    [ -f "$PREFENV_DATA/bunny.obj" ] || die "$PREFENV_DATA/bunny.obj does not exist: run ./bootstrap, which fetches it"
    newer "$target" "$PREFENV_DATA/bunny.obj" "$script" && return
    written "$target" awk -f "$script" "$PREFENV_DATA/bunny.obj" || die 'bunny.obj could not be converted; see above'
}

# make_teapot FOLDER: FOLDER/teapot_mesh.inc out of the 32 patches, likewise
make_teapot()
{
    local target=$1/teapot_mesh.inc script=$srcdir/scenes/patches2mesh.awk patches=$srcdir/scenes/teapot.patches

    newer "$target" "$patches" "$script" && return
    written "$target" awk -f "$script" "$patches" || die 'teapot.patches could not be converted; see above'
}

# The renderer, quietly and without the user's own povray.ini.  What it says goes into LOG, whose end is shown if it
# fails.  Sets trace_seconds to POV-Ray's own "Trace Time", and trace_cpu_seconds to what its threads worked in it.
#
#   render LOG SCENE OUTPUT.png|OUTPUT.exr OPTION...
render()
{
    local log=$1 scene=$2 output=$3 format=+FN8

    shift 3
    case $output in *.exr) format=+FE ;; esac
    if ! env -u POVINI -u POVINC HOME=/nonexistent "$POVRAY_PREFENV" "+I$scene" "+O$output" $format -D -V \
        "+L$srcdir/scenes" "$@" >"$log" 2>&1 </dev/null; then
        sed -e 's/^/  /' -e '/^ *$/d' "$log" | tail -n 20 >&2
        rm -f "$output"
        die "$(basename "$scene") could not be rendered; the whole log is $log"
    fi
    trace_seconds=$(sed -n 's/.*Trace Time:.*(\([0-9.]*\) seconds).*/\1/p' "$log")
    trace_cpu_seconds=$(sed -n '/Trace Time:/,$s/.* with \([0-9.]*\) CPU-seconds total.*/\1/p' "$log")
}
