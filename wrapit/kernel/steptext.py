"""STEP text in one canonical form: entity order and numbers don't depend on memory addresses.

Each entity gets a digest of its text with references replaced by the digests of what they name; points,
curves and surfaces of equal digests become one; entities are then numbered in the order in which they are
reached from the roots, roots sorted by digest. Roots that say the same of different entities are told apart
by who else uses these (colour refinement, Weisfeiler and Leman 1968).
"""

from __future__ import annotations

import hashlib
import re

# Same model, same bytes: the time of writing is none of them.
FIXED_TIME = "2000-01-01T00:00:00"
# How STEP spells what is renumbered or renamed (ISO 10303-21): entities, references, texts, the signs beside
# which blanks say nothing, the counter in the usage of a part, letters that need a code, our own way to carry
# these through the kernel, and the header's name.
_ENTITY = re.compile(r"#(\d+)\s*=\s*(.*?);\s*(?=#\d+\s*=|ENDSEC)", re.DOTALL)
_REFERENCE = re.compile(r"#(\d+)")
_STRING = re.compile(r"('(?:[^']|'')*')")
_SPACED = re.compile(r"\s*([(),])\s*")
_USAGE = re.compile(r"^(NEXT_ASSEMBLY_USAGE_OCCURRENCE\()'\d+'")
_OUTSIDE_ASCII = re.compile(r"[^\x00-\x7f]+")
_CARRIED = re.compile(r"~X([24])~([0-9A-F]+)~X0~")
_FILE_NAME = re.compile(r"FILE_NAME\(.*?\);", re.DOTALL)

# What may be one where it is spelled alike: pure geometry, which has no identity of its own (vertices, edges
# and faces have). The kernel writes a prism's edge once more as what its surface is swept from, and its ends
# as points beside the poles: a third of a jig's file.
_SHAPES = (
    "CARTESIAN_POINT(",
    "DIRECTION(",
    "VECTOR(",
    "LINE(",
    "CIRCLE(",
    "AXIS2_PLACEMENT_3D(",
    "B_SPLINE_",
)


def carried(name: str) -> str:
    r"""A name in ASCII that the kernel's writer leaves alone; `canonical_step` makes STEP's own code of it.

    STEP writes letters outside of ASCII as `\X2\00FC\X0\` (ISO 10303-21, 6.4.3.3); the kernel would write
    the bytes of an encoding that readers don't know, and double a backslash.

    >>> carried("Blüte")
    'Bl~X2~00FC~X0~te'
    """
    return _OUTSIDE_ASCII.sub(_carried_run, name)


def _carried_run(match: re.Match[str]) -> str:
    wide = max(match[0]) > "\uffff"
    digits = "".join(f"{ord(letter):0{8 if wide else 4}X}" for letter in match[0])
    return f"~X{4 if wide else 2}~{digits}~X0~"


def _with_codes(text: str) -> str:
    return _CARRIED.sub(r"\\X\1\\\2\\X0\\", text)


def canonical_step(text: str, file_name: str) -> str:
    """The same model, written so that equal models have equal bytes; carried names as STEP has them."""
    header, data = text.split("DATA;", 1)
    header = _FILE_NAME.sub(lambda _: _file_name(file_name), header)
    entities = {int(m[1]): _USAGE.sub(r"\1''", _in_one_line(m[2])) for m in _ENTITY.finditer(data)}
    uses = {number: _references(body) for number, body in entities.items()}
    digests = _digests(entities, uses)
    used = {reference for references in uses.values() for reference in references}
    one = _one_of_each(entities, digests)
    uses = {number: [one[reference] for reference in references] for number, references in uses.items()}
    roots = _sorted_roots([n for n in entities if n not in used], uses, digests)
    order = _reached(roots, uses)
    new = {old: index for index, old in enumerate(order, start=1)}
    numbers = {old: new[one[old]] for old in entities if one[old] in new}
    usages = 0
    lines = []
    for old in order:
        body = _renumbered(entities[old], numbers)
        if body.startswith("NEXT_ASSEMBLY_USAGE_OCCURRENCE(''"):
            usages += 1
            body = body.replace("(''", f"('{usages}'", 1)
        lines.append(f"#{new[old]}={body};")
    return header + "DATA;\n" + _with_codes("\n".join(lines)) + "\nENDSEC;\nEND-ISO-10303-21;\n"


def _file_name(file_name: str) -> str:
    name = _with_codes(carried(file_name.replace("'", "''")))
    return f"FILE_NAME('{name}','{FIXED_TIME}',(''),(''),'wrapit','wrapit','');"


def _in_one_line(body: str) -> str:
    """The writer breaks lines by their width, before renumbering, and where it does it leaves blanks."""
    body = " ".join(body.split())
    if "'" not in body:
        return _SPACED.sub(r"\1", body)
    parts = _STRING.split(body)
    return "".join(part if index % 2 else _SPACED.sub(r"\1", part) for index, part in enumerate(parts))


def _references(body: str) -> list[int]:
    if "'" not in body:
        return [int(number) for number in _REFERENCE.findall(body)]
    outside = _STRING.sub("''", body)
    return [int(number) for number in _REFERENCE.findall(outside)]


def _renumbered(body: str, numbers: dict[int, int]) -> str:
    def renumber(match: re.Match[str]) -> str:
        return f"#{numbers[int(match[1])]}"

    if "'" not in body:
        return _REFERENCE.sub(renumber, body)
    parts = _STRING.split(body)
    return "".join(part if index % 2 else _REFERENCE.sub(renumber, part) for index, part in enumerate(parts))


def _digests(entities: dict[int, str], uses: dict[int, list[int]]) -> dict[int, str]:
    """Digest of each entity, those that it refers to first (the references of a STEP file have no cycles)."""
    digests: dict[int, str] = {}
    for start in entities:
        stack = [start]
        while stack:
            number = stack[-1]
            if number in digests:
                stack.pop()
                continue
            waiting = [reference for reference in uses[number] if reference not in digests]
            if waiting:
                stack.extend(waiting)
                continue
            names = iter(digests[reference] for reference in uses[number])
            body = _REFERENCE.sub("#", _STRING.sub(_quoted_hash, entities[number]))
            digests[number] = hashlib.sha1("|".join([body, *names]).encode("latin-1")).hexdigest()
            stack.pop()
    return digests


def _one_of_each(entities: dict[int, str], digests: dict[int, str]) -> dict[int, int]:
    """Which entity stands for each: shapes that are spelled alike are one, all else stays itself."""
    first: dict[str, int] = {}
    return {
        number: first.setdefault(digests[number], number) if body.startswith(_SHAPES) else number
        for number, body in entities.items()
    }


def _sorted_roots(roots: list[int], uses: dict[int, list[int]], digests: dict[int, str]) -> list[int]:
    """Roots in an order that doesn't depend on their numbers.

    A digest doesn't say whether two roots share what they refer to or have one each. Where that leaves a
    choice, colours spread to users as well; of roots that tie even then, as on two rings of users, the one
    whose choice gives the least colours to all comes first, and the colours spread from there.
    """
    colours = _spread(digests, uses) if _first_tied(roots, uses, digests) else digests
    while tied := _first_tied(roots, uses, colours):
        trials = [_spread({**colours, root: colours[root] + "first"}, uses) for root in tied]
        colours = min(trials, key=lambda trial: sorted(trial.values()))
    return sorted(roots, key=lambda root: (colours[root], root))


def _first_tied(roots: list[int], uses: dict[int, list[int]], colours: dict[int, str]) -> list[int]:
    """The roots of the least colour that roots of different references share."""
    alike: dict[str, list[int]] = {}
    for root in roots:
        alike.setdefault(colours[root], []).append(root)
    tied = [colour for colour, group in alike.items() if any(uses[n] != uses[group[0]] for n in group)]
    return alike[min(tied)] if tied else []


def _spread(colours: dict[int, str], uses: dict[int, list[int]]) -> dict[int, str]:
    """Colours refined by those of users and used, until no more of them differ."""
    users: dict[int, list[tuple[int, int]]] = {number: [] for number in uses}
    for number, references in uses.items():
        for place, reference in enumerate(references):
            users[reference].append((place, number))
    count = len(set(colours.values()))
    while True:
        refined = {}
        for number, references in uses.items():
            above = sorted(f"{place}:{colours[user]}" for place, user in users[number])
            # Which of its references are one is seen from nowhere else.
            below = [f"{references.index(reference)}:{colours[reference]}" for reference in references]
            told = "|".join([colours[number], *below, "", *above])
            refined[number] = hashlib.sha1(told.encode("ascii")).hexdigest()
        if len(set(refined.values())) == count:
            return refined
        colours, count = refined, len(set(refined.values()))


def _quoted_hash(match: re.Match[str]) -> str:
    return match[1].replace("#", "\x00")


def _reached(roots: list[int], uses: dict[int, list[int]]) -> list[int]:
    """Every entity after those that it refers to, depth first from the roots."""
    order: list[int] = []
    done: set[int] = set()
    for root in roots:
        stack = [(root, False)]
        while stack:
            number, ready = stack.pop()
            if number in done:
                continue
            if ready:
                done.add(number)
                order.append(number)
                continue
            stack.append((number, True))
            stack.extend((reference, False) for reference in reversed(uses[number]) if reference not in done)
    return order
