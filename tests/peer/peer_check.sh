#!/bin/bash
# peer_check.sh - `make peer-check`: our pictures against Mitsuba 3's, by peer.py and bunny.py, some six minutes.
#
# Mitsuba comes from the Python package index into a virtual environment of its own in the cache, once; it is no part of
# `make check`.  The table, table.md and table.json, and the pictures of Fig. 7 are written into peer/ of the build
# tree.

set -euo pipefail
export LC_ALL=C

mitsuba=3.9.1
numpy=2.4.6

die()
{
    printf 'make peer-check: %s\n' "$*" >&2
    exit 1
}

for name in PREFENV PREFENV_CACHE PREFENV_DATA srcdir top_builddir; do
    [ -n "${!name:-}" ] || die "$name is not set: call this through make"
done
hdri=$PREFENV_DATA/hdri/courtyard.exr
[ -f "$hdri" ] || die "$hdri does not exist: run ./bootstrap, which fetches it"

python=$PREFENV_CACHE/peer/mitsuba-$mitsuba-numpy-$numpy/bin/python
if ! [ -x "$python" ]; then
    folder=${python%/bin/python}
    trap 'rm -rf "$folder"' EXIT
    mkdir -p "${folder%/*}"
    rm -rf "$folder"
    python3 -m venv "$folder" || die 'python3 cannot make a virtual environment; as root: apt-get install python3-venv'
    echo "installing Mitsuba $mitsuba into $folder"
    "$folder/bin/pip" install --quiet --disable-pip-version-check "mitsuba==$mitsuba" "numpy==$numpy" ||
        die "pip could not install Mitsuba $mitsuba; see above"
    trap - EXIT
fi

renderer=()
[ -z "${POVRAY_PREFENV:-}" ] || renderer=(--povray "$POVRAY_PREFENV" --scenes "$srcdir/scenes")
status=0
"$python" "$srcdir/tests/peer/peer.py" --prefenv "$PREFENV" --environment "$hdri" --output "$top_builddir/peer" \
    "${renderer[@]}" "$@" || status=$?
if [ -n "${POVRAY_PREFENV:-}" ]; then
    "$python" "$srcdir/tests/peer/bunny.py" --povray "$POVRAY_PREFENV" --environment "$hdri" \
        --mesh "$PREFENV_DATA/bunny.obj" --output "$top_builddir/peer" || status=$?
fi
[ ! -f "$top_builddir/peer/table.md" ] || cat "$top_builddir/peer/table.md"
exit $status
