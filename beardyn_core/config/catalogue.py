"""The catalogue of bearings: read, a bearing by its designation, bearings by their dimensions."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable
from difflib import get_close_matches
from functools import cache
from itertools import pairwise
from math import isnan
from pathlib import Path
from typing import Any

from beardyn_core.base.config_folder import config_folder
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.catalogue_entry import KINDS, CatalogueEntry
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config.folders import shipped_names
from beardyn_core.config.nouns import load_any_bearing, read_noun
from beardyn_core.config.yaml_text import read_file

SAME_SIZE = 0.05e-3  # [m]: dimensions that differ by less are one
_NUMBERS = (
    *("roller_count", "roller_diameter_mm", "pitch_diameter_mm", "contact_angle_deg"),
    *("bpfo", "bpfi", "bsf", "ftf"),
)
_SIZES = ("bore_mm", "outside_mm", "width_mm")
_SHOWN = 6
_KINDS_OF_WHOLE = {
    "tapered": "tapered unit",
    "cylindrical": "cylindrical roller",
    "spherical": "spherical roller",
}
_ABOUT_WHOLE = {"tapered": "which can be simulated"}
# Endings that change no inner design: seals and shields, clearance and tolerance, grease and grooves.
_SEALS = "RS1|RSH|RSR|RS|RZ|ZR|ZZ|Z|LLU|LLB|LLH|DDU|VV"
_NEUTRAL = f"{_SEALS}|C[1-5]|CN|P[0456]|QE6|JEM|W33|W20|NR|N"
_CAGES = "CP|CJ|CML|CM|XL|TVP2|TVP|MA|MB|M1|M|J"  # of cylindrical rollers of the designs E and EC
_BETWEEN = r"[\s/_.-]"


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
    bearing = load_any_bearing(name)
    sources = dict(bearing.sources)
    return CatalogueEntry(
        NamePlate.of(bearing),
        kind=_KINDS_OF_WHOLE[bearing.kind],
        rows=2,
        maker="",
        source=sources.get("roller_diameter", "see the file"),
        place=f"{name}.yaml",
        bore=bearing.bore,
        outer_diameter=bearing.outer_diameter,
        width=bearing.width,
        size_source=sources.get("bore", "see the file"),
        about=f"whole bearing, {_ABOUT_WHOLE.get(bearing.kind, 'with static answers')}",
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
    """Find a bearing by its designation, which may have endings that change no inner design.

    ``6205-2RS JEM`` is 6205, ``SKF NU 214 ECP`` is NU214E: endings of seals, clearance and tolerance, and the
    whole designation in the maker's list. Any other ending, and a maker whose list does not have the bearing,
    is refused: another inner design may be meant.

    Raises
    ------
    InputError
        There is none, or the ending or the maker may be that of another design; with the nearest names.
    """
    path = catalogue_file()
    maker, own = _maker_and_rest(designation)
    for name in (designation.strip().upper(), f"{maker} {own}"):
        if name in _rows(path):
            return _entry(path, name)
    if whole := {each.upper(): each for each in shipped_names("bearings")}.get(designation.strip().upper()):
        return _whole(whole)
    written = designation.upper() if not maker else own
    fitting = [_entry(path, name) for name, (_, row) in _rows(path).items() if _fits(row, maker, written)]
    listed = [each for each in fitting if not maker or maker in _makers_of(each)]
    special = [each for each in listed if maker and each.name.upper().startswith(maker)]
    if listed:
        return max(special or listed, key=lambda each: len(each.name))
    if fitting:
        raise InputError(
            f"the catalogue has {fitting[0].name} of {', '.join(_makers_of(fitting[0])) or 'no maker'}, not "
            f"of {maker}; makers differ in their inner designs: write {fitting[0].name} if it is the same, "
            "or give bpfo, bpfi, bsf and ftf"
        )
    names = {re.sub(_BETWEEN, "", each.upper()): each for each in (*_rows(path), *shipped_names("bearings"))}
    near = [names[each] for each in _nearest(re.sub(_BETWEEN, "", own), names)]
    hint = f"nearest are {', '.join(near)}; an ending may stand for another inner design; " if near else ""
    raise InputError(
        f"there is no bearing {designation!r} in the catalogue; {hint}`beardyn scenes catalogue` lists all, "
        f"shipped whole bearings are {', '.join(shipped_names('bearings'))}; give the "
        "maker's factors (bpfo, bpfi, bsf, ftf), inner dimensions, or the path of a file ending in .yaml"
    )


def _maker_and_rest(designation: str) -> tuple[str, str]:
    """Split the maker off, which may be written in one word with the number: NSK6205."""
    text = designation.strip().upper()
    for maker in sorted(_makers(), key=len, reverse=True):
        rest = text.removeprefix(maker)
        if rest != text and re.match(rf"{_BETWEEN}|\d", rest):
            return maker, re.sub(rf"^{_BETWEEN}+", "", rest)
    return "", text


def _fits(row: dict[str, str], maker: str, written: str) -> bool:
    """Tell whether a line has a designation, with more endings or fewer that change nothing."""
    own = row["maker"].upper()
    whole = row["place"].upper() if row["source"] == "makers_list" else ""
    names = {row["designation"].upper(), whole}
    if maker:
        names |= {name.removeprefix(own).strip() for name in names if name.startswith(f"{own} ")}
    else:
        names |= (
            {whole.removeprefix(own).strip()} if row["designation"][:1] in whole.removeprefix(own) else set()
        )
    extra = f"|{_CAGES}" if row["kind"] == "cylindrical roller" and row["designation"].endswith("E") else ""
    return any(_pattern(name, extra).fullmatch(written) for name in names if name)


@cache
def _pattern(name: str, extra: str) -> re.Pattern[str]:
    """Write a designation with any separators, but no slash between digits: 62/22 is not 6222."""
    letters = re.sub(_BETWEEN, "", name)
    parts = [letters[0]]
    for before, after in pairwise(letters):
        parts += [r"[\s_.-]*" if before.isdigit() and after.isdigit() else f"{_BETWEEN}*", re.escape(after)]
    ending = rf"(?:{_BETWEEN}+2(?:{_SEALS})|{_BETWEEN}*(?:{_NEUTRAL}{extra}))"
    return re.compile(f"{''.join(parts)}{ending}*{_BETWEEN}*")


def _makers_of(entry: CatalogueEntry) -> tuple[str, ...]:
    return tuple(each.upper() for each in (entry.maker, *entry.also_in) if each)


def _makers() -> set[str]:
    rows = [row for _, row in _rows(catalogue_file()).values()]
    return {each.upper() for row in rows for each in (row["maker"], *row["also_in"].split()) if each}


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
