#!/usr/bin/env python3
"""`weft view --serve`: the page of the running graph, to whoever has the token, on this machine alone; it follows a save and a parameter.

    serve.py WEFT COMPARE
"""
import json
import re
import socket
import urllib.error
import urllib.request

from window import Session, edit, run_parts


def get(address):
    with urllib.request.urlopen(address, timeout=60) as answer:
        return answer.read().decode()


def page_of(address):
    return json.loads(re.search(r'<script type="application/json" id="report">(.*?)</script>', get(address), re.DOTALL)[1])


def serve(weft, folder, report):
    live = Session(weft, folder, "--serve", "0", "--idle", graph="graphs/glow.json", size="64x36", data=False)
    try:
        if not report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            return
        address = next(line.split()[1] for line in live.lines() if line.startswith("serving "))
        base, token = address.split("?token=")
        port = int(re.search(r":(\d+)/", base)[1])
        page = page_of(address)
        state = page["states"][0]
        passes = [step["pass"] for step in state["plan"]["steps"]]
        report.check("composite" in passes and len(state["outputs"]) == len(passes) and all(state["outputs"]), f"{passes}")
        report.check(page["command"].startswith("weft render graphs/glow.json --size 64x36"), page["command"])
        report.check(page["live"] == int(get(f"{base}changes?token={token}")), "a page that is out of date when it comes")
        for wrong in (base, f"{base}?token=", f"{base}?token={token[:-1]}", f"{base}changes"):
            try:
                report.check(False, f"{wrong}: {get(wrong)[:80]}")
            except urllib.error.HTTPError as error:
                report.check(error.code == 403, f"{wrong}: {error.code}")
        others = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)} - {"127.0.0.1"}
        for other in others:  # other addresses of this machine
            with socket.socket() as away:
                away.settimeout(2)
                report.check(away.connect_ex((other, port)) != 0, f"{other} is served")
        before = live.mark()
        edit(folder / "graphs/glow.json", r'("threshold": *\{[^}]*"default": )[\d.]+', '"threshold": { "type": "float", "default": 3.5')
        report.check(live.event("files good", before), f"the save is not taken\n{live.said()}")
        report.check(live.until(lambda: int(get(f"{base}changes?token={token}")) != page["live"]), "a save is no change")
        parameters = {each["name"]: each["value"] for each in page_of(address)["states"][0]["parameters"]}
        report.check(parameters.get("threshold") == "3.5", f"{parameters}")
        before, count = live.mark(), int(get(f"{base}changes?token={token}"))
        (folder / "graphs/glow.json").write_text("{ broken")
        report.check(live.event("files wrong", before) and live.until(lambda: int(get(f"{base}changes?token={token}")) != count), "a file that is broken is no change")
        report.check(any(each["severity"] == "error" for each in page_of(address)["states"][0]["messages"]), "the page does not tell the error")
        with socket.create_connection(("127.0.0.1", port)) as slow:  # half a request, while the window closes
            slow.sendall(f"GET /?token={token} HTTP/1.1\r\n".encode())
            live.leave(report, code=1)
    finally:
        live.stop()
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        live = Session(weft, folder, "--serve", other.getsockname()[1], graph="graphs/glow.json", size="64x36", data=False)
        try:
            live.until(lambda: not live.alive() or "serving" in live.told.read_text())
            report.check(live.process.poll() == 1 and "error[W180]" in live.said(), f"a port that is taken: {live.process.poll()}\n{live.said()}")
        finally:
            live.stop()


run_parts(__file__, serve)
