#!/usr/bin/env python3
"""Holds every #include of engine/, importers/ and app/ against the tables below: rooms (folders of engine/, importers and app) and sub-rooms (folders inside a
room, along its pipeline), and finds circles of #includes and headers without #pragma once. In engine/, importers/, app/, tests/ and shaders/ every
folder has less than 25 source files, and every source file at most 800 lines. A .cpp file of engine/ or app/ without a header of its own
shows which header declares its functions: the only one of its folder that it includes, or "Declared in x.h" in its first comment. An
import in a folder of its own (lamps/lamps.cpp) is declared in the builtin.h above.

    rooms.py TOP
"""
import pathlib
import re
import sys

ROOMS = {
    "text": set(),
    "graph": {"text"},
    "glsl": {"text"},
    "gl": {"text", "glsl"},
    "assets": {"text"},
    "scene": {"text", "assets"},
    "passes": {"text", "graph", "glsl", "gl", "scene", "assets"},
    "imports": {"text", "graph", "glsl", "gl", "assets", "scene"},
    "runtime": {"text", "graph", "glsl", "gl", "assets", "scene", "passes", "imports"},
    "importers": {"text", "graph", "glsl"},
    "app": {"text", "graph", "glsl", "gl", "assets", "scene", "passes", "imports", "runtime", "importers"},
}
# Sub-rooms and which others of their room each may include. "." is the door: files in the room's own folder. Each line may name
# earlier lines only, so that no arrow runs upward.
SUB_ROOMS = {
    "text": {".": set(), "files": {"."}, "words": {".", "files"}, "json": {".", "files"}},
    "graph": {
        "language": set(),
        ".": {"language"},
        "versions": {"."},
        "pick": {".", "language"},
        "read": {".", "language"},
        "expand/names": {".", "language", "versions", "pick"},
        "expand/judge": {".", "language", "versions", "expand/names"},
        "expand": {".", "language", "versions", "pick", "expand/names", "expand/judge"},
        "compile": {".", "versions"},
        "print": {".", "language", "pick", "compile"},
        "edit": {".", "language", "read", "expand/names", "expand"},
        "survey": {".", "language", "expand"},
    },
    "assets": {
        "images": set(),
        "loading": set(),
        ".": {"images"},
        "models/parts": {".", "images"},
        "models/gltf": {".", "models/parts"},
        "models/fbx": {".", "images", "models/parts"},
        "models/obj": {".", "models/parts"},
        "models": {".", "images", "models/parts", "models/gltf", "models/fbx", "models/obj"},
    },
    "scene": {".": set(), "frame": {"."}, "models": {".", "frame"}, "files": {".", "frame", "models"}},
    "gl": {
        "context": set(),
        "objects": {"context"},
        "programs": {"context", "objects"},
    },
    "runtime": {
        "storage": set(),
        "cadence": {"storage"},
        "imports": {"storage"},
        "prepare": {"storage", "imports"},
        "uniforms": {"storage", "cadence", "imports", "prepare"},
        "frame": {"storage", "cadence", "imports", "prepare", "uniforms"},
        "inspection": {"frame", "storage", "prepare"},
    },
    "app": {
        "output": set(),
        "session": {"output"},
        "live": {"session", "output"},
        "ui": {"session", "output", "live"},
        "view": {"session", "output", "live", "ui"},
        "lsp": {"session", "output"},
        "trials": {"session", "output"},
        "commands": {"session", "output", "live", "trials"},
        ".": {"session", "output", "commands", "view", "lsp"},
    },
}
MOST_FILES = 24
MOST_LINES = 800
SOURCES = {".h", ".cpp", ".py", ".glsl"}
# Files that define no function that another file calls.
UNDECLARED = {"app/main.cpp", "engine/assets/images/stb_implementation.cpp"}
# Third-party headers by prefix, and the rooms that may name them (directly).
OUTSIDE = {
    "fmt/": set(ROOMS),
    "nlohmann/": {"text", "graph", "assets", "scene", "importers", "app"},
    "glad/": {"gl", "passes", "imports", "runtime"},
    "GL/": {"gl"},
    "GLFW/": {"gl", "app"},
    "stb_": {"assets"}, "stb/": {"assets"}, "OpenEXR/": {"assets"}, "Imath/": {"assets"}, "assimp/": {"assets"}, "draco/": {"assets"}, "meshoptimizer": {"assets"}, "webp/": {"assets"},
    "glm/": {"assets", "scene", "passes", "imports", "runtime", "importers", "app"},
    "CLI/": {"app"}, "imgui": {"app"}, "benchmark/": {"app"}, "tbb/": {"assets", "scene"},
}


def check_tables() -> list[str]:
    problems = []
    for room, table in SUB_ROOMS.items():
        earlier: set[str] = set()
        for sub, allowed in table.items():
            problems += [f"{room}/{sub}: the arrow to {room}/{other} runs upward" for other in sorted(allowed - earlier)]
            earlier.add(sub)
    return problems


def check_page(top: pathlib.Path) -> list[str]:
    """CONTRIBUTING.md has the table of rooms."""
    rows, above = {}, set()
    for room, words in re.findall(r"^\| `(?:engine/)?(\w+)` \| ([\w, ]+)", (top / "CONTRIBUTING.md").read_text(), re.M):
        rows[room] = set(above) if words.startswith("all above") else set(words.strip().split(", ")) - {"nothing"}
        above.add(room)
    return [f"CONTRIBUTING.md: room '{room}' may include {sorted(rows.get(room, ()))}, here {sorted(ROOMS.get(room, ()))}"
            for room in sorted(ROOMS.keys() | rows.keys()) if rows.get(room) != ROOMS.get(room)]


def room_of(name: str) -> tuple[str, str] | None:
    """(room, sub-room) of an include or of a path below the top folder; the sub-room of a file at the door is '.'."""
    parts = name.split("/")
    if parts[0] == "engine" and len(parts) > 2:
        return parts[1], "/".join(parts[2:-1]) or "."
    if parts[0] in ("app", "importers") and len(parts) > 1:
        return parts[0], "/".join(parts[1:-1]) or "."
    return None


def includes_of(text: str) -> list[tuple[int, str]]:
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r'\s*#\s*include\s+[<"]([^>"]+)[>"]', line)
        if match:
            found.append((number, match.group(1)))
    return found


def find_circle(edges: dict[str, list[str]]) -> list[str]:
    """A circle of files that include each other, or nothing."""
    done: set[str] = set()
    for start in edges:
        path: list[str] = []
        work = [(start, iter(edges[start]))] if start not in done else []
        path += [start] if work else []
        while work:
            following = next(work[-1][1], None)
            if following is None:
                done.add(work.pop()[0])
                path.pop()
            elif following in path:
                return path[path.index(following):] + [following]
            elif following in edges and following not in done:
                path.append(following)
                work.append((following, iter(edges[following])))
    return []


def check_file(name: str, text: str, arrows: set) -> list[str]:
    room, sub = room_of(name) or ("", "")
    if room not in ROOMS:
        return [f"{name}: no room of that name in the table"]
    problems, table = [], SUB_ROOMS.get(room, {})
    if table and sub not in table:
        problems.append(f"{name}: room '{room}' has no sub-room '{sub}' in the table")
    if name.endswith(".h") and "#pragma once" not in text:
        problems.append(f"{name}: header without #pragma once")
    for number, included in includes_of(text):
        other = room_of(included)
        if other and other[0] != room and other[0] not in ROOMS[room]:
            problems.append(f"{name}:{number}: room '{room}' may not include '{other[0]}'")
        if other and other[0] == room and table and other[1] != sub:
            arrows.add((room, sub, other[1]))
            if other[1] not in table.get(sub, set()):
                problems.append(f"{name}:{number}: sub-room '{room}/{sub}' may not include '{room}/{other[1]}'")
        for prefix, rooms in OUTSIDE.items():
            if included.startswith(prefix) and room not in rooms:
                problems.append(f"{name}:{number}: room '{room}' may not include <{included}>")
    return problems


def check_header(name: str, text: str, files: set[str]) -> list[str]:
    """Whether a reader sees which header declares the functions of a .cpp file."""
    if not name.endswith(".cpp") or name in UNDECLARED or name.removesuffix(".cpp") + ".h" in files:
        return []
    folder = name.rpartition("/")[0] + "/"
    above, _, kind = folder.rstrip("/").rpartition("/")
    if name == f"{folder}{kind}.cpp" and any(included == above + "/builtin.h" for _, included in includes_of(text)):
        return []
    headers = {included.removeprefix(folder) for _, included in includes_of(text) if included.rpartition("/")[0] + "/" == folder}
    opening = re.match(r"(?://.*\n)*", text).group()
    declared = set(re.findall(r"\bDeclared in (\w+\.h)", opening))
    if declared - headers:
        return [f"{name}: declared in {', '.join(sorted(declared - headers))}, which is no header of its folder that it includes"]
    if len(headers) == 1 or declared:
        return []
    return [f"{name}: has no header of its own and includes {len(headers)} of its folder: say \"Declared in x.h\" in its first comment"]


def check_sizes(top: pathlib.Path) -> tuple[list[str], dict[str, int]]:
    """Problems, and the number of source files of each folder."""
    problems: list[str] = []
    per_folder: dict[str, int] = {}
    for room in ("engine", "importers", "app", "tests", "shaders"):
        for path in sorted((top / room).rglob("*")):
            if path.suffix not in SOURCES:
                continue
            folder, lines = path.parent.relative_to(top).as_posix(), path.read_text().count("\n")
            per_folder[folder] = per_folder.get(folder, 0) + 1
            if lines > MOST_LINES:
                problems.append(f"{path.relative_to(top)}: {lines} lines, more than {MOST_LINES}: split it by what it does")
    problems += [f"{folder}: {count} source files, more than {MOST_FILES}: split it by topic"
                 for folder, count in per_folder.items() if count > MOST_FILES]
    return problems, per_folder


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    problems, arrows = check_tables() + check_page(top), set()
    edges: dict[str, list[str]] = {}
    texts: dict[str, str] = {}
    for path in sorted([path for room in ("engine", "importers", "app") for path in (top / room).rglob("*")]):
        if path.suffix not in {".h", ".cpp"}:
            continue
        name, text = path.relative_to(top).as_posix(), path.read_text()
        edges[name] = [included for _, included in includes_of(text)]
        problems += check_file(name, text, arrows)
        texts[name] = text
    for name, text in texts.items():
        problems += check_header(name, text, set(texts))
    sizes, per_folder = check_sizes(top)
    problems += sizes
    circle = find_circle(edges)
    if circle:
        problems.append("files include each other: " + " -> ".join(circle))
    print("\n".join(problems) or f"rooms: {len(edges)} files, every include allowed, {len(arrows)} arrows between sub-rooms, none upward, "
          f"at most {max(per_folder.values())} files in a folder")
    return 1 if problems or not edges else 0


if __name__ == "__main__":
    sys.exit(main())
