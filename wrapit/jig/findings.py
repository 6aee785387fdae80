"""What the maker should know about a jig: turns that it holds badly, and why it was split."""

from __future__ import annotations

from collections.abc import Iterable

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.geometry.arrays import runs
from wrapit.jig.channel import Channels
from wrapit.jig.model import SEEN_MM, Course, Hold, Pin, SameShape, TurnSupport
from wrapit.jig.support import held_share, kept

# Turns with wall along less than this share are named: more of them is left to the hand than to the wall.
WEAK = 0.5


def support_findings(
    channels: Channels,
    pins: Iterable[Pin],
    support: Iterable[TurnSupport],
    laid: Iterable[Course],
    config: JigConfig,
) -> tuple[Finding, ...]:
    """A finding for each turn or long stretch that is held badly: a pin takes it, or what could be done.

    Where a wire laid under tension follows the drawing all the same, nothing is said.
    """
    course_of = {course.wire: course for course in laid}
    pin_in = {pin.turn: pin for pin in pins}
    findings = []
    for one in support:
        where, at_mm = channels.place(one.turn), (one.turn.start_mm + one.turn.end_mm) / 2
        if one.turn in pin_in:
            diameter = pin_in[one.turn].diameter_mm
            findings.append(
                Finding(
                    "note",
                    "pin",
                    where,
                    f"this turn is too tight for a wall; put a pin of {diameter:.1f} mm into its hole",
                    "bend the wire around the pin",
                )
            )
        elif one.share >= WEAK or kept(one.turn, course_of) == 1.0:
            continue
        elif one.turn.stretch:
            findings.append(
                Finding(
                    "warning",
                    "weak-stretch",
                    where,
                    f"{one.share:.0%} of this long stretch has a wall",
                    "keep it straight by hand, make the piece larger, or set jig.split to per-wire",
                    severity=1 - one.share,
                    wire=one.turn.wire,
                    places_mm=(at_mm,),
                )
            )
        else:
            findings.append(
                Finding(
                    "warning",
                    "weak-turn",
                    where,
                    f"{one.share:.0%} of this turn has a wall on the inside",
                    _remedy(channels, one, config),
                    severity=1 - one.share,
                    wire=one.turn.wire,
                    places_mm=(at_mm,),
                )
            )
    return tuple(findings)


def unheld_findings(held: Iterable[TurnSupport], config: JigConfig) -> tuple[Finding, ...]:
    """An error for each wire that the jig hardly holds."""
    held = tuple(held)
    wires = sorted({one.turn.wire for one in held})
    shares = {wire: held_share(one for one in held if one.turn.wire == wire) for wire in wires}
    return tuple(
        Finding(
            "error",
            "unheld-wire",
            wire,
            f"the jig holds {share:.0%} of this wire; the rest is left to the hand",
            "make the piece larger, take thinner wire, or set jig.split to per-wire",
            severity=1 - share,
        )
        for wire, share in shares.items()
        if share < config.least_support
    )


def split_finding(wire: str, shared: Hold, split: Hold, jigs: int, config: JigConfig) -> Finding:
    """Says why there are several jigs, and what that bought for the worst wire."""
    if config.support == "turns":
        why = f"leave it wall along {shared.turns:.0%} of its turns, now {split.turns:.0%}"
    else:
        why = f"let it lie off by more than {SEEN_MM:g} mm along {shared.strays:.0%}, now {split.strays:.0%}"
    return Finding(
        "note",
        "split",
        wire,
        f"in one jig, other wires would {why}, so there are {jigs} jigs",
        "set jig.split to single to get one all the same",
    )


def form_findings(forms: Iterable[SameShape]) -> tuple[Finding, ...]:
    """Says for each form which other wires are made on it."""
    by_form: dict[str, list[SameShape]] = {}
    for form in forms:
        by_form.setdefault(form.like, []).append(form)
    return tuple(
        Finding(
            "note",
            "form",
            like,
            f"make {len(mine) + 1} on this form: {', '.join(_named(form) for form in mine)} have its shape",
            "turn mirrored ones over after bending",
        )
        for like, mine in by_form.items()
    )


def _named(form: SameShape) -> str:
    return f"{form.wire} (mirrored)" if form.mirrored else form.wire


def stray_findings(laid: Iterable[Course]) -> tuple[Finding, ...]:
    """A warning for each place where a wire laid under tension lies visibly off the drawing."""
    findings = []
    for course in laid:
        for first, last in runs(course.off_mm > SEEN_MM):
            worst = first + int(course.off_mm[first : last + 1].argmax())
            findings.append(
                Finding(
                    "warning",
                    "strays",
                    f"{course.wire} at {course.at_mm[worst]:.0f} mm",
                    f"wrapped tight, it will cut the corner by {course.off_mm[worst]:.1f} mm",
                    "press it by hand there, make the piece larger, or set jig.split to per-wire",
                    severity=float(course.off_mm[worst]),
                    wire=course.wire,
                    places_mm=(float(course.at_mm[worst]),),
                )
            )
    return tuple(findings)


def free_finding(wire: str) -> Finding:
    """Says why a wire is in no jig."""
    return Finding(
        "note",
        "no-jig",
        wire,
        "it has neither turns nor long stretches to hold, so it is in none of the jigs",
        "bend it by hand over the drawing, or set jig.split to single",
    )


def _remedy(channels: Channels, one: TurnSupport, config: JigConfig) -> str:
    bend = one.turn.max_curvature_per_mm
    if bend > 0 and 2 * (1 / bend - channels.face_mm) < config.min_wall_width:
        return "bend it with round-nose pliers, make the piece larger, or use thinner wire"
    return "hold it by hand there, make the piece larger, or set jig.split to per-wire"
