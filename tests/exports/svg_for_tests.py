"""SVG read back."""

from __future__ import annotations

import xml.etree.ElementTree as ET

NS = "{http://www.w3.org/2000/svg}"


def root_of(svg: str) -> ET.Element:
    return ET.fromstring(svg)


def texts(root: ET.Element) -> list[ET.Element]:
    return list(root.iter(f"{NS}text"))


def box(text: ET.Element) -> tuple[float, float, float, float]:
    size, x, y = (float(text.get(key, "nan")) for key in ("font-size", "x", "y"))
    half = 0.31 * size * len(text.text or "")
    return x - half, y - 0.75 * size, x + half, y + 0.05 * size


def collide(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
