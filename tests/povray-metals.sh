#!/bin/bash
# The finished metals of prefenv.inc: every macro makes a texture, of any kind of file; those of one roughness share a
# bake; their colours are those of the metals, and their grooves lie as their names say.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

chart chart.hdr 32 16
chart chart.HDR 32 16
cat >white.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
plane { z, 1 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 1 } }
END
render white.pov +W16 +H8 +FE +Owhite.exr
render white.pov +W16 +H8 +FN +Owhite.png

include=$(dirname "$POVRAY_PREFENV")/share/povray-prefenv/include/prefenv.inc
macros=$(sed -n 's/^#macro \([A-Z][a-z]*_[A-Z][a-z]*\)(File) Prefenv_Metal.*/\1/p' "$include")
is "$(wc -w <<<"$macros")" 14 'the metals of prefenv.inc'

# Each on a sphere of its own, and each once more.
{
    echo 'sky_sphere { pigment { Prefenv_Sky("chart.hdr") } }'
    for macro in $macros $macros; do
        echo "sphere { 0, 1 texture { $macro(\"chart.hdr\") rotate 30*z } rotate 10*x }"
    done
} | scene all.pov
render all.pov +W8 +H8 -F || note "$said"
is "$render_status" 0 'all of them'
is "$(grep -o 'prefiltered_environment: baking' <<<"$said" | wc -l)" 4 '... of four bakes'

# colour NAME FILE MACRO: the middle of a sphere of it
colour()
{
    scene colour.pov <<<"camera { orthographic location -3*z direction z right x/10 up y/10 } sphere { 0, 1 $1 }"
    render colour.pov +W1 +H1 +FE +Ocolour.exr >/dev/null || note "$said"
    oiiotool colour.exr --echo '{TOP.AVGCOLOR}'
}

near() # NAME RGB WANTED
{
    ok "$1" awk -v a="$2" -v b="$3" 'BEGIN {
        n = split(a, x, ","); split(b, y, ",")
        for (i = 1; i <= 3; i++)
            if (n < 3 || (x[i] - y[i])^2 > 1e-4) exit 1
    }' || note "$2"
}

near 'Polished_Gold under a white sky: gold' "$(colour 'texture { Polished_Gold("white.exr") }')" '0.931,0.787,0.408'
near '... as a PNG' "$(colour 'texture { Polished_Gold("white.png") }')" '0.931,0.787,0.408'
near 'Prefenv_Metal takes any colour' \
    "$(colour 'texture { Prefenv_Metal("white.exr", <0.2, 0.4, 0.6>, <0.2, 0.2>, Prefenv_Unbrushed) }')" '0.2,0.4,0.6'

# picture NAME TEXTURE
picture()
{
    scene "$1.pov" <<<"camera { location -3*z direction z right x up y rotate 30*x } sphere { 0, 1 texture { $2 } }"
    render "$1.pov" +W32 +H32 +FE "+O$1.exr" || note "$said"
}

block='hdr "chart.hdr" roughness <0.05, 0.2>'
picture turned 'Turned_Steel("chart.hdr")'
picture spelt "pigment { rgb Prefenv_Iron } finish { ambient 0 diffuse 0 reflection { 1 metallic
  prefiltered_environment { $block direction rotate y transform { Prefenv_Frame } } } }"
ok 'Turned_Steel goes around y' "$PREFENV" diff turned.exr spelt.exr --fail-above 0
sed -i 's/^#include/#declare Prefenv_Frame = transform { rotate 90*y }\n#include/' turned.pov
render turned.pov +W32 +H32 +FE +Oframe.exr
fails 'Prefenv_Frame turns the environment' "$PREFENV" diff turned.exr frame.exr --fail-above 0.01
sed -i 's/^#include/#declare Prefenv_Accuracy = 0.05;\n#include/' turned.pov
render turned.pov +W32 +H32 +FE +Oaccurate.exr
fails 'Prefenv_Accuracy makes other maps' "$PREFENV" diff frame.exr accurate.exr --fail-above 0

done_testing
