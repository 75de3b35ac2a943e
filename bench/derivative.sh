#!/bin/bash
# bench/derivative.sh - `make derivative`: a sphere under the courtyard by the paper's maps and by the default ones, and
# the second derivative of both, as figures/derivative.png of the build tree.

set -euo pipefail

: "${PREFENV:?call this through make}" "${DERIVATIVE:?}" "${PREFENV_DATA:?}" "${top_builddir:?}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
mkdir -p "$top_builddir/figures"
cd "$work"
"$PREFENV" bake "$PREFENV_DATA/hdri/courtyard.exr" -o paper --paper --quiet
"$PREFENV" bake "$PREFENV_DATA/hdri/courtyard.exr" -o default --quiet
"$DERIVATIVE" "$top_builddir/figures/derivative.png" paper default
echo "$top_builddir/figures/derivative.png"
