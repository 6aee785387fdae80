"""Damaged files, generated from valid ones: cut, repeated, overwritten."""

from __future__ import annotations

from hypothesis import strategies as st

TOKENS = (
    b"", b"\0", b"<", b'"', b"{", b"]", b"1e999", b"-1e300", b"nan", b"9" * 500, b"\xff\xfe", b"\\ud800",
    b"<use href='#a'/>", b"<!--", b"rotate(", b"true", b"null", b"[[", b"&#0;", b"e", b"-", b" ",
)  # fmt: skip


@st.composite
def damaged(draw: st.DrawFn, valid: bytes) -> bytes:
    """Up to four mistakes in a valid file, each a part of it replaced by a token or by another part."""
    data = valid
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(data)))
        stop = min(len(data), start + draw(st.sampled_from((0, 0, 1, 2, 8, 64, 10**9))))
        copied = draw(st.integers(0, len(data)))
        token = draw(
            st.one_of(st.sampled_from(TOKENS), st.just(data[copied : copied + 40]), st.binary(max_size=3))
        )
        data = data[:start] + token + data[stop:]
    return data
