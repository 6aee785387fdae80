"""The guide's pictures: one drawing space for the whole piece, path data for each of its parts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from wrapit.geometry import BezierChain
from wrapit.geometry.arclength import piece
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.svgframe import SvgFrame, number
from wrapit.instructions.model import Guide, Step


@dataclass(frozen=True)
class Mark:
    """A lettered or numbered place on a picture, in its own millimetres."""

    text: str
    x: str
    y: str
    anchor_x: str
    anchor_y: str
    radius: str


@dataclass(frozen=True)
class StepPicture:
    """Path data of what is bent already, of the present stretch, and of an arrow at its end."""

    done: str
    present: str
    arrow: str


class Pictures:
    """Every picture of a guide, in one frame around the piece."""

    def __init__(self, guide: Guide) -> None:
        self._chains = {sheet.number: chain_of(sheet.wire.centreline) for sheet in guide.sheets}
        cloud = np.vstack([chain.sampled(0.2) for chain in self._chains.values()])
        low, high = cloud.min(axis=0), cloud.max(axis=0)
        # Text is set in shares of the picture, so that it reads the same on every size of piece.
        self.text_mm = float(np.max(high - low)) / 16
        labels = place_labels(
            [(tie.letter, np.array([tie.point])) for tie in guide.ties], cloud, self.text_mm
        )
        starts = place_labels(
            [(str(key), chain.start[None]) for key, chain in self._chains.items()],
            cloud,
            self.text_mm,
            labels,
        )
        boxes = np.array([[*label.centre, *label.half_size] for label in (*labels, *starts)]).reshape(-1, 4)
        low = np.vstack([low, boxes[:, :2] - boxes[:, 2:]]).min(axis=0)
        high = np.vstack([high, boxes[:, :2] + boxes[:, 2:]]).max(axis=0)
        self.frame = SvgFrame.around(low, high, 0.3 * self.text_mm)
        self.ties = tuple(self._mark(label) for label in labels)
        self.starts = tuple(self._mark(label) for label in starts)
        self.ring = self._ring(guide)
        self.shapes = {key: self.frame.path(chain) for key, chain in self._chains.items()}

    def _ring(self, guide: Guide) -> tuple[str, str, str] | None:
        """Middle and radius of the jump ring's mark."""
        if guide.ring is None:
            return None
        x, y = self.frame.at(np.array(guide.ring.point))
        return number(x), number(y), number((guide.ring.inner_diameter_mm + guide.ring.diameter_mm) / 2)

    def start_of(self, wire: int) -> tuple[str, str]:
        """Where a wire starts, on the page."""
        x, y = self.frame.at(self._chains[wire].start)
        return number(x), number(y)

    def step(self, wire: int, step: Step) -> StepPicture:
        """One stretch of a wire, and what is bent before it."""
        chain = self._chains[wire]
        end_mm = min(step.end_mm, chain.length)
        present = piece(chain, step.start_mm, end_mm)
        done = self.frame.path(piece(chain, 0.0, step.start_mm)) if step.start_mm > 1e-6 else ""
        return StepPicture(done, self.frame.path(present), self._arrow(present))

    def _arrow(self, chain: BezierChain) -> str:
        """A barbed head at the end of the stretch."""
        size = 0.55 * self.text_mm
        heading = math.atan2(*(float(value) for value in chain.end_tangent[::-1]))
        tips = [
            chain.end - size * np.array([math.cos(heading + turn), math.sin(heading + turn)])
            for turn in (0.5, -0.5)
        ]
        return self.frame.polyline(np.array([tips[0], chain.end, tips[1]]))

    def _mark(self, label: Label) -> Mark:
        x, y = self.frame.at(label.centre)
        anchor_x, anchor_y = self.frame.at(label.anchor)
        radius = number(0.62 * self.text_mm + 0.12 * self.text_mm * (len(label.text) - 1))
        return Mark(label.text, number(x), number(y), number(anchor_x), number(anchor_y), radius)
