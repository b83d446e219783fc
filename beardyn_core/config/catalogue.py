"""The catalogue of bearings: read, a bearing by its designation, bearings by their dimensions."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable
from difflib import get_close_matches
from functools import cache
from math import isnan
from pathlib import Path
from typing import Any

from beardyn_core.base.config_folder import config_folder
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.catalogue_entry import KINDS, CatalogueEntry
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config.folders import shipped_names
from beardyn_core.config.nouns import load_bearing, read_noun
from beardyn_core.config.yaml_text import read_file

SAME_SIZE = 0.05e-3  # [m]: dimensions that differ by less are one
_NUMBERS = (
    *("roller_count", "roller_diameter_mm", "pitch_diameter_mm", "contact_angle_deg"),
    *("bpfo", "bpfi", "bsf", "ftf"),
)
_SIZES = ("bore_mm", "outside_mm", "width_mm")
_SHOWN = 6
_LEFT_OUT = ("E", "K")
# endings that make another inner design of the same size, where the designation stands without them
_OTHER_DESIGN = {
    "deep groove ball": ("E",),  # more or larger balls: 6205 ETN9
    "tapered roller": ("B", "C", "D"),  # a steeper angle
    "angular contact ball": ("A", "B", "C"),  # double row: another angle
}


def catalogue_file() -> Path:
    """Find the table of the catalogue."""
    return config_folder() / "catalogue" / "bearings.csv"


def catalogue() -> tuple[CatalogueEntry, ...]:
    """List the bearings of the catalogue, then the whole bearings that are shipped.

    Raises
    ------
    InputError
        With every mistake in the table.
    """
    path, problems, found = catalogue_file(), [], []
    for name in _rows(path):
        try:
            found.append(_entry(path, name))
        except InputError as error:
            problems += error.problems
    if problems:
        raise InputError(problems)
    return (*found, *map(_whole, shipped_names("bearings")))


@cache
def _whole(name: str) -> CatalogueEntry:
    bearing = load_bearing(name)
    sources = dict(bearing.sources)
    return CatalogueEntry(
        NamePlate.of(bearing),
        kind="tapered unit",
        rows=2,
        maker="",
        source=sources.get("roller_diameter", "see the file"),
        place=f"{name}.yaml",
        bore=bearing.bore,
        outer_diameter=bearing.outer_diameter,
        width=bearing.width,
        size_source=sources.get("bore", "see the file"),
        about="whole bearing, which can be simulated",
    )


@cache
def _rows(path: Path) -> dict[str, tuple[int, dict[str, str]]]:
    """Read number and text of each line, by designation."""
    if not path.is_file():  # a folder of configuration of one's own need not have one
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(enumerate(csv.DictReader(file), start=2))
    found = {row["designation"]: (number, row) for number, row in rows}
    if len(found) < len(rows):
        twice = [row["designation"] for number, row in rows if found[row["designation"]][0] != number]
        raise InputError([f"{path}: the designation {each} is there twice" for each in twice])
    return found


@cache
def _sources(path: Path) -> dict[str, str]:
    texts = read_file(path.parent / "sources.yaml")
    return {key: " ".join(str(text).split()) for key, text in texts.items()}


@cache
def _entry(path: Path, name: str) -> CatalogueEntry:
    number, row = _rows(path)[name]
    return _entry_of(row, _sources(path), f"{path}, line {number}, {name}")


def _entry_of(row: dict[str, str], texts: dict[str, str], place: str) -> CatalogueEntry:
    problems = [
        f"{place}: {key} is {row[key].split()[0]!r}; it must be one of {', '.join(texts)}"
        for key in ("source", "size_source")
        if row[key] and row[key].split()[0] not in texts
    ]
    if row["kind"] not in KINDS:
        problems.append(f"{place}: kind is {row['kind']!r}; it must be one of {', '.join(KINDS)}")
    if not row["source"] or not row["place"]:
        problems.append(f"{place}: source or place is missing")
    if problems:
        raise InputError(problems)
    described = ", ".join(each for each in (row["kind"], row["maker"], row["about"]) if each)
    keys: dict[str, Any] = {"name": row["designation"], "description": described}
    keys |= {key: _number(row[key]) for key in _NUMBERS if row[key]}
    source = texts[row["source"]]
    plate: NamePlate = read_noun(NamePlate, keys, place)
    size, _, alike = row["size_source"].partition(" ")
    bore, outside, width = (float(row[key] or "nan") / 1000.0 for key in _SIZES)
    return CatalogueEntry(
        plate,
        kind=row["kind"],
        rows=int(row["rows"]),
        maker=row["maker"],
        source=source,
        place=row["place"],
        bore=bore,
        outer_diameter=outside,
        width=width,
        size_source=f"{texts[size]}{f', as {alike}' if alike else ''}" if size else "",
        also_in=tuple(row["also_in"].split()),
        about=row["about"],
    )


def _number(text: str) -> float | int:
    return int(text) if text.isdecimal() else float(text)


def find_bearing(designation: str) -> CatalogueEntry:
    """Find a bearing by its designation, which may have more endings than the catalogue writes.

    ``6205-2RS JEM`` is 6205, ``SKF NU 214 ECP`` is NU214E: endings of seals, cages, clearance and tolerance
    do not change the fault frequencies. One that stands for another inner design is refused.

    Raises
    ------
    InputError
        There is none, or the ending is that of another design; with the nearest names.
    """
    known = _known_names()
    plain, text = _plain(designation), _without_maker(designation)
    own = _plain(text)
    if exact := known.get(plain) or known.get(own):
        return _named(exact)
    maker = next((each for each in map(_plain, _makers()) if plain != own and plain.startswith(each)), "")
    for wanted in (f"{maker}{own}", own):
        begun = [name for name in known if wanted.startswith(name) and _is_ending(wanted, len(name))]
        if begun:
            longest = max(begun, key=len)
            return _if_same_design(_named(known[longest]), wanted[len(longest) :], designation)
    # the catalogue writes an ending that was left out: NU214E; not where it stands for one of several angles
    longer = [name for name in known if own and name.startswith(own) and name[len(own) :] in _LEFT_OUT]
    if len(longer) == 1:
        return _named(known[longer[0]])
    near = [known[name] for name in _nearest(own, known)]
    hint = f"nearest are {', '.join(near)}; " if near else ""
    raise InputError(
        f"there is no bearing {designation!r} in the catalogue; {hint}`beardyn scenes catalogue` lists all, "
        f"shipped whole bearings are {', '.join(shipped_names('bearings'))}; give the "
        "maker's factors (bpfo, bpfi, bsf, ftf), inner dimensions, or the path of a file ending in .yaml"
    )


def _if_same_design(entry: CatalogueEntry, ending: str, designation: str) -> CatalogueEntry:
    if not entry.name[-1].isdigit() or not ending.startswith(_OTHER_DESIGN.get(entry.kind, ())):
        return entry
    raise InputError(
        f"{designation!r} is not in the catalogue; {entry.name} is of the same size, but {ending!r} may "
        f"stand for another inner design; take {entry.name} if it does not, or give bpfo, bpfi, bsf and ftf"
    )


def _known_names() -> dict[str, str]:
    return {_plain(name): name for name in (*_rows(catalogue_file()), *shipped_names("bearings"))}


def _makers() -> list[str]:
    return sorted({row["maker"] for _, row in _rows(catalogue_file()).values() if row["maker"]})


def _named(name: str) -> CatalogueEntry:
    path = catalogue_file()
    return _entry(path, name) if name in _rows(path) else _whole(name)


def _plain(text: str) -> str:
    return re.sub(r"[\s/_.-]", "", text.upper())


def _without_maker(text: str) -> str:
    makers = {each.upper() for each in _makers()}
    words = text.split()
    return " ".join(words[1:]) if len(words) > 1 and words[0].upper() in makers else text


def _is_ending(text: str, begin: int) -> bool:
    """Tell whether what follows is an ending and not more digits of another designation."""
    return not text[begin : begin + 1].isdigit() or text[begin : begin + 2] in ("2R", "2Z")


def _nearest(text: str, names: Iterable[str]) -> list[str]:
    known = list(names)
    begun = sorted((name for name in known if len(text) > 2 and name.startswith(text)), key=len)
    close = get_close_matches(text, known, n=_SHOWN, cutoff=0.5)
    return list(dict.fromkeys((*begun[:_SHOWN], *close)))[:_SHOWN]


def search_catalogue(
    *,
    bore: float | None = None,
    outer_diameter: float | None = None,
    width: float | None = None,
    kind: str = "",
    maker: str = "",
) -> tuple[CatalogueEntry, ...]:
    """Find bearings by dimensions [m], kind and maker; what is left out is not looked at.

    Raises
    ------
    InputError
        With every mistake.
    """
    problems = [
        f"{name} is {1e3 * value:g}; it must be greater than 0"
        for name, value in (("bore_mm", bore), ("outside_mm", outer_diameter), ("width_mm", width))
        if value is not None and not value > 0.0
    ]
    if kind and not _kinds_like(kind):
        problems.append(f"kind is {kind!r}; it must be one of {', '.join(KINDS)}, or a word of them")
    makers = {each for entry in catalogue() for each in (entry.maker, *entry.also_in) if each}
    if maker and maker.upper() not in (each.upper() for each in makers):
        problems.append(f"maker is {maker!r}; it must be one of {', '.join(sorted(makers))}")
    if problems:
        raise InputError(problems)
    return tuple(
        each
        for each in catalogue()
        if _is_size(each.bore, bore)
        and _is_size(each.outer_diameter, outer_diameter)
        and _is_size(each.width, width)
        and (not kind or each.kind in _kinds_like(kind))
        and (not maker or maker.upper() in (each.maker.upper(), *(other.upper() for other in each.also_in)))
    )


def _kinds_like(word: str) -> tuple[str, ...]:
    return tuple(each for each in KINDS if word.casefold() == each or word.casefold() in each.split())


def _is_size(value: float, wanted: float | None) -> bool:
    return wanted is None or (not isnan(value) and abs(value - wanted) <= SAME_SIZE)
