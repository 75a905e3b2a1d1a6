"""The studio under attack and under load, without a browser.

    python benchmarks/studio_load.py --kills 50 --bad 10000 --clients 20

kills: the server is killed in the midst of a stroke, of many, of an analysis, of saving to a file and of a run in turn, each time
started again: pages lost, strokes that had been acknowledged and are missing, notebooks that are not whole; bad: mutated messages: answers that were no sentence, and how much memory grew;
clients: so many pages drawn at once, a gap of 50 ms between strokes, each then analyzed: p95, and strokes on a wrong page.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import sqlite3
import tempfile
import threading
import time
import urllib.request
from contextlib import closing
from http.client import HTTPException
from pathlib import Path
from typing import Any

import numpy as np
from websockets.exceptions import ConnectionClosed

from data_gen.pages import page as generated
from studio_workshop import (
    PATIENCE,
    RAMP,
    Client,
    Served,
    client,
    dense,
    ready,
    ring,
    served,
    start,
    stroke_message,
)


def main() -> None:
    parser = argparse.ArgumentParser(description="The studio under load.")
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--bad", type=int, default=10_000)
    parser.add_argument("--clients", type=int, default=20)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    figures: dict[str, Any] = {"load average": os.getloadavg()[0]}
    if options.clients or options.bad:
        with tempfile.TemporaryDirectory() as folder, served(Path(folder), warm=True) as studio:
            ready(studio)
            figures["clients"] = _crowd(studio, options.clients) if options.clients else None
            figures["bad messages"] = _bad(studio, options.bad) if options.bad else None
    if options.kills:
        figures["kills"] = _kills(options.kills)
    print(json.dumps(figures, indent=1))
    if options.json:
        options.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


def _new(studio: Served) -> str:
    request = urllib.request.Request(
        f"{studio.url}/api/pages", b"{}", {"content-type": "application/json"}, method="POST"
    )
    return json.loads(urllib.request.urlopen(request).read())["id"]


def _state(studio: Served, page: str) -> dict[str, Any]:
    return json.loads(urllib.request.urlopen(f"{studio.url}/api/pages/{page}/state").read())


def _crowd(studio: Served, count: int) -> dict[str, Any]:
    names = ("incline-and-ball", "pendulum", "two-balls", "mass-on-spring")
    truths = [generated(names[k % len(names)], k, 0).truth for k in range(count)]
    spent: list[float] = []
    strokes: list[float] = []
    wrong: list[int] = []

    def one(k: int) -> None:
        page = _new(studio)
        with client(studio.url, page, f"c{k}-") as mine:
            for stroke in truths[k].ink:
                began = time.perf_counter()
                mine.draw(stroke)
                strokes.append(1000 * (time.perf_counter() - began))
                time.sleep(0.05)
            began = time.perf_counter()
            mine.ask(type="analyze")
            spent.append(1000 * (time.perf_counter() - began))
            names = [stroke["id"] for stroke in mine.state["strokes"]]
            wrong.append(sum(not name.startswith(f"c{k}-") for name in names))

    threads = [threading.Thread(target=one, args=(k,)) for k in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return {
        "clients": count, "analyze p95, ms": round(float(np.percentile(spent, 95))), "analyze median, ms": round(float(np.median(spent))),
        "stroke acknowledged p95, ms": round(float(np.percentile(strokes, 95))), "strokes": len(strokes), "strokes on a wrong page": sum(wrong),
    }  # fmt: skip


def _memory(studio: Served) -> float:
    """Resident, MB."""
    for line in Path(f"/proc/{studio.process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024
    return float("nan")


def _bad(studio: Served, count: int) -> dict[str, Any]:
    rng = random.Random(1)
    seeds = [
        {"type": "stroke", "key": "k", "points": [[0, 0], [5, 5]], "times": [0, 1], "pressure": [0.5, 0.5]},
        {"type": "do", "key": "k", "action": {"do": "write", "text": "m = 2", "line": None, "at": [0, 0]}},
        {"type": "do", "key": "k", "action": {"do": "associate", "lines": [0], "component": "A", "anchor": [0, 0]}},
        {"type": "run", "run": 1, "seconds": 5}, {"type": "observe", "run": 1, "body": "A", "quantity": "speed"},
        {"type": "analyze", "key": "k", "recognizer": "learned"}, {"type": "undo", "key": "k"}, {"type": "contest", "seconds": 1},
    ]  # fmt: skip
    page = _new(studio)
    faults = refused = 0

    def wave(one: Client, number: int) -> None:
        nonlocal faults, refused
        for _ in range(number):
            letters = list(json.dumps(rng.choice(seeds)))
            for _ in range(rng.randint(1, 6)):
                at = rng.randrange(len(letters))
                letters[at] = rng.choice(
                    ["", letters[at] * 2, chr(rng.randrange(32, 127)), "9e999", "null", "[", "\u00e9"]
                )
            one.socket.send("".join(letters))
        one.send(type="ping")
        while (heard := one.hear(60))["type"] != "pong":
            refused += heard["type"] == "error"
            faults += heard["type"] == "error" and "fault" in heard["message"]

    with client(studio.url, page, "bad") as one:
        wave(one, 500)
        before = _memory(studio)
        for _ in range(0, count, 100):
            wave(one, 100)
        after = _memory(studio)
    return {
        "messages": count,
        "refused with a sentence": refused,
        "faults": faults,
        "memory before, MB": round(before),
        "after, MB": round(after),
    }


MIDST = ("of a stroke", "of many strokes", "of an analysis", "of saving to a file", "of a run")


def _kills(count: int) -> dict[str, Any]:
    """Kills the server in the midst of each thing in turn, at a random moment, and looks after each restart at every page
    that there has ever been, and whether it goes on."""
    rng = random.Random(3)
    lost = missing = doubled = broken = 0
    with tempfile.TemporaryDirectory() as folder:
        studio = start(Path(folder))
        pages: dict[str, set[str]] = {}
        for turn in range(count):
            page = _new(studio)
            pages[page] = _worked_and_killed(studio, page, turn, rng.uniform(0.0, 0.15))
            with closing(sqlite3.connect(Path(folder) / "notebook.sqlite")) as notebook:
                broken += notebook.execute("pragma integrity_check").fetchone() != ("ok",)
            studio = start(Path(folder), studio.port)
            there = json.loads(urllib.request.urlopen(f"{studio.url}/api/pages").read())
            lost += len(pages.keys() - {one["id"] for one in there})
            for name, acknowledged in pages.items():
                kept = [stroke["id"] for stroke in _state(studio, name)["strokes"]]
                missing += len(acknowledged.difference(kept))
                doubled += len(kept) - len(set(kept))
            with client(
                studio.url, page, f"t{turn}-"
            ) as one:  # the same stroke again, as a browser does, and another
                for key in ("half", "after"):
                    one.send(type="stroke", key=key, **stroke_message(dense([(0, 0), (90, 9)])))
                    one.until("ack")
            names = [stroke["id"] for stroke in _state(studio, page)["strokes"]]
            broken += names.count("half") != 1 or names.count("after") != 1
            pages[page] |= {"half", "after"}
        studio.kill()
    return {
        "kills": count, "in the midst": MIDST, "pages lost": lost, "acknowledged strokes missing": missing,
        "strokes twice": doubled, "notebooks or pages that did not go on": broken, "strokes acknowledged": sum(map(len, pages.values())),
    }  # fmt: skip


def _worked_and_killed(studio: Served, page: str, turn: int, moment: float) -> set[str]:
    """Draws on a page, does something more, and kills the server so many seconds later; the strokes that were
    acknowledged by then."""
    acknowledged: set[str] = set()
    midst = MIDST[turn % len(MIDST)]
    with client(studio.url, page, f"t{turn}-") as one:
        for stroke in (dense(RAMP), ring(330, 180, 34, 3.0)):
            acknowledged.add(one.draw(stroke)["key"])
        if midst == "of a run":
            one.ask(type="analyze")
        killing = threading.Timer(moment, studio.kill)
        killing.start()
        try:
            match midst:
                case "of a stroke":
                    one.send(type="stroke", key="half", **stroke_message(dense([(0, 0), (90, 9)])))
                case "of many strokes":
                    for k in range(1000):
                        acknowledged.add(one.draw(dense([(0, 5.0 * k), (90, 5.0 * k)]), ink=True)["key"])
                case "of an analysis":
                    one.send(type="analyze", key="analysis")
                case "of saving to a file":
                    urllib.request.urlopen(f"{studio.url}/api/pages/{page}/export?kind=inklined").read()
                case _:
                    one.send(type="run", run=1, seconds=30)
            while one.hear(PATIENCE):
                pass
        except (ConnectionClosed, OSError, HTTPException):
            pass
        killing.join()
    return acknowledged


if __name__ == "__main__":
    main()
