"""The page of the guide on printing the jig: which file, how, and what stands where on it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from wrapit.config import Config
from wrapit.jig.bench.from_above import bench_picture
from wrapit.jig.bench.model import Bench
from wrapit.jig.bench.pin_list import pin_blocks
from wrapit.jig.made import MIRRORED, GuidePage, file_stem
from wrapit.jig.model import Jig, JigSet
from wrapit.pages.model import (
    Block,
    Duration,
    Facts,
    Figure,
    Heading,
    Length,
    Listed,
    Mass,
    Paragraph,
    Text,
    either,
    listed,
    text,
)

# A rule of thumb for each cm³ of the solid in PLA of 1.24 g/cm³, with what the page says: layers of 0.2 mm,
# two perimeters, 20 % infill. PrusaSlicer, so set, says 7.7 to 9.5 minutes (the larger the jig, the fewer)
# and 0.94 to 1.06 g of five of our pieces at 40, 60 and 90 mm.
MINUTES_PER_CM3 = 8.5
GRAMS_PER_CM3 = 0.99


def print_page(jigs: JigSet, benches: Sequence[Bench], config: Config) -> GuidePage:
    """What the guide says of printing these jigs."""
    many = len(jigs.jigs)
    blocks: list[Block] = [Paragraph(text("print-how", jigs=many)), Paragraph(text("print-clean"))]
    for jig, bench in zip(jigs.jigs, benches, strict=True):
        blocks += _printed(jig, bench, many, config)
    return GuidePage("print", text("print-title", jigs=many), tuple(blocks))


def _printed(jig: Jig, bench: Bench, count: int, config: Config) -> Iterator[Block]:
    if count > 1:
        numbers = listed(wire.number for wire in bench.wires)
        yield Heading(text("jig-for", jig=jig.name, wires=numbers, count=len(bench.wires)))
    yield Facts(tuple(_facts(jig, count, config)))
    words = text("jig-picture", jig=jig.name)
    yield Figure(bench_picture(bench), words, text("jig-caption"))
    yield from pin_blocks(jig.plan.pins)


def _facts(jig: Jig, count: int, config: Config) -> Iterator[tuple[Text, Text]]:
    volume_cm3 = jig.volume_mm3 / 1000
    files = _files(jig.name, count, config, "")
    yield text("fact-file"), text("file-one-of", files=files) if files.items else text("file-none")
    if config.pair:
        mirrored = _files(jig.name, count, config, MIRRORED)
        yield text("fact-other-earring"), text("file-mirrored", files=mirrored, count=len(mirrored.items))
    yield text("fact-material"), text("print-material")
    yield text("fact-settings"), text("print-settings")
    x, y, z = map(Length, jig.size_mm)
    yield text("fact-size"), text("size-solid", x=x, y=y, z=z)
    time, mass = Duration(MINUTES_PER_CM3 * volume_cm3), Mass(GRAMS_PER_CM3 * volume_cm3)
    yield text("fact-takes"), text("takes-about", time=time, mass=mass)


def _files(name: str, count: int, config: Config, suffix: str) -> Listed:
    """The files of one jig that a slicer takes, as the pipeline names them."""
    stem = file_stem(name, count) + suffix
    return either(f"{stem}.{kind}" for kind in ("3mf", "stl", "step") if kind in config.outputs)
