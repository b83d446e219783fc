"""The examples run as they stand, shorter, and show what their pages say."""

from __future__ import annotations

import json
import random
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "docs" / "examples"
MOST_LINES = 15
PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
SHORT_BLOCKS = [
    text for text in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL) if not text.startswith("# ")
]


def run_text(text: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Run a program in a folder of its own, without a window; its names."""
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.chdir(folder)
    names: dict[str, Any] = {}
    exec(compile(text, "example", "exec"), names)
    return names


def changed(text: str, before: str, after: str) -> str:
    assert text.count(before) == 1, before
    return text.replace(before, after)


def test_the_readme_begins_with_six_lines_that_simulate_and_plot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    found = re.search(r"```(\w+)\n(.*?)```", readme, re.DOTALL)
    assert found is not None
    assert found[1] == "python", "the first block of the README is the example"
    assert len(found[2].splitlines()) == 6
    names = run_text(changed(found[2], "duration=2.0", "duration=0.6"), tmp_path, monkeypatch)
    axes = names["plt"].gca()
    assert {"BPFO", "2×BPFO"} <= {each.get_text() for each in axes.texts}
    order, level = max((each.get_data() for each in axes.get_lines()), key=lambda each: len(each[0]))
    near = np.abs(order - names["run"].truth["fault_frequencies_per_rev"]["BPFO"]) < 0.5
    assert level[near].max() > 10.0
    names["plt"].close("all")


def test_the_class_k_bearing_shows_its_spalls_in_the_envelope_spectrum(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (EXAMPLES / "class_k.py").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= MOST_LINES
    text = changed(text, "duration=4.0", "duration=1.0")
    names = run_text(text, tmp_path, monkeypatch)
    names["plt"].close("all")
    assert (tmp_path / "class_k.png").stat().st_size > 5_000
    hertz, spectrum, truth = names["hertz"], names["spectrum"], names["run"].truth
    assert truth["bearing"] == "AARK_6.5x9"
    background = np.median(spectrum[(hertz > 20) & (hertz < 400)])

    def level(line: float) -> float:
        return float(20 * np.log10(spectrum[np.abs(hertz - line) <= 1.5].max() / background))

    lines, shaft = truth["fault_frequencies_Hz"], truth["speed"]["rpm"]["mean"] / 60.0
    assert level(lines["BPFO"]) > 30.0
    assert level(lines["BPFI"]) > 15.0
    assert level(lines["BPFI"] - shaft) > 15.0  # the spall of the cone passes through the load zone
    strongest = hertz[5:][spectrum[5:].argmax()]
    assert abs(strongest - lines["BPFO"]) <= 1.5


def test_the_data_set_has_a_row_of_labels_for_each_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pandas = pytest.importorskip("pandas")
    text = (EXAMPLES / "data_set.py").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= MOST_LINES
    random.seed(13)  # draws faults of the cup alone, whose kernels other tests have compiled
    run_text(changed(text, "= 50, 2.0, []", "= 5, 0.1, []"), tmp_path, monkeypatch)
    table = pandas.read_csv(tmp_path / "labels.csv")
    assert len(table) == 5
    assert list(table["seed"]) == [0, 1, 2, 3, 4]
    assert list(table["condition"] == "healthy") == [True, False, False, False, True]
    assert table["fault_width_m"].notna().sum() == 3
    assert table["speed_kmh_mean"].between(80, 200).all()
    for column in ("rms", "load_fz_N_mean", "fault_frequencies_Hz_BPFO", "geometry_roller_count"):
        assert table[column].notna().all(), column
    with np.load(tmp_path / "run_03.npz") as arrays:
        assert arrays["vibration.values"].shape[1] == 3
        truth = json.loads(str(arrays["truth"]))
    assert truth["faults"][0]["width"] == table["fault_width_m"][3]


def test_the_strikes_of_a_wheel_flat_show_in_the_loads_of_the_rollers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (EXAMPLES / "wheel_flat.py").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= MOST_LINES
    names = run_text(changed(text, "duration=2.0", "duration=1.0"), tmp_path, monkeypatch)
    names["plt"].close("all")
    assert (tmp_path / "wheel_flat.png").stat().st_size > 5_000
    assert re.search(r"most loaded roller: [\d.]+ kN, at the strikes [\d.]+ kN", capsys.readouterr().out)
    # in a box with modes 1.17 in `quasistatic`, 1.18 in `full`; 1.4 in a rigid one
    assert 1.1 * names["usual"] < names["strike"] < 1.4 * names["usual"]


def test_the_page_shows_the_examples_as_they_run() -> None:
    for name in ("class_k", "data_set"):
        text = (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")
        assert f"```python\n{text}```" in PAGE, name


def test_the_page_names_all_that_there_is() -> None:
    for name in bd.__all__:
        assert f"`bd.{name}" in PAGE, name
    for signal in bd.Run.__dict__:
        if not signal.startswith("_"):
            assert re.search(rf"\b{signal}\b", PAGE), signal


@pytest.mark.parametrize("number", range(len(SHORT_BLOCKS)))
def test_the_short_blocks_of_the_page_run(
    number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("xarray", "pandas", "pyarrow"):
        pytest.importorskip(name)
    text = SHORT_BLOCKS[number].replace("duration=2.0", "duration=0.2")
    header = "import beardyn_core as bd\n"
    if re.search(r"\brun\b", text) and "run =" not in text:
        seconds = 0.6 if "envelope" in text else 0.2
        header += f"run = bd.simulate('cup_spall', tier='quasistatic', duration={seconds})\n"
    run_text(header + text, tmp_path, monkeypatch)
