#!/usr/bin/env bash
# Installs the build to a temporary prefix and builds and runs tests/docs/embed against it with find_package(weft), as an
# embedder would. Usage: embed_test.sh SOURCE_DIR BINARY_DIR
set -euo pipefail
source=$1 binary=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$binary" --prefix "$folder/prefix" >"$folder/log" || { cat "$folder/log"; exit 1; }
cmake -S "$source/tests/docs/embed" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$folder/prefix" >"$folder/log"
cmake --build "$folder/build" >"$folder/log" || { cat "$folder/log"; exit 1; }
"$folder/build/embed" | tee "$folder/plan"
grep -q '^passes\|^plan sky' "$folder/plan"
grep -q 'framebuffer 1280x720 color ldr' "$folder/plan"
# The core is the core: no OpenGL, no window library.
! ldd "$folder/build/embed" | grep -Ei 'libGL|EGL|OSMesa|glfw'
# With the runtime: an import and a pass type of the program's own.
if [ -x "$folder/build/extend" ]; then
  graph=$source/tests/docs/embed/extend.json
  "$folder/build/extend" "$graph" "$folder/0.png" 0
  "$folder/build/extend" "$graph" "$folder/again.png" 0
  "$folder/build/extend" "$graph" "$folder/1.png" 1
  python3 "$source/tests/docs/embed_picture.py" "$folder/0.png" "$folder/again.png" "$folder/1.png"
elif [ -x "$folder/prefix/bin/weft" ]; then
  echo "the runtime was installed, but find_package(weft OPTIONAL_COMPONENTS runtime) gave no weft::runtime" >&2
  exit 1
fi
if [ -x "$folder/prefix/bin/weft" ]; then
  WEFT_DATA="$folder/prefix/share/weft" "$folder/prefix/bin/weft" check "$folder/prefix/share/weft/graphs/studio.json"
fi
