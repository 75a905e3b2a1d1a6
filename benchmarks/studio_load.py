"""The studio under attack and under load, without a browser.

    python benchmarks/studio_load.py --kills 50 --bad 10000 --clients 20

kills: the server is killed in the middle of a stroke, of an analysis and of a run in turn, and started again: pages lost, and
strokes that had been acknowledged and are missing; bad: mutated messages: answers that were no sentence, and how much memory grew;
clients: so many pages drawn at once, a gap of 50 ms between strokes, each then analyzed: p95, and strokes on a wrong page.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import tempfile
import threading
import time
import urllib.request
from pathlib import Path
from typing import Any

import numpy as np

from data_gen.pages import page as generated
from studio_workshop import RAMP, Client, Served, client, dense, ring, served, start, stroke_message


def main() -> None:
    parser = argparse.ArgumentParser(description="The studio under load.")
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--bad", type=int, default=10_000)
    parser.add_argument("--clients", type=int, default=20)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    figures: dict[str, Any] = {"load average": os.getloadavg()[0]}
    with tempfile.TemporaryDirectory() as folder, served(Path(folder), warm=True) as studio:
        while not json.loads(urllib.request.urlopen(f"{studio.url}/api/status").read())["ready"]:
            time.sleep(1)
        figures["clients"] = _crowd(studio, options.clients)
        figures["bad messages"] = _bad(studio, options.bad)
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


def _kills(count: int) -> dict[str, Any]:
    lost = missing = 0
    with tempfile.TemporaryDirectory() as folder:
        studio = start(Path(folder))
        pages: dict[str, list[str]] = {}
        for turn in range(count):
            page = _new(studio)
            pages[page] = []
            with client(studio.url, page, f"t{turn}-") as one:
                one.draw(dense(RAMP))
                one.draw(ring(330, 180, 34, 3.0))
                if turn % 3 == 2:
                    one.ask(type="analyze")
                pages[page] = [stroke["id"] for stroke in _state(studio, page)["strokes"]]
                match turn % 3:
                    case 0:
                        one.send(type="stroke", key="half", **stroke_message(dense([(0, 0), (90, 9)])))
                    case 1:
                        one.send(type="analyze", key="half")
                    case _:
                        one.send(type="run", run=1, seconds=30)
                time.sleep(0.01 * (turn % 7))
                studio.kill()
            studio = start(Path(folder), studio.port)
            there = {
                one["id"] for one in json.loads(urllib.request.urlopen(f"{studio.url}/api/pages").read())
            }
            lost += sum(name not in there for name in pages)
            kept = {stroke["id"] for stroke in _state(studio, page)["strokes"]}
            missing += sum(name not in kept for name in pages[page])
        studio.kill()
    return {"kills": count, "pages lost": lost, "acknowledged strokes missing": missing}


if __name__ == "__main__":
    main()
