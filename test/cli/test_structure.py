"""`beardyn structure`: a table that is read again, mistakes at once, and nothing without the libraries."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from beardyn_core.cli import main as command
from beardyn_core.config.folders import shipped_names
from beardyn_core.structure.table import read_table
from test.cli.json_page import check
from test.finite_elements import need_finite_elements


@pytest.mark.slow
@pytest.mark.parametrize("name", shipped_names("structures"))
def test_the_modes_of_a_shipped_box(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    need_finite_elements()
    path = tmp_path / "modes.csv"
    words = ["structure", name, "--mesh", "40", "--highest", "6", "-o", str(path), "--json"]
    words += ["--save", str(tmp_path / "modes.rrd")]
    assert command.main(words) == command.DONE
    found = json.loads(capsys.readouterr().out)
    check("structure", found)
    modes = read_table(path)
    # the table has five digits
    assert modes.frequency == pytest.approx(found["frequency_Hz"], rel=5e-5)
    assert modes.mass == pytest.approx(found["mass_kg"], rel=5e-5)
    assert found["yield_modes_m_per_N"] == pytest.approx(found["yield_finite_elements_m_per_N"], rel=0.02)
    assert "axlebox_top" in modes.seats
    assert (tmp_path / "modes.rrd").stat().st_size > 100_000
    assert command.main(words) == command.BAD_INPUT
    assert "--force" in capsys.readouterr().err


def test_mistakes_are_told_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["structure", "metro", "--mesh", "1", "--waves", "9", "-o", str(tmp_path / "no" / "modes.csv")]
    assert command.main(words) == command.BAD_INPUT
    told = capsys.readouterr().err
    for each in ("--mesh is 1; it must be 8 to 60 mm", "--waves is 9; it must be 1 to 8", "--output"):
        assert each in told


def test_modes_of_another_program_have_no_surface(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(
        "name: mine\nbearing: HS130x230\nmodes: modes.unv\n"
        "mass_kg: 70\ninertia_kg_m2: [1, 2, 3]\nproducts_kg_m2: [0, 0, 0]\n"
        "sensors: [{name: top, position_mm: [0, 0, 170]}]\n"
    )
    assert command.main(["structure", str(path), "--save", str(tmp_path / "m.rrd")]) == command.BAD_INPUT
    assert "no surface: leave --save" in capsys.readouterr().err


def test_without_gmsh_a_sentence_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "gmsh", None)
    assert command.main(["structure", "metro"]) == command.BAD_INPUT
    assert "pip install beardyn[structure]" in capsys.readouterr().err
