"""SVG files made to take for ever, or by mistake: refused at once, in one line, with place and remedy."""

from __future__ import annotations

import gzip
import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.drawing.mutations import damaged
from wrapit.config import TracingConfig
from wrapit.drawing.json_file import drawing_json, read_drawing
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.drawing.svg.reading.outlines import MOST_PARTS
from wrapit.drawing.svg.reading.scene import MOST_SHAPES, read_page
from wrapit.errors import DrawingError

STROKE = 'fill="none" stroke="black" stroke-width="2"'
CROSS = f'<path {STROKE} d="M10 10 L90 90 M10 50 L90 30"/>'
# Far above what any refusal takes, far below what the patterns took.
PATIENCE_S = 15.0


def svg(body: str, size: str = 'width="100mm" height="100mm" viewBox="0 0 100 100"') -> bytes:
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f"<svg {names} {size}>{body}</svg>".encode()


def read(folder: Path, data: bytes, size_mm: float | None = None) -> Drawing:
    path = folder / "drawing.svg"
    path.write_bytes(data)
    return trace(path, TracingConfig(), size_mm)[0]


def refusal(folder: Path, data: bytes, size_mm: float | None = None) -> str:
    begin = time.process_time()
    with pytest.raises(DrawingError) as caught:
        read(folder, data, size_mm)
    assert time.process_time() - begin < PATIENCE_S
    assert "drawing.svg" in caught.value.where
    assert caught.value.remedy
    assert "()" not in str(caught.value)
    assert "Error" not in str(caught.value)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def pyramid(levels: int, copies: int) -> str:
    defs = [f'<g id="g0">{CROSS}</g>']
    defs += [
        f'<g id="g{k}">' + f'<use xlink:href="#g{k - 1}"/>' * copies + "</g>" for k in range(1, levels + 1)
    ]
    return f'<defs>{"".join(defs)}</defs><use href="#g{levels}"/>'


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(levels=st.integers(1, 400), copies=st.integers(1, 30))
def test_copies_are_counted_before_they_are_made(tmp_path, levels, copies):
    made = sum(2 * copies**k for k in range(min(levels, 20) + 1))
    data = svg(pyramid(levels, copies))
    if made > MOST_SHAPES or levels > 150:
        message = refusal(tmp_path, data)
        assert "copies" in message or "deep" in message
    elif made < MOST_SHAPES / 8 and levels < 40:
        (tmp_path / "drawing.svg").write_bytes(data)
        assert read_page(tmp_path / "drawing.svg").shapes


def test_copies_that_are_few_are_drawn(tmp_path):
    assert len(read(tmp_path, svg(pyramid(2, 3))).segments) == 4


@pytest.mark.parametrize("length", [1, 2, 7, 3000])
def test_copies_in_a_circle_are_left_out_with_a_warning(tmp_path, length):
    ring = "".join(f'<g id="g{k}"><use href="#g{(k + 1) % length}"/></g>' for k in range(length))
    (tmp_path / "drawing.svg").write_bytes(svg(CROSS + ring))
    drawing, findings = trace(tmp_path / "drawing.svg", TracingConfig(), None)
    assert len(drawing.segments) == 4
    assert [finding.code for finding in findings] == ["endless-copy"]


@pytest.mark.parametrize(
    "body",
    [
        "<image " * 20_000,
        "<!--" * 20_000,
        '<g transform="' + "rotate(" * 20_000 + f'">{CROSS}</g>',
        '<g style="transform:' + "rotate(" * 500 + f'">{CROSS}</g>',
        "<style>" + "/*" * 100_000 + "</style>" + CROSS,
        "<style>" + "a" * 500_000 + "</style>" + CROSS,
        "<style>" + "a{" * 100_000 + "</style>" + CROSS,
        "<style>.a{" + "x:y;" * 1000 + "}</style>" + f'<path class="{"a " * 50_000}" d="M0 0L9 9"/>' * 3,
        f'<polyline {STROKE} points="{"1" * 20_000}"/>',
        f'<polyline {STROKE} points="{("1" * 19 + ";") * 9_000}"/>',
        f'<polyline {STROKE} points="{" " * 50_000}"/>',
        f'<path {STROKE} d="M0 0L{"1" * 50_000}"/>',
        f'<path stroke="rgb({",".join(["1" * 300] * 4)}" d="M0 0L9 9"/>',
        '<g transform="' + "translate(1 1)" * 500 + '">' + CROSS * 2000 + "</g>",
        "<g " + " ".join(f'a{k}="1"' for k in range(20_000)) + ">" + CROSS * 500 + "</g>",
        "<g>" * 10_000 + CROSS + "</g>" * 10_000,
        f'<g fill="url({" " * 50_000}"/>{CROSS}',
    ],
    ids=lambda body: body[:24] + body[-12:],
)
def test_texts_that_took_minutes_are_read_or_refused_at_once(tmp_path, body):
    check(tmp_path, svg(body))


@pytest.mark.parametrize(
    "body",
    [
        f'<path {STROKE} d="M0 0' + "".join(f"L{k % 97} {k % 89}" for k in range(MOST_PARTS + 1)) + '"/>',
        f'<path {STROKE} d="M0 0h1"/>' * (MOST_SHAPES // 2) + f'<path {STROKE} d="M0 0{"h1v1" * 9000}"/>',
        f'<polyline {STROKE} points="{"1,2 " * (MOST_PARTS + 2)}"/>',
        f'<path {STROKE} d="M0 0{"a1 1 0 1 1 1 1" * 4000}"/>',
    ],
    ids=["one path", "many paths", "polyline", "arcs"],
)
def test_too_many_parts_are_refused_with_their_number(tmp_path, body):
    assert f"the limit is {MOST_PARTS}" in refusal(tmp_path, svg(body))


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "empty"),
        (b" \n", "empty"),
        (b"<foo/>", "<foo>"),
        (b'<g xmlns="http://www.w3.org/2000/svg"/>', "<g>"),
        (b'<svg xmlns="http://example.com"><path d="M0 0"/></svg>', "no SVG"),
        (b"<!DOCTYPE html><html><p>hello<br></html>", "web page"),
        (b"\xef\xbb\xbf <html><svg/></html>", "web page"),
        (gzip.compress(svg(CROSS), mtime=0)[:-20], "cut off"),
        (gzip.compress(svg(CROSS), mtime=0)[:9] + b"nothing", "damaged"),
        (gzip.compress(b" " * 60_000_000, mtime=0), "50 MB when unpacked"),
        (gzip.compress(b"<html/>", mtime=0), "web page"),
        (b"\x89PNG\r\n\x1a\n", "PNG"),
        (b"%PDF-1.7", "PDF"),
        (svg(CROSS) + b"\0", "not valid XML"),
        (b'<?xml version="1.0" encoding="foo"?>' + svg(CROSS), "encoding"),
        (b'<?xml version="1.0" encoding="shift_jis"?>' + svg(CROSS), "encoding"),
        (svg(f'\n<path id="wing" {STROKE} d="M 10 10 L"/>'), "drawing.svg:2: the data of path 'wing'"),
        (svg('<image xlink:href=" http://example.com/a.png"/>'), "another file"),
        (svg('<image xlink:href="data:image/png;base64,AA"/>'), "a picture and no lines"),
        (svg("<text>Hello</text>"), "text and no lines"),
        (b"<!-- saved --><html><body><br><svg/></body></html>", "web page"),
    ],
)
def test_what_is_no_svg_is_refused_in_words(tmp_path, data, reason):
    assert reason in refusal(tmp_path, data)


@pytest.mark.parametrize("name", ["drawing.svgz", "drawing.svg"])
def test_a_compressed_file_is_read_as_what_it_holds(tmp_path, name):
    (tmp_path / name).write_bytes(gzip.compress(svg(CROSS), mtime=0))
    compressed = trace(tmp_path / name, TracingConfig(), None)[0]
    assert drawing_json(compressed) == drawing_json(read(tmp_path, svg(CROSS)))


@pytest.mark.parametrize(
    ("head", "body", "codes"),
    [
        ('<?xml-stylesheet href="a.css"?>', "", ["other-file"]),
        ("", f'<path id="wing" {STROKE} d="M 10 10 L"/>', ["path-data"]),
        ("", '<g transform="matrix(1 2)"/>', ["transform"]),
        ("", '<image href="a.png"/><use href="b.svg#c"/>', ["other-file"]),
        ("", '<image href="data:image/png;base64,AA"/>', ["picture-left-out"]),
        ("", "<text>a</text><text> </text><g><text><tspan>b</tspan></text></g>", ["text-left-out"]),
        ("", '<path stroke="red" stroke-linecap="round" d="M30 80zM60 80h0"/>', ["dots"]),
        ("", '<path fill="url( http://example.com)" d=""/>', []),
        ("", '<style>@import "a.css"; @font-face{src:url(b.woff)}</style>', []),
        ("", "<inkscape:page a:b='1'/><title>&nbsp;&copy;&unknown;</title>", []),
        ('<!DOCTYPE svg [<!ENTITY ns "http://ns.adobe.com/"><!ENTITY c "black">]>', '<g id="&ns;"/>', []),
    ],
)
def test_what_is_harmless_is_read_and_what_is_left_out_is_named(tmp_path, head, body, codes):
    (tmp_path / "drawing.svg").write_bytes(head.encode() + svg(CROSS + body))
    drawing, findings = trace(tmp_path / "drawing.svg", TracingConfig(), None)
    assert len(drawing.segments) == 4
    assert [finding.code for finding in findings] == codes
    assert all(finding.remedy for finding in findings)


@pytest.mark.parametrize(
    "entities",
    [
        "".join(f'<!ENTITY e{k} "{10 * f"&#38;e{k - 1};"}">' for k in range(1, 20)),
        f'<!ENTITY big "{"x" * 100_000}">',
        '<!ENTITY % a "b">',
        f'<!ATTLIST path id CDATA "{"x" * 200_000}">',
    ],
    ids=["nested", "long", "parameter", "default"],
)
def test_entities_that_could_grow_are_refused(tmp_path, entities):
    body = CROSS * 200 + f"<desc>{'&big;' * 1000}</desc>"
    assert "entities" in refusal(tmp_path, f"<!DOCTYPE svg [{entities}]>".encode() + svg(body))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1", "windows-1252"])
def test_the_encoding_that_the_file_names_is_read(tmp_path, encoding):
    text = svg(f"<title>Flügel</title>{CROSS}").decode()
    drawing = read(tmp_path, f'<?xml version="1.0" encoding="{encoding}"?>{text}'.encode(encoding))
    assert len(drawing.segments) == 4


def test_styles_and_document_types_as_programs_write_them_are_read(tmp_path):
    head = (
        b'<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    )
    style = "<style>/* a */ .a{stroke:rgb(10.5%, 0%, 0%); fill:none} @media print{.b{fill:red}}/* b */"
    body = style + '</style><path class="a" d="M10 10 L90 90 M10 50 L90 30"/><path fill="url(#x)" d=""/>'
    assert len(read(tmp_path, head + svg(body)).segments) == 4


NUMBERS = st.one_of(
    st.sampled_from(("1e9", "1e12", "1e154", "1e155", "1e300", "1e309", "-1e400", "1e-300", "nan", "0")),
    st.floats(allow_nan=True).map(repr),
)
SHAPES = (
    '<path {s} d="M10 10 L{n} 90 M10 50 L90 30"/>',
    '<path {s} d="M{n} {n} l10 10"/>',
    '<path {s} d="M10 10A{n} 5 {n} 0 1 50 50"/>',
    '<g transform="scale({n})"><path {s} d="M10 10 L90 90"/></g>',
    '<g transform="rotate({n}) translate({n} 3) skewX({n})"><path {s} d="M10 10 L90 90"/></g>',
    '<path fill="none" stroke="black" stroke-width="{n}" d="M10 10 L90 90"/>',
    '<circle {s} r="{n}"/>',
    '<ellipse {s} cx="{n}" rx="{n}" ry="3"/>',
    '<rect {s} width="{n}" height="5" rx="{n}"/>',
)


@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(shape=st.sampled_from(SHAPES), number=NUMBERS, where=st.sampled_from(("shape", "page", "box")))
def test_any_number_is_drawn_or_refused(tmp_path, shape, number, where):
    size = {"page": f'width="{number}mm" height="{number}mm" viewBox="0 0 100 100"'}.get(
        where, f'width="100mm" viewBox="0 0 {number} {number}"' if where == "box" else 'width="100mm"'
    )
    check(tmp_path, svg(shape.format(s=STROKE, n=number), size))


def check(folder: Path, data: bytes) -> None:
    """Draws or refuses; what is drawn can be written and read again."""
    begin = time.process_time()
    drawing, refused = None, None
    try:
        drawing = read(folder, data)
    except DrawingError as error:
        refused = error
    assert time.process_time() - begin < PATIENCE_S
    if drawing is not None:
        (folder / "drawing.json").write_text(drawing_json(drawing), encoding="utf-8")
        read_drawing(folder / "drawing.json")
    if refused is not None:
        assert refused.remedy
        assert refused.where.startswith(str(folder))
        assert "()" not in str(refused)


VALID = svg(
    "<style>.a{stroke:#f00;fill:none}</style><!-- wing -->"
    f"<defs><g id='a'><circle r='9' class='a'/></g></defs>{CROSS}"
    "<g transform='rotate(3) translate(4 5)'><use xlink:href='#a'/></g>"
    f"<polyline {STROKE} points='1,2 30,4 5,60'/>"
    f"<path {STROKE} d='M10 50A20 20 0 0 1 50 50Q60 70 70 50T90 50z'/>"
)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=damaged(VALID))
def test_damaged_files_are_drawn_or_refused(tmp_path, data):
    check(tmp_path, data)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("far", ["1e308", "1e200", "1e30"])
@pytest.mark.parametrize(
    "path", ["M {far} 0 L -{far} 10 L 5 5 Z", "M 0 0 C {far} 0 -{far} 5 9 9 Z", "M 0 -{far} V {far}"]
)
def test_coordinates_out_of_all_bounds_are_refused_without_warnings(tmp_path, path, far):
    file = tmp_path / "far.svg"
    file.write_bytes(svg(f'<path {STROKE} d="{path.format(far=far)}"/>'))
    with pytest.raises(DrawingError, match="coordinate"):
        trace(file, TracingConfig(), 40.0)
