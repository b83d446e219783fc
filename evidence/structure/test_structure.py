"""Modes on springs are those of the finite elements on springs."""

from __future__ import annotations

import pytest

from beardyn_core.config import load_bearing, load_box
from beardyn_core.structure.box import Box
from beardyn_core.structure.build import modes_of
from evidence.structure.study import on_springs
from test.finite_elements import need_finite_elements

need_finite_elements()


@pytest.mark.slow
def test_a_box_on_springs_has_the_frequencies_of_its_finite_elements() -> None:
    box = load_box("metro")
    assert isinstance(box, Box)
    built = modes_of(box, load_bearing(box.bearing), mesh=0.045, highest=8000.0)
    for stiffness in (1e8, 2e9):
        exact, found = on_springs(built, stiffness)
        assert found == pytest.approx(exact, rel=5e-3)
