"""Who may talk to the studio: only pages that it served itself, and where it listens beyond this machine only people
who have the token that the terminal shows.

An ASGI layer around everything: the Host must be an address or a name that the studio was started with (a name that
somebody else's DNS points here is refused), an Origin must be that of the Host, bodies must not be larger than
`LIMITS.body`.
"""

from __future__ import annotations

import hmac
import ipaddress
from collections.abc import Iterable
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, urlencode, urlsplit

from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from studio.limits import LIMITS

COOKIE = "inklined"
POLICY = (
    b"default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; connect-src 'self' ws: wss:; "
    b"frame-ancestors 'none'; base-uri 'none'; form-action 'self'"
)
HEADERS: tuple[tuple[bytes, bytes], ...] = (
    (b"content-security-policy", POLICY),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
)


@dataclass(frozen=True, slots=True)
class Doors:
    """names: host names, besides addresses, that the studio may be called by; token: what must be shown, None where
    anybody on this machine may come in."""

    names: frozenset[str] = frozenset({"localhost"})
    token: str | None = None


class Guard:
    """The layer."""

    def __init__(self, app: ASGIApp, doors: Doors) -> None:
        self._app, self._doors = app, doors

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        refusal = self._refusal(headers, scope)
        if refusal is not None:
            await _refuse(scope, receive, send, *refusal)
            return
        if scope["type"] == "websocket":
            await self._app(scope, receive, send)
            return
        shown = parse_qs(scope["query_string"].decode("latin-1")).get("token", [])
        if self._doors.token is not None and self._right(shown) and scope["method"] == "GET":
            answer = RedirectResponse(_without_token(scope), status_code=303)
            answer.set_cookie(
                COOKIE, shown[0], httponly=True, samesite="strict", secure=scope["scheme"] == "https"
            )
            await answer(scope, receive, send)
            return
        await self._app(scope, _limited(receive), _with_headers(send))

    def _refusal(self, headers: Headers, scope: Scope) -> tuple[int, str] | None:
        host = headers.get("host", "")
        if not self._known(host):
            return 400, "This studio does not go by that name: use the address that the terminal shows."
        origin = headers.get("origin")
        if origin is not None and urlsplit(origin).netloc.casefold() != host.casefold():
            return 403, "Another site's page may not talk to this studio."
        if scope["type"] == "http":
            length = headers.get("content-length", "0")
            if not length.isdecimal() or int(length) > LIMITS.body:
                return 413, f"At most {LIMITS.body >> 20} MB are accepted."
        if self._doors.token is not None and not self._right(self._shown(headers, scope)):
            return 401, "Open the address with the token that the terminal shows."
        return None

    def _known(self, host: str) -> bool:
        try:
            name = urlsplit(f"//{host}").hostname or ""
            ipaddress.ip_address(name)
        except ValueError:
            name = host.rpartition(":")[0] or host
            return name.casefold() in self._doors.names
        return True

    def _right(self, shown: Iterable[str]) -> bool:
        token = (self._doors.token or "").encode()
        return any(hmac.compare_digest(one.encode(), token) for one in shown)

    def _shown(self, headers: Headers, scope: Scope) -> list[str]:
        found = parse_qs(scope["query_string"].decode("latin-1")).get("token", [])
        scheme, _, word = headers.get("authorization", "").partition(" ")
        if scheme.casefold() == "bearer":
            found.append(word)
        try:
            cookies = SimpleCookie(headers.get("cookie", ""))
        except CookieError:
            return found
        if COOKIE in cookies:
            found.append(cookies[COOKIE].value)
        return found


def _without_token(scope: Scope) -> str:
    asked = parse_qs(scope["query_string"].decode("latin-1"))
    asked.pop("token", None)
    path = "/" + scope["path"].lstrip("/")
    return path + (f"?{urlencode(asked, doseq=True)}" if asked else "")


async def _refuse(scope: Scope, receive: Receive, send: Send, status: int, why: str) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": why[:120]})
        return
    await PlainTextResponse(why, status)(scope, receive, send)


class TooLarge(ValueError):
    """A body that goes on beyond `LIMITS.body`."""


def _limited(receive: Receive) -> Receive:
    """The same body, which ends with an error where it has no length and is too long."""
    seen = 0

    async def limited() -> Message:
        nonlocal seen
        message = await receive()
        seen += len(message.get("body", b""))
        if seen > LIMITS.body:
            raise TooLarge(f"At most {LIMITS.body >> 20} MB are accepted.")
        return message

    return limited


def _with_headers(send: Send) -> Send:
    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message["headers"], *HEADERS]
        await send(message)

    return sending
