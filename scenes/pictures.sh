# pictures.sh - how figures.sh and teapot.sh make maps and pictures; read after common.sh, in the folder of the figures.
#
# What is up to date is left as it is, and said to be: a picture if it is no older than its scene, its maps and the
# renderer, and was made by the same command.  The reader sets
#
#   figures scenes   the folder of the figures and that of the scenes
#   inputs           the files that every picture is made from, besides its scene

say()
{
    printf '%-10s %s\n' "$1" "$2"
}

# value FILE.json KEY: a number or string out of what `prefenv --json` printed, a line a key
value()
{
    sed -n 's/^ *"'"$2"'": *"\{0,1\}\([^",]*\)"\{0,1\},\{0,1\}$/\1/p' "$1" | head -n 1
}

# same COMMAND FILE: was the command in FILE this one?
same()
{
    [ -f "$2" ] && [ "$(cat "$2")" = "$1" ]
}

# bake ENVIRONMENT NAME OPTION...: work/NAME.exr; NAME.json says what the bake said, and how long it took
bake()
{
    local hdri=$1 name=$2 target=work/$2.exr begun command

    shift 2
    command="$PREFENV bake $hdri -o $target $*"
    if newer "$target" "$hdri" "$PREFENV" && [ -f "work/$name.seconds" ] && same "$command" "work/$name.txt"; then
        say "$name.exr" 'up to date'
        return
    fi
    rm -f "work/$name.txt"
    begun=$(now)
    "$PREFENV" bake "$hdri" -o "$target" --quiet "$@" || die "$name.exr was not baked; see above"
    seconds_since "$begun" >"work/$name.seconds"
    "$PREFENV" info --json "$target" >"work/$name.json"
    echo "$command" >"work/$name.txt"
    say "$name.exr" "baked in $(cat "work/$name.seconds") s"
}

# png NAME: NAME.exr as NAME.png
png()
{
    ln -sf "../$1.exr" work/picture.exr
    render "work/$1.png.log" "$scenes/view.pov" "work/$1.part.png" "+W$2" "+H$3" -A +Lwork
    mv "work/$1.part.png" "$1.png"
}

# exr NAME SCENE WIDTH HEIGHT OPTION...: NAME.exr and NAME.png; its trace time goes into work/NAME.seconds
exr()
{
    local name=$1 scene=$scenes/$2 width=$3 height=$4 command

    shift 4
    command="$POVRAY_PREFENV +I$scene +O$figures/$name.exr +FE +W$width +H$height $* +L$figures/work +L$scenes -D"
    if newer "$name.exr" "$scene" "${inputs[@]}" "$POVRAY_PREFENV" &&
        newer "$name.png" "$name.exr" "$scenes/view.pov" && same "$command" "$name.txt"; then
        say "$name" "up to date, traced in $(cat "work/$name.seconds") s"
        return
    fi
    rm -f "$name.txt"
    render "work/$name.log" "$scene" "work/$name.part.exr" "+W$width" "+H$height" "$@" +Lwork
    echo "$trace_seconds" >"work/$name.seconds"
    mv "work/$name.part.exr" "$name.exr"
    png "$name" "$width" "$height"
    echo "$command" >"$name.txt"
    say "$name" "traced in $(cat "work/$name.seconds") s"
}

# sheet NAME INPUT...: NAME.png out of NAME.pov and other figures' PNGs; as large as panels.inc says
sheet()
{
    local name=$1 columns side enlarged width height

    shift
    columns=$(sed -n 's/^#declare Columns = \([0-9]*\);/\1/p' "$scenes/$name.pov")
    side=$(sed -n 's/.*#declare Side = \([0-9]*\);.*/\1/p' "$scenes/$name.pov")
    enlarged=$(sed -n 's/^#declare Enlarged = \([0-9]*\);/\1/p' "$scenes/$name.pov")
    side=${side:-384} enlarged=${enlarged:-1}
    width=$((columns * (side + 12) + 12)) height=$((80 + side + enlarged * (12 + side)))
    if newer "$name.png" "$@" "$scenes/$name.pov" "$scenes/panels.inc" "$0"; then
        say "$name" 'up to date'
        return
    fi
    render "work/$name.log" "$scenes/$name.pov" "work/$name.part.png" "+W$width" "+H$height" +A0.0 +AM1 +R4 -J \
        +L. +Lwork
    mv "work/$name.part.png" "$name.png"
    echo "$POVRAY_PREFENV +I$scenes/$name.pov +O$figures/$name.png +W$width +H$height +A0.0 +AM1 +R4 -J" \
        "+L$figures +L$figures/work +L$scenes -D" >"$name.txt"
    say "$name" 'done'
}
