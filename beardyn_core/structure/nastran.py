"""Modes at nodes in a punch file of Nastran, with the grid points of its bulk data file.

Both are text in fixed columns that has not changed for decades, so no library is asked for: no release of
pyNastran allows numpy 2 (1.4.1, the last one, asks for less; only its main branch does).

References
----------
Punch file: NASTRAN-95, https://github.com/nasa/NASTRAN-95, mis/ofppun.f, formats 520, 590 to 610 and 1520.
GRID entry, small, large and free fields: The NASTRAN User's Manual, NASA SP-222, section 2.4.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.base.inputs import text_of_file
from beardyn_core.structure.shapes import Shapes

_EIGENVALUE = re.compile(r"\$EIGENVALUE =\s*(\S+)\s+MODE =\s*(\d+)")
_ASK = "ask for VECTOR(SORT1,PUNCH,REAL) = ALL in a solution 103"
_LARGEST_IS_ONE = 1e-5  # of the largest displacements, which the file has to seven digits

Vectors = dict[int, tuple[float, float, float]]


def read_nastran(punch: Path, bulk: Path) -> Shapes:
    """Read real eigenvectors that are normalised to the mass, and their grid points.

    Raises
    ------
    InputError
        With every mistake in the two files.
    """
    modes, problems = _eigenvectors(_lines(punch), punch)
    if not modes and not problems:
        problems.append(f"{punch}: there are no eigenvectors; {_ASK}")
    largest = [max((max(map(abs, each)) for each in vectors.values()), default=0.0) for _, vectors in modes]
    if modes and max(abs(each - 1.0) for each in largest) < _LARGEST_IS_ONE:
        problems.append(
            f"{punch}: the largest displacement of every mode is 1, so its modal masses are unknown; "
            "normalise to the mass (EIGRL with NORM = MASS)"
        )
    numbers = sorted({number for _, vectors in modes for number in vectors})
    places, wrong = _grid_points(_lines(bulk), set(numbers), bulk)
    problems += wrong
    if problems:
        raise InputError(problems)
    order = {number: i for i, number in enumerate(numbers)}
    shape = np.zeros((len(modes), len(numbers), 3))
    for mode, (_, vectors) in zip(shape, modes, strict=True):
        mode[[order[number] for number in vectors]] = list(vectors.values())
    square = np.array([eigenvalue for eigenvalue, _ in modes])
    return Shapes(
        np.array([places[number] for number in numbers]),
        np.sqrt(np.maximum(square, 0.0)) / (2.0 * math.pi),
        np.zeros(len(modes)),
        shape,
    )


def _lines(path: Path) -> list[str]:
    try:
        return text_of_file(path, "latin-1").splitlines()  # titles may be in any language
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from error


def _eigenvectors(lines: list[str], path: Path) -> tuple[list[tuple[float, Vectors]], list[str]]:
    """Read eigenvalues with the displacements of grid points; gives the mistakes last."""
    modes: list[tuple[float, Vectors]] = []
    problems: list[str] = []
    wanted = False
    for at, line in enumerate(lines, start=1):
        try:
            if line.startswith("$TITLE"):
                wanted = False
            elif line.startswith("$EIGENVECTOR"):
                wanted = "SOLUTION SET" not in line
                vectors: Vectors | None = None
            elif not wanted or line.startswith("-CONT-"):  # a continuation has the rotations
                continue
            elif line.startswith(("$REAL-IMAGINARY", "$MAGNITUDE-PHASE")):
                problems.append(f"{path}, line {at}: the eigenvectors are complex; {_ASK}")
                wanted = False
            elif found := _EIGENVALUE.match(line):
                vectors = {}
                modes.append((_number(found[1]), vectors))
            elif line.startswith("$") or not line.strip():
                continue
            elif vectors is None:
                problems.append(f"{path}, line {at}: displacements without $EIGENVALUE before them; {_ASK}")
                wanted = False
            elif line[10:18].strip() == "G":
                x, y, z = (_number(line[i : i + 18]) for i in (18, 36, 54))
                vectors[int(line[:10])] = (x, y, z)
            elif line[10:18].strip() != "S":  # scalar points have no place
                raise ValueError("no point of type G or S")
        except ValueError as error:
            problems.append(f"{path}, line {at}: is no line of a punch file ({error})")
            break
    return modes, problems


def _grid_points(lines: list[str], wanted: set[int], path: Path) -> tuple[Vectors, list[str]]:
    """Read the places of grid points; gives the mistakes last."""
    places: Vectors = {}
    problems: list[str] = []
    for at, fields in grid_entries(lines):
        try:
            number = int(fields[0])
            if number not in wanted:
                continue
            systems = [each for each in (fields[1], fields[5]) if each not in ("", "0")]
            if systems:
                problems.append(
                    f"{path}, line {at}: GRID {number} is in the coordinate system {systems[0]}; places and "
                    "displacements must be in the basic one (CP and CD blank or 0)"
                )
            x, y, z = (_number(each) if each else 0.0 for each in fields[2:5])
            places[number] = (x, y, z)
        except ValueError as error:
            problems.append(f"{path}, line {at}: is no GRID entry ({error})")
    lost = sorted(wanted - places.keys())
    if lost and not problems:
        included = any(line.strip().upper().startswith("INCLUDE") for line in lines)
        hint = "; it includes other files: give one with everything" if included else ""
        problems.append(f"{path}: {len(lost)} nodes of the shapes have no GRID entry, {lost[0]} first{hint}")
    if any(line.upper().startswith("GRDSET") for line in lines):
        problems.append(f"{path}: GRDSET is not read; write coordinate systems into the GRID entries")
    return places, problems


def grid_entries(lines: list[str]) -> Iterator[tuple[int, list[str]]]:
    """Find the lines of GRID entries, and their fields: number, CP, three coordinates, CD.

    A large entry goes on in the next line with ``*``, or in that with the name it gives; without, the rest is
    blank.
    """
    written = [
        (at, *_fields(line)) for at, line in enumerate(lines, start=1) if line.partition("$")[0].strip()
    ]
    rest = {name: fields for _, name, fields in written if len(name) > 1 and name.startswith("*")}
    for i, (at, name, fields) in enumerate(written):
        if name == "GRID*":
            mark = _continuation_of(lines[at - 1])
            _, next_name, next_fields = written[i + 1] if i + 1 < len(written) else (0, "", [])
            follows = next_name == "*" or (not mark and next_name in rest)
            blank = [""] * (4 - len(fields))
            fields = [*fields[:4], *blank, *(next_fields if follows else rest.get(mark, []))]
        if name in ("GRID", "GRID*"):
            yield at, [*fields, *[""] * 6][:6]


def _continuation_of(line: str) -> str:
    """Take the name that the second line of a large entry begins with; empty where it has none."""
    line = line.partition("$")[0].expandtabs(8)
    mark = ",".join(line.split(",")[5:6]) if "," in line else line[72:80]
    mark = mark.strip().upper().lstrip("*+")
    return f"*{mark}" if mark else ""


def _fields(line: str) -> tuple[str, list[str]]:
    """Split a line into its name and the fields behind it: free ones, or of 8 or 16 columns."""
    line = line.partition("$")[0].expandtabs(8)
    if "," in line:
        name, *fields = (each.strip() for each in line.split(","))
        return name.upper(), fields
    name = line[:8].strip().upper()
    width = 16 if "*" in name else 8
    return name, [line[i : i + width].strip() for i in range(8, 72, width)]


def _number(text: str) -> float:
    """Read a number, which may do without the letter before its exponent."""
    plain = re.sub(r"(?<=[\d.])([-+]\d+)$", r"E\1", text.strip().upper().replace("D", "E"))
    found = float(plain)
    if not math.isfinite(found):
        raise ValueError(f"{text.strip()!r} is not finite")
    return found
