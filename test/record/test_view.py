"""The rerun view: meshes that fit the geometry, a file that holds every entity, a picture."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast
from urllib.request import urlopen

import numpy as np
import pytest
import rerun as rr

from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.record import meshes
from beardyn_core.record.description import BearingShape
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.record.messages import encode_string
from beardyn_core.record.reading import read_run
from beardyn_core.record.rerun_bearing import load_colours, log_parts, roller_loads
from beardyn_core.record.rerun_live import LiveView
from beardyn_core.record.rerun_plots import order_spectrum
from beardyn_core.record.rerun_scale import nice_ticks, round_range
from beardyn_core.record.rerun_view import live_stream
from beardyn_core.record.viewer import picture_problem, take_picture, viewer_executable
from beardyn_core.scene.defect import MissingRoller
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.patch import Patch
from test.record.synthetic_run import SHAPE, SyntheticRun, description


def run_view(arguments: list[str]) -> int:
    return command.main(["view", *arguments])


SPECTRUM = "/plots/envelope/spectrum"


def raceway_gap(points: np.ndarray, shape: BearingShape, angle: float) -> np.ndarray:
    """Signed distance of points of row 1 from a raceway cone, positive on the outside of the cone."""
    apex = shape.row_spacing / 2.0 - shape.apex_distance * np.cos(shape.contact_angle)
    return np.hypot(points[:, 0], points[:, 2]) * np.cos(angle) - (points[:, 1] - apex) * np.sin(angle)


def test_rollers_touch_both_raceways_and_enter_neither() -> None:
    mesh = meshes.roller(SHAPE, segments=180)
    along = np.array([0.0, np.cos(SHAPE.contact_angle), np.sin(SHAPE.contact_angle)])
    outward = np.array([0.0, -np.sin(SHAPE.contact_angle), np.cos(SHAPE.contact_angle)])
    frame = np.stack((along, np.cross(outward, along), outward), axis=1)
    centre = np.array([0.0, SHAPE.row_spacing / 2.0, SHAPE.pitch_diameter / 2.0])
    points = mesh.vertices @ frame.T + centre
    to_cup = raceway_gap(points, SHAPE, SHAPE.cup_angle)
    to_cone = raceway_gap(points, SHAPE, SHAPE.cone_angle)
    assert abs(to_cup.max()) < 1e-5
    assert abs(to_cone.min()) < 1e-5


@pytest.mark.parametrize("row", [0, 1])
def test_raceways_of_the_drawn_rings_lie_on_the_raceway_cones(row: int) -> None:
    for mesh, angle, inside in (
        (meshes.cup(SHAPE), SHAPE.cup_angle, 1.0),
        (meshes.cone(SHAPE), SHAPE.cone_angle, -1.0),
    ):
        points = mesh.vertices * np.array([1.0, 1.0 if row else -1.0, 1.0])
        reach = 0.45 * SHAPE.roller_length * np.cos(angle)
        beside = np.abs(points[:, 1] - SHAPE.row_spacing / 2.0) < reach
        gap = inside * raceway_gap(points[beside], SHAPE, angle)
        assert gap.min(initial=0.0) > -1e-6


def test_the_cup_is_cut_open() -> None:
    points = meshes.cup(SHAPE).vertices
    azimuth = np.arctan2(points[:, 0], points[:, 2])
    low, high = meshes.CUT_OPEN
    assert not np.any((azimuth > low + 1e-6) & (azimuth < high - 1e-6))
    assert np.rad2deg(high - low) == pytest.approx(120.0)


def test_normals_have_length_one_and_point_out_of_the_roller() -> None:
    mesh = meshes.roller(SHAPE)
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-12)
    corners = mesh.vertices[mesh.triangles]
    centre = corners.mean(axis=1)
    assert np.all(np.sum(mesh.normals[mesh.triangles[:, 0]] * centre, axis=1) > 0.0)


def test_the_cage_leaves_room_for_the_rollers() -> None:
    mesh = meshes.cage(SHAPE, 1)
    corners = mesh.vertices[mesh.triangles]
    points = corners[np.ptp(corners[..., 1], axis=1) > 0.5 * SHAPE.roller_length].reshape(-1, 3)
    assert len(points) >= SHAPE.roller_count * 8
    azimuth = np.mod(np.arctan2(points[:, 0], points[:, 2]), 2 * np.pi / SHAPE.roller_count)
    assert np.all(np.abs(azimuth - np.pi / SHAPE.roller_count) < 0.4 * np.pi / SHAPE.roller_count)


@pytest.mark.parametrize("on", ["cup", "cone"])
def test_a_spall_is_drawn_on_its_raceway(on: str) -> None:
    angle = SHAPE.cup_angle if on == "cup" else SHAPE.cone_angle
    points = meshes.spall(SHAPE, Patch(on, 1, 0.5, 0.02, 1e-4, 0.03, 0.005)).vertices
    assert np.abs(raceway_gap(points, SHAPE, angle)).max() < 5e-4
    assert np.arctan2(points[:, 0], points[:, 2]).mean() == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize("on", ["cup", "cone"])
def test_a_field_spall_is_drawn_by_its_strips_where_it_is(on: str) -> None:
    """Along the roller it has its extent, around the raceway about its width."""
    found = FieldSpall(on, 1, 0.5, 0.02, 0.05, seed=3)
    strips = tuple(each for each in found.patches_at(0.1) if each.kind == "spall")
    points = np.concatenate([meshes.spall(SHAPE, each).vertices for each in strips])
    length, middle = found.extent
    whole = meshes.spall(SHAPE, found).vertices
    assert len(whole) >= len(points)
    assert np.ptp(points[:, 1]) == pytest.approx(length, rel=0.1)
    assert np.ptp(np.arctan2(points[:, 0], points[:, 2])) < 1.3 * 0.02 / 0.1 + 0.01
    assert abs(middle) < 0.5 * 0.05


def test_what_is_missing_is_not_drawn() -> None:
    class Listing:
        def __init__(self) -> None:
            self.entities: set[str] = set()

        def log(self, entity: str, *_parts: object, **_options: object) -> None:
            self.entities.add(entity)

    whole, some = Listing(), Listing()
    log_parts(cast(Any, whole), description())
    lacking = replace(description(), defects=(MissingRoller(0, 3),), truth={"rows": 1})
    log_parts(cast(Any, some), lacking)
    assert lacking.absent_bodies == {"roller_0_3", "cage_1", *(f"roller_1_{k}" for k in range(17))}
    drawn = {entity.split("/")[-1] for entity in some.entities} | {
        entity.split("/")[1] for entity in some.entities if entity.startswith("bearing/")
    }
    assert not drawn & lacking.absent_bodies
    assert {"bearing/rollers/roller_0_2", "bearing/cage_0/part", "bearing/cup/part"} <= some.entities
    assert {"bearing/rollers/roller_0_3", "bearing/cage_1/part"} <= whole.entities


def test_colour_grows_from_grey_to_red() -> None:
    colours = load_colours(np.array([0.0, 5e3, 1e4]), 1e4).astype(int)
    assert colours[0].tolist() == [176, 184, 196]
    assert colours[2].tolist() == [225, 40, 35]
    assert load_colours(np.zeros(3), 0.0).shape == (3, 3)


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [(-52.0, 93.0, 2), (0.0, 10.7, 2), (1141.0, 1153.0, 2), (-2.0, 66.0, 7), (0.99, 1.003, 2), (3.0, 3.0, 2)],
)
def test_an_axis_holds_its_curve_and_two_labels_or_more(low: float, high: float, labels: int) -> None:
    """The viewer labels powers of ten that are 20 pixels apart: a ninth of a row; the upper edge is cut."""
    found = round_range(np.array([low, np.nan, high]))
    assert found is not None
    first, last = found
    assert first <= low <= high <= last
    assert high - low > 0.3 * (last - first) or low == high
    step = 10.0 ** np.ceil(np.log10((last - first) / 11.5))
    seen = [n for n in range(-2000, 2000) if first - 1e-9 <= n * step < last - 0.02 * step]
    assert len(seen) >= labels
    assert len(seen) <= 12


def test_an_axis_of_no_number_has_no_range() -> None:
    assert round_range(np.array([np.nan, np.inf])) is None


def test_ticks_are_round_and_inside() -> None:
    assert nice_ticks(9.3, 4).tolist() == [0.0, 2.0, 4.0, 6.0, 8.0]
    assert nice_ticks(0.05, 5)[-1] <= 0.05


def test_roller_loads_are_those_of_the_blocks(recording: Path) -> None:
    run = read_run(recording)
    expected = np.concatenate(
        [np.linalg.norm(b.contacts[..., 0, 3:6], axis=-1) for b in SyntheticRun(sensor_count=2).blocks(60)]
    )
    np.testing.assert_allclose(roller_loads(run), expected, rtol=1e-6, atol=1e-6)


def test_rollers_are_in_their_places_where_the_view_begins() -> None:
    """It begins paused at 0; the first snapshot is of 5 ms later. Pieces of a live run stay as they are."""
    from beardyn_core.record.rerun_bearing import shown_ns

    def shown(*stamps: int) -> list[int]:
        run: Any = SimpleNamespace(bodies=SimpleNamespace(time_ns=np.array(stamps, np.int64)))
        found: list[int] = shown_ns(run).tolist()
        return found

    assert shown(5_000_000, 10_000_000) == [0, 10_000_000]
    assert shown(25_000_000, 30_000_000) == [25_000_000, 30_000_000]
    assert shown() == []


def test_the_strongest_line_of_the_spectrum_is_the_fault(recording: Path) -> None:
    spectrum = order_spectrum(read_run(recording))
    assert spectrum is not None
    searched = spectrum.order > 1.0
    strongest = spectrum.order[searched][np.argmax(spectrum.amplitude[searched])]
    assert strongest == pytest.approx(SHAPE.fault_frequencies["BPFO"], rel=0.01)


def test_view_saves_a_file_with_every_part(recording: Path, tmp_path: Path) -> None:
    target = tmp_path / "run.rrd"
    assert run_view([str(recording), "--save", str(target)]) == 0
    listing = subprocess.run(
        [viewer_executable(), "rrd", "print", str(target)], capture_output=True, text=True, check=True
    ).stdout
    for entity in (
        "/bearing/cup",
        "/bearing/cone",
        "/bearing/cage_1",
        "/bearing/rollers/roller_1_16",
        "/bearing/contact_forces/cup",
        "/bearing/contact_forces/rib",
        "/bearing/load_zone/row_0",
        "/bearing/force_on_cup",
        "/plots/force",
        "/plots/vibration",
        "/plots/speed_ratio",
        "/plots/roller_load",
        "/plots/envelope/spectrum",
        "/plots/envelope/BPFO",
        "/scale/bar",
        "/scale/text/ticks",
    ):
        assert entity in listing, entity
    assert target.stat().st_size < 10e6 * 1.2  # 30 MB for 3 s is the limit; this run has 1.2 s


def test_view_shows_what_is_left_of_a_cut_file(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(recording.read_bytes()[: recording.stat().st_size // 2])
    assert run_view([str(cut), "--save", str(tmp_path / "cut.rrd")]) == 0
    assert "not closed properly" in capsys.readouterr().err
    assert (tmp_path / "cut.rrd").stat().st_size > 100_000


def test_view_without_a_display_says_what_to_do(
    recording: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert run_view([str(recording)]) == 2
    message = capsys.readouterr().err
    assert "no display" in message
    assert "--web" in message


def test_view_refuses_a_file_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_view([str(tmp_path / "absent.mcap"), "--save", str(tmp_path / "x.rrd")]) == 2
    assert "absent.mcap" in capsys.readouterr().err
    assert not (tmp_path / "x.rrd").exists()


def test_a_live_view_draws_the_same_entities(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("beardyn_core.record.rerun_live.SPECTRUM_SECONDS", 0.0)
    target = tmp_path / "live.rrd"
    stream = rr.RecordingStream("beardyn")
    stream.save(target)
    live = LiveView(stream)
    encoder, run = BlockEncoder(17, ("axlebox_top",)), description()
    for block in SyntheticRun().blocks(30):
        for name, _, cdr in encoder.encode(block):
            live.feed(name, cdr)
        if block.index == 2:
            assert live.dropped == 3 * 32
            live.feed("truth", encode_string(run.to_json()))
            live.feed("truth", encode_string(run.to_json()))
    live.flush()
    stream.flush()
    stream.disconnect()
    assert live.dropped == 3 * 32
    listing = subprocess.run(
        [viewer_executable(), "rrd", "print", str(target)], capture_output=True, text=True, check=True
    ).stdout
    for entity in (
        "/bearing/cup/part",
        "/bearing/rollers/roller_0_3",
        "/plots/vibration",
        "/plots/envelope/spectrum",
        "/scale/bar",
    ):
        assert entity in listing, entity


def test_a_live_page_is_served_while_the_stream_is_open_and_not_after() -> None:
    with live_stream("web") as live:
        page = live.where
        with urlopen(page, timeout=10.0) as answer:
            assert answer.status == 200
        view = LiveView(live.stream)
        view.feed("truth", encode_string(description().to_json()))
        for name, _, cdr in BlockEncoder(17, ("axlebox_top",)).encode(SyntheticRun().block(0)):
            view.feed(name, cdr)
        view.flush()
    with pytest.raises(OSError, match="refused"):
        urlopen(page, timeout=10.0)


def test_a_live_view_into_a_folder_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with (
        pytest.raises(InputError, match="cannot write"),
        live_stream("file", tmp_path / "no" / "live.rrd"),
    ):
        pass


def test_a_desk_run_can_be_watched(tmp_path: Path) -> None:
    target = tmp_path / "desk.rrd"
    stream = rr.RecordingStream("beardyn")
    stream.save(target)
    view, encoder = LiveView(stream), BlockEncoder(17, ("axlebox_top",))
    view.feed("truth", encode_string(description().to_json()))
    for block in SyntheticRun().blocks(5):
        for name, _, cdr in encoder.encode(block):
            view.feed(name, cdr)
    view.flush()
    stream.disconnect()
    assert target.stat().st_size > 100_000


@pytest.mark.slow
@pytest.mark.browser
def test_a_picture_of_the_view_shows_bearing_and_curves(recording: Path, tmp_path: Path) -> None:
    problem = picture_problem()
    if problem is not None:
        pytest.skip(problem)
    target, picture = tmp_path / "run.rrd", tmp_path / "run.png"
    assert run_view([str(recording), "--save", str(target)]) == 0
    take_picture(target, picture, (1200, 700))
    pixels = pytest.importorskip("matplotlib.image").imread(picture)
    assert pixels.shape[0] >= 700
    left = pixels[:, : pixels.shape[1] // 2, :3]
    assert np.mean(left.max(axis=2) > 0.35) > 0.1  # the bearing covers more than a tenth of its view


@pytest.mark.slow
@pytest.mark.browser
def test_a_picture_at_a_time_shows_the_rollers_of_that_time(recording: Path, tmp_path: Path) -> None:
    problem = picture_problem()
    if problem is not None:
        pytest.skip(problem)
    shown = []
    for name, time in (("one", "0.5"), ("again", "0.5"), ("later", "0.53")):
        path = tmp_path / f"{name}.png"
        assert run_view([str(recording), "--screenshot", str(path), "--at", time]) == 0
        shown.append(pytest.importorskip("matplotlib.image").imread(path)[60:-120, :700, :3])
    np.testing.assert_array_equal(shown[0], shown[1])
    assert np.mean(np.abs(shown[2] - shown[0]).max(axis=2) > 0.1) > 0.01  # rollers and bars have moved
