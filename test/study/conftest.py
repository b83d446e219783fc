"""What the tests of ladders share."""

from __future__ import annotations

import pytest

from beardyn_core.choice import load_scene
from beardyn_core.study.ladder import comparison_of
from beardyn_core.study.level_run import Comparison


@pytest.fixture(scope="module")
def comparison() -> Comparison:
    return comparison_of(load_scene("static_80kN"), 0.5, 0.1)
