#!/usr/bin/env python3
"""Holds the package list of ./run and the table of docs/dependencies.md against each other: equal names, equal order,
each with a reason. What the program needs and what its tests need besides are apart. And what the CMake files and the tests look for comes from a package of the list."""
import pathlib
import re
import sys

# What find_package, find_program, find_library and the tests' programs ask for, and the package that has it.
# None: does without.
PROVIDED = {
    "fmt": "libfmt-dev", "nlohmann_json": "nlohmann-json3-dev", "doctest": "doctest-dev", "CLI11": "libcli11-dev",
    "glfw3": "libglfw3-dev", "imgui": "libimgui-dev", "Freetype": "libfreetype-dev", "libstb": "libstb-dev", "glm": "libglm-dev", "OpenEXR": "libopenexr-dev", "ZLIB": "zlib1g-dev", "assimp": "libassimp-dev", "draco": "libdraco-dev", "meshoptimizer": "libmeshoptimizer-dev", "webp": "libwebp-dev", "cpp-httplib": "libcpp-httplib-dev", "TBB": "libtbb-dev", "glad": "python3-glad",
    "OSMesa": "libosmesa6-dev", "xvfb-run": "xvfb", "Xvfb": "xvfb", "xdotool": "xdotool", "dot": "graphviz",
    "glslangValidator": "glslang-tools", "clang-format": "clang-format", "jsonschema": "python3-jsonschema", "nvim": "neovim",
    "bash": None, "ccache": None, "git": None, "weft": None,
    "ffmpeg": "ffmpeg", "strace": "strace", "c++": "g++", "slurmctld": None, "slurmd": None, "sbatch": None, "chromium": None, "mpv": None, "node": None, "emacs": None,  # judges of imports and of the language server, and a cluster, which CI does without
}
# Needed without being looked for: by cmake, by xvfb-run, by snippets of the docs, at run time, or as a header only.
IMPLIED = {"g++", "fonts-dejavu-core", "cmake", "ninja-build", "python3", "xauth", "libegl1", "libgl1-mesa-dri", "libstb-dev", "graphviz", "pkg-config", "clang-16", "libclang-rt-16-dev", "mesa-vulkan-drivers"}


def sought(top: pathlib.Path) -> dict:
    """What is looked for, and where: in the program, else in the tests."""
    found = {}
    for path in [*top.glob("CMakeLists.txt"), *(p for f in ("engine", "importers", "app", "cmake", "tests") for p in (top / f).rglob("*"))]:
        if path.name != "CMakeLists.txt" and path.suffix not in {".cmake", ".py", ".sh", ".md"}:
            continue
        text = re.sub(r"^\s*#.*", "", path.read_text(), flags=re.M)
        names = re.findall(r"find_package\((\w+)", text) + re.findall(r"find_(?:program|library)\(\w+ ([\w-]+)", text)
        for modules in re.findall(r"pkg_(?:check|search)_module[s]?\(\w+([^)]*)\)", text):
            names += ["pkg-config", *(m for m in modules.split() if m.islower())]
        names += re.findall(r'which\("([\w-]+)"\)', text) + re.findall(r'find_spec\("(\w+)"\)', text)
        for name in names:
            found.setdefault(name, path.relative_to(top))
    return found


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    run = (top / "run").read_text()
    program, tests, fuzz, soak = (re.search(rf"^{name}=\(([^)]*)\)", run, re.M).group(1).split() for name in ("packages", "test_packages", "fuzz_packages", "soak_packages"))
    packages = program + tests + fuzz + soak
    rows = re.findall(r"^\| `([^`]+)` \|(.*)\|$", (top / "docs/dependencies.md").read_text(), re.M)
    named = [name for name, _ in rows]
    problems = [f"run installs '{p}', docs/dependencies.md does not say why" for p in packages if p not in named]
    problems += [f"docs/dependencies.md names '{p}', run does not install it" for p in named if p not in packages]
    problems += [f"docs/dependencies.md gives no reason for '{name}'" for name, why in rows if len(why.strip()) < 10]
    problems += [f"docs/dependencies.md names '{name}' twice" for name in set(named) if named.count(name) > 1]
    if not problems and named != packages:
        problems.append("docs/dependencies.md has another order than run")
    looked_for = sought(top)
    for name, path in sorted(looked_for.items()):
        if name not in PROVIDED:
            problems.append(f"{path} looks for '{name}', and PROVIDED in tests/dependencies.py does not say which package has it")
        elif PROVIDED[name] and PROVIDED[name] not in packages:
            problems.append(f"{path} looks for '{name}', run does not install {PROVIDED[name]}")
        elif path.parts[0] != "tests" and PROVIDED[name] in tests:
            problems.append(f"{path} looks for '{name}', and {PROVIDED[name]} is a package of the tests alone")
        elif path.parts[0] == "tests" and PROVIDED[name] in set(program) - IMPLIED:
            problems.append(f"run installs '{PROVIDED[name]}' for the program, and only {path} looks for '{name}'")
    used = {PROVIDED.get(name) for name in looked_for} | IMPLIED
    problems += [f"run installs '{p}', which nothing looks for" for p in packages if p not in used]
    print("\n".join(problems) or f"dependencies: {len(packages)} packages, each with its reason")
    return 1 if problems or not packages else 0


sys.exit(main())
