"""Makes the jigs of each kind: those of solids in the kernel's process, flat ones meanwhile in this one."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from wrapit.config import Config, JigKind
from wrapit.errors import Finding, UnheldError
from wrapit.pipeline.cache.remembering import Outcome
from wrapit.pipeline.sharing import shared
from wrapit.pipeline.work import Work
from wrapit.pipeline.worker import Job, OnCall

if TYPE_CHECKING:
    from wrapit.jig.made import Each, JigMaker, Made, Planned, View, Wires

S = TypeVar("S")
T = TypeVar("T")


def kinds_of(work: Work) -> tuple[JigKind, ...]:
    """The kinds that the config asks for, each once."""
    return tuple(dict.fromkeys(work.config.jigs))


def jig_step(kind: JigKind) -> str:
    """What the step is called that makes a kind."""
    return f"jig {kind}"


def jig_key(work: Work, kind: JigKind, *, files: bool) -> str:
    """What the cache calls a jig, with its files or without."""
    return work.key(jig_step(kind), files, work.exact)


def mirrored_key(work: Work, *, files: bool) -> str:
    """The same of the jig of the other earring."""
    return work.key("mirrored jig", files, work.exact, upon=map(jig_step, kinds_of(work)))


def wires_key(work: Work, *, mirror: bool) -> str:
    """What the cache calls `wires.step`, or that of the other earring."""
    return work.key("wires.step", mirror)


def make_jigs(work: Work, kernel: OnCall, folder: Path | None) -> None:
    """Makes every kind that the config asks for; files of solids and flat drawings go to `folder`.

    Raises UnheldError where the first kind would hold too little, and what `JigMaker.make` raises. A further
    kind that would is left out, and an error among the findings says so.
    """
    with work.stage("jig"):
        keys = {kind: jig_key(work, kind, files=folder is not None) for kind in kinds_of(work)}
        made: dict[JigKind, Outcome | UnheldError] = {}
        for kind, key in keys.items():
            if (recalled := work.recall(key, folder)) is not None:
                made[kind] = recalled
        missing = [kind for kind in keys if kind not in made]
        if missing:
            for kind, outcome in _made(work, kernel, folder, missing).items():
                made[kind] = outcome
                if isinstance(outcome, Outcome):
                    work.keep(keys[kind], outcome, folder)
        _take(work, {kind: made[kind] for kind in keys})
        if work.config.pair:
            _take_mirrored(work, kernel, folder)


def _made(
    work: Work, kernel: OnCall, folder: Path | None, kinds: Sequence[JigKind]
) -> dict[JigKind, Outcome | UnheldError]:
    from wrapit.jig.kinds import JIGS
    from wrapit.pipeline.exporting import write_drawings
    from wrapit.pipeline.solids import make_solids

    made: dict[JigKind, Outcome | UnheldError] = {}
    started: dict[JigKind, Job] = {}
    first: Planned | None = None
    # Solids first: their process works while flat jigs are made here.
    for maker in sorted((JIGS[kind] for kind in kinds), key=lambda maker: not maker.solid):
        if maker.plan is None:
            each = each_beside(work, kernel, f"jig {maker.kind}")
            flat = _tried(functools.partial(_with, maker, each), work)
            if isinstance(flat, UnheldError):
                made[maker.kind] = flat
                continue
            # Written now, while solids are made in their own process.
            names = write_drawings(folder, flat, work.config) if folder is not None else ()
            made[maker.kind] = _outcome(flat, names)
            continue
        planned = _tried(maker.plan, work)
        if isinstance(planned, UnheldError):
            made[maker.kind] = planned
            continue
        building = _building(planned, maker, work.laid, work)
        started[maker.kind] = start(work, kernel, "jig", make_solids, building, work.config, folder)
        if maker.kind == kinds_of(work)[0]:
            first = planned
    if folder is not None and first is not None:
        show_jig(work, folder, views=first.views)  # painted while the solids are made
    for kind, job in started.items():
        made[kind] = _solid(kernel.worker().result(job))
    return made


def _with(maker: JigMaker, each: Each, wires: Wires, config: Config) -> Made:
    return maker.make(wires, config, each)


def _building(planned: Planned, maker: JigMaker, wires: Wires, work: Work) -> Callable[[], Made]:
    """Makes the solids, and has the kind's judge look at them if the work is to be exact."""
    from wrapit.pipeline.solids import judged_solids

    if not work.exact or maker.judge is None:
        return planned.build
    return functools.partial(judged_solids, planned.build, maker.judge, wires, work.config)


def _tried(make: Callable[[Wires, Config], T], work: Work) -> T | UnheldError:
    try:
        return make(work.laid, work.config)
    except UnheldError as unheld:
        return unheld


def start(work: Work, kernel: OnCall, what: str, function: Callable[..., Any], *arguments: Any) -> Job:
    """Gives the kernel's process a function; errors name the piece and `what` it makes of it."""
    return kernel.worker().start(f"{kernel.piece}: {what}", _limit_s(work, kernel), function, *arguments)


def each_beside(work: Work, kernel: OnCall, what: str) -> Each:
    """Makes like things in both processes; nothing is loaded before there are some."""

    def each(make: Callable[[S], T], things: Sequence[S], /) -> list[T]:
        return shared(kernel, f"{kernel.piece}: {what}", _limit_s(work, kernel))(make, things)

    return each


def _limit_s(work: Work, kernel: OnCall) -> float:
    return kernel.limit_s or 120 + 60 * len(work.wires)


def _outcome(made: Made, files: Sequence[str]) -> Outcome:
    return Outcome(made, {made.block: made.numbers}, made.findings, files)


def _solid(made: Made) -> Outcome:
    """Each file of solids has its frame among the numbers."""
    return _outcome(made, tuple(made.numbers.get("frames", ())))


def _take(work: Work, made: dict[JigKind, Outcome | UnheldError]) -> None:
    """Puts what was made into the work, in the order of the config."""
    first = next(iter(made.values()))
    if isinstance(first, UnheldError):
        raise first
    for kind, each in made.items():
        if isinstance(each, UnheldError):
            work.findings.append(_left_out(kind, each))
            continue
        work.kinds += (kind,)
        work.take(jig_step(kind), each)


def _left_out(kind: JigKind, unheld: UnheldError) -> Finding:
    return Finding(
        "error",
        "jig-left-out",
        f"jig {kind}",
        f"{unheld.problem}, so it is not made",
        f"make the piece larger, take thinner wire, or leave {kind} out of `jigs`",
    )


def show_jig(work: Work, folder: Path, *, mirror: bool = False, views: Sequence[View] | None = None) -> None:
    """Pictures of the first jig, or of the mirror image of the one that has one.

    They are painted once: `views` are those of a jig whose solids aren't made yet.
    """
    step = "mirrored views" if mirror else "views"
    if step in work.outcomes:
        return

    def painted() -> Outcome:
        from wrapit.jig.made import MIRRORED
        from wrapit.pipeline.exporting import write_views
        from wrapit.wires.mirror import mirrored

        if mirror:
            assert work.mirrored is not None
            return write_views(folder, work.mirrored.views, mirrored(work.wires), MIRRORED)
        shown = views if views is not None else work.made[work.kinds[0]].views
        return write_views(folder, shown, work.wires)

    kinds = kinds_of(work)[:1] if views is not None else kinds_of(work) if mirror else work.kinds[:1]
    key = work.key("views", mirror, upon=map(jig_step, kinds))
    work.outcomes[step] = work.remember(key, painted, folder)


def begin_wires(work: Work, kernel: OnCall, folder: Path, *, mirror: bool = False) -> Callable[[], None]:
    """Has `wires.step` written in the kernel's process; what is returned waits until it is, and takes it."""
    if "step" not in work.config.outputs:
        return lambda: None
    key = wires_key(work, mirror=mirror)
    recalled = work.recall(key, folder)
    name, job = ("", None) if recalled is not None else _start_wires(work, kernel, folder, mirror=mirror)

    def finish() -> None:
        outcome = recalled
        if job is not None:
            findings: tuple[Finding, ...] = kernel.worker().result(job)
            said = [_of_mirrored(f) if mirror else f for f in findings]
            outcome = work.keep(key, Outcome(findings=said, files=(name,)), folder)
        work.findings += outcome.findings if outcome is not None else ()

    return finish


def _start_wires(work: Work, kernel: OnCall, folder: Path, *, mirror: bool) -> tuple[str, Job]:
    """The name of the file that the kernel's process has begun."""
    from wrapit.jig.made import MIRRORED
    from wrapit.pipeline.solids import write_wires
    from wrapit.wires.mirror import mirrored, mirrored_ring

    wires, ring, name = work.wires, work.ring, "wires.step"
    if mirror:
        wires, ring, name = mirrored(wires), mirrored_ring(ring), f"wires{MIRRORED}.step"
    return name, start(work, kernel, "wires", write_wires, wires, ring, work.config, folder / name)


def _take_mirrored(work: Work, kernel: OnCall, folder: Path | None) -> None:
    """The printed jig of the other earring (`pair`), if there is one of this."""
    key = mirrored_key(work, files=folder is not None)
    outcome = work.remember(key, lambda: _mirrored(work, kernel, folder), folder)
    for block, numbers in outcome.blocks.items():
        work.report[block] = {**work.report[block], "mirrored": numbers}
    work.findings += outcome.findings
    work.outcomes["mirrored jig"] = outcome


def _mirrored(work: Work, kernel: OnCall, folder: Path | None) -> Outcome:
    from wrapit.jig.kinds import JIGS
    from wrapit.jig.made import MIRRORED
    from wrapit.jig.printed.seats import mirrored_seats
    from wrapit.pipeline.solids import make_solids
    from wrapit.wires.mirror import mirrored

    maker = next((JIGS[kind] for kind in work.kinds if JIGS[kind].solid), None)
    if maker is None or maker.plan is None:
        return Outcome()
    config = work.config.model_copy(update={"jig": mirrored_seats(work.config.jig)})
    wires = mirrored(work.laid)
    planned = maker.plan(wires, config)
    building = _building(planned, maker, wires, work)
    job = start(work, kernel, "mirrored jig", make_solids, building, config, folder, MIRRORED)
    outcome = _solid(kernel.worker().result(job))
    return Outcome(outcome.value, outcome.blocks, tuple(map(_of_mirrored, outcome.findings)), outcome.files)


def _of_mirrored(finding: Finding) -> Finding:
    return dataclasses.replace(finding, where=f"mirrored: {finding.where}")
