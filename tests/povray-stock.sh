#!/bin/bash
# Scenes that know nothing of Prefenv: the patched renderer gives the same picture as POV-Ray 3.7.0.10, bit for bit, and
# takes no word from them.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

[ -n "${POVRAY_STOCK:-}" ] && [ -x "$POVRAY_STOCK" ] || skip_all 'there is no unpatched POV-Ray to compare with'
share=$(dirname "$POVRAY_STOCK")/share/povray-stock
[ -d "$share/scenes" ] || skip_all "$share/scenes does not exist"

# The pixels alone: the head of the file holds the date.  Two pictures that are missing are no picture.
same_pixels() # PIXELS
{
    [ -s stock.ppm ] && [ -s ours.ppm ] && cmp <(tail -c $((6 * $1)) stock.ppm) <(tail -c $((6 * $1)) ours.ppm)
}

# One thread: what radiosity and photons gather depends on the order of work, in both renderers.
options=(-D -V +W80 +H60 +WT1 +FP16 "+L$share/include")

for name in \
    textures/finishes/metallicreflection textures/finishes/var_reflection textures/finishes/arches \
    textures/normals/normavg textures/normals/bumpmap textures/pigments/irid textures/pigments/mapper \
    textures/pigments/matmap textures/pigments/txtrmap textures/interior_texture interior/ballbox1 interior/magglass \
    interior/media/media1 interior/skysph2 radiosity/radiosity3 advanced/woodbox advanced/chess2 objects/blob; do
    file=$share/scenes/$name.pov
    options_here=("${options[@]}" "+L$(dirname "$file")" "+I$file")
    said=$("$POVRAY_STOCK" "${options_here[@]}" +Ostock.ppm 2>&1) || note "stock: $(tail -n 3 <<<"$said")"
    said=$("$POVRAY_PREFENV" "${options_here[@]}" +Oours.ppm 2>&1) || note "ours: $(tail -n 3 <<<"$said")"
    ok "$name: the same bits" same_pixels 4800
    rm -f stock.ppm ours.ppm
done

cat >identifier.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
#declare prefiltered_environment = 0.25;
#macro Ambient(prefiltered_environment) rgb prefiltered_environment #end
plane { z, 1 pigment { rgb 1 } finish { ambient Ambient(2 * prefiltered_environment) diffuse 0 } }
END
ok 'without #version unofficial, prefiltered_environment is free for identifiers' \
    render identifier.pov +W4 +H4 +FP16 +Oours.ppm
"$POVRAY_STOCK" "${options[@]}" +Iidentifier.pov +W4 +H4 +Ostock.ppm >/dev/null 2>&1
ok '... and keeps its value' same_pixels 16

cat >included.inc <<'END'
#version unofficial 3.7;
END
cat >included.pov <<'END'
#version 3.7;
#declare prefiltered_environment = 1;
#declare Before = prefiltered_environment;
#include "included.inc"
#version 3.7;
#ifdef (prefiltered_environment) #declare Still = 1; #end
#declare prefiltered_environment = 2;
END
rejected 'once an include file asks for it, the word stays reserved' \
    "File 'included.pov' line 7: Parse Error:.*prefiltered_environment" included.pov

done_testing
