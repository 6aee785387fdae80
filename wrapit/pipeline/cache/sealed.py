"""One entry as bytes: a small head, files, and a pickled value, under a checksum."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

# What an entry of this form begins with; another form gets another one.
_MAGIC: Final = b"wrapit-cache/1\n"
# Of SHA-256, and of the number that says how long the contents' list is.
_DIGEST_BYTES, _LENGTH_BYTES = 32, 8


@dataclass(frozen=True)
class Entry:
    """What is kept under one key: `head` is JSON, `files` are bytes by name, `value` is pickled."""

    head: dict[str, Any]
    files: Mapping[str, bytes] = field(default_factory=dict)
    value: bytes = b""


def sealed(key: str, entry: Entry) -> bytes:
    """The entry as bytes; `key` is part of the checksum, so that it opens under no other name."""
    sizes = [[name, len(data)] for name, data in entry.files.items()]
    contents = json.dumps({"head": entry.head, "files": sizes}).encode()
    body = b"".join(
        (len(contents).to_bytes(_LENGTH_BYTES, "big"), contents, *entry.files.values(), entry.value)
    )
    return _MAGIC + _digest(key, body) + body


def opened(key: str, data: bytes) -> Entry:
    """The entry in these bytes. Raises ValueError where they are cut off, changed, or of another key.

    >>> opened("a", sealed("a", Entry({"x": 1}, {"f": b"12"}, b"3")))
    Entry(head={'x': 1}, files={'f': b'12'}, value=b'3')
    >>> opened("a", sealed("b", Entry({})))
    Traceback (most recent call last):
    ValueError: not an entry of this key
    """
    start = len(_MAGIC) + _DIGEST_BYTES
    body = memoryview(data)[start:]
    if data[:start] != _MAGIC + _digest(key, body):
        raise ValueError("not an entry of this key")
    place = _LENGTH_BYTES + int.from_bytes(body[:_LENGTH_BYTES], "big")
    contents = json.loads(bytes(body[_LENGTH_BYTES:place]))
    files = {}
    for name, size in contents["files"]:
        files[name] = bytes(body[place : place + size])
        place += size
    return Entry(contents["head"], files, bytes(body[place:]))


def _digest(key: str, body: bytes | memoryview) -> bytes:
    digest = hashlib.sha256(f"{key}\n".encode())
    digest.update(body)
    return digest.digest()
