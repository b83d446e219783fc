"""``beardyn scenes``: what scenes there are, and what bearings, sensors, ... they can be made of."""

from __future__ import annotations

import argparse
import math
import shutil
import textwrap
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.cli.catalogue_list import (
    CATALOGUE,
    FORMER,
    add_catalogue_options,
    refuse_sizes,
    run_catalogue,
)
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_json

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene

KINDS = (
    "scenes",
    "bearings",
    "lubricants",
    "vehicles",
    "effects",
    "trials",
    "sweeps",
    "structures",
    "sensors",
    "backgrounds",
)
_GROUPS = (
    "healthy bearing under a train",
    "healthy bearing, defect of wheel or rail",
    "fault of the bearing, under a train",
    "fault of the bearing, constant load",
    "healthy bearing, load without a train",
)
_USE = {
    "scenes": "run: beardyn simulate NAME; copy to change it: beardyn new NAME -o mine.yaml",
    "bearings": "in a scene: bearing: NAME; static answers: beardyn bearing NAME",
    "lubricants": "in a scene: lubricant: NAME",
    "vehicles": "in a scene: operation: {kind: quarter_vehicle, vehicle: NAME, ...}",
    "effects": "in a scene: effects: NAME; for one run: beardyn simulate SCENE --effects NAME",
    "trials": "run: beardyn trial NAME",
    "sweeps": "make: beardyn sweep NAME -o DIR",
    "structures": "modes: beardyn structure NAME",
    "sensors": "in a scene: sensors: [{name: top, type: NAME}]",
    "backgrounds": "in a scene: background: NAME",
}


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "scenes",
        help="list the shipped scenes, bearings, lubricants, vehicles, effects, trials, sweeps, boxes, ...",
        description="List what is shipped, with what each is for. Every name is a YAML file that "
        "`beardyn new NAME` copies. The catalogue holds data of ball and roller bearings of test rigs, "
        "machines and railways; all leaves it out.",
    )
    parser.add_argument(
        "kind",
        nargs="?",
        choices=(*KINDS, CATALOGUE, "all"),
        type=lambda text: CATALOGUE if text == FORMER else text,
        default="scenes",
        help="what to list; default scenes",
    )
    add_json(parser)
    add_catalogue_options(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    if args.kind == CATALOGUE:
        return run_catalogue(args)
    refuse_sizes(args)
    lists = {kind: entries(kind) for kind in (KINDS if args.kind == "all" else (args.kind,))}
    if args.json:
        print(json_text("scenes", lists))
    else:
        print("\n\n".join(_text(kind, found) for kind, found in lists.items()))
    return 0


def entries(kind: str) -> list[dict[str, Any]]:
    """Describe the shipped things of one of `KINDS`, in SI units.

    Each has ``name``, ``purpose`` and ``file``, and what distinguishes them; a file with
    mistakes has the first of them as its purpose, and no more.
    """
    from beardyn_core.config import shipped_names
    from beardyn_core.config.folders import find

    found = []
    for name in shipped_names(kind):
        file = find(kind, name)
        about = {"name": name, "purpose": "", "file": str(file)}
        try:
            found.append({**about, **_DESCRIBE[kind](name)})
        except InputError as error:
            found.append({**about, "purpose": f"cannot be used: {error.problems[0]}"})
    return found


def _scene(name: str) -> dict[str, Any]:
    from beardyn_core.config import read_scene
    from beardyn_core.config.automatic import AUTO

    found = read_scene(name)  # what is open stays so: a list is no reason to choose
    scene = found.scene
    effects = scene.effects.names()
    vehicle, vehicle_speed, shaft_speed = _speeds(scene)
    return {
        "purpose": scene.purpose,
        "group": _group(scene),
        "bearing": scene.bearing.name,
        "lubricant": scene.lubricant.name,
        "vehicle": vehicle,
        "duration_s": scene.duration,
        "vehicle_speed_m_per_s": vehicle_speed,
        "shaft_speed_rad_per_s": shaft_speed,
        "tier": AUTO if found.free.tier else scene.tier,
        "effects": (*((AUTO,) if found.free.effects else effects), *scene.effect_names[len(effects) :]),
        "faults": scene.fault_sentences,
        "sensors": [sensor.name for sensor in scene.sensors],
    }


def _speeds(scene: Scene) -> tuple[str | None, list[float] | None, list[float]]:
    """Find the vehicle, its smallest and largest speed [m/s], and those of the shaft [rad/s]."""
    from beardyn_core.rail.measured import read_measurement
    from beardyn_core.scene.operation import ConstantOperation, MeasuredOperation, QuarterVehicleOperation

    operation = scene.operation
    match operation:
        case QuarterVehicleOperation():
            speeds = [speed for _, speed in operation.speed_profile]
            vehicle = [min(speeds), max(speeds)]
            return (
                operation.vehicle.name,
                vehicle,
                [2.0 * each / operation.wheel_diameter for each in vehicle],
            )
        case MeasuredOperation():
            speeds = read_measurement(operation.path, operation.take).shaft_speed.tolist()
        case ConstantOperation():
            speeds = [operation.speed]
        case _:
            speeds = [step.speed for step in operation.steps]
    return None, None, [min(speeds), max(speeds)]


def _group(scene: Scene) -> str:
    from beardyn_core.scene.operation import MeasuredOperation, QuarterVehicleOperation

    operation = scene.operation
    train = isinstance(operation, (QuarterVehicleOperation, MeasuredOperation))
    if scene.fault_sentences:
        return _GROUPS[2 if train else 3]
    if isinstance(operation, QuarterVehicleOperation) and (operation.wheel_defects or operation.rail_defects):
        return _GROUPS[1]
    return _GROUPS[0 if train else 4]


def _bearing(name: str) -> dict[str, Any]:
    from beardyn_core.bearing.life import dynamic_rating
    from beardyn_core.config import load_any_bearing

    bearing = load_any_bearing(name)
    return {
        "purpose": bearing.description,
        "kind": bearing.kind,
        "bore_m": bearing.bore,
        "outer_diameter_m": bearing.outer_diameter,
        "width_m": bearing.width,
        "roller_count": bearing.roller_count,
        "end_play_m": getattr(bearing, "end_play", None),
        "radial_clearance_m": getattr(bearing, "radial_clearance", None),
        "dynamic_load_rating_N": dynamic_rating(bearing).radial,
    }


def _lubricant(name: str) -> dict[str, Any]:
    from beardyn_core.config import load_lubricant

    lubricant = load_lubricant(name)
    return {
        "purpose": lubricant.description,
        "viscosity_40_C_m2_per_s": lubricant.kinematic_viscosity(40.0 + ZERO_CELSIUS),
        "viscosity_100_C_m2_per_s": lubricant.kinematic_viscosity(100.0 + ZERO_CELSIUS),
    }


def _vehicle(name: str) -> dict[str, Any]:
    from beardyn_core.config import load_vehicle

    vehicle = load_vehicle(name)
    return {"purpose": vehicle.description, "body_mass_kg": vehicle.body_mass}


def _effects(name: str) -> dict[str, Any]:
    from beardyn_core.config import load_effects
    from beardyn_core.config.folders import find
    from beardyn_core.config.yaml_text import read_file

    purpose = str(read_file(find("effects", name)).get("purpose", ""))
    return {"purpose": purpose, "effects": load_effects(name).names()}


def _trial(name: str) -> dict[str, Any]:
    from beardyn_core.choice import load_trial

    trial = load_trial(name)
    return {
        "purpose": trial.purpose,
        "scene": trial.scene,
        "tier": trial.tier,
        "run_count": len(trial.cells()),
        "faults": trial.faults,
    }


def _sweep(name: str) -> dict[str, Any]:
    from beardyn_core.config.nouns import read_sweep

    sweep, _ = read_sweep(name)
    return {
        "purpose": sweep.purpose,
        "scene": sweep.scene,
        "run_count": sweep.run_count,
        "varied": [each.key for each in sweep.vary],
    }


def _structure(name: str) -> dict[str, Any]:
    from beardyn_core.config.nouns import load_box

    box = load_box(name)
    return {
        "purpose": box.description,
        "bearing": box.bearing,
        "seats": [seat.name for seat in (*box.sensors, *box.suspension)],
    }


def _sensor(name: str) -> dict[str, Any]:
    from beardyn_core.config.nouns import load_sensor

    sensor = load_sensor(name)
    return {
        "purpose": sensor.description,
        "noise_density_m_per_s2_per_sqrt_Hz": sensor.noise_density,
        "range_m_per_s2": sensor.range,
        "mounting_resonance_Hz": sensor.mounting_resonance,
    }


def _background(name: str) -> dict[str, Any]:
    from beardyn_core.base.edge import write_noun
    from beardyn_core.config.nouns import load_background

    background = load_background(name)
    parts = [part for part in write_noun(background) if part not in ("name", "description", "sources")]
    return {"purpose": background.description, "parts": parts}


_DESCRIBE: dict[str, Callable[[str], dict[str, Any]]] = {
    "scenes": _scene,
    "bearings": _bearing,
    "lubricants": _lubricant,
    "vehicles": _vehicle,
    "effects": _effects,
    "trials": _trial,
    "sweeps": _sweep,
    "structures": _structure,
    "sensors": _sensor,
    "backgrounds": _background,
}


def _text(kind: str, found: list[dict[str, Any]]) -> str:
    """Write a list for the terminal: scenes under the headings of their groups."""
    rows = _rows(kind, found)
    lines = [f"{kind} ({_USE[kind]})"]
    if kind != "scenes":
        return "\n".join([*lines, *rows])
    for group in (*_GROUPS, None):
        members = [row for row, entry in zip(rows, found, strict=True) if entry.get("group") == group]
        if members:
            lines += ["", f"{group or 'with mistakes'}:", *members]
    return "\n".join(lines)


def _rows(kind: str, found: list[dict[str, Any]]) -> list[str]:
    """Align names and figures in columns, and wrap the purpose next to them."""
    cells = [[entry["name"], *(_FIGURES[kind](entry) if len(entry) > 3 else [])] for entry in found]
    count = max(map(len, cells), default=0)
    cells = [[*row, *[""] * (count - len(row))] for row in cells]
    widths = [max(len(row[k]) for row in cells) for k in range(count)]
    rows = []
    for row, entry in zip(cells, found, strict=True):
        head = "  " + "  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)) + "  "
        room = max(shutil.get_terminal_size((120, 24)).columns - len(head), 40)
        first, *more = textwrap.wrap(entry["purpose"], room) or [""]
        rows.append("\n".join([f"{head}{first}".rstrip(), *(" " * len(head) + line for line in more)]))
    return rows


def _range(values: list[float], factor: float, unit: str) -> str:
    low, high = (f"{value * factor:.4g}" for value in values)
    return f"{low} {unit}" if low == high else f"{low} to {high} {unit}"


def _scene_figures(entry: dict[str, Any]) -> list[str]:
    speed = (
        _range(entry["shaft_speed_rad_per_s"], 30.0 / math.pi, "rpm")
        if entry["vehicle_speed_m_per_s"] is None
        else _range(entry["vehicle_speed_m_per_s"], 3.6, "km/h")
    )
    return [f"{entry['duration_s']:g} s", speed, entry["bearing"]]


def _bearing_figures(entry: dict[str, Any]) -> list[str]:
    envelope = " x ".join(f"{entry[key] * 1e3:g}" for key in ("bore_m", "outer_diameter_m", "width_m"))
    rating = f"C {entry['dynamic_load_rating_N'] / 1e3:.0f} kN"
    kind = "" if entry["kind"] == "tapered" else f"{entry['kind']} "
    return [f"{envelope} mm", f"2 x {entry['roller_count']} {kind}rollers", rating]


def _lubricant_figures(entry: dict[str, Any]) -> list[str]:
    cold, hot = (entry[f"viscosity_{at}_C_m2_per_s"] * 1e6 for at in (40, 100))
    return [f"{cold:.0f} mm2/s at 40 °C, {hot:.1f} at 100 °C"]


def _sensor_figures(entry: dict[str, Any]) -> list[str]:
    noise, range_, resonance = (
        entry[key]
        for key in ("noise_density_m_per_s2_per_sqrt_Hz", "range_m_per_s2", "mounting_resonance_Hz")
    )
    return [
        f"{noise:.2g} m/s2 per root Hz",
        f"to {range_:g} m/s2",
        "rigid" if resonance is None else f"{resonance / 1e3:g} kHz",
    ]


_FIGURES: dict[str, Callable[[dict[str, Any]], list[str]]] = {
    "scenes": _scene_figures,
    "bearings": _bearing_figures,
    "lubricants": _lubricant_figures,
    "vehicles": lambda entry: [f"{entry['body_mass_kg'] / 1e3:g} t"],
    "effects": lambda entry: [f"{len(entry['effects'])} effects"],
    "trials": lambda entry: [f"{entry['run_count']} runs", f"of {entry['scene']}"],
    "sweeps": lambda entry: [f"{entry['run_count']} runs", f"of {entry['scene']}"],
    "structures": lambda entry: [f"for {entry['bearing']}"],
    "sensors": _sensor_figures,
    "backgrounds": lambda entry: [", ".join(entry["parts"])],
}
