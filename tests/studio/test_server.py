"""The server without a browser: its pages, its websocket, its doors, and what becomes of it when it is killed."""

from __future__ import annotations

import contextlib
import http.client
import json
import random
import socket
import ssl
import urllib.error
import urllib.request
from io import BytesIO
from pathlib import Path
from typing import Any

import av
import numpy as np
import pytest
from hypothesis.errors import Unsatisfiable
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from physics.pipeline import move
from sketch.files import document
from sketch.ink import Ink, Stroke
from sketch.page import Sketch
from studio.limits import LIMITS
from studio_workshop import PATIENCE, RAMP, Client, Served, client, dense, ring, start, stroke_message


def asked(url: str, method: str = "GET", data: bytes | None = None, **headers: str) -> tuple[int, Any]:
    request = urllib.request.Request(
        url, data, {"content-type": "application/json", **headers}, method=method
    )
    try:
        with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
            body = answer.read()
            return answer.status, json.loads(body) if body[:1] in b"[{" and body else body
    except urllib.error.HTTPError as error:
        return error.code, error.read()


def page_with(one: Client) -> None:
    one.draw(dense(RAMP))
    one.draw(ring(330, 180, 34, 3.0))
    one.ask(type="analyze")
    ramp = next(part["label"] for part in one.state["components"] if part["kind"] == "polygon")
    one.do(do="fix", component=ramp, fixed=True)


def test_a_run_is_what_the_engine_says_and_any_quantity_of_it_can_be_asked_for(
    studio: Served, new_page, tmp_path: Path
) -> None:
    page = new_page()
    with client(studio.url, page) as one:
        page_with(one)
        one.send(type="run", run=4, seconds=1.5)
        head = one.until("run")
        end = one.until("end")
        frames = np.concatenate(
            [numbers.reshape(told["rows"], -1) for told, numbers in one.packed if told["type"] == "piece"]
        )
        file = tmp_path / "page.inklined"
        file.write_bytes(urllib.request.urlopen(f"{studio.url}/api/pages/{page}/export?kind=inklined").read())
        motion = move(document.read(file), 1.5)
        body = head["bodies"][0]["label"]
        np.testing.assert_allclose(frames[:, 0], motion.trajectory.times, atol=1e-6)
        np.testing.assert_allclose(frames[:, 1:3], motion.trajectory.path(body) * [100, -100], atol=1e-3)
        assert "speed" in end["observable"][body]
        one.send(type="observe", run=4, body=body, quantity="speed")
        one.until("series")
        told, speeds = one.packed[-1]
        assert told["unit"] == "m/s"
        np.testing.assert_allclose(speeds, motion.trajectory.speed(body), atol=1e-4)


def test_two_browsers_at_one_page_see_the_same_and_pages_do_not_mix(studio: Served, new_page) -> None:
    page, other = new_page(), new_page()
    with (
        client(studio.url, page, "a") as first,
        client(studio.url, page, "b") as second,
        client(studio.url, other, "c") as third,
    ):
        first.draw(dense([(10, 10), (90, 40)]))
        assert second.until("drawn")["stroke"]["points"][0] == [10, 10]
        second.ask(type="undo")
        assert first.until("state")["strokes"] == []
        third.draw(dense([(0, 0), (50, 50)]))
        assert len(asked(f"{studio.url}/api/pages/{other}/state")[1]["strokes"]) == 1
        assert asked(f"{studio.url}/api/pages/{page}/state")[1]["strokes"] == []


def test_what_is_sent_twice_is_done_once(studio: Served, new_page) -> None:
    with client(studio.url, new_page()) as one:
        message = {"type": "stroke", "key": "same", **stroke_message(dense([(0, 0), (80, 10)]))}
        for _ in range(3):
            one.send(**message)
            one.until("ack")
        one.ask(type="undo")
        assert one.state["strokes"] == []
        assert one.state["undo"] is None


def test_killed_in_a_stroke_and_in_a_run_it_has_every_stroke_that_it_acknowledged(tmp_path: Path) -> None:
    studio = start(tmp_path)
    _, made = asked(f"{studio.url}/api/pages", "POST", b"{}")
    with client(studio.url, made["id"]) as one:
        page_with(one)
        acknowledged = [stroke["id"] for stroke in one.state["strokes"]]
        one.send(type="run", run=1, seconds=30.0)
        one.send(type="stroke", key="half", **stroke_message(dense([(0, 0), (80, 10)])))
        studio.kill()
    again = start(tmp_path, studio.port)
    try:
        with client(again.url, made["id"]) as one:
            assert [stroke["id"] for stroke in one.state["strokes"]][: len(acknowledged)] == acknowledged
            assert len(one.state["components"]) == 2
            one.send(type="stroke", key="half", **stroke_message(dense([(0, 0), (80, 10)])))
            assert one.until("ack")["key"] == "half"
        assert [
            stroke["id"] for stroke in asked(f"{again.url}/api/pages/{made['id']}/state")[1]["strokes"]
        ].count("half") == 1
    finally:
        again.kill()


JUNK = (
    "", "null", "[]", "{", "[" * 5000, '{"type": 5}', '{"type": "stroke"}', '{"type": "stroke", "key": "a b", "points": [[0, 0]]}',
    '{"type": "stroke", "key": "k", "points": [[1, NaN]]}', '{"type": "stroke", "key": "k", "points": [[1e300, 0]]}',
    '{"type": "stroke", "key": "k", "points": [[1, 2], [3]]}', '{"type": "stroke", "key": "k", "points": [["1", "2"]]}',
    '{"type": "stroke", "key": "k", "points": [[0, 0]], "times": [1, 2]}', '{"type": "stroke", "key": "k", "points": [[0, 0], [1, 1]], "times": [2, 1]}',
    '{"type": "do", "key": "k", "action": {"do": "read", "meaning": "", "by": ""}}', '{"type": "do", "key": "k", "action": {"do": "fix", "component": "Q", "fixed": true}}',
    '{"type": "do", "key": "k", "action": {"do": "associate", "lines": [99], "component": "A", "anchor": [0, 0]}}',
    '{"type": "run", "run": 1, "seconds": 1e9}', '{"type": "run", "run": -1, "seconds": 1}', '{"type": "observe", "run": 0, "body": "A", "quantity": "x"}',
    '{"type": "analyze", "key": "k", "recognizer": "os:system"}', '{"type": "undo", "key": "k"}', '{"type": "contest", "seconds": "x"}',
)  # fmt: skip


def refusal(one: Client) -> str:
    """What the next error says; the page's own news may come before it."""
    while (heard := one.hear())["type"] != "error":
        assert heard["type"] in ("verdicts", "status", "state", "live"), heard
    return heard["message"]


def test_junk_is_answered_with_a_sentence_and_the_page_is_as_it_was(studio: Served, new_page) -> None:
    page = new_page()
    with client(studio.url, page) as one:
        for text in JUNK:
            one.socket.send(text)
            assert len(refusal(one)) > 10, text
        one.socket.send(b"\x00\x01")
        assert "JSON" in refusal(one)
        rng = random.Random(5)
        good = json.dumps({"type": "stroke", "key": "k1", "points": [[0, 0], [5, 5]], "times": [0, 1]})
        for _ in range(150):
            letters = list(good)
            for _ in range(rng.randint(1, 4)):
                letters[rng.randrange(len(letters))] = chr(
                    rng.choice((rng.randrange(32, 127), rng.randrange(0x100, 0xD800)))
                )
            one.socket.send("".join(letters))
        one.send(type="ping")
        one.told.pop("pong", None)
        while one.hear()["type"] != "pong":
            pass
        assert asked(f"{studio.url}/api/pages/{page}/state")[0] == 200
        one.socket.send(json.dumps({"type": "ping", "more": "x" * LIMITS.message}))
        with pytest.raises(ConnectionClosed):
            for _ in range(10):
                one.socket.recv(PATIENCE)


def test_another_site_another_name_and_too_large_a_page_are_refused(studio: Served, new_page) -> None:
    page = new_page()
    assert asked(f"{studio.url}/api/pages", origin="https://evil.example")[0] == 403
    with (
        pytest.raises(InvalidStatus, match="403"),
        connect(f"{studio.url.replace('http', 'ws')}/ws/{page}", origin="https://evil.example"),
    ):
        pass
    bare = http.client.HTTPConnection("127.0.0.1", studio.port, timeout=PATIENCE)
    bare.request("GET", "/api/pages", headers={"Host": "rebound.example"})
    assert bare.getresponse().status == 400
    bare.close()
    bare.putrequest("POST", "/api/open?name=a.inklined")
    bare.putheader("Content-Length", str(LIMITS.body + 1))
    bare.endheaders()
    assert bare.getresponse().status == 413
    assert asked(f"{studio.url}/api/open?name=a.inklined", "POST", b"{}")[0] == 400
    crowded = document.dumps(Sketch(Ink(tuple(Stroke([[k, 0]]) for k in range(LIMITS.strokes + 1)))))
    status, said = asked(f"{studio.url}/api/open?name=a.inklined", "POST", crowded.encode())
    assert status == 400 and f"at most {LIMITS.strokes}" in said.decode()
    assert asked(f"{studio.url}/api/open?name=a.exe", "POST", b"x")[0] == 400
    assert asked(f"{studio.url}/api/pages/nosuchpage")[0] == 404
    with (
        connect(f"{studio.url.replace('http', 'ws')}/ws/nosuchpage") as gone,
        pytest.raises(ConnectionClosed, match="there is no page"),
    ):
        gone.recv(PATIENCE)


def films(data: bytes, seconds: float) -> None:
    """Reads an MP4 file back: H.264, as long as was asked for, and something moves in it."""
    with av.open(BytesIO(data)) as file:
        (video,) = file.streams.video
        assert video.codec_context.name == "h264"
        shown = [frame.to_ndarray(format="gray").astype(int) for frame in file.decode(video)]
    assert len(shown) == round(30 * seconds) + 1
    assert np.abs(shown[-1] - shown[0]).max() > 50
    assert np.abs(shown[1] - shown[0]).mean() < np.abs(shown[-1] - shown[0]).mean()


def test_examples_files_and_pictures_come_over_http(studio: Served) -> None:
    status, made = asked(f"{studio.url}/api/examples/pendulum", "POST")
    assert status == 201
    base = f"{studio.url}/api/pages/{made['id']}"
    assert asked(f"{base}/thumbnail.svg")[1].startswith(b"<svg")
    exported = urllib.request.urlopen(f"{base}/export?kind=inklined").read()
    assert document.loads(exported.decode()).components
    assert urllib.request.urlopen(f"{base}/export?kind=gif&seconds=0.4").read()[:4] == b"GIF8"
    films(urllib.request.urlopen(f"{base}/export?kind=mp4&seconds=0.5").read(), 0.5)
    status, again = asked(f"{studio.url}/api/open?name=mine.inklined", "POST", exported)
    assert status == 201 and again["title"] == "mine"
    assert again["id"] in [one["id"] for one in asked(f"{studio.url}/api/pages?words=mine")[1]]
    assert asked(f"{studio.url}/api/pages/{again['id']}", "DELETE")[0] == 204
    assert again["id"] not in [one["id"] for one in asked(f"{studio.url}/api/pages")[1]]
    assert asked(f"{studio.url}/api/formula?text=v%5E2%2F2")[1]["mathml"].startswith("<math")
    assert asked(f"{studio.url}/api/formula?text=%28%28")[1]["problem"]


def test_beyond_this_machine_it_is_encrypted_on_demand_and_asks_for_its_token(tmp_path: Path) -> None:
    from starlette.testclient import TestClient

    from studio.guard import Doors
    from studio.serve import Address, certificate, url
    from studio.server import Settings, make

    app = make(
        Settings(tmp_path / "notebook.sqlite", Doors(frozenset({"localhost"}), "right-token"), warm=False)
    )
    with TestClient(app, base_url="http://127.0.0.1", follow_redirects=False) as browser:
        assert browser.get("/api/pages").status_code == 401
        assert browser.get("/?token=wrong").status_code == 401
        assert browser.get("/api/pages", headers={"authorization": "Bearer right-token"}).status_code == 200
        entered = browser.get("/?token=right-token")
        assert entered.status_code == 303 and "token" not in entered.headers["location"]
        assert browser.get("/api/pages").status_code == 200  # by its cookie
    chain, secret = certificate(tmp_path, "127.0.0.1")
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    context.load_cert_chain(chain, secret)
    assert secret.stat().st_mode & 0o077 == 0
    assert certificate(tmp_path, "127.0.0.1")[0].read_bytes() == chain.read_bytes()
    assert url(Address("127.0.0.1", 8765, tls=True), 8765, "t") == "https://127.0.0.1:8765/?token=t"


def test_a_port_that_is_taken_is_told_by_the_command(tmp_path: Path) -> None:
    from inklined.cli import run

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        assert run(["studio", "--no-browser", "--port", port, "--notebook", str(tmp_path)]) == 1


@pytest.mark.parametrize("mode", ["positive", "negative"])
def test_no_request_that_the_description_allows_or_forbids_makes_it_fail(studio: Served, mode: str) -> None:
    import schemathesis
    from hypothesis import HealthCheck, Phase, given, settings
    from schemathesis import GenerationMode

    schema = schemathesis.openapi.from_url(f"{studio.url}/api/openapi.json")
    tried = 0
    for found in schema.get_all_operations():
        operation = found.ok()

        @settings(
            max_examples=5,
            deadline=None,
            database=None,
            phases=(Phase.generate,),
            suppress_health_check=list(HealthCheck),
        )
        @given(case=operation.as_strategy(GenerationMode(mode)))
        def each(case: Any) -> None:
            nonlocal tried
            tried += 1
            assert case.call(base_url=studio.url, timeout=PATIENCE).status_code < 500, case.as_curl_command()

        with contextlib.suppress(Unsatisfiable):
            each()
    assert tried > 15
