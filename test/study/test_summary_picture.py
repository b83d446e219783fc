"""The summary picture is drawn without a screen, at its size, and shows what it is given."""

import dataclasses

import matplotlib.image
import numpy as np
import pytest
from matplotlib.figure import Figure

from beardyn_core.study.summary_picture import SummaryData, _draw_forces, _draw_spectrum, summary_picture


def _data():
    time = np.linspace(0.0, 3.0, 1200)
    load = np.column_stack([0 * time, 5e3 + 0 * time, 68e3 + 5e3 * np.sin(8 * time)])
    azimuth = np.mod(2 * np.pi * np.arange(17) / 17 + np.array([[0.1], [0.3]]), 2 * np.pi)
    order = np.linspace(0.0, 200.0, 20_000)
    amplitude = np.full_like(order, 0.05)
    for h in range(1, 6):
        amplitude += 2.0 / h * np.exp(-(((order - h * 7.294) / 0.03) ** 2))
    return SummaryData(
        title="cup_spall",
        verdict="cup fault: BPFO found at 140.02 Hz, 140.04 Hz from bearing data (-0.01 %), 24.1 dB",
        time=time,
        force=load + np.random.default_rng(1).normal(size=load.shape) * 300,
        load=load,
        shaft_speed=120 + 4 * time,
        cage_speed=np.column_stack([0.429 * (120 + 4 * time), 0.428 * (120 + 4 * time)]),
        roller_azimuth=azimuth,
        roller_load=9.8e3 * np.maximum(0.0, np.cos(azimuth)) ** (10 / 9),
        envelope_order=order,
        envelope_amplitude=amplitude,
        markers={"BPFO": 7.294, "BPFI": 9.706, "2 BSF": 6.789, "FTF": 0.429},
        shaft_frequency=20.0,
    )


def _picture(data, path):
    summary_picture(data, path)
    return matplotlib.image.imread(path)


@pytest.fixture(scope="module")
def usual(tmp_path_factory):
    return _picture(_data(), tmp_path_factory.mktemp("usual") / "summary.png")


@pytest.mark.slow
def test_picture_is_1600_by_1000_and_changes_with_every_array(tmp_path, usual):
    data, picture = _data(), usual
    assert picture.shape[:2] == (1000, 1600)
    assert picture[..., :3].std() > 0.05
    for name in ("force", "load", "shaft_speed", "cage_speed", "roller_load", "envelope_amplitude"):
        other = dataclasses.replace(data, **{name: 0.5 * getattr(data, name)})
        assert not np.array_equal(_picture(other, tmp_path / "other.png"), picture), name


def _axes(function, data, **kind):
    axes = Figure().add_subplot(**kind)
    function(axes, data)
    return axes


def test_every_marked_line_is_labelled_up_to_the_end_of_the_axis():
    data = _data()
    axes = _axes(_draw_spectrum, data)
    highest = axes.get_xlim()[1]
    for name in data.markers:
        labels = [text for text in axes.texts if text.get_text().strip() == name]
        assert len(labels) == 1, name
    lines = [float(line.get_xdata()[0]) for line in axes.get_lines()[1:]]
    named = [text.get_position()[0] for text in axes.texts]
    assert sorted(named) == sorted(lines)
    five = [place for place in named if place == pytest.approx(5 * data.markers["BPFO"])]
    assert five == [pytest.approx(36.47)]
    assert max(lines) <= highest


def test_the_legend_has_the_colours_and_styles_of_the_curves():
    axes = _axes(_draw_forces, _data())
    entries = dict(
        zip(
            (text.get_text() for text in axes.get_legend().get_texts()),
            axes.get_legend().legend_handles,
            strict=True,
        )
    )
    curves = axes.get_lines()
    assert len(entries) == len(curves) == 6
    for curve in curves:
        entry = entries[curve.get_label()]
        assert (entry.get_color(), entry.get_linestyle()) == (curve.get_color(), curve.get_linestyle())


def test_no_row_hides_the_other(tmp_path, usual):
    """The load of either row alone changes the picture, where the other row has the same loads."""
    for row in range(2):
        load = _data().roller_load.copy()
        load[1 - row] = load[row]
        azimuth = np.tile(_data().roller_azimuth[row], (2, 1))
        both = dataclasses.replace(_data(), roller_load=load, roller_azimuth=azimuth)
        less = load.copy()
        less[row] *= 0.6
        changed = dataclasses.replace(both, roller_load=less)
        one, other = _picture(both, tmp_path / "both.png"), _picture(changed, tmp_path / "less.png")
        half = one.shape[0] // 2
        part = slice(0, half) if row == 0 else slice(half, None)
        rest = slice(half, None) if row == 0 else slice(0, half)
        right = slice(1100, None)
        assert not np.array_equal(one[part, right], other[part, right])
        np.testing.assert_array_equal(one[rest, right], other[rest, right])


@pytest.mark.parametrize("moments", [1, 40])
def test_load_zone_takes_one_moment_or_many(tmp_path, moments, usual):
    data = _data()
    many = dataclasses.replace(
        data,
        roller_azimuth=np.repeat(data.roller_azimuth[None], moments, axis=0),
        roller_load=np.repeat(data.roller_load[None], moments, axis=0),
    )
    picture = _picture(many, tmp_path / "many.png")
    assert np.array_equal(picture, usual) == (moments == 1)


def test_run_too_short_for_a_spectrum_is_still_drawn(tmp_path):
    data = dataclasses.replace(
        _data(),
        envelope_order=np.empty(0),
        envelope_amplitude=np.empty(0),
        shaft_frequency=0.0,
        verdict="waiting",
    )
    assert _picture(data, tmp_path / "short.png").shape[:2] == (1000, 1600)
