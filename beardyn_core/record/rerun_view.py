"""A recording as a rerun recording with a blueprint that lays out its views."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import as_a_whole
from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_writing import COMPLETE
from beardyn_core.record.rerun_bearing import ROOT, log_loads, log_motion, log_parts, roller_loads
from beardyn_core.record.rerun_follower import follower_view, log_follower, quantities_of
from beardyn_core.record.rerun_plots import bounds, log_plots, ranges_of
from beardyn_core.record.rerun_scale import log_scale, scale_view
from beardyn_core.record.rerun_values import DRAWN, log_values, values_view
from beardyn_core.record.run import Run
from beardyn_core.record.view_title import faults_elsewhere, view_title
from beardyn_core.record.viewer import TIMELINE, require_display, waiting_window, web_viewer

APPLICATION = "beardyn"
_SHOWN = 200  # of a line of the scene


@dataclass(frozen=True)
class LiveStream:
    """A rerun stream to a window, a web page or a file."""

    stream: rr.RecordingStream
    where: A[str, "for a person: the page to open, the file, or ``a window``"]


@contextmanager
def live_stream(target: str, path: Path | None = None, port: int = 0) -> Iterator[LiveStream]:
    """Open a stream to a viewer for as long as the context lasts.

    Parameters
    ----------
    target : str
        ``window``, ``web`` (on this machine only) or ``file``.
    path : Path, optional
        Of the ``.rrd`` file.
    port : int
        Of the page; 0: a free one.

    Raises
    ------
    InputError
        No display for a window, no free port, or the file cannot be written.
    """
    stream = rr.RecordingStream(APPLICATION)
    with ExitStack() as stack:
        where = "a window"
        if target == "window":
            require_display()
            stream.connect_grpc(waiting_window())
        elif target == "web":
            page = stack.enter_context(web_viewer(port=port))
            stream.connect_grpc(page.stream_url)
            where = page.url
        else:
            if path is None:
                raise InputError("a live view into a file needs the path of an .rrd file")
            _check_writable(path, path)
            where = str(path)
            stream.save(where)
        try:
            yield LiveStream(stream, where)
        finally:
            stream.flush()
            stream.disconnect()


@contextmanager
def rerun_file(path: Path, name: str, layout: Any, replace: bool = True) -> Iterator[rr.RecordingStream]:
    """Open a recording into an ``.rrd`` file, with its blueprint, for as long as the context lasts.

    Raises
    ------
    InputError
        The file cannot be written, or is there and `replace` is not set; then there is none of this name,
        or what was there before.
    """
    with as_a_whole(path, replace=replace) as fresh:
        _check_writable(fresh, path)
        stream = rr.RecordingStream(APPLICATION, recording_id=name)
        stream.save(fresh, default_blueprint=layout)
        yield stream
        try:
            stream.flush()
        except RuntimeError as error:  # its thread has ended, and does not say why
            raise InputError(
                f"{path}: the rerun file cannot be written to its end; is the disk full? Free space, or "
                "choose another disk"
            ) from error
        stream.disconnect()


def _check_writable(path: Path, name: Path) -> None:
    try:
        path.open("ab").close()
    except OSError as error:
        raise InputError(f"{name}: cannot write the rerun file ({error.strerror})") from error


BACKGROUND = (16, 19, 26)
# about the time that is shown, [s]; a running twin has nothing behind it
CLOSE_WINDOW, LIVE_WINDOW = (-0.02, 0.18), (-0.18, 0.02)
PLAYBACK_SPEED = 0.05


def log_run(stream: rr.RecordingStream, run: Run) -> None:
    """Log a whole recording.

    Raises
    ------
    InputError
        The recording does not name its bearing.
    """
    log_parts(stream, run.described())
    if len(run.bodies):
        log_motion(stream, run)
        log_loads(stream, run)
        log_scale(stream, float(roller_loads(run).max(initial=0.0)))
    log_plots(stream, run)
    log_values(stream, run.plot_values)
    log_follower(stream, run.followed, run.residuals)
    stream.log("about", rr.TextDocument(about(run), media_type=rr.MediaType.MARKDOWN), static=True)


def blueprint(
    run: RunDescription | None,
    span: tuple[float, float] | None = None,
    follow: bool = False,
    ranges: Mapping[str, tuple[float, float]] | None = None,
    estimates: tuple[str, ...] = (),
    name: str = "",
    monitored: bool = False,
) -> rrb.Blueprint:
    """Lay out the view: a page of the bearing and its curves, one of a monitor's numbers, one of a follower.

    ``run`` is `None` where the bearing is not known. The curves show a window of time [s], by default all
    there is, and the newest data of a running twin with ``follow``; else the time stands at the beginning.
    ``ranges`` are those of the curves' axes, by entity, ``estimates`` the keys of what a follower says,
    ``name`` the title of the view of the bearing; ``monitored`` adds the numbers of a monitor.
    """
    whole = None if span is None else _window(rr.TimeRangeBoundary.absolute, *span)
    close = _window(rr.TimeRangeBoundary.cursor_relative, *(LIVE_WINDOW if follow else CLOSE_WINDOW))
    pages = [] if run is None else [_bearing_view(run, whole, close, ranges or {}, name or view_title(run))]
    pages += [values_view()] if monitored else []
    pages += [follower_view(estimates)] if estimates else []
    play: dict[str, Any] = {"play_state": "following"}
    if not follow:
        play = {"play_state": "paused", "playback_speed": PLAYBACK_SPEED}
    return rrb.Blueprint(
        rrb.Tabs(*pages) if len(pages) > 1 else pages[0],
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE, **play),
        auto_views=False,
    )


def _bearing_view(
    run: RunDescription,
    whole: rrb.archetypes.TimeAxis | None,
    close: rrb.archetypes.TimeAxis,
    ranges: Mapping[str, tuple[float, float]],
    title: str,
) -> rrb.Container:
    """Lay out the bearing with the scale of its colours on the left, curves on the right."""
    outer_diameter, sensors = run.shape.outer_diameter, run.sensor_names
    eye = rrb.EyeControls3D(
        kind=rrb.Eye3DKind.Orbital,
        position=np.array([1.12, 1.10, 0.62]) * outer_diameter,
        look_target=np.array([0.0, 0.0, 0.08]) * outer_diameter,
        eye_up=(0.0, 0.0, 1.0),
    )

    def curves(entity: str, name: str, axis: rrb.archetypes.TimeAxis | None = whole) -> rrb.TimeSeriesView:
        legend = rrb.PlotLegend(rrb.Corner2D.RightTop)
        level = ranges.get(f"plots/{entity}")
        axis_y = None if level is None else rrb.ScalarAxis(range=level)
        return rrb.TimeSeriesView(
            origin=f"plots/{entity}", name=name, axis_x=axis, axis_y=axis_y, plot_legend=legend
        )

    bearing = rrb.Spatial3DView(
        origin="/",
        contents=[f"{ROOT}/**"],
        name=title,
        background=BACKGROUND,
        line_grid=False,
        eye_controls=eye,
    )
    readings = [curves("vibration", "vibration, m/s²", close)]
    readings += [curves(f"vibration_{name}", f"vibration of {name}, m/s²", close) for name in sensors[1:]]
    right = rrb.Vertical(
        rrb.Tabs(*readings) if len(readings) > 1 else readings[0],
        rrb.Spatial2DView(
            origin="plots/envelope",
            name="envelope spectrum, m/s² over orders of the shaft",
            visual_bounds=bounds(),
        ),
        rrb.Tabs(
            curves("roller_load", "roller load, kN"),
            curves("force", "force on the cup, kN"),
            curves("speed_ratio", "speed ratio to pure rolling"),
            curves("shaft_speed", "shaft speed, rpm"),
            rrb.TextDocumentView(origin="about", name="about"),
        ),
        row_shares=[1.0, 1.0, 1.0],
    )
    left = rrb.Vertical(bearing, scale_view(), row_shares=[1.0, 0.13])
    return rrb.Horizontal(left, right, column_shares=[1.15, 1.0], name="bearing")


def _window(boundary: Callable[..., Any], start: float, end: float) -> rrb.archetypes.TimeAxis:
    view_range = rr.TimeRange(start=boundary(seconds=start), end=boundary(seconds=end))
    return rrb.archetypes.TimeAxis(view_range=view_range)


def run_blueprint(run: Run) -> rrb.Blueprint:
    """Make the blueprint of a recording, with its time window."""
    times = run.vibration.time if len(run.vibration) else run.force.time
    span = (float(times[0]), float(times[-1])) if len(times) else None
    return blueprint(
        run.described(),
        span,
        ranges=ranges_of(run),
        estimates=quantities_of(run.followed),
        name=view_title(run.described(), run.box, faults_elsewhere(run)),
        monitored=any(each.name in run.plot_values for each in DRAWN),
    )


def save(run: Run, target: Path | str, *, replace: bool = True) -> Path:
    """Write an ``.rrd`` file with the recording and its blueprint.

    Parameters
    ----------
    run : Run
    target : Path
    replace : bool
        Whether a file that is there is replaced.

    Raises
    ------
    InputError
        The recording does not describe its bearing, or the file cannot be written.
    """
    target = Path(target)
    with rerun_file(target, Path(run.label).stem, run_blueprint(run), replace) as stream:
        log_run(stream, run)
    return target


def about(run: Run) -> str:
    """Describe the scene of the recording in Markdown."""
    description = run.described()
    lines = [
        f"# {description.scene}",
        f"Bearing **{description.shape.name}**, {description.truth.get('rows', 2)} x "
        f"{description.roller_count} rollers.",
    ]
    if run.box:
        lines.append(f"Axlebox **{run.box}** of {', '.join(run.boxes)}.")
    if run.problem:
        lines.append(f"**The file was cut off:** {run.problem}")
    if run.status not in (None, COMPLETE):
        lines.append(f"**The run ended:** {run.status}")
    faults = [f"- {defect.described()}" for defect in description.defects]
    elsewhere = [f"- in axlebox {box}: {fault}" for box, fault in faults_elsewhere(run).items()]
    lines += ["## Faults", *(faults or ["none in this bearing" if elsewhere else "none"]), *elsewhere]
    lines += ["## Fault frequencies per shaft revolution"]
    lines += [f"- {name} {value:.4f}" for name, value in description.shape.fault_frequencies.items()]
    results = [s.message for _, statuses in run.results[-1:] for s in statuses]
    if results:
        lines += ["## Monitor", *(f"- {message}" for message in results)]
    written = run.scene_text.splitlines()  # tables stand in it packed, one line each
    shown = "\n".join(line if len(line) <= _SHOWN else f"{line[:_SHOWN]}..." for line in written)
    lines += ["## Scene", "```yaml", shown, "```"]
    return "\n\n".join(lines[:3]) + "\n\n" + "\n".join(lines[3:]) + "\n"
