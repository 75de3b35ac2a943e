# small.sh - every scene, small: what is rendered for scenes/reference/ and compared with it; read after common.sh by
# references.sh and tests/scenes.sh.
#
#   small_prepare      bakes and links into the working folder what the scenes ask for: seconds, not minutes, so the
#                      maps are small
#   small_scenes       the names, in the order in which they have to be rendered: the last ones show others
#   small_render NAME  NAME.png in the working folder
#   small_bound NAME   the greatest RMSE, in linear values, that NAME.png may be away from its reference

small_scenes='bunny mask fig4b fig5a fig5b fig5c fig6a fig6b fig6c fig6d fig6e fig6f fig7_mask fig7a fig7b fig7c
    ten_lines cylinder spheres gallery turned teapot fig4 fig6 fig7 readme surfaces view
    workshop street teapot8 contact teapot6a teapot6b teapot7_mask teapot7a teapot7b pixels difference teapot7 worn'

small_prepare()
{
    local courtyard=$PREFENV_DATA/hdri/courtyard.exr studio=$PREFENV_DATA/hdri/studio.exr alpha kind

    for file in "$courtyard" "$studio"; do
        [ -f "$file" ] || die "$file does not exist: run ./bootstrap, which fetches it"
    done
    ln -sf "$courtyard" courtyard.exr
    ln -sf "$courtyard" environment.exr
    ln -sf "$studio" studio.exr
    make_mesh .
    make_teapot .
    small_bake environment.exr maps.exr --paper --size 100x50
    small_bake environment.exr hemispheres.exr --normals 162 --size 40x40
    small_bake environment.exr baseline.exr --size 100x50 --method baseline
    small_bake courtyard.exr brushed.pe.exr --alpha 0.1,0.03 --paper --size 100x50
    ln -sf brushed.pe.exr brushed42.exr
    small_bake environment.exr brushed.exr --alpha 0.1,0.03 --error 0.05
    small_bake environment.exr workshop.pe.exr --alpha 0.15 --normals 162 --size 40x40
    small_bake studio.exr studio.pe.exr --method representative --size 64x32 --normals 12
    for alpha in 0.02 0.05 0.10 0.20 0.40; do
        small_bake courtyard.exr alpha-$alpha.pe.exr --alpha $alpha --method representative --size 64x32 --normals 12
    done
    . "$srcdir/scenes/machined.sh"
    for kind in $machined_kinds; do
        machined_measure $kind --size 256x256
        small_bake studio.exr surface-$kind.pe.exr --ndf $kind.ndf.exr --method representative --size 64x32 --normals 12
    done
    ln -sf "$courtyard" panorama.exr
    cat >fig6_numbers.inc <<'END'
#declare Traced_Samples = 2;
#declare Reference_Samples = 1;
#declare Mse_C = 3;
#declare Mse_D = 4;
#declare Mse_E = 5;
#declare Mse_F = 6;
END
    cat >fig7_numbers.inc <<'END'
#declare Reference7_Samples = 1;
#declare Mse7_B = 2;
#declare Mse7_C = 3;
END
    cat >teapot7_numbers.inc <<'END'
#declare Mean_Voxels = 2;
#declare Mean_Layers = 1;
END
}

small_bake() # ENVIRONMENT MAPS OPTION...
{
    "$PREFENV" bake "$1" -o "$2" --quiet "${@:3}" || die "$2 was not baked; see above"
}

# small_frame NAME png|exr OPTIONS: the first frame of an animation, as NAME_001.png too
small_frame()
{
    # shellcheck disable=SC2086
    render "$1.log" "$srcdir/scenes/$1.pov" "$1_.$2" +KFI1 +KFF695 +SF1 +EF1 +L. $3
    [ "$2" != png ] || cp "$1_001.png" "$1.png"
}

small_render()
{
    local size='+W128 +H128 -A'

    case $1 in
        bunny) size='+W128 +H128 +A0.1 +AM2 +R2 -J' ;;
        fig5a) size='+W160 +H80 -A' ;;
        fig5b | fig5c) size='+W160 +H133 +A0.1 -J' ;;
        fig6a) size="$size Declare=Samples=128" ;;
        fig6b | fig7a) size="$size Declare=Samples=1024" ;;
        gallery) size='+W192 +H128 +A0.3 -J' ;;
        turned) size='+W192 +H128 +A0.1 -J' ;;
        ten_lines) size='+W160 +H120 -A' ;;
        spheres) size='+W240 +H60 -A' ;;
        fig4) size='+W240 +H220 +A0.0 +AM1 +R2 -J Declare=Side=64 Declare=Picture_Side=128' ;;
        fig6) size='+W468 +H220 +A0.0 +AM1 +R2 -J Declare=Side=64 Declare=Picture_Side=128' ;;
        fig7) size='+W240 +H220 +A0.0 +AM1 +R2 -J Declare=Side=64 Declare=Picture_Side=128' ;;
        readme) size='+W164 +H144 +A0.0 +AM1 +R2 -J Declare=Side=64 Declare=Picture_Side=128' ;;
        teapot7) size='+W392 +H220 +A0.0 +AM1 +R2 -J Declare=Side=64 Declare=Picture_Side=128' ;;
        worn) size='+W192 +H128 +A0.1 +AM2 +R2 -J' ;;
        contact) size='+W326 +H186 +A0.0 +AM1 +R2 -J Declare=Frames=1' ;;
        workshop) size='+W160 +H120 -A Declare=Rays=128' ;;
        teapot6?) size='+W128 +H64 -A' ;;
        surfaces) size='+W235 +H235 +A0.1 +AM2 +R2 -J' ;;
        view)
            # shellcheck disable=SC2086 # the options are a list of words
            render picture.log "$srcdir/scenes/fig6f.pov" picture.exr $size +L.
            ;;
    esac
    # shellcheck disable=SC2086
    case $1 in
        street) # a PNG to look at, an EXR for teapot8
            small_frame street png '+W128 +H64 +A0.05 +AM1 +R3 -J'
            small_frame street exr '+W128 +H64 +A0.05 +AM1 +R3 -J'
            small_bake street_001.exr street_001.pe.exr --method layers
            ;;
        teapot6?) # a PNG to look at, an EXR for teapot7
            render "$1.log" "$srcdir/scenes/$1.pov" "$1.png" $size +L.
            render "$1.log" "$srcdir/scenes/$1.pov" "$1.exr" $size +L.
            small_bake "$1.exr" "layers-${1#teapot6}.exr" --method layers
            ;;
        teapot7?) # the same; phong-b-0 and layers-b-0 are for pixels, difference and teapot7
            render "$1.log" "$srcdir/scenes/$1.pov" "$1.png" $size +L.
            render "$1.log" "$srcdir/scenes/$1.pov" "$1.exr" $size +L.
            ;;
        pixels | difference)
            ln -sf teapot7b.exr picture.exr
            ln -sf teapot7a.exr reference.exr
            render "$1.log" "$srcdir/scenes/$1.pov" "$1.png" $size +L.
            ;;
        teapot7)
            cp teapot7a.png phong-b-0.pixels.png
            cp pixels.png layers-b-0.pixels.png
            cp pixels.png voxels-b-0.pixels.png
            cp difference.png layers-b-0.difference.pixels.png
            cp difference.png voxels-b-0.difference.pixels.png
            render "$1.log" "$srcdir/scenes/$1.pov" "$1.png" $size +L.
            ;;
        worn) # it bakes by itself, but for a brushed metal, of a smaller environment
            mkdir -p worn
            render worn.log "$srcdir/scenes/fig5a.pov" worn/environment.exr +W128 +H64 -A +L.
            cp teapot_mesh.inc worn/
            small_bake worn/environment.exr worn/brushed.pe.exr --alpha 0.02-0.15 --aspect 0.33 --fast
            (cd worn && render worn.log "$srcdir/scenes/worn.pov" ../worn.png $size +L.)
            ;;
        teapot8) small_frame teapot8 png '+W128 +H96 -A' ;;
        gallery | turned)
            # They bake by themselves; of a smaller environment, so that it takes seconds.
            mkdir -p "$1"
            render "$1.log" "$srcdir/scenes/fig5a.pov" "$1/environment.exr" +W128 +H64 -A +L.
            (cd "$1" && ln -sf environment.exr studio.exr && render "$1.log" "$srcdir/scenes/$1.pov" "../$1.png" $size)
            ;;
        *) render "$1.log" "$srcdir/scenes/$1.pov" "$1.png" $size +L. ;;
    esac
}

# Other processors round otherwise in the last bits, and that is all that should differ.  The noise of a Monte Carlo
# picture, though, hangs on the last bit of every normal, and a picture of differences, four times as large as they are,
# on how good a bake is.  (The workshop without its rays is 0.15 away; fig6a is 0.034 away with other rays, and 0.10
# with one bounce.)
small_bound()
{
    case $1 in
        workshop | gallery | fig6a) echo 0.05 ;;
        fig6b | fig7a | difference | teapot7) echo 0.02 ;;
        fig6) echo 0.01 ;;
        fig7 | readme | turned) echo 0.005 ;;
        *) echo 0.002 ;;
    esac
}
