#!/usr/bin/env python3
"""Holds engine/ to this: nobody outside the folder of a plug-in (engine/imports/TYPE, engine/passes/TYPE) knows its name. What
others do by type comes from reflection. Names of geometries count too; they stand in engine/passes/draw. Nor does anybody else
compare with the name of an argument of an import.

    plug_ins.py TOP
"""
import pathlib
import re
import sys

# The same word for something else, as (file, word): what it is there.
OTHER_MEANINGS = {
    ("engine/assets/models/gltf/gltf.cpp", "mesh"): "a key of glTF",
    ("engine/assets/models/gltf/gltf.cpp", "meshes"): "a key of glTF",
    ("engine/assets/models/gltf/gltf.cpp", "materials"): "a key of glTF",
    ("engine/assets/models/gltf/gltf_materials.cpp", "materials"): "a key of glTF",
    ("engine/assets/models/gltf/gltf_document.cpp", "materials"): "a key of glTF",
    ("engine/assets/models/gltf/gltf.cpp", "joints"): "a key of glTF",
    ("engine/assets/models/gltf/gltf.cpp", "camera"): "a key of glTF",
    ("engine/assets/models/fbx/reader.cpp", "mesh"): "a key of glTF",
    ("engine/assets/models/fbx/reader.cpp", "meshes"): "a key of glTF",
    ("engine/assets/models/fbx/reader.cpp", "materials"): "a key of glTF",
    ("engine/assets/models/fbx/reader.cpp", "joints"): "a key of glTF",
    ("engine/scene/scene.cpp", "spheres"): "a draw list",
    ("engine/scene/files/scene_file.cpp", "spheres"): "a key of scene files",
    ("engine/scene/files/scene_file.cpp", "materials"): "a key of scene files",
    ("engine/scene/files/lights.cpp", "sun"): "a key of scene files",
    ("engine/scene/files/lights.cpp", "lamps"): "a key of scene files",
    ("engine/scene/files/scene_file.cpp", "ground"): "a key of scene files",
    ("engine/imports/scene_tables.cpp", "joints"): "an attribute of vertices",
    ("engine/passes/draw/geometry.cpp", "position"): "an attribute of vertices",
    ("engine/graph/read/read.cpp", "name"): "a key of graphs",
    ("engine/graph/read/overlay.cpp", "name"): "a key of graphs",
    ("engine/text/words/words.cpp", "image"): "how types of GLSL begin",
    ("engine/glsl/interface.cpp", "image"): "how types of GLSL begin",
    ("engine/gl/programs/glsl_type.cpp", "image"): "how types of GLSL begin",
    ("engine/graph/subresource.h", "image"): "a kind of use",
    ("engine/graph/read/read_parts.cpp", "mips"): "a key of textures",
    ("engine/graph/read/read_parts.cpp", "compute"): "a rule of the language: what a pass without a type is, by its shader",
    ("engine/graph/read/read_parts.cpp", "draw"): "as compute",
    ("engine/graph/read/read_parts.cpp", "fullscreen"): "as compute",
    ("engine/graph/read/read_parts.cpp", "file"): "a rule of the language: arguments of this name, and of names that end so, hold paths",
}
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
ARGUMENT = re.compile(r'\bargument\("(\w+)"')
COMPARED = re.compile(r'[=!]= "(\w+)"|"(\w+)" [=!]=')
GEOMETRY = re.compile(r'\{(?:\.name = )?"(\w+)", ')


def strip_comments(text: str) -> str:
    """C++ without its comments, lines kept. What looks like one within a literal is left alone."""
    token = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)+\'', re.S)
    def keep(match: re.Match) -> str:
        return "\n" * match.group().count("\n") if match.group().startswith("/") else match.group()
    return token.sub(keep, text)


def names_of_plug_ins(top: pathlib.Path) -> dict[str, str]:
    """Type names by the folder that may say them: the first name of what each reflects."""
    names = {}
    for room in ("imports", "passes"):
        for folder in sorted(p for p in (top / "engine" / room).iterdir() if p.is_dir()):
            text = "".join(strip_comments(p.read_text()) for p in sorted(folder.glob("*.cpp")))
            reflected = re.findall(r"(?:\breflect\(\) \{\s*return|PassType reflected =) \{\s*\.name = \"(\w+)\"", text)
            for name in reflected:
                names[name] = f"engine/{room}/{folder.name}"
            if reflected != [folder.name] and folder.name not in {"tables", "lights"}:
                sys.exit(f"engine/{room}/{folder.name}: it should reflect '{folder.name}', found {reflected}")
    draw = strip_comments((top / "engine/passes/draw/geometry.cpp").read_text())
    body = draw[draw.index("kTopologies[] = {"):]
    for name in GEOMETRY.findall(body[:body.index("return types;")]):
        names[name] = "engine/passes/draw"
    return names


def arguments_of_plug_ins(top: pathlib.Path) -> dict[str, str]:
    """Names of arguments of imports by the folder that may compare with them."""
    return {name: path.parent.relative_to(top).as_posix() for path in sorted((top / "engine/imports").glob("*/*.cpp"))
            for name in ARGUMENT.findall(re.sub(r"\s+", " ", strip_comments(path.read_text())))}


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    names, arguments = names_of_plug_ins(top), arguments_of_plug_ins(top)
    problems, unused, files = [], dict(OTHER_MEANINGS), 0
    for path in sorted((top / "engine").rglob("*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        name, files = path.relative_to(top).as_posix(), files + 1
        for number, line in enumerate(strip_comments(path.read_text()).splitlines(), 1):
            if re.match(r"\s*#\s*include", line):
                continue
            for word in ("".join(pair) for pair in COMPARED.findall(line)):
                if word not in arguments or name.startswith(arguments[word] + "/"):
                    continue
                if unused.pop((name, word), None) is None and (name, word) not in OTHER_MEANINGS:
                    problems.append(f"{name}:{number}: compares with \"{word}\", an argument of {arguments[word]}: let ImportArgument say "
                                    "what is to be known")
            for word in LITERAL.findall(line):
                if word not in names or name.startswith(names[word] + "/"):
                    continue
                if unused.pop((name, word), None) is None and (name, word) not in OTHER_MEANINGS:
                    problems.append(f"{name}:{number}: knows \"{word}\", which is of {names[word]}: let its reflect() say what is "
                                    "to be known, and go by that")
    problems += [f"tests/plug_ins.py: {name} does not say \"{word}\" any more: take the line out" for name, word in unused]
    print("\n".join(problems) or f"plug-ins: {files} files, {len(names)} names ({', '.join(sorted(names))}), each said in its folder only; "
          f"{len(arguments)} arguments, compared with in theirs only")
    return 1 if problems or len(names) < 11 or not arguments else 0


if __name__ == "__main__":
    sys.exit(main())
