"""Modes in a punch file of Nastran are those of the same box in a Universal file; broken files are told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.config import load_bearing
from beardyn_core.config.nouns import load_box
from beardyn_core.structure.imported import ModeFile, modes_of_file
from beardyn_core.structure.nastran import grid_entries
from test.analytic import test_mode_file as universal

BEARING = load_bearing("HS130x230")
FORMS = {
    "small": "GRID    {number:8d}{cp:8s}{x:8.3f}{y:8.3f}{z:8.3f}{cd:8s}",
    "large": "GRID*   {number:16d}{cp:16s}{x:16.8f}{y:16.8f}*G{number}\n*G{number:<6d}{z:16.8f}{cd:16s}",
    "free": "GRID, {number}, {cp}, {x:.7f}, {y:.7f}, {z:.7f}, {cd}  $ in free fields",
}


def bulk(path: Path, form: str = "free", cp: str = "", cd: str = "") -> Path:
    """Grid points of the box, among other entries."""
    lines = ["SOL 103", "CEND", "BEGIN BULK", "$ GRID is an entry", "PSOLID  1       1"]
    for number, place in enumerate(1e3 * (universal.nodes() @ universal.TURN + universal.ORIGIN), start=1):
        x, y, z = place
        lines += FORMS[form].format(number=number, x=x, y=y, z=z, cp=cp, cd=cd).splitlines()
    lines += ["GRID,900,3,,,", "ENDDATA"]  # of no shape: its system does not matter
    path.write_text("\n".join(lines))
    return path


def punch(path: Path, mass: float = 1.0, largest: bool = False) -> Path:
    """The columns of NASTRAN-95, as it writes them in a solution for modes."""
    lines: list[str] = []

    def card(text: str) -> None:
        lines.append(f"{text:72s}{len(lines) + 1:8d}")

    for mode, (hertz, shape) in enumerate(
        zip(universal.HERTZ, universal.shapes() @ universal.TURN, strict=True), start=1
    ):
        for text in ("$TITLE   = A BOX", "$SUBTITLE=", "$LABEL   =", "$EIGENVECTOR", "$REAL OUTPUT"):
            card(text)
        card("$SUBCASE ID =           1")
        card(f"$EIGENVALUE ={(2.0 * np.pi * hertz) ** 2:15.7E}  MODE ={mode:6d}")
        size = np.abs(shape).max() if largest else np.sqrt(mass)
        for number, (x, y, z) in enumerate(shape / size, start=1):
            card(f"{number:10d}       G{x:18.6E}{y:18.6E}{z:18.6E}")
            card(f"-CONT-            {7.0:18.6E}{7.0:18.6E}{7.0:18.6E}")
        card(f"{950:10d}       S{7.0:18.6E}{0.0:18.6E}{0.0:18.6E}")
    for text in ("$TITLE   = A BOX", "$DISPLACEMENTS", "$REAL OUTPUT"):
        card(text)
    card(f"{1:10d}       G{9.0:18.6E}{9.0:18.6E}{9.0:18.6E}")
    path.write_text("\n".join(lines) + "\n")
    return path


def box(folder: Path, **changes: object) -> ModeFile:
    return universal.box(folder / "box.pch", grid=folder / "box.bdf", **changes)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("unit", "mass"), [("kg", 1.0), ("t", 1e-3)])
def test_modes_are_those_of_the_universal_file(form: str, unit: str, mass: float, tmp_path: Path) -> None:
    """A modal mass of one tonne has shapes that are smaller by the root of a thousand."""
    pytest.importorskip("pyuff")
    universal.write(tmp_path / "box.unv")
    expected = modes_of_file(universal.box(tmp_path / "box.unv"), BEARING)
    bulk(tmp_path / "box.bdf", form)
    punch(tmp_path / "box.pch", mass)
    found = modes_of_file(box(tmp_path, mass_unit=unit), BEARING)
    assert found.frequency == pytest.approx(expected.frequency, rel=1e-6)
    assert found.reads == pytest.approx(expected.reads, abs=1e-4)
    assert np.abs(expected.reads).max() > 0.9


def test_a_file_of_a_box_names_both(tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text(
        "name: mine\nbearing: HS130x230\nmodes: box.PCH\ngrid: box.bdf\nmass_unit: t\nmass_kg: 70\n"
        "inertia_kg_m2: [1, 2, 3]\nproducts_kg_m2: [0, 0, 0]\n"
        "sensors: [{name: top, position_mm: [0, 0, 170]}]\n"
    )
    found = load_box(tmp_path / "mine.yaml")
    assert isinstance(found, ModeFile)
    assert found.grid == tmp_path / "box.bdf"
    text = (tmp_path / "mine.yaml").read_text().replace("bearing: HS130x230\n", "")
    (tmp_path / "old.yaml").write_text(text)
    with pytest.raises(
        InputError, match=r"old\.yaml: bearing is missing; files of earlier versions lack it: add"
    ):
        load_box(tmp_path / "old.yaml")
    with pytest.raises(InputError, match=r"grid is the bulk data file of a punch file: give it"):
        universal.box(tmp_path / "box.pch")
    with pytest.raises(InputError, match=r"leave it out with modes box\.unv"):
        universal.box(tmp_path / "box.unv", grid=tmp_path / "box.bdf")


def test_a_large_entry_goes_on_where_it_says() -> None:
    """Comments between, a name that stands elsewhere, a second line that is left out."""
    first = f"GRID*   {7:16d}{'':16s}{1.5:16.3f}{2.5:16.3f}"
    second = f"{3.5:16.3f}{4:16d}"
    whole, short = ["7", "", "1.500", "2.500", "3.500", "4"], ["7", "", "1.500", "2.500", "", ""]
    other = "GRID,8,,1.,2.,9."
    for lines, expected in (
        ([first, "$ a note, of 1", "", f"*       {second}"], whole),
        ([first, f"*G7     {second}"], whole),
        ([f"{first}*G7", other, f"*G7     {second}"], whole),
        ([f"{first}+G7", f"*       {second}"], whole),
        ([f"{first}*G7", f"*G8     {9.5:16.3f}"], short),
        ([first, other], short),
        ([first, f"        {second}"], short),
        ([first], short),
        (["GRID*,7,,1.500,2.500,*G7", "*G7,3.500,4"], whole),
        (["GRID*,7,,1.500,2.500", other], short),
        (["GRID*,7", "*,3.500,4"], ["7", "", "", "", "3.500", "4"]),
    ):
        assert next(grid_entries(lines)) == (1, expected), lines


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "there are no eigenvectors; ask for VECTOR"),
        ("$TITLE\n$EIGENVECTOR\n$REAL-IMAGINARY OUTPUT\n", "line 3: the eigenvectors are complex"),
        ("$EIGENVECTOR\n$POINT ID =  1\n         1       G\n", "line 3: displacements without"),
        (
            "$EIGENVECTOR\n$EIGENVALUE =  1.0E+8  MODE =     1\n         1       G   x\n",
            "line 3: is no line of",
        ),
        ("$EIGENVECTOR\n$EIGENVALUE =  1.0E+8  MODE =     1\nnothing\n", "line 3: is no line of"),
        (
            "$EIGENVECTOR\n$EIGENVALUE =  NAN  MODE =     1\n",
            "line 2: is no line of a punch file ('NAN' is not",
        ),
    ],
)
def test_a_broken_punch_file_is_told(text: str, words: str, tmp_path: Path) -> None:
    bulk(tmp_path / "box.bdf")
    (tmp_path / "box.pch").write_text(text)
    with pytest.raises(InputError) as found:
        modes_of_file(box(tmp_path), BEARING)
    assert any(words in problem for problem in found.value.problems), found.value.problems


def test_shapes_that_are_not_normalised_to_the_mass_are_told(tmp_path: Path) -> None:
    bulk(tmp_path / "box.bdf")
    punch(tmp_path / "box.pch", largest=True)
    with pytest.raises(InputError, match="normalise to the mass"):
        modes_of_file(box(tmp_path), BEARING)


def test_a_bulk_data_file_that_does_not_place_the_nodes_is_told(tmp_path: Path) -> None:
    punch(tmp_path / "box.pch")

    def told() -> str:
        with pytest.raises(InputError) as found:
            modes_of_file(box(tmp_path), BEARING)
        return "\n".join(found.value.problems)

    assert "box.bdf: cannot be read (No such file" in told()
    bulk(tmp_path / "box.bdf", cp="3")
    assert "GRID 1 is in the coordinate system 3; places and displacements must be in the basic one" in told()
    bulk(tmp_path / "box.bdf", cd="4")
    assert "GRID 1 is in the coordinate system 4" in told()
    (tmp_path / "box.bdf").write_text("INCLUDE 'nodes.bdf'\nGRDSET,,,,,,7\nGRID,1,,a\n")
    assert "line 3: is no GRID entry" in told()
    assert "GRDSET is not read" in told()
    (tmp_path / "box.bdf").write_text("INCLUDE 'nodes.bdf'\nGRID,1,,1.5-1,2.D2,-.5+0\n")
    assert "96 nodes of the shapes have no GRID entry, 2 first; it includes other files" in told()
