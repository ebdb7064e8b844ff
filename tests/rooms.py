#!/usr/bin/env python3
"""Holds every #include of engine/ and app/ against the room table of the design. Also: each header has #pragma once."""
import pathlib
import re
import sys

ROOMS = {
    "base": set(),
    "graph": {"base"},
    "gl": {"base"},
    "assets": {"base"},
    "scene": {"base", "assets"},
    "passes": {"base", "graph", "gl", "scene", "assets"},
    "runtime": {"base", "graph", "gl", "assets", "scene", "passes"},
    "app": {"base", "graph", "gl", "assets", "scene", "passes", "runtime"},
}
# Third-party headers by prefix, and the rooms that may name them (directly).
OUTSIDE = {
    "fmt/": set(ROOMS),
    "nlohmann/": {"base", "graph", "assets", "scene", "app"},
    "glad/": {"gl", "passes", "runtime"},
    "EGL/": {"gl"},
    "GL/": {"gl"},
    "GLFW/": {"gl", "app"},
    "stb_": {"assets"}, "stb/": {"assets"}, "tinyexr": {"assets"}, "assimp/": {"assets"},
    "glm/": {"scene", "passes", "runtime", "app"},
    "CLI/": {"app"}, "imgui": {"app"}, "benchmark/": {"app"}, "tbb/": {"assets", "runtime"},
}


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    problems, seen = [], 0
    for room, allowed in ROOMS.items():
        folder = top / ("app" if room == "app" else f"engine/{room}")
        for path in sorted(folder.rglob("*")):
            if path.suffix not in {".h", ".cpp"}:
                continue
            seen += 1
            text = path.read_text()
            if path.suffix == ".h" and "#pragma once" not in text:
                problems.append(f"{path}: header without #pragma once")
            for number, line in enumerate(text.splitlines(), 1):
                found = re.match(r'\s*#\s*include\s+[<"]([^>"]+)[>"]', line)
                if not found:
                    continue
                name = found.group(1)
                own = re.match(r"engine/(\w+)/|(app)/", name)
                if own:
                    other = own.group(1) or own.group(2)
                    if other != room and other not in allowed:
                        problems.append(f"{path}:{number}: room '{room}' may not include '{other}'")
                for prefix, rooms in OUTSIDE.items():
                    if name.startswith(prefix) and room not in rooms:
                        problems.append(f"{path}:{number}: room '{room}' may not include <{name}>")
    print("\n".join(problems) or f"rooms: {seen} files, every include allowed")
    return 1 if problems or not seen else 0


sys.exit(main())
