#!/bin/sh
# Builds the library of the take's viewer anew: three.js with its reader of glTF, as one script without modules.
#
#   tools/build_viewer.sh          builds it in a temporary folder and compares it with the committed one
#   tools/build_viewer.sh --write  and puts it in place of that
#
# Node.js and npm are needed for this alone. Both packages are asked for by their exact versions; neither has
# dependencies but esbuild's own program for this computer, whose version is that of esbuild.
set -eu

THREE=0.187.0
ESBUILD=0.28.2

here=$(cd "$(dirname "$0")" && pwd)
viewer=$here/../station/render/report/take/viewer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp "$here/viewer/entry.js" "$work/entry.js"
cd "$work"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund --no-package-lock --ignore-scripts "three@$THREE" "esbuild@$ESBUILD"
node_modules/.bin/esbuild entry.js --bundle --minify --format=iife --global-name=stationThree --target=es2020 \
    --legal-comments=none --log-level=warning --banner:js="// three.js $THREE, MIT: see three.LICENSE beside it" \
    --outfile=three.js

if [ "${1:-}" = --write ]; then
    cp three.js "$viewer/three.js"
    cp node_modules/three/LICENSE "$viewer/three.LICENSE"
fi
cmp three.js "$viewer/three.js"
cmp node_modules/three/LICENSE "$viewer/three.LICENSE"
echo "three.js $THREE: as committed, $(wc -c <three.js) bytes"
