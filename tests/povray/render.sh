# render.sh - what the tests of the renderer share; read after tap.sh:  . "$srcdir/tests/povray/render.sh"
#
#   $work                    a folder of the test's own, its working folder; removed at the end
#   $rays                    the helper sphere_rays
#   render SCENE [OPTION...] run the patched renderer, quietly; what it said from parsing on, in one
#                            line, in $said, and its status in $render_status
#   rejected TEXT PATTERN SCENE [OPTION...]   claim: it ends with an error that matches PATTERN, leaving no picture
#   scene NAME               write NAME from standard input, behind a head that every scene shares
#   chart NAME WIDTH HEIGHT [SUN]   write a test environment NAME (Radiance HDR): see sphere_rays
#   bake ARGUMENT...         prefenv bake, quietly

[ -n "${POVRAY_PREFENV:-}" ] || skip_all 'this tree is configured without POV-Ray'
[ -x "$POVRAY_PREFENV" ] || bail_out "$POVRAY_PREFENV does not exist: run make"

work=$(mktemp -d) || bail_out 'mktemp -d failed'
trap 'rm -rf "$work"' EXIT
cd "$work" || bail_out "$work cannot be entered"
rays=$top_builddir/tests/sphere_rays

# Neither the user's settings nor the caller's.
HOME=$work
export HOME
unset POVINI POVINC

render()
{
    render_status=0
    said=$("$POVRAY_PREFENV" "+I$1" -D +WT2 "${@:2}" 2>&1) || render_status=$?
    said=$(printf '%s' "$said" | tr -s '\r\n\t ' ' ')
    said=${said#*Warning Stream to console*On } # "[Parsing...]" itself may come behind the first error
    return $render_status
}

rejected()
{
    local name=$1 pattern=$2

    shift 2
    rm -f rejected.png
    render "$@" +W8 +H8 +Orejected.png || true
    if [ $render_status -eq 0 ] || [ $render_status -ge 128 ]; then
        tap_result 1 "$name" || note "exit status $render_status: $said"
    elif [ -s rejected.png ]; then
        tap_result 1 "$name" || note 'a picture was left'
    else
        like "$said" "$pattern" "$name"
    fi
}

scene()
{
    {
        echo '#version unofficial 3.7;'
        echo '#include "prefenv.inc"'
        echo 'global_settings { assumed_gamma 1 }'
        cat
    } >"$1"
}

chart()
{
    "$rays" chart "${@:2}" >"$1" || bail_out "$rays cannot write $1"
}

bake()
{
    bake_said=$("$PREFENV" bake "$@" 2>&1) || bail_out "prefenv bake $*: $bake_said"
}
