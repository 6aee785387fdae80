"""The studio's addresses: what each answers, from a session. Who may ask is the guard's matter."""

from __future__ import annotations

import contextlib
import json
from collections.abc import AsyncIterator, Callable
from typing import Any, Final

from starlette.applications import Starlette
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp

from wrapit.errors import ConfigError
from wrapit.pipeline.output.ownership import is_plain_name
from wrapit.studio.gate import Door, Guard
from wrapit.studio.serving import built_file, drawing_file, not_there, page_file
from wrapit.studio.session import RefusedError, Session

LARGEST_BODY: Final = 1_500_000
"""Bytes of a request: a config of 200 kB in which JSON writes each letter as six, and some."""
MOST_ALTERNATIVES: Final = 12
"""As many as `wrapit build --alternatives` takes."""
ASSETS: Final = (".js", ".css")
"""Kinds of files that the page loads; its own text is at `/`."""


def application(session: Session, door: Door) -> ASGIApp:
    """The guarded application; its begin and end are the session's."""

    @contextlib.asynccontextmanager
    async def life(app: Starlette) -> AsyncIterator[None]:  # noqa: ARG001  the signature is Starlette's
        session.begin()
        try:
            yield
        finally:
            session.end()

    async def page(request: Request) -> Response:
        answer = page_file("studio.html")
        if door.has_token(request.url.query):
            answer.set_cookie(door.cookie, door.token, path="/", httponly=True, samesite="strict")
        return answer

    async def asset(request: Request) -> Response:
        name = request.path_params["name"]
        return page_file(name) if is_plain_name(name) and name.endswith(ASSETS) else not_there()

    async def state(request: Request) -> Response:  # noqa: ARG001
        return JSONResponse(session.state())

    async def events(request: Request) -> Response:  # noqa: ARG001
        return StreamingResponse(_events(session), media_type="text/event-stream")

    async def file(request: Request) -> Response:
        return built_file(session.folder, session.files, request.path_params["name"])

    async def drawing(request: Request) -> Response:  # noqa: ARG001
        return drawing_file(session.drawing)

    return Guard(
        Starlette(
            routes=[
                Route("/", page),
                Route("/assets/{name:path}", asset),
                Route("/state", state),
                Route("/events", events),
                Route("/file/{name:path}", file),
                Route("/drawing", drawing),
                _post("/change", session.change),
                _post("/text", lambda body: session.replace(*_text(body))),
                _post("/undo", lambda body: session.undo()),
                _post("/redo", lambda body: session.redo()),
                _post("/again", lambda body: session.again()),
                _post("/alternatives", lambda body: session.find_alternatives(_count(body)), 202),
                _post("/fewer-wires", lambda body: session.find_fewer_wires(), 202),
            ],
            lifespan=life,
        ),
        door,
    )


async def _events(session: Session) -> AsyncIterator[str]:
    async for revision in session.revisions():
        yield ": still here\n\n" if revision is None else f"data: {json.dumps({'revision': revision})}\n\n"


def _post(path: str, act: Callable[[Any], int], status: int = 200) -> Route:
    """An address that changes something: `act` gets the body's document and returns the new revision."""

    async def answer(request: Request) -> Response:
        try:
            return JSONResponse({"revision": act(await _document(request))}, status)
        except RefusedError as refused:
            return JSONResponse({"error": refused.error}, refused.status)
        except ClientDisconnect:  # amid its request: nobody is there to read an answer
            return Response(status_code=400)

    return Route(path, answer, methods=["POST"])


async def _document(request: Request) -> Any:
    body = b""
    async for part in request.stream():
        body += part
        if len(body) > LARGEST_BODY:
            problem = f"this is more than {LARGEST_BODY // 1000} kB"
            raise RefusedError(413, ConfigError(problem, "request", "the drawing is a file of its own"))
    try:
        return json.loads(body)
    except (ValueError, RecursionError):
        raise RefusedError(400, ConfigError("this is no JSON", "request", "send one document")) from None


def _text(body: Any) -> tuple[str, str]:
    text, base = (body.get("text"), body.get("base")) if isinstance(body, dict) else (None, None)
    if not isinstance(text, str) or not isinstance(base, str):
        raise RefusedError(422, ConfigError("a text and its base are asked for", "request", "send both"))
    return text, base


def _count(body: Any) -> int:
    count = body.get("count", 4) if isinstance(body, dict) else None
    if isinstance(count, bool) or not isinstance(count, int):
        raise RefusedError(422, ConfigError("a count is a whole number", "count", "send for example 4"))
    if not 1 <= count <= MOST_ALTERNATIVES:
        remedy = f"choose between 1 and {MOST_ALTERNATIVES}"
        raise RefusedError(422, ConfigError(f"{count} alternatives can't be shown", "count", remedy))
    return count
