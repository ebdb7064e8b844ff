#!/usr/bin/env bash
# Installs the build to a temporary prefix and builds and runs tests/docs/embed against it with find_package(weft), as an
# embedder would. Usage: embed_test.sh SOURCE_DIR BINARY_DIR
set -euo pipefail
source=$1 binary=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$binary" --prefix "$folder/prefix" >"$folder/log" || { cat "$folder/log"; exit 1; }
# The public headers are few: who adds one shows why an embedder needs it.
[ "$(find "$folder/prefix/include/weft/engine" -name '*.h' | wc -l)" -le 25 ] || { echo "more than 25 public headers" >&2; exit 1; }
cmake -S "$source/tests/docs/embed" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$folder/prefix" >"$folder/log"
cmake --build "$folder/build" >"$folder/log" || { cat "$folder/log"; exit 1; }
"$folder/build/embed" | tee "$folder/plan"
grep -q '^passes\|^plan sky' "$folder/plan"
grep -q 'framebuffer 1280x720 color ldr' "$folder/plan"
# The core is the core: no OpenGL, no window library.
if ldd "$folder/build/embed" | grep -Ei 'libGL|EGL|OSMesa|glfw'; then echo "the core links OpenGL" >&2; exit 1; fi
# The same by pkg-config: the program says the same.
pc_folder=$(dirname "$(find "$folder/prefix" -name weft-graph.pc)")
by_pkg_config() {
  # shellcheck disable=SC2046 # flags are words
  g++ -std=c++20 "$source/tests/docs/embed/$1.cpp" -o "$folder/$1_pc" $(PKG_CONFIG_PATH=$pc_folder pkg-config --cflags --libs "$2")
}
by_pkg_config embed weft-graph
if ldd "$folder/embed_pc" | grep -Ei 'libGL|EGL|OSMesa|glfw'; then echo "weft-graph.pc links OpenGL" >&2; exit 1; fi
# Whatever is installed is named by a .pc file.
for library in "${pc_folder%/pkgconfig}"/libweft_*.a; do
  name=$(basename "$library" .a)
  grep -q -- "-l${name#lib}" "$pc_folder"/weft*.pc || { echo "no .pc file names $name" >&2; exit 1; }
done
"$folder/embed_pc" >"$folder/plan_pc"
cmp "$folder/plan" "$folder/plan_pc"
# With the runtime: an import and a pass type of the program's own.
if [ -x "$folder/build/extend" ]; then
  graph=$source/tests/docs/embed/extend.json
  "$folder/build/extend" "$graph" "$folder/0.png" 0
  "$folder/build/extend" "$graph" "$folder/again.png" 0
  "$folder/build/extend" "$graph" "$folder/1.png" 1
  python3 "$source/tests/docs/embed_picture.py" "$folder/0.png" "$folder/again.png" "$folder/1.png"
  by_pkg_config extend weft
  "$folder/extend_pc" "$graph" "$folder/pc.png" 0
  cmp "$folder/0.png" "$folder/pc.png"
elif [ -x "$folder/prefix/bin/weft" ]; then
  echo "the runtime was installed, but find_package(weft OPTIONAL_COMPONENTS runtime) gave no weft::runtime" >&2
  exit 1
fi
if [ -x "$folder/prefix/bin/weft" ]; then
  grep -q -e '-F _weft weft' "$folder/prefix/share/bash-completion/completions/weft"
  WEFT_DATA="$folder/prefix/share/weft" "$folder/prefix/bin/weft" check "$folder/prefix/share/weft/graphs/studio.json"
  for text in "$source"/app/commands/*.{json,glsl,sh}; do
    cmp "$text" "$folder/prefix/share/weft/app/commands/$(basename "$text")"
  done
fi
