"""The scenes of a trial: one for each run of its matrix."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import UNITS
from beardyn_core.choice.load import choice_for, complete_scene
from beardyn_core.config import automatic
from beardyn_core.config.folders import find
from beardyn_core.config.load import OpenScene, read_scene_mapping
from beardyn_core.config.nouns import read_trial
from beardyn_core.config.scene_file import overlay
from beardyn_core.config.yaml_text import read_file
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import EFFECTS, Scene
from beardyn_core.scene.trial import CAGE, HEALTHY, SLOT, Cell, Spall, Trial, TrialChoice

# a spall of the cup is where the load is
_LOAD_ZONE_DEG = 30.0
# Of a spall that is no rectangle: more change the load lost over a round pit by less than 3 %
_STRIPS = 13
# along an irregular spall, where chance says how wide it is and where its middle is; straight in between
_KNOTS = (-0.75, 0.0, 0.75)


def load_trial(
    name: str | Path, *, tier: str | None = None, seed: int | None = None, effects: str | None = None
) -> Trial:
    """Load the trial of a shipped name or of a file.

    Parameters
    ----------
    tier, seed, effects : optional
        Instead of the file's; with another tier the check falls away where it is the same one.

    Raises
    ------
    InputError
        With every mistake in the file and in the scenes that it asks for.
    """
    trial, path = read_trial(name, tier=tier, seed=seed, effects=effects)
    problems = dict.fromkeys(
        f"{path}: {problem}" for cell in _corners(trial) for problem in _scene_problems(trial, cell)
    )
    if problems:
        raise InputError(list(problems))
    return trial


def _scene_problems(trial: Trial, cell: Cell) -> tuple[str, ...]:
    try:
        read_trial_scene(trial, cell)
    except InputError as error:
        return tuple(error.problems)
    return ()


def trial_scene(trial: Trial, cell: Cell) -> Scene:
    """Make the scene of one run, ready to run; see `read_trial_scene`.

    What scene and trial leave open is as `with_choices` has it, or else chosen for this run alone.
    """
    found = read_trial_scene(trial, cell)
    choice = trial.choice(cell.tier)
    if choice is None:
        return complete_scene(found)
    numerics = replace(found.scene.numerics, laminae=choice.laminae, steps_per_sample=choice.steps_per_sample)
    return replace(found.scene, effects=choice.effects, numerics=numerics, chosen=choice.reasons)


def with_choices(trial: Trial) -> Trial:
    """Choose what scene and trial leave open, once for all runs of a tier.

    A monitor must not tell a spall by the effects that it is computed with: every effect is on that any kind
    of run needs.
    """
    tiers = dict.fromkeys(cell.tier for cell in trial.cells())
    known = {choice.tier for choice in trial.choices}
    found = [_choice_of(trial, tier) for tier in tiers if tier not in known]
    return replace(trial, choices=(*trial.choices, *(choice for choice in found if choice is not None)))


def leaves_open(trial: Trial) -> bool:
    """Tell whether scene and trial leave anything to be chosen."""
    return not trial.choices and read_trial_scene(trial, trial.cells()[0]).free.anything


def _choice_of(trial: Trial, tier: str) -> TrialChoice | None:
    cells = dict.fromkeys(replace(cell, tier=tier) for cell in _corners(trial))
    scenes = [read_trial_scene(trial, cell) for cell in cells]
    if not scenes[0].free.anything:
        return None
    choices = [choice_for(scene) for scene in scenes]
    hardest = max(choices, key=lambda choice: choice.seconds)
    why = f"the same in all runs of the tier, which is what any of {len(choices)} kinds of them needs"
    return TrialChoice(
        tier,
        together([choice.effects for choice in choices], scenes[0].scene.effects),
        max(choice.laminae for choice in choices),
        max(choice.steps_per_sample for choice in choices),
        (f"{hardest.summary}; {why}", *hardest.reasons[1:]),
    )


def together(sets: list[EffectSet], reference: EffectSet) -> EffectSet:
    """Put the effects of several sets into one, each of the kind that leaves out least."""
    found: dict[str, Any] = {}
    for name in EFFECTS:
        present = [getattr(effects, name) for effects in sets if getattr(effects, name) is not None]
        whole = getattr(reference, name)
        if whole in present or not present:
            found[name] = whole if present else None
        elif all(isinstance(each, ModalStructure) for each in present):
            found[name] = max(present, key=lambda each: each.highest or inf)
        else:
            found[name] = present[0] if all(each == present[0] for each in present) else whole
    return replace(sets[0], **found)


def read_trial_scene(trial: Trial, cell: Cell) -> OpenScene:
    """Read the scene of one run.

    The bearing of a lot, row and place of the spall follow from the run's seed: on the cup within 30 degrees
    of the middle of the load zone, anywhere on the cone or a roller.

    Raises
    ------
    InputError
        With every mistake.
    """
    path = find("scenes", trial.scene, trial.folder)
    data = read_file(path)
    operation = data.get("operation")
    if not isinstance(operation, dict) or operation.get("kind") != "quarter_vehicle":
        raise InputError(
            f"scene {trial.scene}: operation.kind must be 'quarter_vehicle', whose speed a trial sets"
        )
    irregularity = operation.get("irregularity")
    given = operation.get("wheel_diameter_mm")
    diameter = QuarterVehicleOperation.wheel_diameter if given is None else UNITS["mm"].to_si(float(given))
    seed = cell.seed(trial.seed)
    data["operation"] = {
        **operation,
        "irregularity": {**(irregularity if isinstance(irregularity, dict) else {}), "kind": cell.track},
        "speed_profile": [{"time_s": 0, "speed_kmh": UNITS["kmh"].to_edge(cell.speed)}],
        "wheel_defects": [write_noun(defect) for defect in trial.wheel(cell.wheel).defects],
    }
    data |= {
        "scene": f"{trial.name}, {cell.key}"[:80],
        "tier": cell.tier,
        "duration_s": trial.duration(cell.speed, diameter),
        "seed": seed,
        "defects": [] if cell.fault == HEALTHY else _defects(trial.spall, cell, seed),
    }
    if cell.sensor:
        data["sensors"] = [{**sensor, "type": cell.sensor} for sensor in data.get("sensors", [])]
    if trial.noise_density is not None:
        data["sensors"] = [
            {**sensor, "noise_density_m_per_s2_per_sqrt_Hz": trial.noise_density}
            for sensor in data.get("sensors", [])
        ]
    scatter, made = data.get("scatter"), {"grade": trial.scatter, "surface": cell.surface}
    given_by_trial = {key: value for key, value in made.items() if value}
    if given_by_trial:
        scatter = {**(scatter if isinstance(scatter, dict) else {}), **given_by_trial}
    if isinstance(scatter, dict):
        data["scatter"] = {**scatter, "seed": seed}
    if cell.tier == "lumped":  # healthy and faulty runs with the same band
        data["numerics"] = {"steps_per_sample": 1, **data.get("numerics", {})}
    if isinstance(trial.effects, dict) and "preset" not in trial.effects:
        effects = data.get("effects")
        data["effects"] = overlay(
            effects if isinstance(effects, dict) else {"preset": effects or automatic.UNNAMED}, trial.effects
        )
    elif trial.effects is not None:
        data["effects"] = _in_the_same_box(trial.effects, data.get("effects"))
    found = read_scene_mapping(data, f"scene {trial.scene} as {cell.key}", path.parent)
    return replace(found, free=replace(found.free, rates=False))  # the monitor reads all that sensors measure


def _in_the_same_box(effects: str | dict[str, Any], given: Any) -> str | dict[str, Any]:
    """Give a preset the structure of the scene's effects, which belongs to the box and not to the preset."""
    structure = given.get("structure") if isinstance(given, dict) else None
    if structure is None or (isinstance(effects, dict) and "structure" in effects):
        return effects
    return {**({"preset": effects} if isinstance(effects, str) else effects), "structure": structure}


def _defects(spall: Spall, cell: Cell, seed: int) -> list[dict[str, Any]]:
    """Write the fault of a run: one patch, the strips of a round or irregular spall, or a worn pocket."""
    random = np.random.default_rng(seed)
    row, roller = int(random.integers(2)), int(random.integers(8))
    if cell.fault == CAGE:
        worn = {"kind": "worn_pocket", "row": row, "pocket": roller}
        return [{**worn, "clearance_mm": UNITS["mm"].to_edge(cell.size)}]
    reach = _LOAD_ZONE_DEG if cell.fault == "cup" else 180.0
    patch: dict[str, Any] = {
        "kind": "spall",
        "on": cell.fault,
        "row": row,
        "azimuth_deg": float(random.uniform(-reach, reach)),
        "width_mm": UNITS["mm"].to_edge(cell.size),
        "depth_um": UNITS["um"].to_edge(spall.depth(cell.size)),
        "length_mm": UNITS["mm"].to_edge(spall.length_per_width * cell.size),
        **({"roller": roller} if cell.fault == "roller" else {}),
    }
    if cell.shape == "field":
        grown = {key: patch[key] for key in ("on", "row", "azimuth_deg", "width_mm")}
        grown |= {"kind": "field_spall", "roller": patch.get("roller", 0)}
        return [{**grown, "seed": int(random.integers(1 << 31))}]
    if cell.shape == "whole":
        del patch["length_mm"]
    elif cell.shape in ("round", "irregular"):
        return _strips(patch, cell.shape, random)
    return [patch]


def _strips(patch: dict[str, Any], shape: str, random: np.random.Generator) -> list[dict[str, Any]]:
    """Write the strips of a spall that is no rectangle: as wide as a circle there, or as chance has it."""
    across = (2.0 * np.arange(_STRIPS) - _STRIPS + 1.0) / _STRIPS
    length, share, turned = patch["width_mm"], np.sqrt(1.0 - across**2), np.zeros(_STRIPS)
    if shape == "irregular":
        length = patch["length_mm"]
        share = np.interp(across, _KNOTS, random.uniform(0.4, 1.0, len(_KNOTS)))
        turned = np.interp(across, _KNOTS, random.uniform(-0.2, 0.2, len(_KNOTS)))
    return [
        {
            **patch,
            "width_mm": patch["width_mm"] * float(wide),
            "length_mm": length / _STRIPS,
            "offset_mm": 0.5 * length * float(place),
            "azimuth_deg": patch["azimuth_deg"] + float(turn),
        }
        for place, wide, turn in zip(across, share, turned, strict=True)
    ]


def _corners(trial: Trial) -> list[Cell]:
    """Find runs among which every entry of the matrix stands once, sizes with every fault."""
    first = trial.cells()[0]
    healthy = replace(first, fault=HEALTHY, size=0.0, shape=SLOT, repeat=0, tier=trial.tier, checks=False)
    tiers = dict.fromkeys(cell.tier for cell in trial.cells())
    corners = [replace(healthy, tier=tier) for tier in tiers]
    corners += [replace(healthy, speed=speed) for speed in trial.speeds[1:]]
    corners += [replace(healthy, track=track) for track in trial.tracks[1:]]
    corners += [replace(healthy, wheel=wheel.name) for wheel in trial.wheels[1:]]
    corners += [replace(healthy, sensor=sensor) for sensor in trial.sensors[1:]]
    corners += [replace(healthy, surface=surface) for surface in trial.surfaces[1:]]
    ends = (*trial.sizes[:1], *trial.sizes[-1:])
    corners += [
        replace(healthy, fault=fault, size=size, shape=shape)
        for fault in trial.faults
        for size in ends
        for shape in ((SLOT,) if fault == CAGE else trial.shapes)
    ]
    return list(dict.fromkeys(corners))
