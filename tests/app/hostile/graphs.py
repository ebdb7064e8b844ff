#!/usr/bin/env python3
"""Graphs made to fill the stack, the memory or the time of `weft check`: each dimension just below its limit, where the
check ends well, and above it, where one error says the limit at a place. No run may end by a signal or take more than
1 GB (more with the sanitizers: MEMORY_BYTES). The files are made here. --full prints what each run took.

    graphs.py WEFT [--full] [--sanitized]
"""
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

from huge_graphs import *  # noqa: F403: the table below names nearly all of them
from program import DIAGNOSTIC, MEMORY_BYTES, SANITIZED, SLOWER, Report, count_run, temporary_folder

GUARD_S = 60 * SLOWER  # of the processor: a hanging run ends; what it took is printed, not judged
TWICE, FOURFOLD = ["--limit", "2"], ["--limit", "4"]
# name: (files, arguments, code or None, text of the message). A code: exit code 1, and the first error has it, at a place.
CASES = {
    "20,000 alternatives in a row": (lambda: alternatives_in_a_row(20_000), [], "W201", "too many resources"),
    "4,000 alternatives in a row": (lambda: alternatives_in_a_row(4000), [], "W201", "too many alternatives"),
    "64 alternatives in a row": (lambda: alternatives_in_a_row(64), [], None, ""),
    "65 alternatives in a row": (lambda: alternatives_in_a_row(65), [], "W201", "raise the limits with --limit 2"),
    "256 alternatives in a row, the limits raised": (lambda: alternatives_in_a_row(256), FOURFOLD, None, ""),
    "2^60 ways through alternatives": (lambda: alternatives_of_two(60), [], "W201", "too many alternatives"),
    "2^60 ways through alternatives with a history": (lambda: history_of_alternatives_of_two(60), [], "W201", "too many alternatives"),
    "2^60 ways through alternatives, asked by has()": (lambda: size_of_alternatives_of_two(60), [], "W201", "too many alternatives"),
    "2^5 ways through alternatives": (lambda: alternatives_of_two(5), [], None, ""),
    "3,000 includes in a row": (lambda: includes_in_a_row(3000), [], "W201", "too many files in a row"),
    "64 files in a row": (lambda: includes_in_a_row(64), [], None, ""),
    "65 files in a row": (lambda: includes_in_a_row(65), [], "W201", "found: 65 with 'f64.json'"),
    "2^31 includes": (lambda: includes_twice(31), [], "W201", "includes too many files"),
    "2^31 includes, disabled": (lambda: includes_twice(31), ["--disable", "a", "--disable", "b"], "W201", "includes too many files"),
    "2^31 includes below a preset": (lambda: {**includes_twice(31), "p.json": {"parameters": {}, "let": {"a": 1}}}, ["--preset", "p.json"], "W201", "includes too many files"),
    "999 includes": (lambda: includes_beside(999), [], None, ""),
    "1,000 includes": (lambda: includes_beside(1000), [], "W201", "at most 1000 files"),
    "900 uses of a file of 5,000 values": (lambda: includes_of_much(900, 5000), [], "W201", "too many values"),
    "5,000 extends in a row": (lambda: extends_in_a_row(5000), [], "W201", "too long a row"),
    "64 extends in a row": (lambda: extends_in_a_row(64), [], None, ""),
    "65 extends in a row": (lambda: extends_in_a_row(65), [], "W201", "at most 64"),
    "2^60 ways through extends to nothing": (lambda: extends_of_two(60), [], "W001", "60.json"),
    "60 copies of 30,000 values": (lambda: extends_of_much(60, 30_000), [], "W201", "too many values"),
    "overlay of 20,000 entries": (lambda: overlay_of_much(20_000, 20_000), [], "W201", "the overlay changes too much"),
    "overlay of 300 entries": (lambda: overlay_of_much(3000, 300), [], None, ""),
    "20,000 lets in a row": (lambda: lets_in_a_row(20_000), [], "W201", "at most 256 lets"),
    "31 lets in a row": (lambda: lets_in_a_row(31), [], None, ""),
    "32 lets in a row": (lambda: lets_in_a_row(32), [], "W201", "which ends at"),
    "200 lets in a circle": (lambda: lets_in_a_cycle(200), [], "W201", "which ends at"),
    "31 tall lets in a row": (lambda: tall_lets(31, 198), [], None, ""),
    "200 lets of age() in a row": (lambda: ages_in_a_row(200), [], "W201", "which ends at"),
    "20 lets of age(), each twice the next": (lambda: ages_doubled(20), [], "W020", "operators and operands"),
    "4,000 sizes in a row": (lambda: sizes_in_a_row(4000), [], "W201", "which ends at"),
    "32 sizes in a row": (lambda: sizes_in_a_row(32), [], None, ""),
    "4,000 conditions in a row": (lambda: conditions_in_a_row(4000), [], "W201", "which ends at"),
    "30 conditions in a row": (lambda: conditions_in_a_row(30), [], None, ""),
    "900 binds in a row": (lambda: binds_in_a_row(900), [], "W201", "which ends at"),
    "30 binds in a row": (lambda: binds_in_a_row(30), [], None, ""),
    "20,000 indices of a repeat": (lambda: repeat_of(20_000), [], "W201", "at most 8 indices"),
    "8 indices of a repeat": (lambda: repeat_of(8), [], None, ""),
    "9 indices of a repeat": (lambda: repeat_of(9), [], "W201", "'i8' is one too many"),
    "16 indices of a repeat, the limits raised": (lambda: repeat_of(16), TWICE, None, ""),
    "4,094 instances": (lambda: repeat_to(4094), [], None, ""),
    "4,095 instances": (lambda: repeat_to(4095), [], "W081", "--limit 2"),
    "4,095 instances, the limits raised": (lambda: repeat_to(4095), TWICE, None, ""),
    "1,000,000,000 instances": (lambda: repeat_to(1_000_000_000), [], "W081", ""),
    "4,000 passes": (lambda: small_passes(4000), [], None, ""),
    "20,000 passes": (lambda: small_passes(20_000), [], "W081", ""),
    "500 passes that read all before them": (lambda: passes_that_read_all_before(500), [], None, ""),
    "1,000 passes that read all before them": (lambda: passes_that_read_all_before(1000), [], "W201", "slots, parameters"),
    "2,000 disabled passes that read 2,000 layers a hundred times": (lambda: layers_read_by_disabled(2000, 2000), [], None, ""),
    "2,000 disabled passes that read 2,000 layers of the frame before": (lambda: layers_read_by_disabled(2000, 2000, "@-1"), [], None, ""),
    "1,000 slots of one pass": (lambda: slots_of_one_pass(1000), [], None, ""),
    "20,000 slots of one pass": (lambda: slots_of_one_pass(20_000), [], "W201", "at most 1024 slots"),
    "250 instances of 1,000 parameters": (lambda: parameters_of_one_pass(1000, 250), [], None, ""),
    "1,000 instances of 1,000 parameters": (lambda: parameters_of_one_pass(1000, 1000), [], "W201", "slots, parameters"),
    "4,000 passes of one set of 1,000 defines": (lambda: passes_of_one_set(4000, 1000), [], "W201", "hold too much"),
    "an overlay that changes 2,000 of them": (lambda: overlay_on_sets(2000, 1000), [], "W201", "too much of sets"),
    "4,000 instances of 198 terms": (lambda: terms_of_one_pass(98, 4000), [], None, ""),
    "1,000 images of one texture": (lambda: images_of_one_texture(1000), [], None, ""),
    "1,000 readers of 2,048 layers": (lambda: layers_read_again(2048, 1000), [], "W201", "versions that are read"),
    "5 textures of 1 GB, the limits raised": (lambda: textures(5), TWICE, None, ""),
    "16 textures of 1 GB": (lambda: textures(16), [], "W202", "the largest is 't0', 1024000000 bytes"),
    "4 textures of 1 GB": (lambda: textures(4), [], None, ""),
    "4,000 unknown names": (lambda: unknown_names(4000, 4000), [], "W040", ""),
    "100,000 unknown keys": (lambda: unknown_keys(100_000), [], "W004", ""),
    "a key of 10 MB": (lambda: long_key(10_000_000), [], "W201", "at most 255 bytes"),
    "a key of 255 bytes": (lambda: long_key(255), [], None, ""),
    "a name of 256 bytes": (lambda: long_pass_name(256), [], "W201", "found: 256 bytes"),
    "a name of 10 MB": (lambda: long_pass_name(10_000_000), [], "W201", "at most 255 bytes"),
    "40 long keys around 50,000 values": (lambda: long_keys_in_depth(50_000), [], "W004", ""),
    "a call with 2,000,000 arguments": (lambda: long_expression(2_000_000), [], "W020", "more than 8 arguments"),
    "a list of 2,000,000 numbers": (lambda: long_list(2_000_000), [], "W020", "more than 4 items"),
    "an expression of 20,000 variables": (lambda: wide_expression(20_000), [], "W020", "more than 1000 operands"),
    "an expression of 800 variables": (lambda: wide_expression(800), [], None, ""),
    "20,000 parameters": (lambda: many("parameters", 20_000), [], "W201", "at most 4096 parameters"),
    "4,096 parameters": (lambda: many("parameters", 4096), [], None, ""),
    "20,000 resources": (lambda: many("resources", 20_000), [], "W201", "at most 4096 resources"),
    "4,095 resources": (lambda: many("resources", 4095), [], None, ""),
    "257 lets": (lambda: many("let", 257), [], "W201", "at most 256 lets"),
    "256 lets": (lambda: many("let", 256), [], None, ""),
    "4,000 imports that differ": (lambda: imports(4000), [], None, ""),
    "2,000 time-sliced groups": (lambda: sliced_groups(2000), [], None, ""),
    "40 MB of white space": (lambda: blanks(40 << 20), [], "W201", "at most 33554432 bytes"),
    "30 MB of lines": (lambda: blanks(30 << 20), [], None, ""),
    "1,600,000 values": (lambda: values_of(1_600_000), [], "W201", "at most 1500000 values"),
    "1,400,000 values": (lambda: values_of(1_400_000), [], "W003", ""),
}


class Ended:
    def __init__(self, command, folder):
        count_run()
        with open(folder / "out.txt", "w+b") as out:
            begin = time.monotonic()
            process = subprocess.Popen(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT, preexec_fn=self.limit)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.seconds = time.monotonic() - begin
            self.busy = usage.ru_utime + usage.ru_stime
            self.code, self.bytes = process.returncode, usage.ru_maxrss * 1024
            out.seek(0)
            self.text = out.read(1 << 20).decode(errors="replace")

    @staticmethod
    def limit():  # what goes wrong must not take the machine along
        resource.setrlimit(resource.RLIMIT_CPU, (GUARD_S, GUARD_S))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if SANITIZED:
            # They map terabytes that they never use; sanitize.sh bounds resident memory instead. Frames are about sixteen times as
            # large: the deepest walk, which takes between 1 and 2 MB of the usual 8 without them, takes between 16 and 32.
            resource.setrlimit(resource.RLIMIT_STACK, (64 << 20, resource.getrlimit(resource.RLIMIT_STACK)[1]))
        else:
            resource.setrlimit(resource.RLIMIT_AS, (4 * MEMORY_BYTES, 4 * MEMORY_BYTES))


def check_case(report, weft, name, case, full):
    make, arguments, code, says = case
    with temporary_folder() as folder_name:
        folder = pathlib.Path(folder_name)
        for file, value in make().items():
            (folder / file).write_text(value if isinstance(value, str) else text(value))
        (folder / "shaders").mkdir()
        for shader in ("a.frag.glsl", "a.comp.glsl"):
            # A bracket that nothing closes: it may declare anything, so that slots and parameters fit.
            (folder / "shaders" / shader).write_text("void main() { (\n")
        ended = Ended([str(weft), "check", "--no-shaders", "g.json", *arguments], folder)
    if full:
        print(f"{ended.seconds:6.2f} s ({ended.busy:5.2f} of the processor) {ended.bytes / 1e6:6.0f} MB  exit {ended.code}  {name}", flush=True)
    shown = f"{name}:\n{ended.text[:1500]}"
    report.check(ended.code == (1 if code else 0), f"exit code {ended.code}: {shown}")
    report.check(ended.bytes <= MEMORY_BYTES, f"{ended.bytes / 1e6:.0f} MB: {name}")
    report.check(says in ended.text, f"does not say {says!r}: {shown}")
    if code:
        errors = [m for m in map(DIAGNOSTIC.match, ended.text.splitlines()) if m and m["severity"] == "error"]
        fits = errors and any(m["code"] == code for m in errors) and all(m["place"] for m in errors)
        report.check(fits, f"no {code} at a place: {shown}")
        if code in ("W201", "W202"):
            report.check([m["code"] for m in errors] == [code], f"more than one {code}: {shown}")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    wanted = [a for a in sys.argv[2:] if not a.startswith("--")]
    for name, case in CASES.items():
        if all(re.search(w, name) for w in wanted):
            check_case(report, weft, name, case, "--full" in sys.argv)
    report.end()


if __name__ == "__main__":
    main()
