#!/usr/bin/env python3
"""Runs the fuzz targets of a build and prints a row for each: seconds, inputs, coverage, findings.

    fuzz.py BUILD KEPT [--seconds N] [--mutations N] [TARGET...]

KEPT is a folder of files that tests wrote (WEFT_KEEP_FILES). With clang each target runs --seconds as libFuzzer does; what it
learns stays in BUILD/fuzz/TARGET, a finding in tests/fuzz/found/TARGET. Otherwise each runs its seeds, the findings and --mutations
inputs that are the same each time.
"""
import argparse
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
HERE = TOP / "tests/fuzz"
LARGEST = 30_000  # bytes of a seed


def seeds_of(name, build, kept):
    """A folder with the seeds of a target, and one with its words."""
    folder = build / "fuzz" / f"{name}.seeds"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    found = [path.read_bytes() for where in ("seeds", "found") for path in sorted((HERE / where / name).glob("*"))]
    for glob in (build / f"tests/fuzz/fuzz_{name}.seeds").read_text().split():
        if glob == "strings":
            graphs = "\n".join(path.read_text() for path in sorted((TOP / "graphs").rglob("*.json")))
            found += [text.encode() for text in sorted(set(re.findall(r'"([^"\\\n]+)"', graphs))) if re.search(r"[^\w ./]", text)]
        else:
            top, pattern = (kept, glob[5:]) if glob.startswith("kept/") else (TOP, glob)
            found += [path.read_bytes() for path in sorted(top.glob(pattern)) if path.stat().st_size <= LARGEST]
    for data in found:
        (folder / hashlib.sha1(data).hexdigest()[:16]).write_bytes(data)
    words = sorted({word for data in found for word in re.findall(rb"[A-Za-z_@$#/!][\w.]{2,24}", data[:4000])}, key=lambda w: (len(w), w))[:2000]
    (build / "fuzz" / f"{name}.words").write_bytes(b'"0"\n' + b"".join(b'"%s"\n' % word for word in words))
    return folder


def fuzz(program, seeds, learned, findings, seconds):
    """Runs of libFuzzer until the time is over; it ends with each finding. One block may be larger than all that is used: stb_image asks for up
    to 2 GiB, as much as a chunk of a PNG claims to have, and fills what the file has."""
    learned.mkdir(exist_ok=True)
    inputs = coverage = features = 0
    end = time.monotonic() + seconds
    while (left := int(end - time.monotonic())) > 0:
        run = subprocess.run([program, f"-max_total_time={left}", "-timeout=20", "-report_slow_units=20", "-rss_limit_mb=2048", "-malloc_limit_mb=2049", "-print_final_stats=1", "-close_fd_mask=1", f"-artifact_prefix={findings}/",
                              f"-dict={seeds.with_suffix('.words')}", learned, seeds], capture_output=True, text=True, errors="replace")
        inputs += int((re.findall(r"number_of_executed_units: (\d+)", run.stderr) or [0])[-1])
        coverage, features = max([(coverage, features), *((int(c), int(f)) for c, f in re.findall(r"cov: (\d+) ft: (\d+)", run.stderr))])
        if run.returncode:
            print("\n".join(run.stderr.splitlines()[-60:]), file=sys.stderr)
    return inputs, f"{coverage} edges, {features} features"


def replay(program, seeds, findings, mutations):
    last = seeds.with_suffix(".last")
    files = sorted(seeds.iterdir())
    run = subprocess.run([program, str(mutations), *files], capture_output=True, env={**os.environ, "WEFT_FUZZ_INPUT": str(last)})
    if run.returncode:
        shutil.copy(last, findings / last.name) if last.exists() else None
        print(run.stderr.decode(errors="replace"), file=sys.stderr)
    return int(run.stdout.split()[-1]) if run.returncode == 0 else 0, f"{len(files)} files"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("kept", type=pathlib.Path)
    parser.add_argument("targets", nargs="*")
    parser.add_argument("--seconds", type=int, default=1200)
    parser.add_argument("--mutations", type=int, default=1000)
    given = parser.parse_intermixed_args()
    build = given.build.resolve()
    libfuzzer = "fuzzer" in re.search(r"^WEFT_SANITIZE:.*", (build / "CMakeCache.txt").read_text(), re.M)[0]
    names = given.targets or sorted(path.stem[5:] for path in (build / "tests/fuzz").glob("fuzz_*.seeds"))
    os.environ.setdefault("UBSAN_OPTIONS", f"halt_on_error=1:print_stacktrace=1:suppressions={TOP}/tests/app/hostile/ubsan.supp")
    os.environ.setdefault("LSAN_OPTIONS", f"suppressions={TOP}/tests/gl/lsan.supp:print_suppressions=0")
    bad = 0
    for name in names:
        program, findings = build / f"tests/fuzz/fuzz_{name}", HERE / "found" / name if libfuzzer else build / "fuzz"
        seeds = seeds_of(name, build, given.kept)
        findings.mkdir(parents=True, exist_ok=True)
        before = set(findings.iterdir())
        start = time.monotonic()
        inputs, covered = fuzz(program, seeds, build / "fuzz" / name, findings, given.seconds) if libfuzzer else replay(program, seeds, findings, given.mutations)
        new = sorted(path.name for path in set(findings.iterdir()) - before) if libfuzzer else ["one"] * (inputs == 0)
        bad += len(new)
        print(f"{name:12} {time.monotonic() - start:6.0f} s {inputs:10} inputs, {covered}, {len(new)} findings{': ' if new else ''}{', '.join(new)}", flush=True)
        if not any(findings.iterdir()):
            findings.rmdir()
    return 1 if bad else 0


sys.exit(main())
