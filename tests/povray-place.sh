#!/bin/bash
# Where the renderer finds its files: beside itself as in the build tree, under its prefix once installed, through a
# symbolic link, and together with the user's own settings; and that it says what it is.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

include=$(dirname "$POVRAY_PREFENV")/share/povray-prefenv/include
[ -f "$include/prefenv.inc" ] || bail_out "$include/prefenv.inc does not exist"

scene names.pov <<'END'
#include "colors.inc"
#debug concat("linear is ", str(Prefenv_Linear, 0, 0), "\n")
sphere { 0, 1 }
END

# Its own words, from the first line on, but for the banner.
finds() # NAME RENDERER [OPTION...]
{
    said=$("$2" +Inames.pov -D -F +W4 +H4 "${@:3}" 2>&1)
    like "$said" 'linear is 3' "$1: POV-Ray's include files and Prefenv's own"
    is "$(grep -Ei 'cannot|warning:|restrictions are' <<<"$said")" '' '... without a complaint'
}

finds 'where it was built' "$POVRAY_PREFENV"

mkdir -p prefix/bin prefix/share/povray-prefenv elsewhere
cp "$POVRAY_PREFENV" prefix/bin/povray-prefenv
cp -R "$include" prefix/share/povray-prefenv/
finds 'installed' "$work/prefix/bin/povray-prefenv"
cd prefix/bin && cp "$work/names.pov" . && finds 'called by a relative name' ./povray-prefenv
cd "$work" || exit
ln -s ../prefix/bin/povray-prefenv elsewhere/glossy
finds 'through a symbolic link' elsewhere/glossy

cp "$POVRAY_PREFENV" elsewhere/alone
fails 'alone, it has no include files' elsewhere/alone +Inames.pov -D -F +W4 +H4

# ---- settings ----

width()
{
    "$work/prefix/bin/povray-prefenv" +Inames.pov -D +H4 +Owidth.png >/dev/null 2>&1
    # the width stands in bytes 17 to 20 of a PNG
    od -An -t u1 -j 16 -N 4 width.png | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'
}

echo 'Width=17' >prefix/share/povray-prefenv/povray.ini
is "$(width)" 17 'povray.ini beside the include files is read'
mkdir -p .povray/3.7
echo 'Width=23' >.povray/3.7/povray.ini
is "$(width)" 23 "the user's povray.ini goes before it"
finds '... and takes nothing away' "$work/prefix/bin/povray-prefenv"
echo 'Width=29' >mine.ini
is "$(POVINI=mine.ini width)" 29 'POVINI goes before that'

# ---- what it is ----

version=$("$POVRAY_PREFENV" --version 2>&1)
like "$version" '^POV-Ray 3\.7\.0\.10\.unofficial' '--version: POV-Ray, unofficial'
like "$version" 'It is modified: Prefenv adds prefiltered_environment' '... modified, and by what'
like "$version" 'The POV-Ray Team is not responsible' '... and whom not to ask'

done_testing
