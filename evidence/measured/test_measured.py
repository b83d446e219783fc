"""The harness reads the public formats, counts what monitors say, and its page tells it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat
from scipy.signal import lfilter

from beardyn_core.base.arrays import Float
from beardyn_core.config import load_plate
from beardyn_core.monitor.chain import REFERENCE
from beardyn_core.study.monitored_recording import Finding, conclude
from evidence.measured.cases import (
    CWRU_12_DRIVE,
    CWRU_12_FAN,
    CWRU_SOUND,
    DRIVE,
    FAN,
    G,
    cwru_known,
    listenings,
    records,
)
from evidence.measured.grades import GRADES, MEANINGS
from evidence.measured.page import main, receive, text
from evidence.measured.run import Measurement, verdicts_of

RPM = 1797


def struck(order: float, rate: float, turns: float, seconds: float, seed: int = 1) -> Float:
    """Strikes of a spall through a resonance of 3 kHz in noise, [g]; no strikes at order 0."""
    random = np.random.default_rng(seed)
    count = int(seconds * rate)
    signal = random.normal(0.0, 0.1, count)
    if order:
        at = np.arange(0.0, seconds, 1.0 / (order * turns))
        at = at + random.normal(0.0, 0.005 / (order * turns), len(at))
        strikes = np.zeros(count)
        strikes[np.clip((at * rate).astype(int), 0, count - 1)] = 1.0
        pole = np.exp(-600.0 / rate) * np.exp(2j * np.pi * 3000.0 / rate)
        signal += lfilter([1.0], [1.0, -2.0 * pole.real, abs(pole) ** 2], strikes)
    return signal


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Files as those of the two public sets: a spalled cup, a healthy machine, a spalled cone."""
    cwru, mfpt = tmp_path_factory.mktemp("cwru"), tmp_path_factory.mktemp("mfpt")
    turns = RPM / 60.0
    (cwru / "OR").mkdir()
    bpfo = load_plate("6205").frequencies.bpfo
    faulty = {"DE": struck(bpfo, 12e3, turns, 4.1), "FE": struck(0.0, 12e3, turns, 4.1, 2)}
    sound = {end: struck(0.0, 48e3, turns, 2.1, seed) for end, seed in (("DE", 3), ("FE", 4))}
    for name, number, signals in (("OR/130@6_0.mat", 130, faulty), ("97_Normal_0.mat", 97, sound)):
        arrays = {f"X{number:03}_{end}_time": signal[:, None] for end, signal in signals.items()}
        savemat(cwru / name, {**arrays, f"X{number:03}RPM": RPM})
    signal = struck(load_plate("NICE").frequencies.bpfi, 48_828.0, 25.0, 3.0, 5)[:, None]
    savemat(
        mfpt / "InnerRaceFault_vload_1.mat",
        {"bearing": {"sr": 48_828, "gs": signal, "load": 0, "rate": 25}},
    )
    return cwru, mfpt


def test_every_record_is_in_one_set_and_grades_are_of_known_records() -> None:
    known = cwru_known()
    assert len(known) == 60 + 45 + 52 + 4
    assert set(GRADES.values()) <= set(MEANINGS)
    assert {known[number][0] for number in GRADES} == {CWRU_12_DRIVE}
    assert len(GRADES) == 60


def test_records_are_read_with_bearing_speed_and_unit(folders: tuple[Path, Path]) -> None:
    found = {each.name: each for each in records(*folders)}
    assert set(found) == {"130", "97", "InnerRaceFault_vload_1"}
    faulty, sound = listenings(found["130"])
    assert (faulty.end, faulty.part, sound.end, sound.part) == (DRIVE, "cup", FAN, "")
    assert (faulty.plate.name, sound.plate.name) == ("6205", "6203")
    assert (faulty.rate, faulty.shaft_frequency) == (12e3, RPM / 60.0)
    assert found["130"].grade == "Y1"
    bpfo = load_plate("6205").frequencies.bpfo
    assert faulty.acceleration == pytest.approx(G * struck(bpfo, 12e3, RPM / 60.0, 4.1))
    assert found["97"].group == CWRU_SOUND
    (nice,) = listenings(found["InnerRaceFault_vload_1"])
    assert (nice.plate.name, nice.part, nice.rate, nice.shaft_frequency) == ("NICE", "cone", 48_828.0, 25.0)


def test_the_page_tells_what_every_method_says(
    folders: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept, page = tmp_path / "kept.json", tmp_path / "page.md"
    arguments = [
        "--cwru",
        str(folders[0]),
        "--mfpt",
        str(folders[1]),
        "--results",
        str(kept),
        "-o",
        str(page),
    ]
    assert main(arguments) == 0
    written = page.read_text(encoding="utf-8")
    assert "| CWRU 130 | cup 7 at 6 | 0 | Y1 | cup 4/4 | cup 4/4 | cup 4/4 | healthy 4/4 |" in written
    assert "| CWRU 97 | healthy | 0 |  | healthy 2/2, healthy 2/2 |" in written
    assert "| CWRU 12 kHz, drive end | cup | 1/0/0 | 24/1/3 | 1/0/0 | 1/0/0 |" in written
    assert "this page had 3 of them" in written
    assert f"59 of {CWRU_12_DRIVE}, 45 of {CWRU_12_FAN}" in written
    before = page.read_bytes()

    def received_twice(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr("evidence.measured.page.verdicts_of", received_twice)
    assert main(arguments) == 0
    assert page.read_bytes() == before


def test_a_part_that_is_called_in_place_of_the_faulty_one_is_wrong(folders: tuple[Path, Path]) -> None:
    record = records(folders[0])[0]
    said = {"healthy": 2, "cup": 3, "waiting": 9}
    right, wrong, missed = (
        Measurement(record, DRIVE, part, "ours", counts)
        for part, counts in (("cup", said), ("cone", said), ("cup", {"healthy": 3, "cup": 2}))
    )
    assert (right.outcome, wrong.outcome, missed.outcome) == ("right", "wrong", "missed")
    assert (right.analyses, right.alarms, right.verdict) == (5, 3, "cup")
    # of two the later, as the product does
    assert Measurement(record, DRIVE, "cup", "ours", {"healthy": 1, "cup": 1}).verdict == "cup"
    for order in (("healthy", "cup"), ("cup", "healthy")):
        assert conclude(Finding(name, "", float(at)) for at, name in enumerate(order)).verdict == order[1]


def test_the_page_in_the_repository_is_of_this_form() -> None:
    """Its numbers are those of files which are not here."""
    page = (Path(__file__).parents[2] / "docs" / "evidence" / "monitor_measured.md").read_text(
        encoding="utf-8"
    )
    frame = text([], "nothing")
    for heading in (line for line in frame.splitlines() if line.startswith("#")):
        assert heading in page


def test_the_monitor_names_the_part_that_is_struck_and_leaves_the_other_end_alone(
    folders: tuple[Path, Path],
) -> None:
    received = receive([record for record in records(*folders) if record.name == "130"], None)
    said = {(each.end, each.method): each.verdict for each in received}
    assert said[DRIVE, "ours"] == "cup"
    assert said[FAN, "ours"] == "healthy"
    faulty = next(iter(listenings(received[0].record)))
    assert verdicts_of(faulty, REFERENCE) == {"cup": 4}
