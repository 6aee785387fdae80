"""What people, programs and attackers may write where a number belongs."""

from __future__ import annotations

import datetime
import math

# fmt: off
NUMBERS: tuple[object, ...] = (
    math.inf, -math.inf, math.nan, 1e300, -1e300, -1, -0.5, 0, -0.0, 1e-300, 0.5, 3, 10**9, 10**30, 10**400,
)

TEXTS = (
    "inf", "-inf", "nan", "1e300", "-1", "0", "1e-300", "1e999", "0x10", "1_0", "", " ", "mm", "40", "awg",
    "-", ".", "1e", "top", "null", "~", "4O mm", "40 mm mm", "4 0 mm", "40 furlong", "2001-13-45", "[", "{",
    "\x00", "9" * 5000, "x" * 5000, "９９ AWG", "99999999999999999999 AWG", "🐝", "40\nmm", "--set", "true",
    *(
        f"{number} {unit}"
        for number in (
            "inf", "nan", "1e300", "-1", "0", "-0", "1e-300", "1e999", "1e308", "40", "４０", "1_0", "0x10",
            "9" * 400,
        )
        for unit in ("mm", "m", "/mm", "deg", "rad", "s", "h", "AWG", "swg")
    ),
)

OTHERS: tuple[object, ...] = (
    True, False, None, [], {}, [1], [1, 2], [-1, -1], [10**400, 1], ["40 mm"], ["1e9 mm", "0 mm"],
    ["nan mm", "0 mm"], [None, None], [[], []], {"a": 1}, datetime.date(2001, 1, 1),
    datetime.datetime(2001, 1, 1), b"40 mm",
)

SPELLED = (
    ".inf", "-.inf", ".nan", "1e300", "-1", "0", "1e-300", "1" + "0" * 400, '""', "mm", "1e999 mm", "1e999",
    "true", "null", "[]", "{}", "2001-01-01", "2001-13-45", '"40"', "４０ mm", "1_0 mm", "0x10", "0x10 mm",
    "9" * 5000, "[.inf, 1e300 mm]", "{a: {b: 1}}", "-40 mm", "1e300 mm", "1e300 deg", "1e300 /mm", "1e300 s",
)
"""In YAML."""
