#!/bin/bash
# bench/derivative.sh - `make derivative`: a sphere under the courtyard by the paper's maps and by the default ones, and
# the second derivative of both, as figures/derivative.png of the build tree; and the same of brushed metal whose brush
# points nearly at the viewer, where tangents turn fast, as figures/derivative_brushed.png.

set -euo pipefail

: "${PREFENV:?call this through make}" "${DERIVATIVE:?}" "${PREFENV_DATA:?}" "${top_builddir:?}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
mkdir -p "$top_builddir/figures"
cd "$work"

derive() # NAME OPTION...
{
    "$PREFENV" bake "$PREFENV_DATA/hdri/courtyard.exr" -o paper --paper --quiet "${@:2}"
    "$PREFENV" bake "$PREFENV_DATA/hdri/courtyard.exr" -o default --quiet "${@:2}"
    echo "$top_builddir/figures/$1.png"
    "$DERIVATIVE" "$top_builddir/figures/$1.png" paper default
}

derive derivative
derive derivative_brushed --alpha 0.1,0.03 --direction 0.2,0.3,-1
