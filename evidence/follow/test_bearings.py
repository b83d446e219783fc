"""The table of bearings has what the data cards say, and the page has the table."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from evidence.follow import bearings


def test_a_row_has_errors_in_their_units_and_what_intervals_hold() -> None:
    tests = {
        "lateral_load": {"runs": 90, "error": 4230.0, "coverage": [0.5, 0.92]},
        "width": {"runs": 20, "error": 0.043, "coverage": [0.6, 0.95]},
    }
    card = {
        "condition": {"runs": 100, "named": 0.97, "coverage": [0.97, 0.98]},
        "quantities": {
            "end_play": {"explained": 0.1},
            **{name: {"test": each} for name, each in tests.items()},
        },
    }
    mine: Any = SimpleNamespace(axes=("x", "z"), card=card)
    row = "| `mine` | x, z | 97 %, 98 % of 100 | - | 90: 4.2 kN, 92 % | - | 20: 4 %, 95 % | - |\n"
    assert bearings.row_of("mine", mine) == row


def test_the_page_has_the_section_as_the_command_writes_it() -> None:
    assert bearings.section() in bearings.PAGE.read_text(encoding="utf-8")
