"""The laser's sheets as SVG at true size, hairlines in the colours of the profile."""

from __future__ import annotations

from xml.sax.saxutils import escape

import numpy as np

from wrapit.config.plate import ProfileName
from wrapit.exports.laser_profiles import ORDER, PROFILES
from wrapit.geometry import Loop
from wrapit.geometry.svgframe import SvgFrame, number
from wrapit.jig.contours import FlatDrawing

# How broad is a line? Programs of lasers take what is drawn as a hairline (0.01 inch or less) for a cut.
HAIRLINE_MM = 0.05


def plate_svg(drawing: FlatDrawing, profile: ProfileName = "lightburn") -> str:
    """SVG whose user unit is a millimetre; one group for each kind of work, in the order of working.

    Curves are exact cubics, arcs are arcs; nothing is filled.
    """
    frame = SvgFrame.around(np.zeros(2), np.array([drawing.width_mm, drawing.height_mm]), 0.0)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" {frame.size} viewBox="{frame.view_box}">',
        f"<title>{escape(drawing.title)}</title>",
    ]
    looks = PROFILES[profile]
    for layer in ORDER:
        shapes = [
            frame.outline(Loop(contour.edges)) if contour.closed else frame.edges(contour.edges)
            for contour in drawing.contours
            if contour.layer == layer
        ]
        if shapes:
            style = f'fill="none" stroke="{looks[layer].css}" stroke-width="{number(HAIRLINE_MM)}"'
            lines.append(f'<g id="{layer}" {style}>')
            lines += [f'<path d="{shape}"/>' for shape in shapes]
            lines.append("</g>")
    return "\n".join([*lines, "</svg>", ""])
