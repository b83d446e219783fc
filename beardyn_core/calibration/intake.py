"""Recordings and a scene that fit each other, or the reasons why they do not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.calibration.spectra import Reception, Ride, received_in, rides_of
from beardyn_core.calibration.twin import operation_at
from beardyn_core.calibration.unknowns import UNKNOWNS, Unknown
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.inference import FEWEST_TURNS, alike, sizes_text
from beardyn_core.record.run import Run
from beardyn_core.scene.operation import ConstantOperation, QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.study.monitored_recording import HOT_BOX, conclude, findings_of

_SHORTEST, _LONGEST = 1.0, 4.0  # stretch, [s]
_TURNS = 1.2 * FEWEST_TURNS  # of the shaft in a stretch
_SAME_RATE = 1e-3
_FARTHEST_SPEED = 2.0  # of the recordings from that of the scene, as a ratio: the level grows with it


def sensor_number(scene: Scene, name: str, asked: bool) -> int:
    """Find the accelerometer of the scene that stands for the one that is used."""
    names = [each.name for each in scene.sensors]
    if scene.faults:
        raise InputError(
            f"scene {scene.name}: has a fault ({scene.fault_sentences[0]}); calibrate with the healthy scene"
        )
    if scene.axleboxes is not None:
        raise InputError(f"scene {scene.name}: has several axleboxes; give the scene of one")
    if asked and len(names) > 1 and name not in names:
        raise InputError(f"scene {scene.name}: has no sensor {name!r}; it has {', '.join(names)}")
    return names.index(name) if name in names else 0


def unknowns_of(
    scene: Scene, sensor: int, fit: Sequence[str] | None
) -> tuple[tuple[Unknown, ...], tuple[str, ...]]:
    """Find what is to be fitted, and say what the scene has none of.

    Raises
    ------
    InputError
        It has none of what is asked for, or of anything.
    """
    wanted = [each for each in UNKNOWNS if fit is None or each.name in fit]
    lacking = [each for each in wanted if each.base_of(scene, sensor) is None]
    if fit is not None and lacking:
        raise InputError([f"fit {each.name}: the scene {scene.name} {each.absent}" for each in lacking])
    absent = tuple(f"{each.words}: not fitted, the scene {each.absent}" for each in lacking)
    return tuple(each for each in wanted if each not in lacking), absent


def rides_received(
    scene: Scene, sensor: int, received: list[tuple[Run, RollerBearing | NamePlate, str]]
) -> tuple[Reception, tuple[Ride, ...]]:
    """Measure the recordings, and refuse those that are not of such an axlebox."""
    rate, problems, axes, speeds = scene.sensors[sensor].rate, list[str](), set(AXES), list[float]()
    for run, plate, name in received:
        if not alike(scene.bearing, plate):
            problems.append(
                f"{run.label}: is of {plate.name}, {sizes_text(plate)}; the scene {scene.name} has "
                f"{scene.bearing.name}, {sizes_text(scene.bearing)}"
            )
        signal = run.sensors.get(name, run.vibration)
        if name and name not in run.sensors:
            problems.append(f"{run.label}: has no sensor {name!r}; it has {', '.join(run.sensors)}")
        elif not len(signal) or len(run.shaft) < 2:
            problems.append(f"{run.label}: has no vibration with a shaft angle to calibrate with")
        elif signal.rate < (1.0 - _SAME_RATE) * rate:
            problems.append(
                f"{run.label}: is sampled at {signal.rate:.0f} Hz, the accelerometer of the scene "
                f"{scene.name} at {rate:.0f} Hz; what lies between is not in the signal"
            )
        else:
            measured = np.isfinite(np.asarray(signal.values))
            axes &= {axis for k, axis in enumerate(AXES) if measured[:, k].any()}
            turned = np.unwrap(run.shaft.angle)
            seconds = 1e-9 * float(run.shaft.time_ns[-1] - run.shaft.time_ns[0])
            speeds.append(abs(float(turned[-1] - turned[0])) / (2.0 * np.pi * seconds))
            problems += _too_far(scene, run.label, speeds[-1])
    if not problems and not axes:
        problems.append("the recordings have no axis of vibration in common")
    if problems:
        raise InputError(problems)
    for run, plate, name in received:
        verdict = conclude(findings_of(run, plate, sensor=name))
        if verdict.finding is not None and (verdict.finding.is_fault or verdict.verdict == HOT_BOX):
            problems.append(
                f"{run.label}: the monitor finds a fault ({verdict.finding.reason}); a calibration is by "
                "healthy bearings"
            )
    stretch = max(_SHORTEST, _TURNS / max(float(np.median(speeds)), 1e-3))
    reception = Reception(tuple(axis for axis in AXES if axis in axes), rate, min(stretch, _LONGEST))
    found = [each for run, _, name in received for each in received_in(run, reception, name)]
    if not found:
        problems.append(
            f"{received[0][0].label}: has no {reception.stretch:.2f} s of whole vibration in which the shaft "
            f"turns {FEWEST_TURNS:g} times one way"
        )
    if problems:
        raise InputError(problems)
    return reception, rides_of(found)


def _too_far(scene: Scene, label: str, frequency: float) -> list[str]:
    """Say why a recording's speed does not fit a scene."""
    course = scene.operation
    if isinstance(course, QuarterVehicleOperation):
        fastest = max(speed for _, speed in course.speed_profile) / (np.pi * course.wheel_diameter)
    elif isinstance(course, ConstantOperation):
        fastest = abs(course.speed) / (2.0 * np.pi)
    else:
        operation_at(scene, frequency)  # refuses it
    if fastest / _FARTHEST_SPEED <= frequency <= _FARTHEST_SPEED * fastest:
        return []
    return [
        f"{label}: its shaft turns {60.0 * frequency:.0f} times a minute, that of the scene {scene.name} "
        f"{60.0 * fastest:.0f} times; give a scene of about this speed, as the background grows with it"
    ]
