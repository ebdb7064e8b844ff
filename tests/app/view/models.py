#!/usr/bin/env python3
"""Models in the viewer: a scene with models loads beside the frames; a model that is broken is told, with what is shown going on,
and comes back when it is whole again. Idle mode comes to rest over a model that stands still, and never over one that moves now and
then."""
import base64
import json
import shutil
import struct

from program import TOP
from window import Session, run_parts, save


def comes_and_stays(weft, folder, report):
    live = Session(weft, folder, "--no-ui", "--scene", "scenes/helmet_alone.json", graph="graphs/glow.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        report.check(live.event("loading helmet_alone.json"), f"nobody says that the scene is on its way\n{live.said()}")
        arrived = live.event("files good")
        report.check(arrived, f"the scene does not arrive\n{live.said()}")
        model = folder / "scenes/models/FlightHelmet/FlightHelmet.gltf"
        text = model.read_text()
        # A buffer outside the model's folder, an index that names nothing, half a file.
        for broken, code in ((text.replace("FlightHelmet.bin", "../../secret.bin"), "W166"), (text.replace('"mesh": 5', '"mesh": 55'), "W165"),
                             (text[:len(text) // 2], "W002")):
            if not report.check(broken != text, f"nothing to break for {code}"):
                continue
            since, said = live.mark(), len(live.said())
            save(model, broken)
            report.check(live.event("files wrong", since), f"{code}: nobody says that the model is broken\n{live.said()}")
            report.check(f"error[{code}]" in live.said()[said:], f"no {code} in\n{live.said()[said:]}")
            report.check(live.shot(), f"{code}: no picture while the model is broken")
            since = live.mark()
            save(model, text)
            report.check(live.event("files good", since), f"{code}: the model is whole again, and nobody sees it\n{live.said()}")
        # A file that the model names is watched as well.
        image = folder / "scenes/models/FlightHelmet/FlightHelmet_Materials_LensesMat_Normal.png"
        bytes_of, since, said = image.read_bytes(), live.mark(), len(live.said())
        image.unlink()
        report.check(live.event("files good", since), f"a texture went, and nothing is loaded\n{live.said()}")
        report.check("warning[W167]" in live.said()[said:], f"no W167 in\n{live.said()[said:]}")
        since = live.mark()
        image.write_bytes(bytes_of)
        report.check(live.event("files good", since), f"the texture is back, and nothing is loaded\n{live.said()}")
        live.leave(report)
    finally:
        live.stop()


def model_as_scene(weft, folder, report):
    live = Session(weft, folder, "--no-ui", "--scene", "scenes/models/Fox.glb", graph="graphs/glow.json")
    try:
        if report.check(live.open() and live.event("files good"), f"a model as a scene does not arrive\n{live.said()}"):
            live.leave(report)
    finally:
        live.stop()


def flag(animated):
    """A triangle; `animated`: it jumps from the left to the right and back, and stands still for two seconds each time."""
    parts = [struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0), struct.pack("<3I", 0, 1, 2)]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
                 {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}]
    model = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "flag", "mesh": 0, "translation": [-2, 0, 0]}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]}
    if animated:
        parts += [struct.pack("<3f", 0, 2, 4), struct.pack("<9f", -2, 0, 0, 2, 0, 0, -2, 0, 0)]
        accessors += [{"bufferView": 2, "componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [4]},
                      {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC3"}]
        model["animations"] = [{"name": "jump", "samplers": [{"input": 2, "output": 3, "interpolation": "STEP"}],
                                "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]
    blob = b"".join(parts)
    ends = [sum(map(len, parts[:i + 1])) for i in range(len(parts))]
    model["bufferViews"] = [{"buffer": 0, "byteOffset": end - len(part), "byteLength": len(part)} for end, part in zip(ends, parts)]
    model["buffers"] = [{"byteLength": len(blob), "uri": "data:application/octet-stream;base64," + base64.b64encode(blob).decode()}]
    model["accessors"] = accessors
    return json.dumps(model)


def idle(weft, folder, report):
    """The graph draws nothing but meshes, as they are seen from above."""
    shutil.copy(TOP / "tests/imports/graphs/mesh.json", folder / "graphs")
    shutil.copytree(TOP / "tests/imports/shaders/mesh", folder / "shaders/mesh")
    for name, animated in (("still", False), ("jumping", True)):
        save(folder / f"scenes/{name}.gltf", flag(animated))
        live = Session(weft, folder, "--no-ui", "--idle", "--scene", f"scenes/{name}.gltf", graph="graphs/mesh.json")
        try:
            arrived = live.open() and live.event("files good")
            if not report.check(arrived, f"{name}: the model does not arrive\n{live.said()}"):
                continue
            if not animated:
                report.check(live.rest(0), "idle mode never comes to rest over a model that stands still")
            else:
                jumps(live, report)
            live.leave(report)
        finally:
            live.stop()


def jumps(live, report):
    def resting():
        return any(line.endswith(" resting") for line in live.lines())

    def until(holds, what):
        """Until a picture is such; each is taken, as everything may be at rest."""
        report.check(live.until(lambda: resting() or ((s := live.shot()) and holds(s.read_bytes()))), what)
        report.check(not resting(), f"idle mode rests over a model that will move: {what}")

    first = live.shot()
    if report.check(first, f"no picture\n{live.said()}"):
        left = first.read_bytes()
        until(lambda picture: picture != left, "it never jumps")
        until(lambda picture: picture == left, "it never jumps back")


run_parts(__file__, comes_and_stays, model_as_scene, idle)
