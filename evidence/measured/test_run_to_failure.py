"""The page of runs to failure is made of any folder of the same form."""

import numpy as np
import pytest

from evidence.measured import run_to_failure


def _record(path, loud, separator):
    random = np.random.default_rng(int(path.stem[4:]))
    rows = np.column_stack([np.tile([9, 39, 39, 65664.0], (2560, 1)), loud * random.normal(size=(2560, 2))])
    np.savetxt(path, rows, delimiter=separator, fmt="%.3f")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("Learning_set") / "Bearing1_1"
    folder.mkdir()
    for number in range(1, 71):
        _record(folder / f"acc_{number:05d}.csv", 4.0 if number > 60 else 1.0, ";" if number % 2 else ",")
    return run_to_failure.levels_of_run(folder, folder / "kept")


def test_both_separators_are_read_and_the_levels_are_kept(run):
    assert run.bands.shape == (70, 2, 5)
    assert np.median(run.rms[:60]) == pytest.approx(20 * np.log10(9.80665), abs=0.3)
    assert np.median(run.rms[60:]) - np.median(run.rms[:60]) == pytest.approx(12.0, abs=0.3)


def test_trend_and_rms_alarm_at_the_change_and_stay(run):
    for judged in (run_to_failure.by_trend(run), run_to_failure.by_rms(run)):
        assert judged.first is not None
        assert judged.first == judged.stays
        assert 60 <= judged.first <= 63


def test_an_alarm_that_ends_does_not_stay():
    judged = run_to_failure.Judged.of([False, True, False, True, True])
    assert (judged.first, judged.stays) == (1, 3)
    assert run_to_failure.Judged.of([True, False]).stays is None


def test_added_energy_stands_still_jumps_with_the_change_and_tells_how_steadily_it_grows(run):
    added = run_to_failure.added_energy(run)
    assert added.shape == (70,)
    assert np.abs(added[:60]).max() < 1.0  # of steady noise, which scatters
    assert added[-1] == pytest.approx(12.0, abs=0.5)  # four times as loud
    bands = np.zeros((100, 2, 5))
    bands[50:] += np.arange(50)[:, None, None]
    rises = run_to_failure.grown(run_to_failure.Levels(bands, bands[..., 0]), 60)
    assert (rises.quarter, rises.tenth, rises.alarmed) == pytest.approx((1.0, 1.0, 1.0))
    assert rises.fall == 0.0
    bands[90:] -= 20.0 * np.arange(10)[:, None, None] / 10.0
    falls = run_to_failure.grown(run_to_failure.Levels(bands, bands[..., 0]), 95)
    assert falls.tenth < 0.0 < falls.fall
    assert np.isnan(falls.alarmed)  # too few records of it


def test_the_page_is_in_the_documentation():
    text = run_to_failure.PAGE.read_text(encoding="utf-8")
    assert text.count("| Bearing") == 2 * 17
    assert "in alarm at the end of 17 of 17 runs" in text
    assert "in the last quarter of 6 of 17 runs, in the last tenth of 11" in text
