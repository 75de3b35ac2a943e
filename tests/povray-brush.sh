#!/bin/bash
# The brush direction, point by point: it follows texture, object and whatever the texture stands in; along u and v; in
# circles around an axis; turned by a pattern.  Each is held to `prefenv exact`, or to another way to say the same; and
# the maps, baked for many angles, to the reference of the same block.
#
# On a sphere about the origin, circles around y stand across the lines along y at every point: brushing around y with
# the widths A, B is brushing along y with the widths B, A.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

size=40
chart chart.hdr 64 32

# texture BLOCK [TRANSFORMATIONS]
texture()
{
    echo "texture { pigment { rgb 1 } finish { ambient 0 diffuse 0 reflection { 1"
    echo "  prefiltered_environment { hdr \"chart.hdr\" $1 } } } ${2:-} }"
}

# picture NAME OBJECT: NAME.exr of it
picture()
{
    scene "$1.pov" <<END
camera { location -3*z direction z right x up y rotate <30, 40, 10> }
$2
END
    rm -f "$1.exr"
    render "$1.pov" +W$size +H$size +FE "+O$1.exr" || note "$said"
}

sphere() # NAME BLOCK [OF-THE-TEXTURE [OF-THE-OBJECT]]
{
    picture "$1" "sphere { 0, 1 $(texture "samples 1000 $2" "${3:-}") ${4:-} }"
}

# same NAME A B: the same picture, but for half floats and rounding
same()
{
    ok "$1" "$PREFENV" diff "$2.exr" "$3.exr" --fail-above-relative 0.002 || note "$tap_output"
}

# nearly NAME A B: the same, but for samples of their own
nearly()
{
    ok "$1" "$PREFENV" diff "$2.exr" "$3.exr" --fail-above-relative 0.03 || note "$tap_output"
}

# exactly NAME PICTURE OPTION...: within 1 % of prefenv exact in the mean
exactly()
{
    "$rays" rays $size 3 30,40,10 0,0,0 | "$PREFENV" exact chart.hdr "${@:3}" >wanted.txt || note 'prefenv exact failed'
    ok "$1" "$rays" check "$2.exr" 3 0.2 0.01 <wanted.txt && note "$tap_output"
}

# ---- one direction ----

sphere along 'roughness 0.4, 0.15 direction <1, 2, 0.5>'
exactly 'direction VECTOR: prefenv exact --direction' along --alpha 0.4,0.15 --direction 1,2,0.5
sphere across 'roughness 0.15, 0.4 direction <1, 2, 0.5>'
fails '... which the widths tell apart' "$PREFENV" diff along.exr across.exr --fail-above-relative 0.1
sphere turned 'roughness 0.4, 0.15 direction <1, 2, 0.5> rotate <10, 50, 20>' '' 'rotate <10, 50, 20>'
"$rays" rays $size 3 30,40,10 10,50,20 | "$PREFENV" exact chart.hdr --alpha 0.4,0.15 --direction 1,2,0.5 >wanted.txt
ok 'environment and object turned' "$rays" check turned.exr 3 0.2 0.01 <wanted.txt && note "$tap_output"

sphere axis 'roughness 0.4, 0.15 direction y'
sphere texture 'roughness 0.4, 0.15 direction x' 'rotate 90*z'
same 'it follows the texture' texture axis
sphere object 'roughness 0.4, 0.15 direction x' '' 'rotate 90*z'
same 'it follows the object' object axis
sphere both 'roughness 0.4, 0.15 direction x' 'rotate 90*y' 'rotate 90*x translate 3*z translate -3*z'
same 'it follows both, one after the other' both axis
sphere scaled 'roughness 0.4, 0.15 direction <1, 1, 0>' 'scale <1, 3, 1> rotate 20*z' \
    'rotate -20*z scale <1, 1, 5> scale <1, 1, 1/5>'
sphere sheared 'roughness 0.4, 0.15 direction <1, 3, 0>'
nearly 'it is stretched with the texture, as grooves would be' scaled sheared
sphere world 'roughness 0.4, 0.15' 'rotate 90*z' 'rotate 90*x'
same 'without a direction it stands along y in the environment, come what may' world axis

# ---- textures in textures ----

x_brushed=$(texture 'samples 1000 roughness 0.4, 0.15 direction x' | sed 's/^texture {\(.*\)/\1/; $s/}[[:space:]]*$//')
picture nested "sphere { 0, 1
  texture { gradient x texture_map { [0 $x_brushed] [1 $x_brushed rotate 90*x] } rotate 90*z } }"
same 'it follows the texture_map that it is in' nested axis
picture averaged "sphere { 0, 1 texture { average texture_map { [1 $x_brushed] } rotate 90*z } }"
same '... and the average' averaged axis
picture shared "#declare Brushed = texture { $x_brushed }
sphere { 0, 1 texture { Brushed rotate 90*y } rotate 70*z clipped_by { plane { y, 5 } } scale 0.001 }
sphere { 0, 1 texture { Brushed rotate 90*z } }"
same 'textures of one name are turned each for itself' shared axis
picture layers "sphere { 0, 1 texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 } }
  texture { $(sed 's/rgb 1/rgbt 1/' <<<"$x_brushed") rotate 90*z } }"
same 'layers' layers axis

# ---- around an axis ----

sphere around 'roughness 0.15, 0.4 direction rotate y'
exactly 'direction rotate y: along y with the widths exchanged' around --alpha 0.4,0.15 --direction 0,1,0
sphere around_x 'roughness 0.15, 0.4 direction rotate x' 'rotate 90*z'
same '... and the axis follows the texture' around_x around
picture away "sphere { <5, 0, 0>, 1 $(texture 'samples 1000 roughness 0.15, 0.4 direction rotate y' 'translate 5*x')
  translate -5*x }"
same '... and so does the place of the axis' away around

# ---- u and v ----

sphere uv 'roughness 0.15, 0.4 uv_mapping direction x'
exactly 'uv_mapping direction x: along u, which goes around y' uv --alpha 0.4,0.15 --direction 0,1,0
sphere uv_v 'roughness 0.4, 0.15 direction y uv_mapping'
nearly 'direction y: along v' uv_v uv
picture uv_object "sphere { 0, 1 uv_mapping $(texture 'samples 1000 roughness 0.15, 0.4 direction x') }"
same 'an object that is uv-mapped has its direction along u by itself' uv_object uv
picture uv_texture "sphere { 0, 1 texture { uv_mapping $(texture 'samples 1000 roughness 0.15, 0.4 direction x' |
    sed 's/^texture {\(.*\)/\1/; $s/}[[:space:]]*$//') } }"
same '... and so has a uv-mapped texture' uv_texture uv
sphere uv_turned 'roughness 0.15, 0.4 uv_mapping direction x' '' 'rotate <40, 50, 60>'
sphere around_turned 'roughness 0.15, 0.4 direction rotate y' '' 'rotate <40, 50, 60>'
same 'u and v follow the object' uv_turned around_turned

mesh() # NAME BLOCK: four triangles whose u stands at 30 degrees to x
{
    picture "$1" "mesh2 {
  vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <1, 1, 0>, <-1, 1, 0> }
  normal_vectors { 4, <-0.5, -0.5, -1>, <0.5, -0.5, -1>, <0.5, 0.5, -1>, <-0.5, 0.5, -1> }
  uv_vectors { 4, <-1.3660254, -0.3660254>, <0.3660254, -1.3660254>, <1.3660254, 0.3660254>, <-0.3660254, 1.3660254> }
  face_indices { 2, <0, 1, 2>, <0, 2, 3> }
  $(texture "samples 1000 roughness 0.15, 0.4 $2") rotate <30, 40, 10> }"
}
mesh mesh_uv 'uv_mapping direction x'
mesh mesh_world 'direction <0.8660254, 0.5, 0>'
mesh mesh_other 'direction <0.8660254, -0.5, 0>'
nearly 'a mesh: along its own u' mesh_uv mesh_world
fails '... which could have been otherwise' "$PREFENV" diff mesh_uv.exr mesh_other.exr --fail-above-relative 0.01

# ---- a pattern ----

sphere quarter 'roughness 0.15, 0.4 direction y pattern { function { 0.25 } }'
exactly 'a pattern of a quarter turn: across' quarter --alpha 0.4,0.15 --direction 0,1,0
sphere half 'roughness 0.4, 0.15 direction y pattern { function { 0.5 } }'
nearly 'half a turn: as before' half axis
plane='samples 1000 roughness 0.4, 0.15'
picture tilted "plane { z, 0 $(texture "$plane direction y pattern { function { 30/360 } }") }"
picture clockwise "plane { z, 0 $(texture "$plane direction <sin(pi/6), cos(pi/6), 0>") }"
same 'a twelfth: clockwise, as it is seen' tilted clockwise
sphere halves 'roughness 0.4, 0.15 direction x pattern { gradient x translate -1/2*x scale 4 sine_wave }' 'rotate 90*z'
sphere halves_world 'roughness 0.4, 0.15 direction y pattern { gradient y translate -1/2*y scale 4 sine_wave }'
same 'the pattern follows the texture' halves halves_world

# ---- maps ----

# maps NAME BOUND BLOCK OBJECT: the maps of as many angles as a bake has by itself against the reference of the block
chart smooth.hdr 256 128 0
maps()
{
    picture "$1" "${4/TEXTURE/$(texture "$3" | sed 's/chart/smooth/')}"
    picture "$1-reference" "${4/TEXTURE/$(texture "$3 samples 4000" | sed 's/chart/smooth/')}"
    ok "$1: the maps, to $2 of their reference" \
        "$PREFENV" diff "$1.exr" "$1-reference.exr" --fail-above-relative "$2" &&
        note "$(grep 'relative RMSE' <<<"$tap_output")"
}

maps turned-disc 0.01 'roughness 0.1, 0.3 direction rotate z' 'disc { 0, z, 1.5 TEXTURE }'
maps turned-object 0.01 'roughness 0.3, 0.1 direction <1, 2, 3>' \
    'cylinder { -y, y, 0.6 TEXTURE rotate <30, 0, 70> scale <1, 1, 1.5> }'
maps uv-sphere 0.01 'roughness 0.3, 0.1 direction <1, 2> uv_mapping' 'sphere { 0, 1 TEXTURE rotate <30, 0, 70> }'
maps patterned 0.01 'roughness 0.1, 0.3 direction y pattern { bozo scale 0.5 }' 'sphere { 0, 1 TEXTURE }'

bake chart.hdr -o fixed.exr --alpha 0.3,0.1
scene fixed.pov <<<'sphere { 0, 1 finish { reflection { 1 prefiltered_environment { exr "fixed.exr" direction x } } } }'
render fixed.pov +W8 +H8 -F
like "$render_status $said" \
    '^0 .*line 4: Parse Warning: .*baked for one brush direction, so direction changes nothing' \
    'a maps file of one direction is warned of'

done_testing
