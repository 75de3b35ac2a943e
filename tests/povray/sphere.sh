# sphere.sh - the glossy sphere that several tests look at; read after render.sh:  . "$srcdir/tests/povray/sphere.sh"
#
#   sphere BLOCK REST        write sphere.pov: a sphere of radius 1 with that block, and the rest of the scene.  Its
#                            Place depends on the clock, which makes other noise at each; the camera is three units
#                            before it
#   one NAME BLOCK REST [OPTION...]      the picture of the first place is NAME, $size pixels wide and high
#   places NAME COUNT        one of each of so many places, NAME1.exr and on; of two digits if there are ten
#                            All of these reflect $amount, 1 if nothing else is said
#   is_exact NAME COUNT COMMAND...       claim: so many places differ by noise alone from what that command of prefenv
#                            says
#   rmse PICTURE REFERENCE   relative, to standard output
#   holds EXPRESSION         true if awk finds it so

size=24
amount=1

sphere()
{
    scene sphere.pov <<END
#declare Place = clock * <0.37, -0.21, 0.11>;
camera { location -3*z direction z right x up y translate Place }
sphere {
    0, 1
    pigment { rgb 1 }
    finish { ambient 0 diffuse 0 reflection { $amount prefiltered_environment { $1 } } }
    translate Place
}
$2
END
}

one()
{
    sphere "$2" "$3"
    render sphere.pov +W$size +H$size +FE +K1 "+O$1" "${@:4}" || note "$said"
}

places()
{
    rm -f "$1"[0-9]*.exr
    render sphere.pov +W$size +H$size +FE +KI1 "+KF$2" +KFI1 "+KFF$2" "+O$1.exr" || note "$said"
}

is_exact()
{
    local name=$1 count=$2

    shift 2
    places picture "$count"
    "$rays" rays $size 3 0,0,0 0,0,0 | "$PREFENV" "$@" >wanted.txt || note "prefenv $* failed"
    ok "$name" "$rays" noise 3 picture*.exr <wanted.txt
    note "$tap_output"
}

rmse()
{
    "$PREFENV" diff "$1" "$2" --json | tr ',{' '\n\n' | sed -n 's/.*"relative_rmse": *\([0-9.e+-]*\).*/\1/p'
}

holds()
{
    [ "$(awk "BEGIN { print ($1) ? 1 : 0 }")" = 1 ]
}
