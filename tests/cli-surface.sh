# cli-surface.sh - `prefenv surface`: what it writes, says and refuses.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

# refused NAME PATTERN ARGUMENT...: exit code 2, one line that the pattern matches, and no file.
refused()
{
    local name=$1 pattern=$2 said status

    shift 2
    said=$("$PREFENV" surface "$@" 2>&1 >/dev/null)
    status=$?
    is "$status $(wc -l <<<"$said") $(ls x.exr 2>/dev/null)" "2 1 " "$name: exit code 2, one line, no file"
    like "$said" "$pattern" "$name: says so"
}

for kind in turned milled blasted brushed; do
    said=$("$PREFENV" surface $kind -o $kind.exr --size 256x320 --length 20um,10um 2>&1)
    like "$said" "^$kind.exr: $kind, 256x320 texels of 1 um; roughness " "$kind: one line says what was made"
    "$PREFENV" surface $kind -o again.exr --size 256x320 --length 20um,10um -q
    ok "$kind: the same surface again" cmp $kind.exr again.exr
    "$PREFENV" surface $kind -o again.exr --size 256x320 --length 20um,10um -q --seed 2
    fails "$kind: another with another seed" cmp $kind.exr again.exr
done
like "$(exrheader turned.exr)" 'prefenv:pitch.*double.*: 1$' "the file knows its pitch"
like "$(exrheader turned.exr)" 'R, 32-bit floating-point' "and holds floats"

# Lengths are the same in any unit.
"$PREFENV" surface turned -o um.exr --size 256x256 --pitch 2um --feed 64um --radius 400 --roughness 0.1 --length 20 -q
"$PREFENV" surface turned -o mm.exr --size 256x256 --pitch 2000nm --feed 0.064mm --radius 0.04cm --roughness 100nm \
    --length 20um,0.02mm -q
# To a bit: 0.064 times 1000 rounds.
ok "the same lengths in other units" "$PREFENV" diff um.exr mm.exr --fail-above 1e-6

like "$("$PREFENV" surface turned -o x.exr --size 64x100 --feed 30um --length 5 2>&1)" \
    'grooves every 33.3333 um, slopes across even to 0.0417$' "the feed is rounded to fit"
rm x.exr

refused "no such kind" "unknown kind 'turnt'; did you mean 'turned'" turnt -o x.exr
refused "nothing like it" "unknown kind 'cast'; what there is: turned, milled, blasted, brushed" cast -o x.exr
refused "a feed for nothing" "--feed is for turned and milled; a blasted surface" blasted -o x.exr --feed 1mm
refused "a radius for nothing" "--radius is for turned; a milled surface" milled -o x.exr --radius 1mm
refused "flanks for nothing" "--slope is for milled; a turned surface" turned -o x.exr --slope 0.1
refused "a unit like no other" "--pitch 1parsec: a length is wanted, as in 1.5um" turned -o x.exr --pitch 1parsec
refused "no number" "--feed um: a length is wanted" turned -o x.exr --feed um
refused "three lengths" "one length is wanted, or two as in 40um,8um" turned -o x.exr --length 1um,2um,3um
refused "too short" "length of 3 along x must lie between 4, 4 texels, and 256" turned -o x.exr --length 3um
refused "too fine a feed" "a feed of 7 is narrower than 8 texels of a pitch of 1, .*; the feed is at least 8, or" \
    milled -o x.exr --feed 7um
refused "too coarse a tool" "feed of 500 with a radius of 400 is not turning" turned -o x.exr --feed 0.5mm
refused "a folder that is not there" "nowhere" turned -o nowhere/x.exr
is "$(ls -A | grep -v '^\(turned\|milled\|blasted\|brushed\|again\|um\|mm\)\.exr$')" "" "nothing else is left behind"

done_testing
