"""What a verdict rests on that nobody has measured, grouped, every input by its name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.monitor.severity import NOT_MEASURABLE, grade_limits
from beardyn_core.scene.scene import Scene
from beardyn_core.study.inspection import FROM_SCENE, Inspection, hidden_parts
from beardyn_core.study.report_page.identity import (
    bearing_source,
    fact_of,
    measured_names,
    signal_of,
    speed_source,
)

_OF_FREQUENCIES = (
    *("roller_count", "roller_diameter", "pitch_diameter", "contact_angle"),
    *("bpfo", "bpfi", "bsf", "ftf"),
)
_WEAK = ("assumed", "derived")  # how the source of a number begins that nobody has published


def assumed_rows(inspection: Inspection, scene: Scene | None = None) -> tuple[tuple[str, str], ...]:
    """Write a row for each group of what was assumed.

    Parameters
    ----------
    scene : Scene, optional
        Of a simulated recording: its files say which of their numbers are assumed.
    """
    settings, run = inspection.settings, inspection.run
    plate = inspection.mounted.plate
    uncertainty = settings.speed_uncertainty
    own = scene if inspection.bearing_from == FROM_SCENE else plate
    rows = {
        "Speed": f"from {speed_source(inspection)}; searched over ±{100.0 * uncertainty:.2g} %"
        if uncertainty
        else f"from {speed_source(inspection)}; taken as exact",
        "Bearing": f"{plate.name}, {bearing_source(inspection)}; the outer ring stands still; rollers slip "
        f"by up to {100.0 * settings.tolerance:.2g} %{_data_source(own)}",
        "Accelerometer": _sensor(inspection),
        "Other bearings": f"{len(settings.neighbours)} named on the same shaft"
        if settings.neighbours
        else "none named; strikes of a gear or of another bearing on the shaft would be unexplained",
        "Temperature": f"warm from {settings.warm - ZERO_CELSIUS:.0f} °C, hot from "
        f"{settings.hot - ZERO_CELSIUS:.0f} °C or by {60.0 * settings.heating:.2g} K a minute above "
        f"{settings.heating_floor - ZERO_CELSIUS:.0f} °C"
        + ("" if len(run.temperature) else "; no temperature is in the record"),
        "False alarms": f"noise alone alarms in 1 of {1.0 / settings.false_alarm_rate:.0f} analyses",
        "Not judged": _not_judged(inspection),
        "Confidence": "judged on test rigs, none of a train",
    }
    severity = inspection.severity
    if severity is not None and severity.grade != NOT_MEASURABLE:
        developed, severe = grade_limits(inspection.verdict, plate)
        rows["Size"] = (
            f"developed from {1e3 * developed:g} mm, severe from {1e3 * severe:.0f} mm: limits of this "
            "program, not of a keeper"
        )
    if said := fact_of(run.measured, "understood", list):
        rows["Files were read as"] = "; ".join(_without_path(str(each), run.path) for each in said)
    if said := fact_of(run.measured, "warnings", list):
        rows["Warnings"] = "; ".join(_without_path(str(each), run.path) for each in said)
    for kind, names in assumed_inputs(own):
        rows[f"{kind}: assumed or derived, not published"] = ", ".join(names)
    return tuple(rows.items())


def assumed_inputs(noun: Any, name: str = "bearing") -> Iterator[tuple[str, list[str]]]:
    """List the inputs in a scene, and in all that it is made of, whose source says that they are assumed."""
    sources = [each for each in getattr(noun, "sources", ()) if len(each) == 2]
    weak = [re.sub("[_.]", " ", key) for key, source in sources if str(source).startswith(_WEAK)]
    if weak:
        yield name.replace("_", " ").capitalize(), weak
    for member in fields(noun):
        value = getattr(noun, member.name)
        if is_dataclass(value) and not isinstance(value, type):
            yield from assumed_inputs(value, member.name)


def _data_source(noun: Any) -> str:
    """Say who publishes the numbers from which the fault frequencies follow, where that is known."""
    sources = dict(each for each in getattr(getattr(noun, "bearing", noun), "sources", ()) if len(each) == 2)
    found = (str(sources[key]) for key in _OF_FREQUENCIES if key in sources)
    named = dict.fromkeys(re.sub(r" \([^)]*\)$", "", each) for each in found)  # without notes on one number
    return f"; its data: {'; '.join(named)}" if named else ""


def _sensor(inspection: Inspection) -> str:
    signal, measured = signal_of(inspection), inspection.run.measured
    axes = f"axes {', '.join(measured_names(signal))} as the file names them, at the axlebox"
    if not measured:
        return f"simulated; {axes}"
    sensors = fact_of(measured, "sensors", dict)
    name = inspection.mounted.sensor or next(iter(sensors), "")
    factors = fact_of(fact_of(sensors, name, dict), "m_per_s2_per_number", dict)
    known = {axis: factor for axis, factor in factors.items() if isinstance(factor, int | float)}
    scale = ", ".join(f"{axis} {factor:g}" for axis, factor in known.items())
    return f"{axes}; m/s² in one number of the file: {scale}" if scale else axes


def _without_path(sentence: str, path: Path | None) -> str:
    """Leave out which file a sentence is about where that is the first, or the first and others like it."""
    if path is None:
        return sentence
    return re.sub(rf"^{re.escape(str(path))}( and \d+ more)?: ", "", sentence).replace(str(path), path.name)


def _not_judged(inspection: Inspection) -> str:
    from beardyn_core.monitor.chain.ambiguity import ON_THE_SHAFT
    from beardyn_core.monitor.chain.explanations import PART_NAMES

    found = ["the cage"]
    for part, why in inspection.mounted.plate.cannot_tell.items():
        found.append(f"the {PART_NAMES[part]}, because {why}")
    hidden = hidden_parts(inspection.mounted.plate, inspection.results.findings)
    found += [f"the {PART_NAMES[part]}, {ON_THE_SHAFT}" for part in hidden]
    return "; ".join(found)
