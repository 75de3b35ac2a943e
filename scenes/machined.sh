# machined.sh - the four surfaces of surfaces.pov; read after common.sh by surfaces.sh and small.sh.
#
#   machined_kinds                     their names
#   machined_measure KIND [OPTION...]  into the working folder KIND.heights.exr, its distribution KIND.ndf.exr, and
#                                      KIND.plot.exr for the picture; the options are those of `prefenv surface`

machined_kinds='turned milled blasted brushed'

# The two with grooves are a little rougher than they would be by themselves: a finer lobe along the grooves takes
# longer to bake and shows no more.
machined_measure()
{
    local kind=$1 roughness=

    shift
    case $kind in turned | milled) roughness='--roughness 0.24um' ;; esac
    # shellcheck disable=SC2086 # an option and its value
    "$PREFENV" surface $kind -o $kind.heights.exr --quiet $roughness "$@" &&
        "$PREFENV" ndf $kind.heights.exr -o $kind.ndf.exr --wrap --turn --quiet &&
        "$PREFENV" ndf $kind.heights.exr -o $kind.plot.exr --wrap --turn --range 0.35 --quiet ||
        die "$kind was not measured; see above"
}
