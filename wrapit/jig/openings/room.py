"""How much plate and ground stays free around what goes through or into the plate."""

from __future__ import annotations

# What holds the plate together beside an opening: no plate of 0.5 mm has broken out in the jigs made so far
# is not known; it is one line of a nozzle of 0.4 mm with some to spare, the least that a slicer draws.
PLATE_WEB_MM = 0.5
# So that a wall never stands on an opening's very rim, where its side and the opening's would be one face.
FOOT_MM = 0.1
