"""The studio's server: pages over HTTP (described at /api/openapi.json), pen and motion over a websocket."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator
from contextlib import asynccontextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Annotated, Any

from fastapi import FastAPI, Query, Request, Response, WebSocket
from fastapi.responses import JSONResponse
from pydantic import BaseModel, Field
from starlette.staticfiles import StaticFiles

from sketch.files.errors import FileError
from sketch.formula import mathml
from sketch.formula.parse import expression
from studio import examples, exports
from studio.actions import Title
from studio.bundle import DIST
from studio.desk import Desk, opened
from studio.guard import Doors, Guard, TooLarge
from studio.limits import LIMITS, Refused
from studio.link import Link


@dataclass(frozen=True, slots=True)
class Settings:
    """notebook: the file that pages are kept in; doors: who may come in; warm: whether the engine is made ready
    at once."""

    notebook: Path
    doors: Doors = field(default_factory=Doors)
    warm: bool = True


class Page(BaseModel):
    """A page in the notebook; times in seconds since 1970."""

    id: str
    title: str
    words: str = Field(description="Its formulas.")
    strokes: int
    created: float
    changed: float


class NewPage(BaseModel):
    """A page to be made."""

    title: str = Field("", max_length=LIMITS.title)


class Example(BaseModel):
    """A page that comes with the studio."""

    name: str
    title: str
    about: str


class Formula(BaseModel):
    """A formula as it is read."""

    mathml: str | None
    problem: str | None


class Reason(BaseModel):
    """What was wrong, and what would be right."""

    detail: str


class Status(BaseModel):
    """Whether recognizers are loaded and the engine is compiled; what is the most of everything."""

    ready: bool
    limits: dict[str, float]


REFUSALS: dict[int | str, dict[str, Any]] = {
    400: {"model": Reason}, 403: {"model": Reason}, 404: {"model": Reason}, 409: {"model": Reason}, 413: {"model": Reason},
}  # fmt: skip
PageId = Annotated[str, "The name of a page, as /api/pages tells it."]


def make(settings: Settings) -> FastAPI:
    """The application."""

    @asynccontextmanager
    async def life(app: FastAPI) -> AsyncGenerator[None]:
        app.state.desk = desk = Desk(settings.notebook)
        warming = asyncio.create_task(desk.warm()) if settings.warm else None
        desk.ready = not settings.warm
        yield
        if warming is not None:
            warming.cancel()
        desk.close()

    app = FastAPI(
        title="inklined studio", version="1", lifespan=life, docs_url=None, redoc_url=None,
        openapi_url="/api/openapi.json", responses=REFUSALS,
    )  # fmt: skip
    app.add_exception_handler(Refused, _refused)
    app.add_exception_handler(FileError, _refused)
    app.add_exception_handler(TooLarge, _too_large)
    app.add_middleware(Guard, doors=settings.doors)
    _pages(app)
    _files(app)
    _socket(app)
    if DIST.is_dir():
        app.mount("/", StaticFiles(directory=DIST, html=True), name="web")
    return app


async def _refused(_: Request, reason: Exception) -> Response:
    missing = str(reason).startswith("there is no ")
    return JSONResponse({"detail": str(reason)}, 404 if missing else 400)


async def _too_large(_: Request, reason: Exception) -> Response:
    return JSONResponse({"detail": str(reason)}, 413)


def _pages(app: FastAPI) -> None:
    @app.get("/api/status")
    async def status(request: Request) -> Status:
        """Whether the studio is ready, and its limits."""
        return Status(ready=request.app.state.desk.ready, limits=asdict(LIMITS))

    @app.get("/api/pages")
    async def pages(request: Request, words: Annotated[str, Query(max_length=200)] = "") -> list[Page]:
        """The notebook's pages, the last changed first; only those in whose name or formulas all words stand."""
        found = await asyncio.to_thread(_desk(request).store.pages, words)
        return [Page(**asdict(one)) for one in found]

    @app.post("/api/pages", status_code=201)
    async def create(request: Request, new: NewPage) -> Page:
        """Makes an empty page."""
        desk = _desk(request)
        page = await desk.new_page()
        if new.title:
            await (await desk.session(page)).act("title", Title(new.title))
        return Page(**asdict(await asyncio.to_thread(desk.store.page, page)))

    @app.get("/api/pages/{page}")
    async def one(request: Request, page: PageId) -> Page:
        """One page of the notebook."""
        return Page(**asdict(await asyncio.to_thread(_desk(request).store.page, page)))

    @app.get("/api/pages/{page}/state")
    async def state(request: Request, page: PageId) -> dict[str, Any]:
        """What is on a page: components, formulas, associations, corrections, notices."""
        return (await _desk(request).session(page)).state()

    @app.delete("/api/pages/{page}", status_code=204)
    async def throw(request: Request, page: PageId) -> None:
        """Throws a page away; POST …/back fetches it back."""
        await asyncio.to_thread(_desk(request).throw, page)

    @app.post("/api/pages/{page}/back", status_code=204)
    async def back(request: Request, page: PageId) -> None:
        """Fetches a page back that was thrown away."""
        await asyncio.to_thread(_desk(request).store.fetch_back, page)

    @app.get("/api/formula")
    async def formula(text: Annotated[str, Query(min_length=1, max_length=LIMITS.formula)]) -> Formula:
        """How a typed formula is read: MathML, or what is wrong with it."""
        read = await asyncio.to_thread(expression, text)
        return Formula(mathml=mathml.shown(read), problem=read.problem)

    @app.get("/api/examples")
    async def every_example() -> list[Example]:
        """The pages that come with the studio."""
        return [Example(name=one.name, title=one.title, about=one.about) for one in examples.EXAMPLES]

    @app.post("/api/examples/{name}", status_code=201)
    async def example(request: Request, name: str) -> Page:
        """A copy of an example as a new page."""
        desk = _desk(request)
        sketch, title = await asyncio.to_thread(examples.example, name)
        page = await desk.new_page(sketch, title)
        return Page(**asdict(await asyncio.to_thread(desk.store.page, page)))


def _files(app: FastAPI) -> None:
    @app.post("/api/open", status_code=201)
    async def open_file(request: Request, name: Annotated[str, Query(min_length=1, max_length=200)]) -> Page:
        """A file as a new page: the body is the file, .inklined or .inkml by its name."""
        desk, data = _desk(request), await request.body()
        sketch = await asyncio.to_thread(opened, name, data)
        if len(sketch.ink) > LIMITS.strokes:
            raise Refused(f"{name} has {len(sketch.ink)} strokes; a page holds at most {LIMITS.strokes}")
        page = await desk.new_page(sketch, Path(name).stem[: LIMITS.title])
        return Page(**asdict(await asyncio.to_thread(desk.store.page, page)))

    @app.get("/api/pages/{page}/thumbnail.svg", response_class=Response)
    async def thumbnail(request: Request, page: PageId) -> Response:
        """A small picture of a page."""
        session = await _desk(request).session(page)
        sketch = session.shown.sketch
        text = await asyncio.get_running_loop().run_in_executor(
            _desk(request).work, exports.thumbnail, sketch
        )
        return Response(text, media_type="image/svg+xml")

    @app.get("/api/pages/{page}/export", response_class=Response)
    async def export(
        request: Request, page: PageId, kind: exports.Kind, seconds: Annotated[float, Query(ge=0.1, le=10)] = 3.0
    ) -> Response:  # fmt: skip
        """A page as a file: .inklined (everything), .inkml (ink), .svg (a picture), .gif and .mp4 (its motion)."""
        session = await _desk(request).session(page)
        made = await asyncio.get_running_loop().run_in_executor(
            _desk(request).runs, exports.exported, session.shown, kind, seconds
        )
        name = exports.file_name(session.board, kind)
        return Response(
            made,
            media_type=exports.MEDIA[kind],
            headers={"content-disposition": f'attachment; filename="{name}"'},
        )


def _socket(app: FastAPI) -> None:
    @app.websocket("/ws/{page}")
    async def socket(websocket: WebSocket, page: str) -> None:
        desk: Desk = websocket.app.state.desk
        await websocket.accept()
        if len(desk.connected) >= LIMITS.clients:
            await websocket.close(1013, f"{LIMITS.clients} browsers are connected, the most there may be")
            return
        try:
            session = await desk.session(page)
        except Refused as reason:
            await websocket.close(4404, str(reason)[:120])
            return
        await Link(websocket, desk, session).serve()


def _desk(request: Request) -> Desk:
    return request.app.state.desk
