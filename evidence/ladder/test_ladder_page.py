"""The page of the ladders says what the levels of a ladder showed."""

from __future__ import annotations

from pathlib import Path

import pytest

from beardyn_core.base.errors import ValidityError
from beardyn_core.choice import load_scene
from beardyn_core.study.ladder import comparison_of
from beardyn_core.twin import Twin
from evidence.ladder import front
from evidence.ladder.page import page
from evidence.ladder.turns import in_turns
from evidence.pages import REPORTS
from test.study.fake_ladder import FakeRuns, climbed


def test_a_section_has_every_level_and_the_summary_the_cheapest_good_one() -> None:
    ladder = climbed(comparison_of(load_scene("static_80kN"), 0.5, 0.1), FakeRuns())
    summary, text = page([ladder], [Path("somewhere/static.png")], "neighbour").split("\n## static_80kN\n")
    lines = text.splitlines()
    assert "![Accuracy against wall time of static_80kN](../pictures/static.png)" in lines
    assert any("No fault, so no fault line" in line for line in lines)
    for row in ladder.rows:
        assert sum(line.startswith("|") and row.level.name in line for line in lines) == 1
    assert any("static_80kN" in line and "middle" in line for line in summary.splitlines())


def test_the_front_on_the_first_page_is_that_of_the_ladder() -> None:
    readme = front.README.read_text(encoding="utf-8")
    ladder = (REPORTS / "ladder.md").read_text(encoding="utf-8")
    assert readme == front.renewed(readme, ladder)
    assert "| auto 5 % |" in front.front(ladder)


def test_levels_that_take_turns_have_costs_of_their_own_and_the_same_errors() -> None:
    """A level that failed keeps what the climb had found."""
    scene = load_scene("static_80kN", effects="standard")
    ladder = climbed(comparison_of(scene, 0.5, 0.1), FakeRuns(invalid=7))
    found = in_turns(ladder, scene, turns=3)
    assert [row.errors for row in found.rows] == [row.errors for row in ladder.rows]
    costs = {row.level.steps_per_sample: row.cost for row in found.rows}
    assert all(cost.lower <= cost.median <= cost.upper for cost in costs.values())
    assert costs[1].median < costs[8].median  # a spring a roller, and every roller in 8 steps: 50 times
    for before, after in zip(ladder.rows, found.rows, strict=True):
        assert (before.cost == after.cost) == (not before.errors)
    assert found.reference.cost != ladder.reference.cost


def test_a_level_that_breaks_down_in_a_turn_keeps_the_cost_of_its_climb(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It must not end the page, and the others go on with their turns."""
    scene = load_scene("static_80kN", effects="standard")
    ladder = climbed(comparison_of(scene, 0.5, 0.1), FakeRuns())

    def advance(twin: Twin, count: int = 1) -> None:
        if twin.scene.tier == "lumped":
            raise ValidityError("a roller is pressed too far")

    monkeypatch.setattr(Twin, "advance", advance)
    found = in_turns(ladder, scene, turns=3)
    kept = [before.cost == after.cost for before, after in zip(ladder.rows, found.rows, strict=True)]
    assert kept == [row.level.tier == "lumped" for row in ladder.rows]
    assert any(kept)
    assert not all(kept)
