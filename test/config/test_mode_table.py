"""The text file of the modes of a box: what is written is read again, and every mistake is told at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.base.errors import InputError
from beardyn_core.config import load_bearing
from beardyn_core.structure.cup import Cup
from beardyn_core.structure.modes import Modes
from beardyn_core.structure.table import SERIES, modes_of_text, read_table, table_text

HEAD = """\
# name: mine
# bearing: HS130x230
# cup_mm: {outer_diameter: 230, width: 160, raceway_diameter: 200, row_spacing: 80}
# mass_kg: 61.5
# inertia_kg_m2: [1.1, 2.2, 3.3]
# seats_mm:
#   top: [0, 0, 170]
"""


def drawn(seed: int, count: int = 5) -> Modes:
    random = np.random.default_rng(seed)
    return Modes(
        "drawn",
        "by chance",
        np.sort(random.uniform(500.0, 30e3, count)),
        random.uniform(0.0, 0.1, count),
        random.normal(size=(count, 2, 3, len(SERIES))),
        {"top": random.normal(size=(count, 3)), "spring": random.normal(size=(count, 3))},
        {"top": (0.0, 0.0, 0.17), "spring": (-0.21, 0.0, 0.03)},
        61.5,
        (0.01, 0.0, -0.002),
        (1.1, 2.2, 3.3),
        3,
        Cup("HS130x230", 0.23, 0.16, 0.2, 0.08),
    )


@pytest.mark.parametrize("seed", range(3))
def test_what_is_written_is_read_again(seed: int, tmp_path: Path) -> None:
    modes = drawn(seed)
    path = tmp_path / "modes.csv"
    path.write_text(table_text(modes))
    again = read_table(path)
    assert again.frequency == pytest.approx(modes.frequency, rel=5e-5)  # five digits
    assert again.reads == pytest.approx(modes.reads, rel=5e-5, abs=5e-5)
    for kept in ("name", "places", "mass", "centre", "inertia", "free_count", "cup"):
        assert getattr(again, kept) == getattr(modes, kept), kept
    assert table_text(again) == path.read_text()


def test_a_short_table_of_ones_own_needs_no_column_that_is_zero() -> None:
    text = HEAD + (
        "frequency_Hz,damping_ratio,inboard_radial_cos2,outboard_radial_cos2,top_x,top_y,top_z\n"
        "2100,0.02,0.15,0.15,0,0,0.1\n"
        "1300,0.03,0.1,0.1,0,0,0.2\n"
    )
    modes = modes_of_text(text, "mine.csv")
    assert modes.frequency.tolist() == [1300.0, 2100.0]  # in order
    assert modes.raceway[0, :, 0, 2].tolist() == [0.1, 0.1]
    assert np.count_nonzero(modes.raceway) == 4
    assert modes.seats["top"][0].tolist() == [0.0, 0.0, 0.2]
    assert modes.free_count == 2


def test_every_mistake_is_told_at_once() -> None:
    text = HEAD.replace("# mass_kg: 61.5\n", "# mass: 61.5\n") + (
        "frequency_Hz,damping_ratio,inboard_radial_cos9,top_x,top_z\n0,0.02,0,0,0\n1200,2,0,0\n1300,0.1,0,x,inf\n"
    )
    with pytest.raises(InputError) as found:
        modes_of_text(text, "mine.csv")
    told = "\n".join(found.value.problems)
    for words in (
        "mine.csv: the head lacks mass_kg",
        "mine.csv: the head has 'mass'; allowed are",
        "line 9: frequency_Hz is 0; rigid motion is no mode",
        "line 10 has 4 numbers; there are 5 columns",
        "line 11, top_x: 'x' is no number",
        "line 11, top_z: inf is not finite",
        "the column top_y is missing",
        "the column 'inboard_radial_cos9' is unknown",
    ):
        assert words in told


def test_a_table_of_an_earlier_version_is_told_what_to_add() -> None:
    lines = [line for line in HEAD.splitlines() if not line.startswith(("# bearing", "# cup_mm"))]
    with pytest.raises(InputError) as found:
        modes_of_text(
            "\n".join([*lines, "frequency_Hz,damping_ratio,top_x,top_y,top_z", "1200,0.02,0,0,1"]), "old.csv"
        )
    bearing, cup = found.value.problems
    added = [each.split("`")[-2] for each in (bearing, cup)]
    assert "make the table again with `beardyn structure`" in bearing
    assert "make the table again with `beardyn structure`" in cup
    modes = modes_of_text(
        "\n".join([*added, *lines, "frequency_Hz,damping_ratio,top_x,top_y,top_z", "1200,0.02,0,0,1"]),
        "new.csv",
    )
    assert not list(modes.cup.differences(load_bearing("HS130x230")))


@given(st.text(max_size=200), st.booleans())
@settings(max_examples=100, deadline=None)
def test_any_text_is_modes_or_a_sentence(text: str, after_a_head: bool) -> None:
    problems: list[str] = []
    try:
        modes_of_text(HEAD + text if after_a_head else text, "any.csv")
    except InputError as error:
        problems = error.problems
    assert all(problem.startswith("any.csv: ") for problem in problems)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (HEAD.encode() + b"frequency_Hz;damping_ratio\n1,5;0,02\n", "separated by semicolons"),
        (b"PK\x03\x04\xff\xfe", "is not UTF-8 text"),
    ],
)
def test_a_table_of_another_kind_is_one_sentence(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "box.csv"
    path.write_bytes(content)
    with pytest.raises(InputError) as found:
        read_table(path)
    (problem,) = found.value.problems
    assert words in problem
