"""The page of measured bearings next to the twin: its runs, its verdicts, its words for numbers that lack."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from beardyn_core.scene.field_spall import FieldSpall
from evidence.measured.texture import OWN, Measured, main, middle_range, page_values, sum_goals, verdict
from evidence.measured.texture_quantities import Texture
from evidence.measured.twin_runs import FIELD, TwinCase, measure_twin, scene_of, twin_cases
from evidence.pages import render

QUIET = Texture((1.0, 1.0, 2.0, 3.0, 4.0), 5.0, 4.0, 3.5, 0.2, 20.0, 7000.0, 1e-3, 0.002)
OF_12_KHZ = replace(
    QUIET,
    levels=(1.0, 1.0, 2.0, math.nan, math.nan),
    above=math.nan,
    ring_frequency=math.nan,
    ring_down=math.nan,
    wander=math.nan,
)
RECORDS = [
    Measured("MFPT", "cup", QUIET),
    Measured("MFPT", "cup", replace(QUIET, depth=0.4)),
    Measured("CWRU 12 kHz, drive end", "cone", OF_12_KHZ),
]


def runs() -> list[Measured]:
    return [Measured(case.train, case.part, QUIET, case) for case in twin_cases()]


def test_the_page_is_whole_with_public_records_and_with_own_ones() -> None:
    public = render("evidence/measured/texture.py", page_values(RECORDS, [], runs(), "nothing"))
    assert "middle 80 % of the public records" in public
    assert " nan" not in public
    own = render(
        "evidence/measured/texture.py",
        page_values(RECORDS, [Measured(OWN, "cup", replace(QUIET, levels=(2.0,) * 5))], runs(), "nothing"),
    )
    assert "| outer ring (cup), field | freight | 1 | -6.0 | -6.0 | +0.0 | +3.5 | +6.0 |" in own


def test_a_twin_in_the_range_of_the_records_is_inside_and_else_its_distance_is_stated() -> None:
    assert middle_range([float(each) for each in range(11)]) == (1.0, 5.0, 9.0)
    assert verdict([1.0, 3.0], [0.1, 2.0, 9.0], in_dB=False) == "inside"
    assert verdict([1.0, 3.0], [6.0], in_dB=False) == "2.00 times above"
    assert verdict([10.0, 30.0], [4.0], in_dB=True) == "6.0 dB below"
    assert verdict([], [4.0], in_dB=True) == "not compared"
    assert verdict([0.0], [4.0], in_dB=False) == "above"


def test_goals_count_the_runs_inside() -> None:
    assert sum_goals(runs())[0].startswith(
        "modulation depth 0.1 to 0.4, outer ring (cup): 12 of 12 runs inside"
    )
    assert "inner ring (cone): 0 of 12 runs inside, they reach from 4.0 to 4.0" in sum_goals(runs())[1]


def test_runs_have_coupled_laminae_their_spall_and_their_surface() -> None:
    cases = list(twin_cases())
    assert len(cases) == len(set(cases)) == 34
    for case in cases[::5]:
        scene = scene_of(case)
        assert scene.effects.lamina_coupling is not None
        assert scene.scatter is not None
        assert scene.scatter.surface == case.surface
        assert [spall.on for spall in scene.defects] == ([case.part] if case.part else [])
        assert [isinstance(spall, FieldSpall) for spall in scene.defects] == [case.spall == FIELD] * len(
            scene.defects
        )


def test_mistakes_of_the_table_and_absent_records_end_the_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for words in (["--cwru", str(tmp_path)], ["--records", str(tmp_path / "absent.csv")]):
        with pytest.raises(SystemExit) as ended:
            main(words)
        assert ended.value.code == 2
    assert "absent.csv: cannot be read" in capsys.readouterr().err


@pytest.mark.slow  # compiles the kernels of coupled laminae
def test_a_run_of_the_twin_has_every_quantity() -> None:
    found = measure_twin(TwinCase("freight", "cup", "laboratory", "fine"), 4.0)
    assert min(found.levels) > 0.0
    assert found.line > 10.0
    assert math.isfinite(found.ring_down)
