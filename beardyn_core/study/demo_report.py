"""Result of a demonstration: in words, as a picture, and as files to open."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain, count
from pathlib import Path
from typing import TYPE_CHECKING
from typing import Annotated as A

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import folder_problems
from beardyn_core.monitor.chain.explanations import PART_NAMES
from beardyn_core.record.envelope_spectrum import envelope_order_spectrum
from beardyn_core.record.reading import read_run
from beardyn_core.record.run import Run
from beardyn_core.scene.defect import Defect
from beardyn_core.sensors.summary import SETTLING_S
from beardyn_core.study.monitored_recording import HEALTHY, Conclusion, Finding, conclude

if TYPE_CHECKING:
    from beardyn_core.study.summary_picture import SummaryData

RECORDING_NAME = "run.mcap"
RERUN_NAME = "run.rrd"
SUMMARY_NAME = "summary.png"
VIEW_NAME = "view.png"
FILES = (RECORDING_NAME, RERUN_NAME, SUMMARY_NAME, VIEW_NAME)
USUAL_FOLDER = Path("demo")
HIGHEST_HARMONIC = 5.0
LABEL_WIDTH = 22

Say = Callable[[str], None]


@dataclass(frozen=True)
class Pace:
    """How fast a demonstration went."""

    simulated: A[float, "[s]"]
    real_time_factor: A[float, "simulated time over the time spent in the twin"]
    overall: A[float | None, "simulated time over wall time with all running; ``None``: not measured"] = None
    late_blocks: A[int | None, "published more than 40 ms after they were due"] = None


def demo_folder(given: Path | None, say: Say, *, inputs: Sequence[Path] = (), force: bool = False) -> Path:
    """Make the folder for the results when it is missing; ``force`` replaces earlier ones, never an input.

    Parameters
    ----------
    given : Path or None
        Of ``--output``. ``None``: ``demo``, or ``demo_2``, ``demo_3`` and so on where a folder holds
        results already.
    say : callable
        Prints one line, when another folder than ``demo`` is taken.

    Raises
    ------
    InputError
        It cannot be made or written, it holds results already, or a library is missing that draws them.
    """
    if problems := missing("matplotlib", "the demo", "plot") + missing("rerun", "the demo", "view"):
        raise InputError(problems)
    folder = _free_folder(force) if given is None else given
    if given is None and folder != USUAL_FOLDER:
        say(
            f"{USUAL_FOLDER} holds the results of an earlier run: these go to {folder} "
            f"(--force replaces those in {USUAL_FOLDER})"
        )
    if folder.exists() and (
        problems := folder_problems("--output", folder, FILES, inputs=inputs, force=force)
    ):
        raise InputError(problems)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"--output {folder}: cannot be written ({error.strerror}); choose another"
        ) from error
    return folder


def _free_folder(force: bool) -> Path:
    """Find the first folder that holds no results, of ``demo``, ``demo_2``, ``demo_3`` and so on."""
    if force:
        return USUAL_FOLDER
    numbered = (USUAL_FOLDER.with_name(f"{USUAL_FOLDER}_{number}") for number in count(2))
    return next(each for each in chain((USUAL_FOLDER,), numbered) if not _is_taken(each))


def _is_taken(folder: Path) -> bool:
    """Whether there is a file of this name, or a folder with results in it."""
    if not folder.is_dir():
        return os.path.lexists(folder)
    return any(os.path.lexists(folder / name) for name in FILES)


def report(folder: Path, pace: Pace, say: Say, picture_of_view: bool = True) -> Conclusion:
    """Write the files, print the result and where everything lies.

    Parameters
    ----------
    folder : Path
        With the recording `RECORDING_NAME` in it.
    pace : Pace
    say : callable
        Prints one line.
    picture_of_view : bool
        Take a picture of the rerun view where that is possible.
    """
    from beardyn_core.record.rerun_view import save
    from beardyn_core.record.viewer import picture_problem, take_picture
    from beardyn_core.study.summary_picture import summary_picture

    recording = folder / RECORDING_NAME
    run = read_run(recording)
    conclusion = conclude(findings_of(run))
    say("drawing the summary ...")
    summary_picture(summary_data(run, conclusion), folder / SUMMARY_NAME)
    say("writing the rerun file ...")
    replay = save(run, folder / RERUN_NAME)
    view = "not made"
    if picture_of_view and (problem := picture_problem()) is not None:
        view = f"not made: {problem}"
    elif picture_of_view:
        say("taking a picture of the rerun view ...")
        try:
            view = str(take_picture(replay, folder / VIEW_NAME))
        except InputError as error:
            view = f"not made: {error}"
    say("")
    for line in result_lines(run, conclusion, pace):
        say(line)
    for label, text in (
        ("recording", f"{recording}   (beardyn report {recording})"),
        ("rerun file", f"{replay}   (rerun {replay})"),
        ("summary picture", str(folder / SUMMARY_NAME)),
        ("picture of the view", view),
    ):
        say(f"  {label:{LABEL_WIDTH}}{text}")
    return conclusion


def findings_of(run: Run) -> list[Finding]:
    """Read the results of the monitor in a recording, without its final summary."""
    statuses = [each for _, found in run.results for each in found if each.value("final") != "true"]
    return [finding for status in statuses if (finding := Finding.from_diagnostic(status)) is not None]


def result_lines(run: Run, conclusion: Conclusion, pace: Pace) -> list[str]:
    """Write the results of the monitor, one line each."""
    description = run.described()
    factor = f"{pace.real_time_factor:.2f}"
    if pace.overall is not None:
        factor += f" in the twin, {pace.overall:.3f} with all nodes running"
    rows = [
        ("scene", f"{description.scene}, bearing {description.shape.name}"),
        ("real-time factor", f"{factor} ({pace.simulated:.2f} s simulated)"),
    ]
    if pace.late_blocks is not None:
        rows.append(("late blocks", str(pace.late_blocks)))
    finding = conclusion.finding
    if finding is None:
        rows.append(("monitor", "no verdict yet, the run is too short"))
    elif finding.is_fault:
        rows += [
            (
                "monitor found",
                f"fault of the {PART_NAMES[finding.verdict]} "
                f"({conclusion.agreeing} of {conclusion.analyses} analyses)",
            ),
            (
                "frequency",
                f"{finding.found_frequency:.2f} Hz; {finding.symbol} from bearing data "
                f"{finding.expected_frequency:.2f} Hz ({100.0 * finding.deviation:+.2f} %)",
            ),
            ("signal to background", f"{finding.signal_to_background:.1f} dB"),
        ]
    else:
        rows += [
            ("monitor found", f"no fault ({conclusion.agreeing} of {conclusion.analyses} analyses)"),
            ("strongest line", f"{finding.signal_to_background:.1f} dB over the background"),
        ]
    rows.append(("ground truth", truth_sentence(description.defects, conclusion)))
    return [f"  {label:{LABEL_WIDTH}}{text}" for label, text in rows]


def truth_sentence(defects: tuple[Defect, ...], conclusion: Conclusion) -> str:
    """Write which fault the bearing really has, and whether the monitor is right."""
    there = " and ".join(defect.described() for defect in defects)
    if conclusion.finding is None:
        return there or "no defect"
    right = conclusion.verdict in ({d.on for d in defects} or {HEALTHY})
    return f"{there or 'no defect'}: the monitor is {'right' if right else 'wrong'}"


def summary_data(run: Run, conclusion: Conclusion) -> SummaryData:
    """Gather the arrays of the summary picture."""
    shape = run.described().shape
    orders = shape.fault_frequencies
    time = run.force.time
    load = np.stack([np.interp(time, run.load.time, axis) for axis in run.load.wrench[:, :3].T], axis=1)
    cage_speed = np.stack([np.interp(time, run.cages.time, row) for row in run.cages.speed.T], axis=1)
    shaft_speed = np.interp(time, run.shaft.time, run.shaft.speed)
    settled = run.bodies.time >= min(SETTLING_S, 0.5 * run.bodies.time[-1])
    centre = run.bodies.pose[settled, 4:, :3].reshape(int(settled.sum()), 2, shape.roller_count, 3)
    spectrum = envelope_order_spectrum(run.vibration, run.shaft, HIGHEST_HARMONIC * orders["BPFI"])
    finding = conclusion.finding
    from beardyn_core.study.summary_picture import SummaryData

    return SummaryData(
        title=f"{run.described().scene}: {shape.name}",
        verdict=finding.reason if finding else "monitor: not enough signal for a verdict",
        time=time,
        force=run.force.values[:, :3],
        load=load,
        shaft_speed=shaft_speed,
        cage_speed=cage_speed,
        roller_azimuth=np.arctan2(centre[..., 0], centre[..., 2]),
        roller_load=run.contacts.load[settled][..., run.contacts.of("cup")],
        envelope_order=spectrum.order if spectrum else np.zeros(0),
        envelope_amplitude=spectrum.amplitude if spectrum else np.zeros(0),
        markers={
            "BPFO": orders["BPFO"],
            "BPFI": orders["BPFI"],
            "2 BSF": 2.0 * orders["BSF"],
            "FTF": orders["FTF"],
        },
        shaft_frequency=float(np.mean(shaft_speed)) / (2.0 * np.pi),
    )
