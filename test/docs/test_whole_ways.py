"""The ways in CONTRIBUTING are whole: each file holds what its row names, no other one knows the example."""

from __future__ import annotations

import ast
import re
import sys
from functools import cache
from pathlib import Path
from types import FrameType

import numpy as np
import pytest

from beardyn_core.api.simulating import simulate
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain import Band, MonitorSettings, Stretch, algorithm_named, answer_of

ROOT = Path(__file__).parents[2]
ROW = re.compile(r"^\| `([^`]+)` \| (.+) \|$", re.MULTILINE)
WAYS = ("effect", "contact", "quantity of the sensors", "kind of bearing", "tier", "step of the monitor")


def section(way: str) -> str:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    return text.split(f"\n### A new {way}\n")[1].split("\n### ")[0].split("\n## ")[0]


def rows(way: str) -> dict[str, list[str]]:
    """File -> names that its row says it holds."""
    return {file: re.findall(r"`(\w+)`", words) for file, words in ROW.findall(section(way))}


@cache
def known(file: Path) -> tuple[frozenset[str], frozenset[str]]:
    """Names and whole strings of a file; words in comments and docstrings do not count."""
    names: set[str] = set()
    strings: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        for field in ("id", "attr", "arg"):
            names |= {getattr(node, field, None) or ""}
        if isinstance(node, (ast.FunctionDef, ast.ClassDef, ast.alias)):
            names |= {node.name.rpartition(".")[2]}
        if isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module.rpartition(".")[2]}
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            strings |= {node.value}
    return frozenset(names), frozenset(strings)


def sources(words: set[str], *packages: str) -> dict[str, Path]:
    """Files in which one of the words stands, be it in a comment."""
    found = (path for package in packages for path in (ROOT / package).rglob("*.py"))
    return {
        path.relative_to(ROOT).as_posix(): path
        for path in found
        if any(word in path.read_text(encoding="utf-8").lower().replace("_", "") for word in words)
    }


def knowing(word: str, *packages: str) -> set[str]:
    """Files in whose names or strings a word occurs, in any spelling of it."""
    plain = word.replace("_", "")
    return {
        file
        for file, path in sources({plain}, *packages).items()
        if any(plain in name.lower().replace("_", "") for name in known(path)[0]) or word in known(path)[1]
    }


@pytest.mark.parametrize("way", WAYS)
def test_each_file_of_a_way_holds_what_its_row_names(way: str) -> None:
    assert rows(way)
    for file, wanted in rows(way).items():
        assert wanted, file
        names, strings = known(ROOT / file)
        assert set(wanted) <= names | strings, file


def test_an_effect_is_one_new_file_and_at_most_three_edits() -> None:
    files = list(rows("effect"))
    assert knowing("windage", "beardyn_core", "beardyn_ros") == set(files)
    assert len(files) - 1 <= 3
    assert files[0] == "beardyn_core/effects/windage.py"


def test_a_contact_is_known_to_the_files_of_its_way_alone() -> None:
    assert knowing("small_rib", "beardyn_core", "beardyn_ros") == set(rows("contact"))


def test_a_quantity_is_known_to_the_files_of_its_way_alone() -> None:
    """Of recording and nodes, where the topic is a string; the block has a field."""
    found = {
        file
        for file, path in sources({"temperature"}, "beardyn_core/record", "beardyn_ros").items()
        if "temperature" in known(path)[1]
    }
    assert found == {file for file in rows("quantity of the sensors") if "/sensors/" not in file}


def test_so_many_files_read_the_geometry_of_tapered_rollers_as_the_way_says() -> None:
    angles = {"cup_angle", "cone_angle", "half_angle", "cup_slant", "cone_slant", "slant"}
    found = sources({"angle", "slant"}, "beardyn_core", "beardyn_ros")
    reading = {file for file, path in found.items() if known(path)[0] & angles}
    told = re.search(r"(\d+) files read the cone angles", section("kind of bearing"))
    assert told is not None
    assert len(reading) == int(told[1])
    assert set(rows("kind of bearing")) <= reading


def test_a_tier_is_named_in_the_files_of_its_way_alone() -> None:
    found = {
        file
        for file, path in sources({"lumped", "quasistatic"}, "beardyn_core", "beardyn_ros").items()
        if {"lumped", "quasistatic"} & known(path)[1]
    }
    assert found == set(rows("tier"))
    told = re.search(r"(\d+) that name the tiers", section("tier"))
    assert told is not None
    assert int(told[1]) == len(found)


def test_a_step_of_ones_own_runs_by_name_without_an_edit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The band that the step answers is that of the result."""
    words = "from beardyn_core.monitor.chain import Band, Chain\n\n\n"
    words += "def own_band(stretch, settings):\n    return Band(3000.0, 5000.0)\n\n\n"
    words += "chain = Chain(select_band=own_band)\n"
    (tmp_path / "own_step_of_the_ways.py").write_text(words, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    chain = algorithm_named("own_step_of_the_ways:chain")
    assert chain.select_band is sys.modules["own_step_of_the_ways"].own_band  # type: ignore[attr-defined]
    rate, seconds, speed = 25600.0, 3.0, 20.0
    time = np.arange(int(rate * seconds)) / rate
    noise = np.random.default_rng(1).normal(size=(len(time), 3))
    stretch = Stretch(rate, noise, 2.0 * np.pi * speed * time, 8e4, 0)
    result = answer_of(chain, stretch, FaultFrequencies(0.43, 8.6, 11.4, 3.3), 20, MonitorSettings())
    assert result.band == (3000.0, 5000.0)
    assert result.revolutions == pytest.approx(speed * seconds, rel=1e-3)
    assert Band(3000.0, 5000.0).low == result.band[0]


def calls_of_a_run(folder: Path) -> list[tuple[str, str]]:
    """Functions of the core in the order of their calls in a recorded run of 0.1 s, each with its file."""
    core = ROOT / "beardyn_core"
    found = []

    def note(frame: FrameType, event: str, _argument: object) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(str(core)):
            found.append((frame.f_code.co_qualname, frame.f_code.co_filename.removeprefix(f"{core}/")))

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        simulate("cup_spall", tier="lumped", duration=0.1, record=folder / "run.mcap")
    finally:
        sys.setprofile(before)
    return found


def test_a_load_sample_goes_the_way_that_the_page_tells(tmp_path: Path) -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").split("### The way of a load sample")[1]
    way = re.findall(r"^\| `([^`]+)` \| `([^`]+)` \|", text.split("\n## ")[0], re.MULTILINE)
    assert len(way) > 10
    calls = iter(calls_of_a_run(tmp_path))
    for step in way:
        assert step in calls, f"{step} is not called after those before it"
