#!/usr/bin/env bash
# Builds a native drill of example_service by its own project file, with nothing but what `cmake --install` wrote, and flies it.
#   native_build.sh BUILD_FOLDER VENDOR DRILL
# VENDOR: folder of example_service/native; DRILL: folder of tests/missions whose mission and logbook it flies with.
set -euo pipefail
build=$1 vendor=$2 drill=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder/prefix" >"$folder/log"
cd /
cmake -S "$folder/prefix/share/rocinante/example_service/native/$vendor" -B "$folder/build" -DCMAKE_BUILD_TYPE=Debug \
  -Drocinante_IDL_DIR="$folder/prefix/share/rocinante/idl" >>"$folder/log"
cmake --build "$folder/build" --parallel 2 >>"$folder/log" || { tail -n 40 "$folder/log"; exit 1; }
cp -r "$build/tests/missions/$drill/borehole" "$folder/borehole"
cp "$folder/build/drill_svc" "$folder/borehole/bin/drill_svc"
"$folder/prefix/bin/roci-launch" "$folder/borehole" --speed max --headless --json --run-folder "$folder/run" | tail -n 1
