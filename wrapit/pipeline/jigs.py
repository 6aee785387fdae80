"""Makes the jigs of each kind: those of solids in the kernel's process, flat ones meanwhile in this one."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any, Final

from wrapit.config import JigKind
from wrapit.errors import Finding, UnheldError
from wrapit.jig.made import JigMaker, Made
from wrapit.pipeline.solids import make_solids, write_wires
from wrapit.pipeline.work import Work
from wrapit.pipeline.worker import Worker

# What the names of files of the other earring end in.
MIRRORED: Final = "-mirrored"


def make_jigs(work: Work, worker: Worker | None, folder: Path | None) -> None:
    """Makes every kind that the config asks for; solids' files, and the wires' own, go to `folder`.

    Raises UnheldError where the first kind would hold too little, and what `JigMaker.make` raises. A further
    kind that would is left out, and an error among the findings says so.
    """
    from wrapit.jig.kinds import JIGS

    with work.stage("jig"):
        makers = [JIGS[kind] for kind in dict.fromkeys(work.config.jigs)]
        solid = next((maker for maker in makers if maker.solid), None)
        if solid is not None and worker is not None:
            worker.start(make_solids, solid.kind, work.laid, work.config, folder, work.exact)
        made: dict[JigKind, Made | UnheldError] = {}
        for maker in makers:
            if not maker.solid:
                made[maker.kind] = _made(maker, work)
        if solid is not None and worker is not None:
            made[solid.kind] = _solid_made(work, worker, "jig")
        _take(work, {maker.kind: made[maker.kind] for maker in makers})
        if worker is not None and folder is not None and "step" in work.config.outputs:
            _write_wires(work, worker, folder, "")
        if work.config.pair and solid is not None and solid.kind in work.made and worker is not None:
            _make_mirrored(work, worker, solid, folder)


def _made(maker: JigMaker, work: Work) -> Made | UnheldError:
    try:
        return maker.make(work.laid, work.config)
    except UnheldError as unheld:
        return unheld


def _solid_made(work: Work, worker: Worker, what: str) -> Made | UnheldError:
    try:
        made: Made = _awaited(work, worker, what)
    except UnheldError as unheld:
        return unheld
    return made


def _awaited(work: Work, worker: Worker, what: str) -> Any:
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


def _write_wires(work: Work, worker: Worker, folder: Path, suffix: str) -> None:
    from wrapit.wires.mirror import mirrored, mirrored_ring

    wires, ring = work.wires, work.ring
    if suffix:
        wires, ring = mirrored(wires), mirrored_ring(ring)
    worker.start(write_wires, wires, ring, work.config, folder / f"wires{suffix}.step")
    findings: tuple[Finding, ...] = _awaited(work, worker, "wires")
    work.findings += [_of_mirrored(f) if suffix else f for f in findings]


def _make_mirrored(work: Work, worker: Worker, maker: JigMaker, folder: Path | None) -> None:
    from wrapit.jig.printed.seats import mirrored_seats
    from wrapit.wires.mirror import mirrored

    config = work.config.model_copy(update={"jig": mirrored_seats(work.config.jig)})
    worker.start(make_solids, maker.kind, mirrored(work.laid), config, folder, work.exact, MIRRORED)
    made: Made = _awaited(work, worker, "mirrored jig")
    work.mirrored = made
    work.findings += map(_of_mirrored, made.findings)
    work.report[made.block]["mirrored"] = made.numbers
    if folder is not None and "step" in work.config.outputs:
        _write_wires(work, worker, folder, MIRRORED)


def _of_mirrored(finding: Finding) -> Finding:
    return dataclasses.replace(finding, where=f"mirrored: {finding.where}")
