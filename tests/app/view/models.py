#!/usr/bin/env python3
"""Models in the viewer: a scene with models loads beside the frames, of which there are some before it has arrived; a model that is
broken is told, with what is shown going on, and comes back when it is whole again."""
import os
import pathlib
import sys

from program import Report, temporary_folder
from window import Session, copy_of_tree, inside_display, save


def comes_and_stays(weft, folder, report):
    live = Session(weft, folder, "--no-ui", "--scene", "scenes/helmet.json", graph="graphs/glow.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        report.check(live.event("loading helmet.json"), f"nobody says that the scene is on its way\n{live.said()}")
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


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    inside_display(report, weft, compare, __file__)
    for part in (comes_and_stays, model_as_scene):
        with temporary_folder() as name:
            folder = pathlib.Path(name)
            copy_of_tree(folder)
            part(weft, folder, report)
    report.end()


main()
