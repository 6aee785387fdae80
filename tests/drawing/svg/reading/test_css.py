"""One drawing written in many styles is one drawing."""

from __future__ import annotations

import numpy as np
import pytest

from wrapit.drawing.svg.reading.model import Page
from wrapit.drawing.svg.reading.scene import read_page
from wrapit.errors import DrawingError

# Lines of SVG are kept in one piece.
# ruff: noqa: E501
D = 'd="M10 10L90 90"'


def page(folder, body: str, attributes: str = 'width="100" height="100"') -> Page:
    path = folder / "a.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{body}</svg>', encoding="utf-8")
    return read_page(path)


@pytest.mark.parametrize(
    "body",
    [
        f'<path fill="none" stroke="red" stroke-width="3" {D}/>',
        f'<path style="fill:none;stroke:#f00;stroke-width:3px" {D}/>',
        f"<style>path{{fill:none;stroke:rgb(255,0,0);stroke-width:3}}</style><path {D}/>",
        f"<style>svg > g path.a.b{{fill:none;stroke:red;stroke-width:3}}</style><g><path class='b a' {D}/></g>",
        f"<style>circle,#p{{fill:none;stroke:red;stroke-width:3}}</style><path id='p' {D}/>",
        f"<path {D} class='x'/><style><![CDATA[ .x{{fill:none;stroke:red;stroke-width:3}} ]]></style>",
        f"<style>[d]{{fill:none;stroke:red;stroke-width:3!important}}</style><path style='stroke-width:9' {D}/>",
        f"<style>g:first-of-type *{{fill:none;stroke:red;stroke-width:3}}</style><g><path stroke='blue' {D}/></g>",
        f"<style>@media print{{*{{stroke:none}}}} @media screen{{path{{stroke:red;fill:none;stroke-width:3}}}}"
        f"</style><path {D}/>",
        f"<style>@media (prefers-color-scheme: dark){{*{{stroke:none!important}}}}</style>"
        f"<path fill='none' stroke='red' stroke-width='3' {D}/>",
        f"<style media='print'>*{{stroke:none!important}}</style><style type='text/x'>*{{stroke:none}}</style>"
        f"<path fill='none' stroke='red' stroke-width='3' {D}/>",
        f"<style>:is(path,g{{}} path:::x{{stroke:blue}} path{{stroke:red}}</style>"
        f"<path fill='none' stroke='red' stroke-width='3' {D}/>",
        f"<g color='red' stroke='currentColor' fill='none' stroke-width='3'><path {D}/></g>",
        f"<g fill='none' stroke='red' style='font-size:2px'><path stroke-width='1.5em' {D}/></g>",
        f"<path style='fill:none;stroke:red;stroke-width:3;stroke-width:foo' stroke-width='7' {D}/>",
        f"<g stroke='red' fill='none' stroke-width='3'><g stroke='blue'><path style='stroke:red' {D}/></g></g>",
        f"<defs><path id='p' {D}/></defs><use href='#p' fill='none' stroke='red' stroke-width='3'/>",
        f"<defs><path id='p' style='stroke:context-fill;fill:none' stroke-width='3' {D}/></defs>"
        "<use href='#p' fill='red'/>",
        f"<g stroke='blue'><path stroke='inherit' style='stroke:red' fill='none' stroke-width='3%' {D}/></g>",
    ],
)  # fmt: skip
def test_the_same_line_in_many_words(tmp_path, body):
    (shape,) = page(tmp_path, body).shapes
    assert shape.fill is None
    assert shape.stroke is not None
    assert shape.stroke.colour == pytest.approx((1, 0, 0, 1))
    assert shape.stroke_width == pytest.approx(3)
    line = np.array([[10, 10], [110 / 3, 110 / 3], [190 / 3, 190 / 3], [90, 90]])
    assert np.abs(shape.curves[0].cubics[0] - line).max() < 1e-9


@pytest.mark.parametrize(
    "attributes",
    [
        "stroke-width='0'", "opacity='0'", "opacity='0%'", "stroke-opacity='0'", "display='none'",
        "visibility='hidden'", "style='visibility:collapse'", "stroke='none'", "stroke='rgba(1,2,3,0)'",
        "stroke='url(#missing)'", "stroke='url(other.svg#a)'", "transform='scale(0)'", "systemLanguage='ru'",
        "requiredExtensions='x'", "stroke='transparent'",
    ],
)  # fmt: skip
def test_what_is_not_seen_is_no_shape(tmp_path, attributes):
    stroke = "" if "stroke='" in attributes else "stroke='red'"
    assert page(tmp_path, f"<path fill='none' {stroke} {attributes} {D}/>").shapes == ()


@pytest.mark.parametrize(
    "tag", ["defs", "symbol", "marker", "mask", "clipPath", "pattern", "title", "x:other"]
)
def test_what_is_not_drawn_is_no_shape(tmp_path, tag):
    assert page(tmp_path, f"<{tag} id='m'><path stroke='red' {D}/></{tag}>").shapes == ()


@pytest.mark.parametrize(
    "style",
    ["a " * 300 + "{}", "(" * 100, "*~*~*~*~*~*~*~*~* {stroke:red}", "g " * 12 + "x{}"],
    ids=["long", "nested", "beside", "inside"],
)
def test_selectors_that_would_take_minutes_are_refused(tmp_path, style):
    body = "<g>" * 100 + "</g>" * 100 + "<g/>" * 2000
    with pytest.raises(DrawingError, match=r"selector|nested"):
        page(tmp_path, f"<style>{style}</style>{body}")


@pytest.mark.parametrize(
    ("attributes", "size"),
    [
        ('width="40mm" height="20mm"', (40 * 96 / 25.4, 20 * 96 / 25.4)),
        ('width="40mm" viewBox="0 0 100 50"', (40 * 96 / 25.4, 20 * 96 / 25.4)),
        ('viewBox="0 0 100 50"', (100, 50)),
        ('width="auto" height="" viewBox="0 0 100 50"', (100, 50)),
        ('width="1em" height="1em" viewBox="0 0 24 24"', (24, 24)),
        ('width="100%" height="50%" viewBox="0 0 24 24"', (24, 24)),
        ('width="2in" height="72pt" viewBox="0 0 9 9"', (192, 96)),
    ],
)
def test_the_size_of_the_page(tmp_path, attributes, size):
    assert page(tmp_path, "", attributes).size == pytest.approx(size)
