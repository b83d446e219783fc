"""The table of boxes counts what an estimator reports, and what of it holds."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from beardyn_core.follow.labelled import Described
from evidence.follow import boxes


def estimates(strangeness: float, width: float, least: float, half: float) -> Any:
    """Report a lateral load of 5 kN, a width with an interval of +-half, or a least width."""
    nothing = SimpleNamespace(value=np.nan, at_least=np.nan, intervals=())
    load = SimpleNamespace(value=5e3, at_least=np.nan, intervals=((0, 0), (4e3, 6e3)))
    ends = ((width, width), (width - half, width + half))
    spall = SimpleNamespace(value=width, at_least=least, intervals=ends)
    part = SimpleNamespace(condition="cup")

    class Found(dict[str, Any]):
        pass

    found: Any = Found(lateral_load=load, end_play=nothing, width=spall)
    found.strangeness, found.part = strangeness, part
    return found


def test_a_row_counts_numbers_their_error_and_what_holds() -> None:
    truth = {
        "width": np.array([5e-3, 10e-3, 25e-3]),
        "lateral_load": np.array([5.5e3, 5.0e3, 9.0e3]),
        "end_play": np.full(3, 1e-4),
    }
    runs = Described(np.zeros((3, 1)), truth, np.arange(3), np.array(["cup", "cone", "cup"]))
    found = [
        estimates(0.5, 5.5e-3, np.nan, 1e-3),
        estimates(0.5, 8e-3, np.nan, 1e-3),
        estimates(2.0, np.nan, 30e-3, 0.0),
    ]
    row = boxes.row_of("here", runs, found, np.ones(3, bool))
    assert row == (
        "| here | 3 | 1 | 2 | 3 of 3, 0.5 kN, 2 | 0 of 3 | 2 of 3, 15 %, 1 | 1 of 3, 0 | 2 of 2 |\n"
    )
