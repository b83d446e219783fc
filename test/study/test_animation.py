"""Moving pictures show rollers and passages where and when they are; files last as long as stated."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.record.load_colours import load_colours
from beardyn_core.record.reading import read_run
from beardyn_core.record.run import Run
from beardyn_core.record.view_title import view_title
from beardyn_core.scene.defect import MissingRoller
from beardyn_core.scene.patch import Patch
from beardyn_core.study.animation import SUBJECTS
from beardyn_core.study.animation.picture_file import (
    GIF_RATE,
    PICTURES,
    SECONDS,
    moving_picture,
    usual_subject,
    write_gif,
)
from beardyn_core.study.animation.row_motion import RowMotion, _continuous
from beardyn_core.study.animation.spall_passages import chosen_window, passages
from test.record.synthetic_run import SHAPE, SyntheticRun, description
from test.recordings import write_recording

BLOCKS = 40  # 0.8 s
SHAFT_HZ = 120.0 / (2.0 * np.pi)
ORDERS = SHAPE.fault_frequencies


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("moving") / "run.mcap", BLOCKS)


@pytest.fixture(scope="module")
def run(recording: Path) -> Run:
    return read_run(recording)


@pytest.fixture(scope="module")
def motion(run: Run) -> RowMotion:
    return RowMotion.of(run, 0)


def with_faults(*faults: Any, blocks: int = BLOCKS) -> Run:
    """The synthetic run under another description."""
    described = replace(description(), defects=faults, sensor_names=("axlebox_top",))
    return Run.of_blocks(SyntheticRun().blocks(blocks), described)


def spall(on: str, azimuth: float = 0.0, row: int = 0) -> Patch:
    return Patch(on, row, azimuth, 0.012, 2e-4, 0.02)


def test_rollers_move_between_snapshots_as_they_roll(motion: RowMotion) -> None:
    cage = 2.0 * np.pi * SHAFT_HZ * ORDERS["FTF"]
    for time in (0.1011, 0.1023, 0.4047):
        moment = motion.at(time)
        expected = 2.0 * np.pi * np.arange(17) / 17 + cage * time
        away = np.mod(moment.azimuth - expected + np.pi, 2.0 * np.pi) - np.pi
        np.testing.assert_allclose(away, 0.0, atol=2e-3)
        assert moment.shaft == pytest.approx(120.0 * time, rel=1e-6)
    assert motion.cage_period(0.3) == pytest.approx(2.0 * np.pi / cage, rel=1e-3)


def test_loads_are_those_of_the_snapshots(run: Run, motion: RowMotion) -> None:
    for number in (20, 21, 77):
        load = run.contacts.load[number, 0, :, run.contacts.of("cup")]
        np.testing.assert_allclose(
            motion.at(float(run.contacts.time[number])).load, load, rtol=1e-6, atol=1e-6
        )


@given(
    st.floats(-4000.0, 4000.0),
    st.floats(-300.0, 300.0),
    st.floats(-np.pi, np.pi),
    st.floats(-20.0, 20.0),
)
def test_an_angle_is_followed_through_several_turns_between_snapshots(
    speed: float, growth: float, begin: float, error: float
) -> None:
    """Half a turn is 628 rad/s over 5 ms: speeds of the snapshots say how many turns there were."""
    time = np.asarray(5e-3 * np.arange(12), np.float64)
    angle = begin + speed * time + 0.5 * growth * time**2
    rate = speed + growth * time + error
    wrapped = np.asarray(np.mod(angle + np.pi, 2.0 * np.pi) - np.pi, np.float64)
    found = _continuous(wrapped[:, None], rate[:, None], time)[:, 0]
    np.testing.assert_allclose(found - found[0], angle - angle[0], atol=1e-6)


@pytest.mark.parametrize(("on", "order"), [("cup", "BPFO"), ("cone", "BPFI")])
def test_rollers_pass_a_spall_at_the_rate_of_its_ring(motion: RowMotion, on: str, order: str) -> None:
    found = passages(motion, spall(on))
    np.testing.assert_allclose(np.diff(found.time), 1.0 / (ORDERS[order] * SHAFT_HZ), rtol=2e-3)
    assert set(found.roller.tolist()) == set(range(17))
    for each in range(0, len(found.time), 7):
        moment = motion.at(float(found.time[each]))
        place = moment.azimuth[found.roller[each]] - (moment.shaft if on == "cone" else 0.0)
        assert abs(np.mod(place + np.pi, 2.0 * np.pi) - np.pi) < 5e-3


def test_a_missing_roller_passes_no_spall() -> None:
    lacking = with_faults(spall("cup"), MissingRoller(0, 3))
    found = passages(RowMotion.of(lacking, 0), spall("cup"))
    assert set(found.roller.tolist()) == set(range(17)) - {3}


def test_the_window_has_the_most_loaded_passage_of_a_turn_in_its_middle(run: Run, motion: RowMotion) -> None:
    turning = spall("cone", azimuth=1.0)
    begin, end = chosen_window(run, motion, turning, 0.2, 3)
    found = passages(motion, turning)
    turn = found.load[(found.time >= 0.2) & (found.time <= 0.2 + 1.0 / SHAFT_HZ)]
    middle = np.argmin(np.abs(found.time - 0.5 * (begin + end)))
    assert found.load[middle] == turn.max()
    assert found.load[middle] > 2.0 * np.median(found.load)  # it is in the load zone a third of the time
    assert end - begin == pytest.approx(3.0 / (ORDERS["BPFI"] * SHAFT_HZ), rel=1e-3)


@pytest.mark.parametrize("of", SUBJECTS)
def test_frames_show_each_roller_where_it_is_in_the_colour_of_its_load(run: Run, of: str) -> None:
    picture = moving_picture(run, of, 0.3)
    frames = list(picture.frames(4))
    motion = RowMotion.of(run, 0)
    section = picture.figure.axes[0]
    largest = motion.load.max()
    for time, frame in zip(picture.times(4), frames, strict=True):
        moment = motion.at(float(time))
        # off the centre, where the spoke of the turning mark is not
        away = 0.3 * SHAPE.roller_diameter
        for roller in range(0, 17, 3):
            against = moment.spin[roller] + np.pi
            place = 0.5 * SHAPE.pitch_diameter * np.array(
                [np.sin(moment.azimuth[roller]), np.cos(moment.azimuth[roller])]
            ) + away * np.array([np.sin(against), np.cos(against)])
            x, y = section.transData.transform(place)
            pixel = frame[round(frame.shape[0] - y), round(x)].astype(int)
            expected = load_colours(moment.load[roller], float(largest)).astype(int)
            assert np.abs(pixel - expected).max() <= 3, (time, roller)
    assert not np.array_equal(frames[0], frames[1])
    title = slice(0, 30)
    np.testing.assert_array_equal(frames[0][title], frames[3][title])


def test_a_gif_lasts_as_long_as_stated_and_begins_again(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "run.gif"
    count = write_gif(moving_picture(run, "load_zone"), path)
    assert count == int(SECONDS * GIF_RATE)
    with Image.open(path) as moving:
        lasted = 0
        for number in range(moving.n_frames):  # type: ignore[attr-defined]
            moving.seek(number)
            lasted += moving.info["duration"]
        assert moving.info["loop"] == 0
    assert lasted / 1e3 == pytest.approx(SECONDS, abs=0.1)
    assert path.stat().st_size < 1.2e6


def test_an_mp4_has_every_frame(recording: Path, tmp_path: Path) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    path = tmp_path / "run.mp4"
    assert command.main(["view", str(recording), "--mp4", str(path)]) == 0
    frames, seconds = ffmpeg.count_frames_and_secs(str(path))
    assert frames == 150
    assert seconds == pytest.approx(SECONDS, abs=0.1)
    assert path.stat().st_size < 4e6
    assert [each.name for each in tmp_path.iterdir()] == ["run.mp4"]


def test_the_subject_is_a_spall_of_a_ring_where_there_is_one() -> None:
    assert set(PICTURES) == set(SUBJECTS)
    assert usual_subject(with_faults(spall("cone"), blocks=1)) == "crossing"
    assert usual_subject(with_faults(spall("roller"), blocks=1)) == "load_zone"
    assert usual_subject(with_faults(blocks=1)) == "load_zone"


def test_what_cannot_be_shown_is_refused_with_a_reason() -> None:
    with pytest.raises(InputError, match="the bearing has no fault"):
        moving_picture(with_faults(), "crossing")
    with pytest.raises(InputError, match="the bearing has spall on the roller 0"):
        moving_picture(with_faults(spall("roller")), "crossing")
    with pytest.raises(InputError, match=r"too few are of bodies, contacts$"):
        moving_picture(_without_snapshots(), "load_zone")
    with pytest.raises(InputError, match=r"one turn of the rollers about the axis takes 0\.12 s"):
        moving_picture(with_faults(blocks=5), "load_zone")
    with pytest.raises(InputError, match=r"rollers pass the spall from 0\.790 s"):
        moving_picture(with_faults(spall("cup")), "crossing", 0.79)


def _without_snapshots() -> Run:
    """A recording of signals alone, as a logger on a train keeps it."""
    run = with_faults(blocks=4)
    for name in ("bodies", "contacts"):
        kept = getattr(run, name)
        empty = {field: value[:0] for field, value in vars(kept).items() if isinstance(value, np.ndarray)}
        run.__dict__[name] = replace(kept, **empty)
    return run


def test_the_command_names_file_subject_and_time(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run.gif"
    assert command.main(["view", str(recording), "--gif", str(path), "--at", "0.3"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith(f"{path}: 3 rollers that cross the spall, 0.3")
    assert "62 frames" in printed


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--of", "crossing"], "--of: is that of --gif and --mp4"),
        (["--web", "--at", "0.1"], "--at: a viewer opens a page at its beginning"),
        (["--save", "x.rrd", "--at", "0.1"], "--at: a viewer opens a file at its beginning"),
        (["--gif", "x.gif", "--at", "7"], "--at 7: the recording goes from 0.000 to 0.795 s"),
        (["--gif", "x.gif", "--at", "nan"], "--at nan: the recording goes from"),
        (["--gif", "x.mp4"], "let its name end in .gif"),
    ],
)
def test_options_that_do_not_go_together_are_refused(
    words: list[str],
    sentence: str,
    recording: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert command.main(["view", str(recording), *words]) == 2
    assert sentence in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_title_of_a_healthy_box_names_the_fault_of_another() -> None:
    healthy = replace(description(), defects=())
    assert view_title(healthy).endswith("bearing HS130x230, no fault")
    shown = view_title(healthy, "axle_1_left", {"axle_2_right": "spall on the cup"})
    assert shown == (
        "synthetic, axlebox axle_1_left: bearing HS130x230, no fault here; in axle_2_right: spall on the cup"
    )
