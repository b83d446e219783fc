"""How small a spall a record would have shown: spalls of the twin, added to it."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.follow.known_load import KnownLoad
    from beardyn_core.monitor.chain import Algorithm, MonitorSettings
    from beardyn_core.record.run import Run
    from beardyn_core.scene.scene import Scene
    from beardyn_core.study.smallest_spall import SmallestSpalls

_LEAST_LOAD = 1000.0  # of a record, below which it is none: that of the twin is taken [N]
_OF_RECORD = 0.02  # half of the 90 % interval of a load that a record has
_ALIKE = 0.01  # orders of record and twin, relative: the monitor searches within 2 %


def smallest_spalls(
    run: Run | Path | str,
    twin: Scene | Path | str | None = None,
    *,
    bearing: Bearing | NamePlate | str | None = None,
    sensor: str = "",
    algorithm: Algorithm | None = None,
    settings: MonitorSettings | None = None,
    load_kn: KnownLoad | str | float | None = None,
) -> SmallestSpalls:
    """Find the smallest spall of each part that the monitor would have named in a record without a fault.

    Spalls of the twin, at the speed and load of the record, are added to the vibration of its last
    revolutions.

    Parameters
    ----------
    run, bearing, sensor, algorithm, settings
        See `monitor`.
    twin : Scene, Path or str, optional
        Scene of the axlebox, or of one like it, of which box, sensor and spalls are taken, and the load where
        the record has none; by default that of the recording. It runs in the tier of the scene, up to 28
        times as long as an analysis needs.
    load_kn : KnownLoad, str or float, optional
        Known vertical load on this journal, kN, VALUE or VALUE:UNCERTAINTY, half of its 90 % interval;
        default that of the record, or of the twin. See `estimate`.

    Returns
    -------
    SmallestSpalls
        For each part, with the twin that they are of.

    Raises
    ------
    InputError
        The record is shorter than an analysis, its last revolutions are not healthy, it has no scene, or the
        twin has a bearing of other orders.
    """
    from beardyn_core.api.estimating import known_load_in
    from beardyn_core.api.making import scene as make_scene
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.choice import scene_from_text
    from beardyn_core.choice.load_cases import circumstances
    from beardyn_core.follow.known_load import KnownLoad, combine_loads
    from beardyn_core.follow.load_checks import Evidence, doubts_of
    from beardyn_core.measured.stated_speed import recorded_uncertainty
    from beardyn_core.monitor.chain import REFERENCE, MonitorSettings
    from beardyn_core.study.monitored_recording import HEALTHY, results_of
    from beardyn_core.study.smallest_spall import WIDTHS, LastStretch, SmallestSpalls, smallest_spalls_in

    record, data, sensor = resolve_source(run, bearing, sensor)
    known = known_load_in(record, load_kn, ())
    if twin is None:
        if not record.scene_text:
            raise InputError(
                f"{record.label}: holds no scene; give twin, a scene of this axlebox or of one like it"
            )
        twin = scene_from_text(record.scene_text, record.label)
    base = replace(
        make_scene(twin), background=None, axleboxes=None
    )  # both runs of the twin receive these alike
    own, orders = base.bearing.frequencies, data.frequencies
    for symbol in ("bpfo", "bpfi", "bsf"):
        twins, stated = getattr(own, symbol), getattr(orders, symbol)
        if not abs(twins / stated - 1.0) <= _ALIKE:
            raise InputError(
                f"twin {base.name}: its {base.bearing.name} has {symbol.upper()} {twins:.4f}, that of "
                f"{record.label} has {stated:.4f}: a twin must have the bearing of the record"
            )
    settings = settings or MonitorSettings(speed_uncertainty=recorded_uncertainty(record.measured))
    kept = LastStretch()
    for _ in results_of(record, data, kept, settings, sensor):
        pass
    stretch = kept.stretch
    if stretch is None:
        raise InputError(f"{record.label}: is shorter than an analysis of the monitor needs")
    judged = (algorithm or REFERENCE)(stretch, orders, data.roller_count, settings)
    if judged.verdict != HEALTHY:
        raise InputError(
            f"{record.label}: the last {stretch.revolutions:.0f} revolutions are not healthy but "
            f"{judged.verdict}; spalls are added to a healthy record"
        )
    force = circumstances(base).typical.force
    if isfinite(stretch.load) and abs(stretch.load) > _LEAST_LOAD:
        force = (force[0], force[1], stretch.load)
        if known is not None:
            recorded = KnownLoad(abs(stretch.load), _OF_RECORD * abs(stretch.load), "load of the record")
            known = combine_loads([known, recorded])
    if known is not None:
        known = replace(known, doubts=doubts_of(known, base.bearing, Evidence()))
        force = (force[0], force[1], known.value)
    made = make_scene(
        base,
        faults=[{"kind": "field_spall", "on": "cup", "width_mm": 1e3 * WIDTHS[-1]}],
        load_kN=[1e-3 * each for each in force],
        speed_rpm=60.0 * stretch.shaft_frequency,
    )
    signal = record.sensors[sensor] if sensor else record.vibration
    measured = np.flatnonzero(~np.isnan(signal.values).all(axis=0))
    live = np.ptp(stretch.acceleration, axis=0) > 0.0  # a dead axis receives no spall either
    stretch = replace(stretch, acceleration=stretch.acceleration[:, live])
    axes = tuple(measured[live].tolist())
    same = sensor if sensor in [each.name for each in made.sensors] else ""
    spalls = smallest_spalls_in(
        stretch,
        axes,
        orders,
        data.roller_count,
        made,
        same,
        settings,
        algorithm or REFERENCE,
    )
    words = (
        f"{base.name}, {base.bearing.name} at {60.0 * stretch.shaft_frequency:.4g} rpm and "
        f"{1e-3 * abs(force[2]):.3g} kN, field spalls that begin in the middle of the "
        f"load zone, tier {made.tier}"
    )
    if known is not None:
        words = "; ".join([words, known.sentence, *known.doubts])
    return SmallestSpalls(tuple(spalls), words)
