# cli-ndf.sh - `prefenv ndf`: heights and normal maps to a table, what is reported, what is refused.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

# near NAME GOT WANTED TOLERANCE: relative
near()
{
    ok "$1: $2 is $3" awk -v got="$2" -v want="$3" -v bound="$4" \
        'BEGIN { d = (got - want) / want; exit !(got != "" && d * d <= bound * bound) }'
}

# measured FILTER ARGUMENT...: what jq's filter picks from the report of a measurement into x.ndf.exr
measured()
{
    local filter=$1

    shift
    "$PREFENV" ndf --json -o x.ndf.exr "$@" | jq -c "$filter"
}

# refused NAME PATTERN ARGUMENT...: exit code 2, one line that the pattern matches, and no file.
refused()
{
    local name=$1 pattern=$2 said status

    shift 2
    rm -f x.ndf.exr
    said=$("$PREFENV" ndf -o x.ndf.exr "$@" 2>&1 >/dev/null)
    status=$?
    is "$status $(wc -l <<<"$said") $(ls x.ndf.exr 2>/dev/null)" "2 1 " "$name: exit code 2, one line, no file"
    like "$said" "$pattern" "$name: says so"
}

# ---- heights ----

"$PREFENV" surface turned -o turned.exr --size 512x512 --feed 64um --radius 256um -q || bail_out "surface does not work"
# Even slopes to 0.125, so alpha^2 = 0.01^2 + 2/3 0.125^2.
near "alpha across" "$(measured '.alpha[1]' turned.exr --wrap)" 0.10255 0.02
near "alpha along" "$(measured '.alpha[0]' turned.exr --wrap)" 0.005 0.03
near "turned, they change places" "$(measured '.alpha[0]' turned.exr --wrap --turn)" 0.10255 0.02
is "$(measured '[.slopes, .missing]' turned.exr --wrap)" '[262144,0]' "wrapped, every texel has a slope"
is "$(measured '[.slopes, .missing]' turned.exr)" '[256036,6108]' "else all but three at each edge"

text=$("$PREFENV" ndf turned.exr -o x.ndf.exr)
like "$text" '^slopes     256036, and 6108 texels without$' "the text has the count"
like "$text" '^alpha      0.00[0-9]* along the brush, 0.1[0-9]* across: Beckmann' "and alpha"
like "$text" '^table      [0-9]*x[0-9]* cells to slopes of ' "and the table"
is "$("$PREFENV" ndf turned.exr -o x.ndf.exr -q 2>&1)" "" "--quiet is quiet"

# The same heights as a PNG of 16 bits, white 8 um over black, and no gamma in between.
oiiotool turned.exr --addc 1 --divc 8 -d uint16 -o turned.png || bail_out "oiiotool does not work"
near "a PNG of 16 bits" "$(measured '.alpha[1]' turned.png --wrap --height 8um --pitch 1um)" 0.10255 0.02
"$PREFENV" ndf turned.png -o a.ndf.exr -q --height 0.008mm --pitch 1000nm
"$PREFENV" ndf turned.png -o b.ndf.exr -q --scale 8
ok "--scale is --height over --pitch" "$PREFENV" diff a.ndf.exr b.ndf.exr --fail-above-relative 1e-5
near "twice as high, twice as steep" "$(measured '.rms_slope[1]' turned.png --scale 16)" \
    "$(measured '2 * .rms_slope[1]' turned.png --scale 8)" 1e-5
near "a scale given outdoes the file's own" "$(measured '.rms_slope[1]' turned.exr --height 3um --pitch 1um -q)" \
    "$(measured '3 * .rms_slope[1]' turned.exr)" 1e-5
like "$("$PREFENV" ndf turned.exr -o x.ndf.exr --scale 3 2>&1 >/dev/null)" \
    '^prefenv: ndf: warning: turned.exr: states its scale, a pitch of 1 um, which the one given takes the place of$' \
    "which is said"
is "$("$PREFENV" ndf turned.exr -o x.ndf.exr --scale 3 -q 2>&1)" "" "but not with --quiet"

# A part that lay askew: 0.002 of the height range a texel along x, so a slope of -0.016.
oiiotool --pattern "fill:left=0,0,0:right=0.05,0.05,0.05" 512x512 3 -d float -o ramp.exr
oiiotool turned.exr --divc 8 ramp.exr --add -d float -o askew.exr
near "its tilt is told" "$(measured '.tilt[0]' askew.exr --scale 8)" -0.00078278 0.01
near "and taken off" "$(measured '.alpha[1]' askew.exr --scale 8)" 0.10255 0.03

# What was not measured.
oiiotool turned.exr --fill:color=nan,nan,nan 10x10+100+100 -d float -o hole.exr
is "$(measured '.missing' hole.exr --wrap --scale 1)" 220 "a hole takes its surroundings along"

# ---- normal maps ----

# One facet: p = 0.25, q = -0.5 with green down, stored with 16 bits; length 1.145644.
facet()
{
    oiiotool --pattern "constant:color=0.609109,0.281782,0.936436" 16x16 3 -d uint16 -o facet.png
}
facet || bail_out "oiiotool does not work"
like "$(measured '.tilt | map(. * 1000 | round)' facet.png --normal-map directx)" '^\[250,-500\]$' "green down"
like "$(measured '.tilt | map(. * 1000 | round)' facet.png --normal-map opengl)" '^\[250,500\]$' "green up"
like "$(measured '.tilt | map(. * 1000 | round)' facet.png --normal-map opengl --turn)" '^\[500,-250\]$' "turned"
is "$(measured '.range[0] < 0.01' facet.png --normal-map opengl)" true "levelled, a facet is flat"
is "$(measured '.range[0] > 0.24' facet.png --normal-map opengl --keep-tilt)" true "but not with --keep-tilt"

# ---- the table ----

is "$(measured '[.range, .beyond > 0.1]' turned.exr --range 0.1 2>/dev/null)" '[[0.1,0.1],true]' "--range"
like "$("$PREFENV" ndf turned.exr -o x.ndf.exr --range 0.1 2>&1 >/dev/null)" \
    '^prefenv: ndf: warning: [0-9]* % of the area is steeper than the range and left out; widen --range$' "a warning"
"$PREFENV" ndf turned.exr -o sharp.ndf.exr -q --range 0.3 --raw
"$PREFENV" ndf turned.exr -o soft.ndf.exr -q --range 0.3 --smooth 0.02
peak()
{
    oiiotool --stats "$1" | sed -n 's/.*Stats Max: \([0-9.]*\) .*/\1/p'
}
ok "--smooth lowers the peak: $(peak sharp.ndf.exr) to $(peak soft.ndf.exr)" \
    awk -v a="$(peak sharp.ndf.exr)" -v b="$(peak soft.ndf.exr)" 'BEGIN { exit !(b > 0 && b < a / 2) }'

is "$(measured '.smooth' turned.exr --smooth 0.02)" '[0.02,0.02]' "and is told"
is "$(measured '.smooth' turned.exr --raw)" '[0,0]' "--raw does without"
is "$(measured '.smooth as $s | .rms_slope as $r | [($s[0] > 0.002 * $r[0]), ($s[0] < 0.3 * $r[0])]' turned.exr)" \
    '[true,true]' "else the width is found"

# ---- rounding ----

oiiotool turned.png -d uint8 -o coarse.png
like "$("$PREFENV" ndf coarse.png -o x.ndf.exr --scale 8 2>&1 >/dev/null)" 'rounded so coarsely.*16 bits or floats' \
    "8 bits are too few, and that is said"
is "$("$PREFENV" ndf turned.png -o x.ndf.exr --scale 8 2>&1 >/dev/null)" "" "16 are enough"

# ---- refused ----

refused "no scale" "turned.png: does not say its scale; give the height .* \(--height 20um --pitch 1.5um\).*--scale" \
    turned.png
refused "a pitch alone" "--height is missing" turned.png --pitch 1um
refused "a height alone" "--pitch is missing" turned.png --height 1um
refused "two scales" "--scale is --height divided by --pitch" turned.png --scale 1 --height 1um --pitch 1um
refused "a scale of normals" "a normal map holds slopes as it is" facet.png --normal-map opengl --scale 2
refused "wrapped normals" "a normal map holds slopes as it is" facet.png --normal-map opengl --wrap
refused "raw and smooth" "--raw and --smooth exclude each other" turned.exr --raw --smooth 0.1
refused "normals as heights" "heights are grey, but texel \(0, 0\) is .*; is it a normal map" facet.png --scale 1
refused "green sideways" "--normal-map vulkan: not known; what there is: none, opengl, directx" \
    facet.png --normal-map vulkan
refused "no file" "missing.png" missing.png --scale 1
refused "no unit" "--height 3 um: a length is wanted" turned.png --height "3 um" --pitch 1um
oiiotool --pattern constant:color=0,0,0 7x7 3 -d uint16 -o small.png
refused "too small" "small.png: 7 x 7 heights are too few; at least 8 x 8" small.png --scale 1
oiiotool --pattern constant:color=0,0,0 16x16 3 -d uint8 -o black.png
refused "black normals" "black.png: no texel holds a normal that faces out" black.png --normal-map opengl
refused "a range of nothing" "--range 0: out of range: 0.004 to 100" turned.exr --range 0
like "$("$PREFENV" ndf turned.exr -o turned.exr 2>&1)" "turned.exr" "the surface itself is not written over"

# ---- what the files say of themselves ----

"$PREFENV" ndf turned.exr -o a.ndf.exr --wrap --json >said || bail_out "ndf does not work"
info=$("$PREFENV" info --json a.ndf.exr)
is "$(jq -c '[.file, .kind, .width, .height]' <<<"$info")" \
    "[\"a.ndf.exr\",\"table\",$(jq .width said),$(jq .height said)]" "info of a table: its size"
near "its width" "$(jq '.alpha[1]' <<<"$info")" "$(jq '.alpha[1]' said)" 0.02
near "and rms slope" "$(jq '.rms_slope[1]' <<<"$info")" "$(jq '.rms_slope[1]' said)" 0.02
like "$("$PREFENV" info a.ndf.exr)" '^kind       table of slopes, for bake --ndf$' "and in text"
info=$("$PREFENV" info --json turned.exr)
is "$(jq -c '[.kind, .width, .height, .pitch]' <<<"$info")" '["heights",512,512,1]' "info of heights: size and pitch"
near "and width" "$(jq '.alpha[1]' <<<"$info")" "$(measured '.alpha[1]' turned.exr)" 1e-9
like "$("$PREFENV" info turned.exr)" '^heights    512x512 texels of 1 um, 512 by 512 um$' "and in text"
for input in turned.exr turned.png; do
    said=$("$PREFENV" bake missing.hdr -o x.exr --ndf $input 2>&1)
    like "$said" "^prefenv: bake: $input: is not .*; make (a table of slopes|one of .*) with prefenv ndf$" \
        "bake --ndf $input points to prefenv ndf"
done

done_testing
