"""Recordings of a folder, from its manifest and from the paths, with all mistakes at once."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from math import isfinite, nan
from pathlib import Path
from typing import Any, NamedTuple

from beardyn_core.base.edge import kind_of, places
from beardyn_core.base.errors import InputError, separator_problem
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.fleet.identity import SIDES, Axlebox, FleetRecording, read_time
from beardyn_core.fleet.manifest_line import IDENTITY_COLUMNS, NUMBERS, READING_COLUMNS
from beardyn_core.fleet.path_pattern import PathPattern
from beardyn_core.measured.options import Reading

MANIFESTS = ("manifest.csv", "manifest.yaml", "manifest.yml")
_MEASURED = frozenset(
    {".csv", ".txt", ".tsv", ".mat", ".h5", ".hdf5", ".wav", ".flac", ".npz", ".npy", ".tdms", ".mf4", ".mdf"}
    | {".parquet", ".mcap", ".unv", ".uff"}
)
_YES = {"yes": True, "true": True, "1": True, "no": False, "false": False, "0": False, "": False}
_ABSENT = (None, "")
_IDENTITY = ("vehicle", "axle", "side", "time")


class Listed(NamedTuple):
    """What was found in folders and files."""

    recordings: tuple[FleetRecording, ...]
    warnings: tuple[str, ...]


class _Line(NamedTuple):
    place: str  # in sentences
    path: Path
    cells: dict[str, Any]


def list_recordings(
    inputs: Sequence[Path],
    *,
    manifest: Path | None = None,
    pattern: str = "",
    defaults: Mapping[str, Any] | None = None,
) -> Listed:
    """List the recordings of folders and files with their identity.

    Parameters
    ----------
    inputs : sequence of Path
        Folders and files. Of a folder its manifest, or with a pattern every measured file that fits it.
    manifest : Path, optional
        In place of the one in the folder.
    pattern : str
        Of the paths; see `PathPattern`.
    defaults : mapping, optional
        Columns of every line that does not have them.

    Raises
    ------
    InputError
        With every mistake of every line.
    """
    problems: list[str] = []
    warnings: list[str] = []
    read_path = PathPattern(pattern) if pattern else None
    lines: list[_Line] = []
    for each in [manifest] if manifest is not None else []:
        lines += _lines_of_manifest(each, problems)
    chosen: set[Path] = set()
    for given in inputs:
        own = [path for name in MANIFESTS if (path := given / name).is_file()] if manifest is None else []
        if not given.exists():
            problems.append(f"{given}: does not exist; give a folder or files")
        elif len(own) > 1:
            problems.append(f"{given}: has {' and '.join(each.name for each in own)}; keep one")
        elif own:
            lines += _lines_of_manifest(own[0], problems)
        if given.exists():
            chosen |= {path.resolve() for path in _measured_files(given)}
    if manifest is not None and chosen:
        lines = [each for each in lines if each.path.resolve() in chosen]
    known = {each.path.resolve() for each in lines}
    named_by_options = any((defaults or {}).get(key) not in _ABSENT for key in _IDENTITY)
    from_paths = []
    for given in inputs:
        for path in _measured_files(given):
            if path.resolve() in known:
                continue
            stated = read_path.read(path) if read_path is not None else None
            if stated is not None or (read_path is None and named_by_options and not lines):
                from_paths.append(_Line(str(path), path, {"file": str(path)}))
            elif read_path is not None:
                problems.append(
                    f"{path}: does not fit --pattern {pattern}, and no line of a manifest names it"
                )
            elif lines:
                warnings.append(f"{path}: no line of the manifest names it; it is left out")
            else:
                problems.append(
                    f"{path}: nothing names its axlebox; write {MANIFESTS[0]} in its "
                    "folder, give --pattern such as {vehicle}/{axle}_{side}/{date}.csv, or for one file "
                    "--vehicle, --axle, --side and --time"
                )
    lines += from_paths
    if not lines and not problems:
        problems.append("no measured file and no recording was found in what was given")
    found = []
    for line in lines:
        one = _recording_of(line, read_path, defaults or {}, problems)
        if one is not None:
            found.append(one)
    if problems:
        raise InputError(problems)
    return Listed(tuple(sorted(found, key=lambda each: (each.time, each.axlebox))), tuple(warnings))


def _measured_files(given: Path) -> Iterator[Path]:
    if given.is_file():
        yield given
    elif given.is_dir():
        for path in sorted(given.rglob("*")):
            if path.is_file() and path.suffix.lower() in _MEASURED and path.name not in MANIFESTS:
                yield path


def _lines_of_manifest(path: Path, problems: list[str]) -> list[_Line]:
    """Read the lines of a manifest, defaults of a YAML file put in."""
    try:
        rows = _csv_rows(path) if path.suffix.lower() == ".csv" else _yaml_rows(path)
    except InputError as error:
        problems += error.problems
        return []
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        problems.append(f"{path}: cannot be read ({error})")
        return []
    lines, known = [], {*IDENTITY_COLUMNS, *READING_COLUMNS}
    unknown = dict.fromkeys(key for _, cells in rows for key in cells if key not in known)
    for key in unknown:
        problems.append(f"{path}: {key} is no column of a manifest; allowed are {', '.join(sorted(known))}")
    for number, cells in rows:
        place = f"{path}, {number}"
        name = str(cells.get("file") or "").strip()
        if not name:
            problems.append(f"{place}: file is missing")
            continue
        target = path.parent / name
        if not target.is_file():
            problems.append(f"{place}: file is {name}, which does not exist in {path.parent}")
            continue
        lines.append(_Line(place, target, cells))
    if not rows:
        problems.append(f"{path}: has no line")
    return lines


def _csv_rows(path: Path) -> list[tuple[str, dict[str, Any]]]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        head = file.readline()
        if sentence := separator_problem(head):
            raise InputError(f"{path}: {sentence}")
        file.seek(0)
        reader = csv.DictReader(file, restkey="", strict=True)
        rows = []
        for cells in reader:
            if cells.get(""):
                raise InputError(f"{path}, line {reader.line_num}: has more cells than the head has columns")
            kept = {str(key).strip(): value for key, value in cells.items() if key and value is not None}
            rows.append((f"line {reader.line_num}", {k: v.strip() for k, v in kept.items()}))
        return rows


def _yaml_rows(path: Path) -> list[tuple[str, dict[str, Any]]]:
    from beardyn_core.config.yaml_text import read_file

    content = read_file(path)
    defaults, several = content.get("defaults") or {}, content.get("recordings")
    problems = [
        f"{path}: {key} is no key of a manifest; allowed are defaults and recordings"
        for key in content
        if key not in ("defaults", "recordings")
    ]
    if not isinstance(several, list) or not all(isinstance(each, dict) for each in several):
        problems.append(f"{path}: recordings must be a list of mappings, one a file")
    if not isinstance(defaults, dict):
        problems.append(f"{path}: defaults must be a mapping of columns")
    if problems:
        raise InputError(problems)
    assert isinstance(several, list)
    return [(f"recordings[{number}]", {**defaults, **each}) for number, each in enumerate(several)]


def _recording_of(
    line: _Line, pattern: PathPattern | None, defaults: Mapping[str, Any], problems: list[str]
) -> FleetRecording | None:
    """Make the recording of a line; adds what is missing or contradicts to the problems."""
    place, cells = line.place, {k: v for k, v in line.cells.items() if v not in _ABSENT}
    found: list[str] = []
    stated = pattern.read(line.path) if pattern is not None else None
    for key, value in (stated or {}).items():
        own = cells.setdefault(key, value)
        if _as_compared(key, own) != _as_compared(key, value):
            found.append(f"{place}: {key} is {own} in the manifest and {value} in the path; correct one")
    cells = {**{k: v for k, v in defaults.items() if v not in _ABSENT}, **cells}
    texts = {key: str(cells.get(key, "")).strip() for key in IDENTITY_COLUMNS}
    for key in _IDENTITY:
        if not texts[key]:
            named = "{date}" if key == "time" else f"{{{key}}}"
            found.append(
                f"{place}: {key} is missing; give it in the manifest, as {named} of --pattern, or as --{key}"
            )
    side = SIDES.get(texts["side"].lower(), "")
    if texts["side"] and not side:
        found.append(f"{place}: side is {texts['side']!r}; it must be left or right")
    exchanged = _YES.get(texts["bearing_exchanged"].lower())
    if exchanged is None:
        found.append(f"{place}: bearing_exchanged is {texts['bearing_exchanged']!r}; it must be yes or no")
    numbers = {key: _number(place, key, texts[key], found) for key in NUMBERS}
    if numbers["mileage_km"] < 0.0:
        found.append(f"{place}: mileage_km is {texts['mileage_km']}; it must be at least 0")
    time = nan
    if texts["time"]:
        try:
            time = read_time(texts["time"])
        except ValueError:
            found.append(
                f"{place}: time is {texts['time']!r}; write it as 2026-03-01, 2026-03-01T14:05:00 or "
                "20260301_140500"
            )
    reading = _reading_of(place, cells, found)
    problems += found
    if found:
        return None
    return FleetRecording(
        line.path,
        Axlebox(texts["vehicle"], texts["axle"], side),
        texts["train"] or texts["vehicle"],
        time,
        1e3 * numbers["mileage_km"],
        texts["bearing"],
        texts["sensor"],
        texts["source_box"],
        bool(exchanged),
        numbers["temperature_C"] + ZERO_CELSIUS,
        reading,
    )


def _as_compared(key: str, value: Any) -> object:
    """Give what two statements of a column are compared by."""
    text = str(value).strip()
    try:
        if key == "time":
            return read_time(text)
        if key in NUMBERS:
            return float(text)
    except ValueError:
        return text
    return SIDES.get(text.lower(), text) if key == "side" else text


def _number(place: str, key: str, text: str, found: list[str]) -> float:
    if not text:
        return nan
    try:
        number = float(text)
    except ValueError:
        number = nan
    if not isfinite(number):
        found.append(f"{place}: {key} is {text!r}; it must be a number")
    return number


def _reading_of(place: str, cells: Mapping[str, Any], found: list[str]) -> dict[str, Any]:
    """Gather how the file is read, texts of a CSV file converted."""
    given: dict[str, Any] = {}
    for each in places(Reading):
        value = cells.get(each.key)
        if value in _ABSENT:
            continue
        kind = kind_of(each) if each.field != "channels" else str
        try:
            given[each.key] = kind(value) if isinstance(value, str) else value
        except ValueError:
            found.append(f"{place}: {each.key} is {value!r}; it must be a number")
    try:
        Reading.of(**given)
    except InputError as error:
        found += [f"{place}: {each}" for each in error.problems]
    return given
