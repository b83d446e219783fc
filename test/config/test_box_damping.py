"""Damping of a box: one number or a table over the frequency, mistakes, and the tables of shipped boxes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.config.folders import find, shipped_names
from beardyn_core.config.nouns import load_box, read_noun
from beardyn_core.config.yaml_text import read_file
from beardyn_core.structure.box import Box
from beardyn_core.structure.damping import DampingTable, damping_ratios
from beardyn_core.structure.mounted_box import table_path
from beardyn_core.structure.table import read_table

TABLE = {"frequency_Hz": [1000.0, 6000.0], "ratio": [0.02, 0.0125]}
BOXES = shipped_names("structures")


def box_with(damping: Any) -> Box:
    data = {**read_file(find("structures", "high_speed")), "damping_ratio": damping}
    box = read_noun(Box, data, "box.yaml")
    assert isinstance(box, Box)
    return box


def test_one_number_is_the_ratio_of_every_mode() -> None:
    assert damping_ratios(box_with(0.03).damping_ratio, np.array([10.0, 1e4])).tolist() == [0.03, 0.03]


def test_a_table_is_linear_in_the_logarithm_and_constant_beyond_its_ends() -> None:
    damping = box_with(TABLE).damping_ratio
    middle = np.sqrt(1000.0 * 6000.0)
    found = damping_ratios(damping, np.array([100.0, 1000.0, middle, 6000.0, 40_000.0]))
    assert found == pytest.approx([0.02, 0.02, 0.01625, 0.0125, 0.0125], rel=1e-12)


@pytest.mark.parametrize("form", [TABLE, {"value": TABLE, "source": "ring-down"}])
def test_a_table_may_say_where_it_comes_from_and_is_written_as_it_is_read(form: dict[str, Any]) -> None:
    box = box_with(form)
    assert box.damping_ratio == DampingTable((1000.0, 6000.0), (0.02, 0.0125))
    assert dict(box.sources).get("damping_ratio") == form.get("source")
    assert write_noun(box)["damping_ratio"] == TABLE


@pytest.mark.parametrize(
    ("damping", "sentence"),
    [
        ("2 %", "damping_ratio is '2 %'; it must be a number or a mapping of keys to values"),
        (0.5, "damping_ratio is 0.5; it must be at most 0.2"),
        ({**TABLE, "ratio": [0.02, 0.3]}, r"damping_ratio.ratio[1] is 0.3; it must be at most 0.2"),
        ({**TABLE, "ratio": [0.02]}, "damping_ratio.ratio is [0.02]; it must have at least 2 entries"),
        ({**TABLE, "ratio": [0.02, 0.01, 0.01]}, "frequency_Hz has 2 entries and ratio 3"),
        ({**TABLE, "frequency_Hz": [6000, 1000]}, "frequency_Hz is [6000.0, 1000.0]; it must rise"),
        ({"frequency": [1000], "ratio": [0.02, 0.01]}, "give `frequency_Hz`, a number in hertz"),
        ({"ratio": [0.02, 0.01]}, "damping_ratio.frequency_Hz is missing"),
    ],
)
def test_a_damping_that_cannot_be_is_refused_with_its_key(damping: Any, sentence: str) -> None:
    with pytest.raises(InputError) as refused:
        box_with(damping)
    assert len(refused.value.problems) == 1
    assert refused.value.problems[0].startswith("box.yaml: ")
    assert sentence in refused.value.problems[0]


@pytest.mark.parametrize("name", BOXES)
def test_the_damping_in_a_shipped_table_is_that_of_its_description(name: str) -> None:
    box, modes = load_box(Path(find("structures", name))), read_table(table_path(name))
    assert isinstance(box, Box)
    expected = damping_ratios(box.damping_ratio, modes.frequency)
    assert modes.damping_ratio == pytest.approx(expected, rel=1e-4)  # the table has five digits
