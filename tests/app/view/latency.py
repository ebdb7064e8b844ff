#!/usr/bin/env python3
"""How long a save takes to be on the screen, and what it makes anew. latency.py WEFT COMPARE [--size WxH] [--saves N]
[--continuous]: graphs/studio.json in a window of a virtual display, in idle mode with its panels or (--continuous) drawing frame after
frame without; the largest shader, a parameter's default in the JSON, and a material are saved in turn. Times are printed and not
judged: they depend on what else the machine does, which is why the processor time of the program stands beside. Judged is that a
save compiles the programs whose sources it changed and no other."""
import argparse
import mmap
import os
import pathlib
import random
import re
import statistics
import sys
import time

from program import Report, temporary_folder
from screen import Screen
from window import Session, copy_of_tree, inside_display, save

LIMIT = 300  # seconds, against hanging


def processor_seconds(pid):
    """Of all its threads."""
    total = 0
    for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
        try:
            total += int((task / "schedstat").read_text().split()[0])
        except OSError:
            pass  # it has ended
    return total / 1e9


def shader(text, i):
    end = text.rindex("}")
    return text[:end] + f"  result.rgb *= {0.4 + 0.05 * i + 0.01 * random.random():.9f};\n" + text[end:]


def value(text, i):
    edited, count = re.subn(r'("exposure":.*?"default": )[-\d.]+', lambda m: f"{m[1]}{0.3 + 0.1 * i:.2f}", text, count=1)
    assert count == 1
    return edited


def material(text, i):
    return re.sub(r'("albedo": \[)[\d.]+', lambda m: f"{m[1]}{0.1 + 0.05 * i:.2f}", text)


CASES = (("shader", "shaders/composite/composite.frag.glsl", shader),
         ("parameter", "graphs/effects/composite.json", value),
         ("material", "materials/pbr_materials.json", material))


class Band:
    """Some rows from the middle of the picture: looking at all of it every few milliseconds would take a part of the time that is
    measured."""

    def __init__(self, screen, size):
        width, height = map(int, size.split("x"))
        line = len(screen.pixels()) // 1024  # of the display, roughly
        with open(screen.path, "rb") as file:
            self.memory = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        self.begin, self.end = line * (height // 2), line * (height // 2 + 16)

    def look(self):
        return self.memory[self.begin:self.end]

    def until_another(self, before):
        end = time.monotonic() + LIMIT
        while time.monotonic() < end:
            if self.look() != before:
                return True
            time.sleep(0.003)
        return False

    def until_still(self):
        end, same, before = time.monotonic() + LIMIT, 0, self.look()
        while time.monotonic() < end and same < 4:
            time.sleep(0.2)
            now = self.look()
            same, before = same + 1 if now == before else 0, now
        return same >= 4


def measure(live, band, folder, saves, idle, report):
    for name, path, change in CASES:
        walls, costs = [], []
        file = folder / path
        original = file.read_text()
        for i in range(saves):
            if not report.check(idle or band.until_still(), f"{name}: the picture does not rest\n{live.said()}"):
                return
            before, spent, said = band.look(), processor_seconds(live.process.pid), live.mark()
            start = time.monotonic()
            save(file, change(original, i))
            if not report.check(band.until_another(before), f"{name}: saving changes nothing\n{live.said()}"):
                return
            walls.append(1e3 * (time.monotonic() - start))
            costs.append(1e3 * (processor_seconds(live.process.pid) - spent))
            taken = live.event("files good", said) and (not idle or live.rest(said))
            if not report.check(taken, f"{name}: the save is never taken up, or no rest comes after it\n{live.said()}"):
                return
        print(f"{name:10} {statistics.median(walls):4.0f} ms in the median of {saves}, {min(walls):.0f} to {max(walls):.0f}; "
              f"{statistics.median(costs):.0f} ms of processor time")
        sys.stdout.flush()


def compilations(live):
    return int(re.search(r'"compilations": (\d+)', live.said())[1])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("weft")
    parser.add_argument("compare")
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--saves", type=int, default=7)
    parser.add_argument("--continuous", action="store_true")
    parser.add_argument("--inside", action="store_true", help=argparse.SUPPRESS)
    arguments, report = parser.parse_args(), Report()
    weft = os.path.abspath(arguments.weft)
    screen = Screen(inside_display(report, weft, os.path.abspath(arguments.compare), __file__))
    mode = "--no-ui" if arguments.continuous else "--idle"
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        first = Session(weft, folder, mode, "--stats", "--max-frames", "2", size=arguments.size)
        first.until(lambda: not first.alive())
        at_start = compilations(first)
        live = Session(weft, folder, mode, "--stats", size=arguments.size)
        try:
            report.check(live.open() and live.shot(), f"no picture\n{live.said()}")
            live.tool("mousemove", 1270, 1010)  # the display draws its cursor into the picture
            idle = not arguments.continuous
            report.check(not idle or live.rest(0), f"the picture does not rest\n{live.said()}")
            measure(live, Band(screen, arguments.size), folder, arguments.saves, idle, report)
            live.leave(report)
            made = compilations(live) - at_start
            report.check(made == arguments.saves, f"{made} programs compiled for {arguments.saves} saves of one shader")
        finally:
            live.stop()
    report.end()


main()
