"""Metals that jewellery wire is made of: weight, stiffness and how tightly they bend."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, Literal, get_args

Temper = Literal["dead soft", "half hard", "hard"]

# Smallest inner bend radius in wire diameters, from the wire wrap test.
BEND_RADIUS_DIAMETERS: Final[dict[str, float]] = {"dead soft": 0.5, "half hard": 1.0, "hard": 2.0}


@dataclass(frozen=True)
class Metal:
    """Density in g/cm³, Young's modulus in GPa, proof stress in MPa for each temper."""

    name: str
    density_g_per_cm3: float
    young_gpa: float
    proof_mpa: dict[str, float]
    colour: str

    def mass_g(self, length_mm: float, diameter_mm: float) -> float:
        """Weight of a piece of round wire."""
        return self.density_g_per_cm3 * 1e-3 * length_mm * math.pi / 4 * diameter_mm**2

    def springback_per_mm(self, diameter_mm: float, temper: Temper) -> float:
        """Curvature that a round wire loses when let go: 3.395 · Y / (E · d), elastic–perfectly plastic."""
        return 3.395 * self.proof_mpa[temper] / (self.young_gpa * 1e3 * diameter_mm)


def _proof(soft: float, half: float, hard: float) -> dict[str, float]:
    return dict(zip(get_args(Temper), (soft, half, hard), strict=True))


METALS: Final[dict[str, Metal]] = {
    metal.name: metal
    for metal in (
        Metal("copper", 8.96, 117, _proof(60, 200, 300), "#b87333"),
        Metal("brass", 8.53, 105, _proof(110, 270, 420), "#c9a24b"),
        Metal("bronze", 8.80, 110, _proof(140, 320, 480), "#a97142"),
        Metal("sterling silver", 10.36, 75, _proof(120, 240, 350), "#c4c8cc"),
        Metal("fine silver", 10.49, 76, _proof(50, 150, 250), "#d4d8dc"),
        Metal("gold-filled", 9.20, 105, _proof(110, 270, 400), "#d9b44a"),
        Metal("aluminium", 2.70, 69, _proof(35, 95, 145), "#b9bec4"),
        Metal("steel", 7.85, 200, _proof(250, 450, 700), "#8a9096"),
    )
}
MetalName = Literal[
    "copper", "brass", "bronze", "sterling silver", "fine silver", "gold-filled", "aluminium", "steel"
]


def min_inner_bend_radius_mm(diameter_mm: float, temper: Temper) -> float:
    """Tightest inner radius that a round wire of this temper takes without damage."""
    return BEND_RADIUS_DIAMETERS[temper] * diameter_mm
