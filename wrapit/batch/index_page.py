"""The catalogue as one page: pieces with their pictures, what they need, and what failed and why."""

from __future__ import annotations

import base64
import hashlib
from importlib import resources
from typing import Any
from urllib.parse import quote

from wrapit.batch.telling import amount, duration, length


def index_page(document: dict[str, Any]) -> str:
    """`index.html`; the same document gives the same text.

    Its style and its script are the only ones that the page lets run, by their hashes.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from markupsafe import Markup

    environment = Environment(
        loader=PackageLoader("wrapit.batch", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    style, script = _own("index.css"), _own("index.js")
    return environment.get_template("index.html.jinja").render(
        pieces=document["pieces"],
        totals=document["totals"],
        style=Markup(style),
        script=Markup(script),
        style_hash=_hash(style),
        script_hash=_hash(script),
        link=quote,
        amount=amount,
        duration=duration,
        length=length,
    )


def _own(name: str) -> str:
    return resources.files("wrapit.batch").joinpath(name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    return f"'sha256-{digest}'"
