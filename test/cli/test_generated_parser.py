"""What the parser of a command takes from the function that it calls."""

from __future__ import annotations

import argparse
import inspect
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import pytest

from beardyn_core.cli.generated_parser import add_command, add_parameter, parameters_of


class Recording:
    """Stands for an object of Python that no command line can give."""


def roll(
    run: Recording | Path | str,
    speed_rpm: float | None = None,
    *,
    turns: int = 3,
    tier: Literal["lumped", "full"] = "full",
    others: Sequence[Recording | Path] = (),
    name: str = "",
    axes: Sequence[str] = ("x", "z"),
    hard: bool = False,
) -> None:
    """Roll a bearing along `train` and ``end_play_mm``.

    Roll it for 5 % of a day, as
    `estimate` does.

    Parameters
    ----------
    run : Recording or Path
        Recording to begin with. Or a run of Python.
    speed_rpm : float, optional
        Of the shaft, e.g. 100 %; default that of the run.
    turns, tier
        YAML or none.
    others : sequence of Recording
        Another one. It may be empty.
    name : str
        ``axle`` of it.
    axes : sequence of str
        Axes that are rolled; default x and z.
    hard : bool
        Roll harder.

    Raises
    ------
    InputError
        Never.
    """


def parser_of(**differences: Any) -> argparse.ArgumentParser:
    """The parser of `roll` with every parameter."""
    subparsers = argparse.ArgumentParser(prog="p").add_subparsers()
    parser = add_command(subparsers, "roll", roll, "Nothing is printed.")
    add_parameter(parser, roll, "run", "recording")
    for name in list(inspect.signature(roll).parameters)[1:]:
        add_parameter(parser, roll, name, **differences.get(name, {}))
    return parser


def helps(parser: argparse.ArgumentParser) -> dict[str, str]:
    """What the help says of each argument."""
    return {each.dest: each.help or "" for each in parser._actions}


def test_purpose_and_description_are_those_of_the_docstring() -> None:
    subparsers = argparse.ArgumentParser(prog="p").add_subparsers()
    parser = add_command(subparsers, "roll", roll, "Nothing is printed.")
    (shown,) = subparsers._choices_actions
    assert shown.help == "roll a bearing along `beardyn train` and end_play_mm"
    assert parser.description == "Roll it for 5 % of a day, as `beardyn estimate` does. Nothing is printed."
    assert "5 % of a day" in parser.format_help()


def test_a_help_is_the_first_sentence_with_the_default() -> None:
    told = helps(parser_of(name={"required": True}))
    assert told["recording"] == "recording to begin with"
    assert told["speed_rpm"] == "of the shaft, e.g. 100 %%; default that of the run"
    assert (told["turns"], told["tier"]) == ("YAML or none; default 3", "YAML or none; default full")
    assert told["others"] == "another one; may be given again; default none"
    assert told["name"] == "axle of it; no default"
    assert told["axes"] == "axes that are rolled; with commas between; default x and z"
    assert told["hard"] == "roll harder"


def test_types_choices_and_defaults_are_those_of_the_signature(capsys: pytest.CaptureFixture[str]) -> None:
    parser = parser_of()
    usual = vars(parser.parse_args(["run.mcap"]))
    assert usual == {
        "recording": Path("run.mcap"), "speed_rpm": None, "turns": 3, "tier": "full", "others": [],
        "name": "", "axes": ("x", "z"), "hard": False,
    }  # fmt: skip
    words = "run.mcap --speed-rpm 60 --turns 2 --others a --others b --axes y,z --hard"
    given = parser.parse_args(words.split())
    assert (given.speed_rpm, given.turns, given.others) == (60.0, 2, [Path("a"), Path("b")])
    assert (given.axes, given.hard) == (["y", "z"], True)
    with pytest.raises(SystemExit):
        parser.parse_args(["run.mcap", "--tier", "planar"])
    assert "choose from" in capsys.readouterr().err


def test_a_command_differs_where_it_says_so() -> None:
    parser = parser_of(
        others={"nargs": "+"},
        turns={"default": 7, "metavar": "COUNT"},
        tier={"usual": "any", "suffix": "; or none"},
    )
    assert parser.parse_args(["run.mcap", "--others", "a", "b"]).others == [Path("a"), Path("b")]
    assert parser.parse_args(["run.mcap"]).turns == 7
    assert helps(parser)["turns"] == "YAML or none; default 7"
    assert helps(parser)["tier"] == "YAML or none; default any; or none"


def test_every_parameter_of_a_function_is_read_with_its_words() -> None:
    found = parameters_of(roll)
    assert list(found) == list(inspect.signature(roll).parameters)
    assert found["run"].words == "Recording to begin with. Or a run of Python."
    assert all(each.words for each in found.values())
