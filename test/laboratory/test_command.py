"""``beardyn contacts``; its run and its page are in `evidence.contacts`."""

import argparse

import pytest

from beardyn_core.cli.contacts import option_problems
from beardyn_core.cli.main import BAD_INPUT, main
from beardyn_core.study.table import Table, digits, duration_text


def test_all_mistakes_are_named_at_once_and_nothing_is_written(tmp_path, capsys) -> None:
    missing = tmp_path / "no" / "folder"
    command = ["contacts", "--bearing", "nonesuch", "-o", str(missing), "--rrd", str(tmp_path)]
    assert main(command) == BAD_INPUT
    said = capsys.readouterr().err
    assert "nonesuch" in said
    assert "--output" in said
    assert "--rrd" in said
    assert not missing.exists()


def test_an_animation_in_the_folder_to_be_made_is_no_mistake(tmp_path) -> None:
    folder = tmp_path / "new"
    assert option_problems(argparse.Namespace(output=folder, rrd=folder / "a.rrd", force=False)) == []
    assert len(option_problems(argparse.Namespace(output=None, rrd=folder / "a.rrd", force=False))) == 1


def test_table_lines_up_and_makes_markdown() -> None:
    table = Table("Title", ("way", "us"), (("fsolve", "173"), ("closed", "0.0043")), ("remark",))
    lines = table.text().splitlines()
    assert lines[2:5] == ["way         us", "fsolve     173", "closed  0.0043"]
    assert table.markdown().splitlines()[:2] == ["| way | us |", "|---|--:|"]


@pytest.mark.parametrize(
    ("value", "text"),
    [(173.2, "173"), (0.00431, "0.00431"), (2.0e-7, "2.00e-07"), (0.0, "0"), (float("nan"), "-")],
)
def test_numbers_have_few_digits(value: float, text: str) -> None:
    assert digits(value) == text


@pytest.mark.parametrize(("hours", "text"), [(24.0, "24.0 h"), (0.12, "7.2 min"), (2.0 / 3600.0, "2.0 s")])
def test_durations_have_a_unit_that_reads(hours: float, text: str) -> None:
    assert duration_text(hours) == text
