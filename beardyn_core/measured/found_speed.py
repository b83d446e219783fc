"""Speed of the shaft from the vibration of measured files that do not say it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.measured.about import Mounted
from beardyn_core.measured.stream import SensorBlock, Stream
from beardyn_core.measured.survey import Survey
from beardyn_core.monitor.speed import SpeedTrack, speed_from_vibration
from beardyn_core.monitor.streaming import measured_axes

PIECE_S = 10.0  # of vibration that is searched at a time
_RPM = 60.0  # of a hertz


def with_found_speed(survey: Survey, bearings: Sequence[Mounted]) -> Survey:
    """Find the speed in the vibration of the first accelerometer, where it was asked for.

    Raises
    ------
    InputError
        No bearing is known, whose lines tell the shaft's from others; or the speed is not certain.
    """
    limits = survey.reading.speed_range
    if limits is None or survey.has_speed:
        return survey
    path = survey.files[0].chosen.path
    if not bearings:
        raise InputError(
            f"{path}: the speed of the shaft is sought in the vibration (--speed-range-rpm); that "
            "needs the bearing: "
            "give --bearing"
        )
    if doubtful := [each.plate.name for each in bearings if each.plate.cannot_tell]:
        raise InputError(
            f"{path}: the speed of the shaft is sought in the vibration (--speed-range-rpm); that needs all "
            f"orders of the bearing, and those of {', '.join(doubtful)} are not all known: give bpfo, bpfi, "
            "bsf and ftf, or its inner dimensions"
        )
    plates = {each.plate.frequencies: each.plate.name for each in bearings}
    orders, names = tuple(plates), tuple(plates.values())
    rate, times, found = survey.rate(survey.sensors[0]), [], []
    for begin, acceleration in _pieces(survey, rate):
        low, high = (each / (2.0 * np.pi) for each in limits)
        track = speed_from_vibration(acceleration, rate, low, high, orders, names=names)
        if not track.certain:
            raise InputError(
                f"{path}: the speed of the shaft is not known, and from {begin:.3g} s on "
                f"{track.reason}; give one "
                "of --speed-rpm, --speed-kmh with --wheel-diameter-mm, --speed-channel, --tacho-channel"
            )
        times.append(begin + track.time)
        found.append(track)
    if not found:
        raise InputError(f"{path}: is too short to find the speed of the shaft in its vibration")
    whole = SpeedTrack(
        np.concatenate(times),
        np.concatenate([track.frequency for track in found]),
        np.concatenate([track.deviation for track in found]),
        min(track.evidence for track in found),
        min(track.share for track in found),
        True,
        found[0].reason,
        max(track.spread for track in found),
    )
    slowest, fastest = _RPM * whole.frequency.min(), _RPM * whole.frequency.max()
    doubt = whole.uncertainty * fastest
    told = (
        f"{path}: by the vibration the shaft turns with {slowest:.5g} to {fastest:.5g} rpm, "
        f"give or take {doubt:.3g}"
    )
    return replace(survey, received=whole, told=(*survey.told, told))


def _pieces(survey: Survey, rate: float) -> Iterator[tuple[float, Float]]:
    """Give begin [s] and vibration of pieces without a gap; a short rest belongs to the piece before."""
    parts: list[SensorBlock] = []
    count = 0
    for part in Stream(survey):
        if not isinstance(part, SensorBlock) or part.sensor != survey.sensors[0]:
            continue
        gap = bool(parts) and part.sample != parts[-1].sample + len(parts[-1].time_ns)
        if parts and (gap or count >= PIECE_S * rate):
            yield _join_parts(parts)
            parts, count = ([] if gap else parts[-_tail(parts, rate) :]), 0
            count = sum(len(each.time_ns) for each in parts)
        parts.append(part)
        count += len(part.time_ns)
    if parts:
        yield _join_parts(parts)


def _tail(parts: list[SensorBlock], rate: float) -> int:
    """Count the parts of the last third, with which the next piece begins: no piece is a short rest."""
    return max(1, int(PIECE_S * rate / 3.0 / max(1, len(parts[-1].time_ns))))


def _join_parts(parts: list[SensorBlock]) -> tuple[float, Float]:
    return parts[0].time_ns[0] * 1e-9, measured_axes(np.concatenate([part.acceleration for part in parts]))
