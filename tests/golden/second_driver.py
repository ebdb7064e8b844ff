#!/usr/bin/env python3
"""Goldens on a second driver: Mesa's zink over lavapipe (Debian: mesa-vulkan-drivers), which takes OpenGL through Vulkan, with barriers and
memory that llvmpipe does not know. Each picture is one that a person cannot tell from the golden; and with fresh memory filled with either of two
patterns pictures and records of passes are equal to the byte, so that nothing undefined is read or recorded.

    second_driver.py WEFT      a few small cases; WEFT_ALL_GOLDENS=1 in the environment: all of them
"""
import glob
import json
import os
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "tests/app"))
from program import Report, run, temporary_folder  # noqa: E402

SMALL = ("glow_small", "view_front", "occlusion", "studio_gi_probes")
PATTERNS = ("1", "85")


def main():
    weft, report = sys.argv[1], Report()
    drivers = glob.glob("/usr/share/vulkan/icd.d/lvp_icd*.json")
    if not drivers:
        report.skip("no lavapipe in /usr/share/vulkan/icd.d (Debian: mesa-vulkan-drivers)")
    # Mesa 22.3: zink over a software driver crashes when it inlines a uniform that bounds a loop.
    environment = {**os.environ, "ZINK_INLINE_UNIFORMS": "0", "GALLIUM_DRIVER": "zink", "LIBGL_ALWAYS_SOFTWARE": "1", "VK_ICD_FILENAMES": drivers[0], "VK_DRIVER_FILES": drivers[0]}
    options = ("--backend", "egl", "--program-cache", "none")
    with temporary_folder() as folder:
        device = run(weft, "render", "graphs/glow.json", "--size", "16x9", *options, "--quiet", "--stats", "-o", f"{folder}/a.png", env=environment)
    if device.code != 0 or '"renderer": "zink' not in device.err:
        report.skip(f"EGL does not give zink: {device.err.strip()[:200]}")
    everything = os.environ.get("WEFT_ALL_GOLDENS") == "1"
    goldens = json.loads((HERE / "goldens.cases.json").read_text())
    cases = [case for case in goldens["cases"] if not case.get("plan") and (everything or case["name"] in SMALL)]
    report.check(len(cases) >= len(SMALL), "the cases are among the goldens")
    with temporary_folder() as folder:
        for case in cases:
            case["graph"] = str((HERE / case["graph"]).resolve())
            if "scene" in case:
                case["scene"] = str((HERE / case["scene"]).resolve())
        records = {}
        for pattern in PATTERNS:
            here = pathlib.Path(folder) / pattern
            here.mkdir()
            (here / "cases.cases.json").write_text(json.dumps({"defaults": goldens["defaults"], "cases": cases}))
            filled = {**environment, "MALLOC_PERTURB_": pattern}
            if pattern == PATTERNS[0]:
                for case in cases:
                    for golden in HERE.glob(f"{case['name']}.*"):
                        shutil.copy(golden, here)
                done = run(weft, "test", here, *options, env=filled)
                report.check(done.code == 0, f"the goldens on zink: {done.out}{done.err}")
            done = run(weft, "test", here, "--accept", *options, env=filled)
            report.check(done.code == 0, f"--accept with memory of {pattern}: {done.out}{done.err}")
            records[pattern] = {file.name: file.read_bytes() for file in here.iterdir() if file.suffix in (".png", ".passes")}
        first, second = (records[pattern] for pattern in PATTERNS)
        report.check(len(first) >= 2 * len(cases), f"pictures and records: {sorted(first)}")
        differing = sorted(name for name in {**first, **second} if first.get(name) != second.get(name))
        report.check(not differing, f"with memory of {PATTERNS} these differ: {differing}")
    report.end()


main()
