"""What one accelerometer receives of a worn pocket: ``python -m evidence.trial.worn_pockets``.

The same bearings of the trial `cage` sound, with a pocket worn, and sound but made less well (grade G3):
where the roller of that pocket passes the middle of the load zone, how far the lines of FTF stand out in the
spectrum of the chain over the revolutions of a run of the trial, of a window of the monitor and of two, and
what share of the power they make. The alarm is where noise has such a sum as seldom as for the other parts.

With ``--cwru FOLDER`` and ``--mfpt FOLDER`` (as of `evidence.measured.page`): in how many measured bearings,
none of which has a faulty cage, the lines of FTF pass that alarm.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.choice import load_trial
from beardyn_core.choice.trial import trial_scene, with_choices
from beardyn_core.monitor.chain import FaultLines, MonitorSettings, Stretch
from beardyn_core.monitor.chain.competing_orders import Rival
from beardyn_core.monitor.chain.false_alarm_rate import PLACES_PER_RESOLUTION, evidence, score_threshold
from beardyn_core.monitor.chain.fault_lines import Candidate, Pattern
from beardyn_core.monitor.chain.impulsiveness import with_strikes
from beardyn_core.monitor.chain.tracking import logarithm_by_angle
from beardyn_core.monitor.chain.whitening import by_cepstrum, whole_band
from beardyn_core.monitor.features import order_spectrum
from beardyn_core.run import blocks
from beardyn_core.scene.defect import WornPocket
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import CAGE
from evidence.measured.cases import Record, listenings, records
from evidence.trial.pockets import RATE, SETTLED, TREND

SPEED = 160.0  # [km/h]
REVOLUTIONS = (40.0, 60.0, 120.0)  # of a run of the trial, of the monitor's window, of two
HARMONICS = 8  # of FTF; a cage turns at some 0.43 of the shaft, so that more lie among the track's orders
WEAR = (0.5e-3, 1e-3, 2e-3)  # [m]
WORSE = "G3"  # grade of bearings whose rollers are less alike
ZONE = 0.25  # around the middle of the load zone, [rad]


@dataclass(frozen=True)
class Shown:
    """What a run shows of a pocket."""

    late: A[float, "way by which its roller passes the middle of the load zone behind its place, [m]"]
    scores: A[tuple[float, ...], "lines of FTF but the strongest over noise, over `REVOLUTIONS`, [dB]"]
    alarms: A[tuple[float, ...], "scores that noise passes with the stated rate, [dB]"]
    share: A[float, "what the lines but the loudest make of the mean power, over the longest, [-]"]


def scenes() -> Iterator[tuple[str, Scene, WornPocket]]:
    """Make the scenes by their kind, each with the pocket that is or is not worn."""
    trial = with_choices(load_trial("cage"))
    for cell in trial.cells():
        if cell.fault != CAGE or cell.size != WEAR[0] or not math.isclose(3.6 * cell.speed, SPEED):
            continue
        scene = trial_scene(trial, cell)
        (pocket,) = scene.defects
        if not isinstance(pocket, WornPocket) or scene.scatter is None:
            raise TypeError(f"{cell.key}: the fault is no worn pocket, or the bearing is of no lot")
        sound = replace(scene, defects=())
        yield "sound", sound, pocket
        for wear in WEAR:
            worn = replace(pocket, clearance=wear)
            yield f"worn by {1e3 * wear:g} mm", replace(scene, defects=(worn,)), pocket
        yield f"sound, {WORSE}", replace(sound, scatter=replace(scene.scatter, grade=WORSE)), pocket


def way_behind(bearing: RollerBearing, rollers: Float, cage: Float, number: int) -> float:
    """Measure how far behind its place a roller passes the middle of the load zone on average, [m].

    Parameters
    ----------
    rollers : array, shape [time, roller]
        Of a row, [rad].
    cage : array, shape [time]
        [rad].
    """
    azimuth = rollers[:, number]
    place = cage + 2.0 * math.pi * number / bearing.roller_count
    off = (azimuth - place + math.pi) % (2.0 * math.pi) - math.pi
    here = np.abs((azimuth + math.pi) % (2.0 * math.pi) - math.pi) < ZONE
    return float(-off[here].mean() * 0.5 * bearing.pitch_diameter)


def cage_lines(stretch: Stretch, ftf: float, settings: MonitorSettings) -> FaultLines:
    """Lay harmonics of FTF over the spectrum of the chain, as `comb_score` does with those of other parts."""
    band = whole_band(stretch, settings)
    white = by_cepstrum(stretch, settings)
    tracked = logarithm_by_angle(white.squared_envelope((band.low, band.high)), stretch, settings)
    highest = HARMONICS * ftf * (1.0 + settings.tolerance)
    spectrum = order_spectrum(tracked, settings.samples_per_revolution, highest, settings.background_width)
    beside = np.abs(spectrum.order - np.round(spectrum.order)) > 2.0 * spectrum.resolution
    power = np.where(beside, math.log(2.0) * 10.0 ** (0.1 * spectrum.level), 0.0)
    half = settings.tolerance * ftf
    trial = np.arange(ftf - half, ftf + half, 0.25 * spectrum.resolution / HARMONICS)
    index = np.rint(trial[:, None] * np.arange(1, HARMONICS + 1) / spectrum.order[1]).astype(int)
    laid = power[np.minimum(index, len(power) - 1)]
    summed = laid.sum(axis=1) - laid.max(axis=1)
    best = int(summed.argmax())
    places = max(1.0, PLACES_PER_RESOLUTION * 2.0 * half * HARMONICS / spectrum.resolution)
    candidate = Candidate(
        pattern=Pattern("cage", "FTF", ftf, 1.0, "shaft", 0, 0),
        order=float(trial[best]),
        score=10.0 * math.log10(max(1.0, summed[best] / (HARMONICS - 1))),
        threshold=score_threshold(HARMONICS, round(places, 1), settings.false_alarm_rate / 3.0),
        evidence=evidence(float(summed[best]), HARMONICS, places),
        rival=Rival(),
        lines=(),
    )
    return with_strikes(FaultLines(spectrum, (candidate,), math.nan, math.nan), stretch, band, settings)


def show(scene: Scene, pocket: WornPocket) -> Shown:
    """Run a scene and look for the pocket."""
    if not isinstance(scene.operation, QuarterVehicleOperation):
        raise TypeError("a trial's scene runs on wheels")
    shaft_frequency = SPEED / 3.6 / (math.pi * scene.operation.wheel_diameter)
    done = list(blocks(scene, SETTLED + (REVOLUTIONS[-1] + 2.0) / shaft_frequency))
    first, begin = round(SETTLED * TREND), round(SETTLED * RATE)
    rollers = np.concatenate([each.roller_angle for each in done])[first:, pocket.row]
    cage = np.concatenate([each.cage_angle for each in done])[first:, pocket.row]
    turned = np.unwrap(np.concatenate([each.shaft_angle for each in done]))
    signal = np.concatenate([each.vibration[0].acceleration for each in done])
    angle = np.interp(np.arange(len(signal)) / RATE, np.arange(len(turned)) / TREND, turned)
    signal, angle = signal[begin:], angle[begin:]
    ftf, settings = fault_frequencies(scene.bearing).ftf, MonitorSettings()
    found = []
    for revolutions in REVOLUTIONS:
        end = int(np.searchsorted(angle, angle[0] + 2.0 * math.pi * revolutions))
        stretch = Stretch(RATE, signal[:end], angle[:end], math.nan, 0)
        (candidate,) = cage_lines(stretch, ftf, settings).candidates
        found.append(candidate)
    return Shown(
        late=way_behind(scene.bearing, rollers, cage, pocket.pocket),
        scores=tuple(each.score for each in found),
        alarms=tuple(each.threshold for each in found),
        share=found[-1].strikes,
    )


def measured(found: Sequence[Record], revolutions: float) -> tuple[Counter[str], Counter[str]]:
    """Count bearings by their faulty part, and those whose lines of FTF pass the alarm in the beginning."""
    received: Counter[str] = Counter()
    passing: Counter[str] = Counter()
    for record in found:
        for each in listenings(record):
            end = round(revolutions * each.rate / each.shaft_frequency)
            if end <= len(each.acceleration):
                angle = np.asarray(2.0 * math.pi * each.shaft_frequency * np.arange(end) / each.rate)
                stretch = Stretch(each.rate, each.acceleration[:end], angle, math.nan, 0)
                (lines,) = cage_lines(stretch, each.plate.frequencies.ftf, MonitorSettings()).candidates
                part = each.part or "none"
                received[part] += 1
                passing[part] += lines.score >= lines.threshold
    return received, passing


def main(arguments: Sequence[str] | None = None) -> int:
    """Run and print, or receive the measured records and print."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--cwru", type=Path, metavar="FOLDER", help="with the .mat files of CWRU")
    parser.add_argument("--mfpt", type=Path, metavar="FOLDER", help="with the .mat files of MFPT")
    folders = parser.parse_args(arguments)
    if folders.cwru or folders.mfpt:
        found = records(folders.cwru, folders.mfpt)
        for revolutions in REVOLUTIONS[1:]:
            received, passing = measured(found, revolutions)
            for part, count in received.items():
                print(f"over {revolutions:g} revolutions, faulty part {part}: {passing[part]} of {count}")
        return 0
    over = " | ".join(f"over {each:g} dB" for each in REVOLUTIONS)
    print(f"| bearing | pocket | mm behind | {over} | share % |")
    print("|---|---|--:|" + "--:|" * (len(REVOLUTIONS) + 1))
    alarms: tuple[float, ...] = ()
    for kind, scene, pocket in scenes():
        shown = show(scene, pocket)
        scores = " | ".join(f"{each:.1f}" for each in shown.scores)
        where = f"{pocket.row}/{pocket.pocket}"
        late, share = 1e3 * shown.late, 100.0 * shown.share
        print(f"| {kind} | {where} | {late:.2f} | {scores} | {share:.1f} |", flush=True)
        alarms = shown.alarms
    print("alarm at", ", ".join(f"{each:.1f}" for each in alarms), "dB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
