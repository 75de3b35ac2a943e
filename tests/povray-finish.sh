#!/bin/bash
# The finish: what POV-Ray shows on a sphere is what `prefenv eval` answers for the same normal and viewer, pixel by
# pixel, however camera, object and environment are turned; and both agree with the exact answer.
#
# The pictures are EXR, which POV-Ray writes as half floats: 2^-11, or 0.0005, is the rounding alone.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

size=64
chart chart.hdr 64 32
bake chart.hdr -o maps.exr --alpha 0.2 --normals 42 --size 64x32 --float
bake chart.hdr -o brushed.exr --alpha 0.3,0.1 --direction 1,2,0.5 --normals 42 --size 64x32 --float
bake chart.hdr -o baseline.exr --method baseline --alpha 0.2 --size 64x32 --float
bake chart.hdr -o fine.exr --alpha 0.2 --normals 1002 --size 128x64 --float

# Block, transformations of the sphere, rotation of the camera; picture.exr is the result.
sphere() # BLOCK TRANSFORMATIONS CAMERA
{
    scene sphere.pov <<END
camera { location -3*z direction z right x up y rotate <$3> }
sphere {
    0, 1
    pigment { rgb 1 }
    finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { $1 } } }
    $2
}
END
    rm -f picture.exr
    render sphere.pov +W$size +H$size +FE +Opicture.exr || note "$said"
}

# ... against COMMAND of prefenv, for rays in the frame of an environment turned by TURN.
agrees() # NAME "WORST [MEAN]" CAMERA TURN COMMAND...
{
    local name=$1 tolerance=$2 camera=$3 turn=$4

    shift 4
    "$rays" rays $size 3 "$camera" "$turn" | awk -v m="${mirrored:-1}" '{ print m * $1, $2, $3, m * $4, $5, $6 }' |
        "$PREFENV" "$@" >wanted.txt || note "prefenv $* failed"
    ok "$name" "$rays" check picture.exr 3 $tolerance <wanted.txt && note "$tap_output"
}

# ---- against eval ----

sphere 'exr "maps.exr"' '' 0,0,0
agrees 'the default is linear' 1e-3 0,0,0 0,0,0 eval maps.exr --interpolation linear
sphere 'exr "maps.exr" method Prefenv_Nearest' '' 0,0,0
agrees 'method 1 is nearest' 1e-3 0,0,0 0,0,0 eval maps.exr --interpolation nearest
sphere 'exr "maps.exr" method Prefenv_Weighted exponent 10' '' 0,0,0
agrees 'method 2 is weighted by the exponent' 1e-3 0,0,0 0,0,0 eval maps.exr --interpolation weighted --exponent 10
sphere 'exr "maps.exr" method 2' '' 0,0,0
agrees "method 2 without an exponent: eval's default" 1e-3 0,0,0 0,0,0 eval maps.exr --interpolation weighted
sphere 'exr "maps.exr" method 3 exponent 50' '' 0,0,0
agrees 'method 3 has no use for an exponent' 1e-3 0,0,0 0,0,0 eval maps.exr --interpolation linear
sphere 'exr "baseline.exr"' '' 0,0,0
agrees 'a baseline file' 1e-3 0,0,0 0,0,0 eval baseline.exr

sphere 'exr "maps.exr"' '' 20,130,-40
agrees 'the camera turned' 1e-3 20,130,-40 0,0,0 eval maps.exr
sphere 'exr "maps.exr" rotate <10, 50, 20>' '' 0,0,0
agrees 'the environment turned' 1e-3 0,0,0 10,50,20 eval maps.exr
sphere 'exr "maps.exr" rotate 10*x rotate 50*y transform { rotate 20*z }' '' 70,-15,5
agrees '... step by step, and the camera too' 1e-3 70,-15,5 10,50,20 eval maps.exr
mirrored=-1
sphere 'exr "maps.exr" scale <-1, 1, 1>' '' 0,40,0
agrees 'the environment mirrored' 1e-3 0,40,0 0,0,0 eval maps.exr
mirrored=1
sphere 'exr "maps.exr" scale 7' '' 0,40,0
agrees 'the environment scaled' 1e-3 0,40,0 0,0,0 eval maps.exr
sphere 'exr "maps.exr" rotate 30*y' \
    'scale <2, 3, 4> scale <1/2, 1/3, 1/4> rotate <30, 60, 80> translate <1, 2, 3> translate -<1, 2, 3>' 0,0,0
agrees 'the object transformed: the environment stays' 1e-3 0,0,0 0,30,0 eval maps.exr

sphere 'exr "brushed.exr"' '' 0,0,0
agrees 'brushed' 1e-3 0,0,0 0,0,0 eval brushed.exr
sphere 'exr "brushed.exr" rotate <10, 50, 20>' 'rotate <10, 50, 20>' 30,40,50
agrees 'brushed, environment and object turned together' 1e-3 30,40,50 10,50,20 eval brushed.exr

# ---- against the exact answer ----

sphere 'exr "fine.exr"' '' 20,30,0
agrees '1002 normals, linear: within 0.2 % of exact in the mean' '0.06 0.002' 20,30,0 0,0,0 exact chart.hdr --alpha 0.2
size=32
sphere 'hdr "chart.hdr" roughness 0.2 samples 20000' '' 20,30,0
agrees 'roughness and samples: within 0.3 % of exact in the mean' '0.08 0.003' 20,30,0 0,0,0 exact chart.hdr --alpha 0.2
sphere 'hdr "chart.hdr" roughness 0.3, 0.1 direction <1, 2, 0.5> samples 20000 rotate <10, 50, 20>' \
    'rotate <10, 50, 20>' 20,30,0
agrees '... brushed, with environment and object turned' '0.08 0.003' 20,30,0 10,50,20 \
    exact chart.hdr --alpha 0.3,0.1 --direction 1,2,0.5

# ---- the same picture every time ----

sphere 'hdr "chart.hdr" roughness 0.3 samples 7' '' 20,30,0
mv picture.exr first.exr
render sphere.pov +W$size +H$size +FE +Opicture.exr +WT1
ok 'samples: the same picture in another run, with another number of threads' \
    "$PREFENV" diff first.exr picture.exr --fail-above 0

done_testing
