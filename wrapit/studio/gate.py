"""Who may ask: a page of ours in a browser on this machine, and nobody else.

Any page on the web can send requests to this machine, and a name of somebody else's can be made to mean it
(DNS rebinding). So each request names us as its host, comes from our own page if it says where it comes
from, and knows the token, which the link hands to the browser once and the browser keeps in a cookie.
"""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from dataclasses import dataclass, field
from http.cookies import CookieError, SimpleCookie
from typing import Final
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

TOKEN_BYTES: Final = 32
"""256 random bits: nobody guesses them in the life of a server."""
# The page loads nothing from outside, and nobody else frames it; its script sets widths as styles.
PAGE_POLICY: Final = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
    "connect-src 'self'; frame-src 'self'; frame-ancestors 'self'; base-uri 'none'; form-action 'none'"
)
# What each answer says to the browser, unless it says something else itself.
_HEADERS: Final = {
    "Content-Security-Policy": PAGE_POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
}


def new_token() -> str:
    """A token of a server."""
    return secrets.token_urlsafe(TOKEN_BYTES)


@dataclass(frozen=True)
class Door:
    """What a request has to know to come in."""

    port: int
    token: str = field(default_factory=new_token, repr=False)

    @property
    def cookie(self) -> str:
        """The cookie's name; cookies don't tell ports apart, and two studios may run at once."""
        return f"wrapit-{self.port}"

    @property
    def link(self) -> str:
        """The address with the token."""
        return f"http://127.0.0.1:{self.port}/?token={self.token}"

    @property
    def hosts(self) -> tuple[str, ...]:
        """What the browser may call us."""
        return (f"127.0.0.1:{self.port}", f"localhost:{self.port}")

    def refusal(self, method: str, headers: Headers, query: str) -> str | None:
        """Why a request may not come in; None where it may."""
        return next(self._refusals(method, headers, query), None)

    def _refusals(self, method: str, headers: Headers, query: str) -> Iterator[str]:
        origins = tuple(f"http://{host}" for host in self.hosts)
        given = headers.getlist("origin")
        site = headers.get("sec-fetch-site", "none")
        if [host.lower() for host in headers.getlist("host")] not in [[host] for host in self.hosts]:
            yield "this address is not the studio's"
        if any(origin.lower() not in origins for origin in given):
            yield "this page is not the studio's"
        if not (self.has_token(query) or self._has_cookie(headers)):
            yield "open the link that wrapit studio printed: this one lacks its token"
        # A page of another port has the cookie too, for a site is a site whatever its port.
        if site not in ("same-origin", "none") and not self.has_token(query):
            yield "another page asks"
        if method not in ("GET", "HEAD"):
            if headers.get("content-type", "").partition(";")[0].strip().lower() != "application/json":
                yield "a change is sent as application/json"
            if not given and site != "same-origin":
                yield "a change comes from the studio's own page"

    def has_token(self, query: str) -> bool:
        """Whether the query of an address has the token."""
        return any(self._is_token(given) for given in parse_qs(query).get("token", ()))

    def _has_cookie(self, headers: Headers) -> bool:
        for line in headers.getlist("cookie"):
            for pair in line.split(";"):
                try:
                    crumbs = SimpleCookie(pair.strip())
                except CookieError:  # another server's, with a name that is none
                    continue
                if self.cookie in crumbs and self._is_token(crumbs[self.cookie].value):
                    return True
        return False

    def _is_token(self, given: str) -> bool:
        return secrets.compare_digest(given.encode("utf-8", "replace"), self.token.encode())


class Guard:
    """Lets nothing pass to an application but what the door lets in, and puts our headers on each answer."""

    def __init__(self, inner: ASGIApp, door: Door) -> None:
        self._inner, self._door = inner, door

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._inner(scope, receive, send)  # the server's own begin and end; it speaks no websockets
            return
        query = scope.get("query_string", b"").decode("latin-1")
        refusal = self._door.refusal(scope["method"], Headers(scope=scope), query)

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in _HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        answer = self._inner if refusal is None else PlainTextResponse(f"{refusal}\n", 403)
        await answer(scope, receive, send_with_headers)
