"""What `trace` asks for before anything is read: a file that is one, of a kind that is known, and a size."""

from __future__ import annotations

import os

import pytest
from PIL import Image

from tests.drawing.refused import refusal
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
from wrapit.errors import ConfigError, DrawingError


def test_a_bitmap_needs_a_size(ink, tmp_path):
    Image.fromarray(ink).save(tmp_path / "cross.png")
    with pytest.raises(ConfigError, match="size: 40 mm"):
        trace(tmp_path / "cross.png", TracingConfig(), None)


@pytest.mark.parametrize("name", ["missing.png", "missing.svg", "missing.json"])
def test_a_missing_file_is_named(name, tmp_path):
    with pytest.raises(DrawingError, match=name):
        trace(tmp_path / name, TracingConfig(), 40.0)


def test_an_unknown_kind_of_file_is_refused(tmp_path):
    (tmp_path / "drawing.pdf").write_bytes(b"%PDF")
    with pytest.raises(DrawingError, match=r"\.pdf"):
        trace(tmp_path / "drawing.pdf", TracingConfig(), 40.0)


def test_what_is_no_file_is_never_opened(tmp_path):
    (tmp_path / "folder.png").mkdir()
    os.mkfifo(tmp_path / "pipe.svg")
    (tmp_path / "device.json").symlink_to("/dev/zero")
    (tmp_path / "circle.png").symlink_to(tmp_path / "circle.png")
    assert "folder" in refusal(tmp_path / "folder.png")
    assert "pipe" in refusal(tmp_path / "pipe.svg")
    assert "device" in refusal(tmp_path / "device.json")
    assert "reached" in refusal(tmp_path / "circle.png")
    (tmp_path / "a.png").write_bytes(b"")
    assert "no such drawing" in refusal(tmp_path / "a.png" / "b.png")


@pytest.mark.parametrize("name", ["a" * 300 + ".png", "a\0b.svg", "a\ud800.json", "a\nb.svg"])
def test_names_that_no_file_can_have_are_refused(tmp_path, name):
    message = refusal(tmp_path / name)
    message.encode("utf-8")
    assert len(message) < 600
    assert "\n" not in message


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("a.heic", "share menu"),
        ("a.ai", "untick 'Preserve Illustrator"),
        ("a.pdf", "Plain SVG"),
        ("a.dxf", "Inkscape"),
        ("a.cdr", "CorelDRAW"),
        ("a.xcf", "Export As"),
        ("a.kra", "Krita"),
        ("a.html", "Canva"),
    ],
)
def test_a_file_of_another_program_is_refused_with_its_export(name, words, tmp_path):
    (tmp_path / name).write_bytes(b"anything")
    assert words in refusal(tmp_path / name)


@pytest.mark.parametrize(("head", "name"), [(b"\x89PNG\r\n\x1a\n", ".png"), (b"<svg/>", ".svg")])
def test_a_readable_file_of_an_unknown_name_is_told_its_name(head, name, tmp_path):
    (tmp_path / "drawing.dat").write_bytes(head)
    assert f"name it {name}" in refusal(tmp_path / "drawing.dat")
