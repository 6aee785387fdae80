"""How much plate and ground stays free around what goes through the plate or into it."""

from __future__ import annotations

# Plate that is left between a pin's hole or a seat and another opening: one line of a nozzle of 0.4 mm and
# some to spare. Refuses seats and pins only; 30 % up or down changes no pin of leaf and butterfly.
PLATE_WEB_MM = 0.5
# Between an opening's rim and a wall's foot, so that their sides are never one face: far more than both
# err (2e-3 mm), and little of a wall is lost (30 % up or down: 0.1 % of the butterfly's area).
FOOT_MM = 0.1
