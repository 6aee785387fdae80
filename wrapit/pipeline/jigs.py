"""Makes the jigs of each kind: those of solids in the kernel's process, flat ones meanwhile in this one."""

from __future__ import annotations

import contextlib
import dataclasses
import functools
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

from wrapit.config import Config, JigKind
from wrapit.errors import Finding, UnheldError
from wrapit.jig.made import MIRRORED, JigMaker, Made, Wires
from wrapit.pipeline.exporting import write_drawings
from wrapit.pipeline.solids import judged_solids, make_solids, write_wires
from wrapit.pipeline.work import Work
from wrapit.pipeline.worker import Worker

T = TypeVar("T")


def make_jigs(work: Work, worker: Worker | None, folder: Path | None) -> None:
    """Makes every kind that the config asks for; files of solids and flat drawings go to `folder`.

    Raises UnheldError where the first kind would hold too little, and what `JigMaker.make` raises. A further
    kind that would is left out, and an error among the findings says so.
    """
    from wrapit.jig.kinds import JIGS

    with work.stage("jig"):
        makers = [JIGS[kind] for kind in dict.fromkeys(work.config.jigs)]
        made: dict[JigKind, Made | UnheldError] = {}
        started: list[JigKind] = []
        # Solids first: their process works while flat jigs are made here.
        for maker in sorted(makers, key=lambda maker: not maker.solid):
            if maker.plan is None or worker is None:
                made[maker.kind] = flat = _tried(maker.make, work)
                if isinstance(flat, Made) and folder is not None:
                    # Written now, while solids are made in their own process.
                    write_drawings(folder, flat, work.config)
                continue
            planned = _tried(maker.plan, work)
            if isinstance(planned, UnheldError):
                made[maker.kind] = planned
                continue
            making = _judged_too(planned, maker, work.laid, work.config) if work.exact else planned
            worker.start(make_solids, making, work.config, folder)
            started.append(maker.kind)
        for kind in started:
            made[kind] = _awaited(work, worker, "jig")
        _take(work, {maker.kind: made[maker.kind] for maker in makers})
        _make_mirrored(work, worker, folder)


def _judged_too(
    planned: Callable[[], Made], maker: JigMaker, wires: Wires, config: Config
) -> Callable[[], Made]:
    """Makes the solids and has the kind's judge look at them."""
    return (
        planned
        if maker.judge is None
        else functools.partial(judged_solids, planned, maker.judge, wires, config)
    )


def _tried(make: Callable[[Wires, Config], T], work: Work) -> T | UnheldError:
    try:
        return make(work.laid, work.config)
    except UnheldError as unheld:
        return unheld


def _awaited(work: Work, worker: Worker | None, what: str) -> Any:
    assert worker is not None
    limit_s = work.config.jig.time_limit or 120 + 60 * len(work.wires)
    return worker.result(f"{work.config.name}: {what}", limit_s)


def _take(work: Work, made: dict[JigKind, Made | UnheldError]) -> None:
    """Puts what was made into the work, in the order of the config."""
    first = next(iter(made.values()))
    if isinstance(first, UnheldError):
        raise first
    for kind, each in made.items():
        if isinstance(each, UnheldError):
            work.findings.append(_left_out(kind, each))
            continue
        work.made[kind] = each
        work.findings += each.findings
        work.report[each.block] = each.numbers


def _left_out(kind: JigKind, unheld: UnheldError) -> Finding:
    return Finding(
        "error",
        "jig-left-out",
        f"jig {kind}",
        f"{unheld.problem}, so it is not made",
        f"make the piece larger, take thinner wire, or leave {kind} out of `jigs`",
    )


@contextlib.contextmanager
def wires_beside(work: Work, worker: Worker | None, folder: Path, suffix: str = "") -> Iterator[None]:
    """Has `wires{suffix}.step` written in the kernel's process while this one does something else."""
    if worker is None or "step" not in work.config.outputs:
        yield
        return
    from wrapit.wires.mirror import mirrored, mirrored_ring

    wires, ring = work.wires, work.ring
    if suffix:
        wires, ring = mirrored(wires), mirrored_ring(ring)
    worker.start(write_wires, wires, ring, work.config, folder / f"wires{suffix}.step")
    yield
    findings: tuple[Finding, ...] = _awaited(work, worker, "wires")
    work.findings += [_of_mirrored(f) if suffix else f for f in findings]


def _make_mirrored(work: Work, worker: Worker | None, folder: Path | None) -> None:
    """The printed jig of the other earring (`pair`), if there is one of this."""
    from wrapit.jig.kinds import JIGS
    from wrapit.jig.printed.seats import mirrored_seats
    from wrapit.wires.mirror import mirrored

    maker = next((JIGS[kind] for kind in work.made if JIGS[kind].solid), None)
    if not work.config.pair or worker is None or maker is None or maker.plan is None:
        return
    config = work.config.model_copy(update={"jig": mirrored_seats(work.config.jig)})
    planned = maker.plan(mirrored(work.laid), config)
    making = _judged_too(planned, maker, mirrored(work.laid), config) if work.exact else planned
    worker.start(make_solids, making, config, folder, MIRRORED)
    made: Made = _awaited(work, worker, "mirrored jig")
    work.mirrored = made
    work.findings += map(_of_mirrored, made.findings)
    work.report[made.block]["mirrored"] = made.numbers


def _of_mirrored(finding: Finding) -> Finding:
    return dataclasses.replace(finding, where=f"mirrored: {finding.where}")
