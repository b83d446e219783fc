"""Legal scenes at random: any number that the configuration takes, in kernels of a short list."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.life import static_rating
from beardyn_core.choice import scene_from_text
from beardyn_core.config.keys import valid
from beardyn_core.config.nouns import load_bearing, load_effects
from beardyn_core.config.scene_file import with_length
from beardyn_core.config.yaml_text import write_mapping
from beardyn_core.effects import Thermal
from beardyn_core.scene.defect import WornPocket
from beardyn_core.scene.excitation import IRREGULARITY_KINDS, MEASURED
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.operation import (
    MOST_RPM,
    ConstantOperation,
    QuarterVehicleOperation,
    SteppedOperation,
)
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIERS
from beardyn_core.scene.waviness import Waviness
from evidence.random.drawing import ABSENT, Chance, draw, redrawn

SURFACES = ("cup", "cone", "roller")
FEWEST_ROLLERS = 17
BOXES = {
    "AARK_6.5x9": "freight_adapter",
    "FR130x230x150": "freight_box",
    "HS130x230": "high_speed",
    "METRO120x220": "metro",
}
BEARINGS = tuple(BOXES)
LUBRICANTS = ("BEACON_EP2", "EP220", "FVA3", "L055", "LGEP2", "RAIL100", "SHC100", "SHC220")
VEHICLES = ("emu_300", "freight_y25", "passenger_coach")
SENSORS = ("iepe_100", "mems_50g", "piezo_axlebox")
STEPS = {"lumped": (0.25, 0.5, 1, 2, 4, 8), "quasistatic": (1, 2, 4, 8), "full": (2, 4, 8, 16)}
LONGEST_BLOCKS = {"lumped": 4, "quasistatic": 3, "full": 2}
BLOCK_S = 0.02
SMALLEST_FORCE = 1e-3  # [kN]
# A ride takes seconds before the bearing turns at all: one scene in twelve.
OPERATIONS = (*(ConstantOperation, SteppedOperation) * 5, ConstantOperation, QuarterVehicleOperation)
MOST_TRIES = 400
# of a number of an effect that it is not the usual one
SHAKEN = 0.1


@dataclass(frozen=True)
class Kernel:
    """What decides which kernel a scene needs: none but these are compiled."""

    tier: str
    effects: A[str, "a preset; `rings` and `box`: the standard one with a cup or a box that bends"]
    faults: A[str, "sound; patches on the cup, or everywhere; made: a lot that scatters; all of it"]
    off_centre: A[bool, "whether box and springs have their centres beside that of the bearing"] = False


def _kernels(tier: str, *pairs: str, off_centre: str) -> tuple[Kernel, ...]:
    """List kernels of a tier from effects and faults; the last one has box and springs off centre."""
    plain = [Kernel(tier, effects, faults) for effects, faults in (pair.split() for pair in pairs)]
    effects, faults = off_centre.split()
    return (*plain, Kernel(tier, effects, faults, off_centre=True))


KERNELS = {
    "fast": (
        *_kernels(
            "lumped",
            *("standard sound", "standard cup", "standard everywhere", "standard made", "standard all"),
            *("rings everywhere", "box sound", "box all"),
            off_centre="standard everywhere",
        ),
        *_kernels(
            "quasistatic",
            *("standard sound", "standard cup", "standard everywhere", "standard made", "standard all"),
            *("full everywhere", "rings everywhere", "box sound", "box all"),
            off_centre="standard everywhere",
        ),
    ),
    "full": _kernels(
        "full",
        *("standard sound", "standard everywhere", "standard all", "full sound", "full all"),
        *("dry everywhere", "box all"),
        off_centre="standard all",
    ),
}


@dataclass(frozen=True)
class Case:
    """One legal scene, and what it took to find it."""

    number: int
    kernel: Kernel
    text: A[str, "the scene file"]
    scene: Scene
    refused: A[tuple[str, ...], "problems of the draws before it, which the configuration refused"]


def case(number: int, seed: int, speed: str) -> Case:
    """Draw a legal scene: the same for a number and a seed on every machine.

    What the configuration refuses, because numbers that are right by themselves contradict each other, is
    drawn again.

    Parameters
    ----------
    number, seed : int
    speed : str
        Key of `KERNELS`.
    """
    chance = np.random.default_rng(np.random.SeedSequence([seed, number, len(KERNELS[speed])]))
    kernel = of(KERNELS[speed], chance)
    refused: list[str] = []
    for _ in range(MOST_TRIES):
        text = write_mapping(drawn_keys(chance, kernel, f"random {speed} {number}"))
        try:
            return Case(number, kernel, text, scene_from_text(text, "random"), tuple(refused))
        except InputError as error:
            refused += error.problems
    raise AssertionError(f"case {number}: {MOST_TRIES} draws were all refused, the last with {refused[-1]}")


def drawn_keys(chance: Chance, kernel: Kernel, name: str) -> dict[str, Any]:
    """Draw the keys of a scene, each legal by itself."""
    bearing = of(BEARINGS, chance)
    rating = static_rating(load_bearing(bearing)) / 1e3
    own = {
        **OWN,
        ("ConstantOperation", "force"): lambda chance: _force(chance, rating),
        ("SteppedOperation", "steps"): lambda chance: _steps(chance, rating),
    }
    keys = {"scene": name, **draw(Scene, chance, own)}
    keys |= {"bearing": bearing, "tier": kernel.tier, "operation": draw(of(OPERATIONS, chance), chance, own)}
    keys |= {"effects": _effects(chance, kernel, bearing), "numerics": _numerics(chance, kernel.tier)}
    keys["duration_s"] = BLOCK_S * int(chance.integers(1, LONGEST_BLOCKS[kernel.tier] + 1))
    _damage(keys, chance, kernel.faults, load_bearing(bearing))
    _place(keys, chance, kernel)
    return keys


def _effects(chance: Chance, kernel: Kernel, bearing: str) -> dict[str, Any]:
    """Write out a preset with some of its numbers drawn: a number needs no kernel of its own."""
    preset = kernel.effects if kernel.effects in ("full", "dry") else "standard"
    effects = load_effects(preset)
    found: dict[str, Any] = {"preset": preset}
    for name in effects.names():
        drawn = redrawn(getattr(effects, name), chance, SHAKEN)
        if drawn:
            found[name] = drawn
    if kernel.effects == "rings":
        found["structure"] = {"kind": "rings"}
    if kernel.effects == "box":
        found["structure"] = {"kind": "modes", "table": BOXES[bearing]}
    if chance.random() < 0.2:
        found["thermal"] = draw(Thermal, chance, {})
    return found


def _damage(keys: dict[str, Any], chance: Chance, faults: str, bearing: Bearing) -> None:
    """Put in the faults that a kernel has, and take out those that it has not."""
    others = [each for each in keys.get("defects", ()) if each.get("kind") == "diameter"]
    for key in ("defects", "waviness", "scatter"):
        keys.pop(key, None)
    patched = {"cup": ("cup",), "everywhere": SURFACES, "all": SURFACES}.get(faults, ())
    for on in patched:
        others += [_patch(chance, on, bearing) for _ in range(int(chance.integers(1, 3)))]
    if faults in ("everywhere", "all"):
        others.append(draw(WornPocket, chance, OWN))
    if faults in ("made", "all"):
        keys["scatter"] = {**draw(Scatter, chance, OWN), "grade": of(("G1", "G2", "G3", "G5"), chance)}
        keys["waviness"] = [{**draw(Waviness, chance, OWN), "on": on} for on in SURFACES]
    if others:
        keys["defects"] = others
    if keys["rows"] == 1:  # there is none but the inboard one
        for each in (*keys.get("defects", ()), *keys.get("waviness", ()), *keys.get("missing_rollers", ())):
            each["row"] = 0


_FIELD_SPALLS = 0.2  # share of them


def _patch(chance: Chance, on: str, bearing: Bearing) -> dict[str, Any]:
    """Draw a patch that fits on a surface; most do not, and each would cost a scene."""
    for _ in range(MOST_TRIES):
        noun = FieldSpall if chance.random() < _FIELD_SPALLS else Patch
        keys = {**draw(noun, chance, OWN), "on": on}
        if on == "roller":
            keys["roller"] = int(chance.integers(FEWEST_ROLLERS))
        patch = valid(noun, keys)
        if patch is not None and not any(
            with_length(patch, bearing.effective_length).contradictions(bearing)
        ):
            return keys
    raise AssertionError(f"{MOST_TRIES} patches do not fit on the {on} of {bearing.name}")


def _place(keys: dict[str, Any], chance: Chance, kernel: Kernel) -> None:
    """Put box, springs and sensors where a kernel has them."""
    mounting = keys.setdefault("mounting", {})
    for key in ("box_centre_mm", "suspension_centre_mm"):
        mounting.pop(key, None)
        if kernel.off_centre:
            mounting[key] = _any_vector(50.0, chance)
    if kernel.off_centre:
        mounting["cup"] = "suspended"
    if kernel.effects == "box":  # mass and inertia are those of its table
        for key in ("box_mass_kg", "box_inertia_kg_m2"):
            mounting.pop(key, None)
        keys["sensors"] = [{"name": "top", "position_mm": [0, 0, 170]}]
    operation = keys["operation"]
    if (
        keys["rows"] == 1 and chance.random() < 0.9
    ):  # without a prop it thrusts the journal out, and is told so
        mounting["axial_prop_stiffness_MN_per_m"] = float(10.0 ** chance.uniform(0.0, 2.0))
    if operation["kind"] == "quarter_vehicle" and operation.get("wheelset") == "coupled":
        operation["wheelset"] = "elastic"  # a journal that bends is a kernel of its own


def _numerics(chance: Chance, tier: str) -> dict[str, Any]:
    fewest = TIERS[tier].smallest_laminae
    laminae = int(chance.integers(fewest, 13)) if chance.random() < 0.95 else int(chance.integers(13, 41))
    return {"laminae": laminae, "steps_per_sample": of(STEPS[tier], chance)}


def _force(chance: Chance, rating: float) -> list[float]:
    """Draw a force [kN] of any direction, most often upwards: a newton to the static rating, or none."""
    if chance.random() < 0.05:
        return [0.0, 0.0, 0.0]
    size = rating * 10.0 ** -chance.uniform(0.0, math.log10(rating / SMALLEST_FORCE))
    if chance.random() < 0.5:
        return [0.0, 0.0, size]
    if chance.random() < 0.3:  # lifted off, or pulled down
        return [0.0, 0.0, -size]
    along = chance.standard_normal(3)
    return [float(each) for each in size * along / np.linalg.norm(along)]


def _speed(chance: Chance) -> float:
    """Draw a shaft speed [rpm]: standing, creeping, usual, or up to what a scene may ask for, either way."""
    kind, sign = chance.random(), 1.0 if chance.random() < 0.7 else -1.0
    if kind < 0.1:
        return 0.0
    if kind < 0.3:
        return sign * float(10.0 ** chance.uniform(-3.0, 1.0))
    if kind < 0.75:
        return sign * float(chance.uniform(10.0, 2500.0))
    return sign * float(chance.uniform(2500.0, MOST_RPM))


def _steps(chance: Chance, rating: float) -> list[dict[str, Any]]:
    time, steps = 0, []
    for _ in range(int(chance.integers(1, 4))):
        level = {"time_s": 1e-3 * time, "force_kN": _force(chance, rating), "speed_rpm": _speed(chance)}
        steps.append(level if chance.random() < 0.7 else {**level, "moment_kN_m": _any_vector(2.0, chance)})
        time += int(chance.integers(10, 40))
    return steps


def _profile(chance: Chance) -> list[dict[str, float]]:
    time, points = 0.0, []
    for _ in range(int(chance.integers(1, 4))):
        points.append({"time_s": time, "speed_kmh": float(chance.uniform(-400.0, 400.0))})
        time += float(chance.uniform(0.01, 2.0))
    return points


def of(options: Any, chance: Chance) -> Any:
    """Take one of some options."""
    return options[int(chance.integers(len(options)))]


def _orders(chance: Chance) -> list[int]:
    count = int(chance.integers(1, 6))
    return sorted({int(10.0 ** chance.uniform(0.0, 3.0)) for _ in range(count)})


def _left_out(_chance: Chance) -> Any:
    return ABSENT


def _named(names: tuple[str, ...], given: float = 1.0) -> Any:
    return lambda chance: of(names, chance) if chance.random() < given else ABSENT


def _within(low: float, high: float, given: float = 1.0) -> Any:
    return lambda chance: float(chance.uniform(low, high)) if chance.random() < given else ABSENT


def _vector(size: float, given: float = 0.3) -> Any:
    return lambda chance: _any_vector(size, chance) if chance.random() < given else ABSENT


def _any_vector(size: float, chance: Chance) -> list[float]:
    return [float(each) for each in chance.uniform(-size, size, 3)]


def _whole(below: int) -> Any:
    return lambda chance: int(chance.integers(below))


# What a declaration leaves open: names, places, forces, and what belongs to no random scene of one box.
OWN: dict[tuple[str, str], Any] = {
    ("Scene", "name"): _left_out,  # written afterwards, as are all that follow
    ("Scene", "purpose"): _left_out,
    ("Scene", "bearing"): _left_out,
    ("Scene", "tier"): _left_out,
    ("Scene", "effects"): _left_out,
    ("Scene", "operation"): _left_out,
    ("Scene", "numerics"): _left_out,
    ("Scene", "duration"): _left_out,
    ("Scene", "lubricant"): _named(LUBRICANTS),
    ("Scene", "accuracy"): _left_out,  # these four belong to what is chosen automatically, which nothing is
    ("Scene", "quantities"): _left_out,
    ("Scene", "vibration_to"): _left_out,
    ("Scene", "axleboxes"): _left_out,  # several of what is tried here
    ("Scene", "rows"): lambda chance: of((1, 2, 2, 2), chance),
    ("ConstantOperation", "moment"): _vector(2.0),
    ("ConstantOperation", "speed"): _speed,
    ("SteppedOperation", "ramp"): _within(0.0, 0.02),
    ("QuarterVehicleOperation", "vehicle"): _named(VEHICLES),
    ("QuarterVehicleOperation", "speed_profile"): _profile,
    ("Irregularity", "kind"): _named(tuple(each for each in IRREGULARITY_KINDS if each not in MEASURED)),
    ("Irregularity", "path"): _left_out,
    ("WheelFlat", "depth"): _left_out,
    ("WheelFlat", "azimuth"): _within(-180.0, 180.0),
    ("WheelPolygon", "azimuth"): _within(-180.0, 180.0),
    ("Corrugation", "end"): _left_out,
    ("DippedJoint", "spacing"): _within(0.5, 30.0, 0.5),
    ("DippedWeld", "spacing"): _within(0.5, 30.0, 0.5),
    ("Patch", "azimuth"): _within(-180.0, 180.0),
    ("Patch", "offset"): _within(-20.0, 20.0, 0.3),
    ("Patch", "length"): _within(0.1, 50.0, 0.6),
    ("Patch", "depth"): lambda chance: float(10.0 ** chance.uniform(-1.5, 3.7)),
    ("Patch", "roller"): _left_out,
    ("FieldSpall", "azimuth"): _within(-180.0, 180.0),
    ("FieldSpall", "width"): lambda chance: float(10.0 ** chance.uniform(-0.3, 1.7)),
    ("FieldSpall", "length"): _left_out,
    ("FieldSpall", "offset"): _within(-20.0, 20.0, 0.3),
    ("FieldSpall", "roller"): _left_out,
    ("Growth", "start"): _within(0.0, 0.05),
    ("Growth", "end"): _within(0.01, 0.1),
    ("RollerError", "roller"): _whole(20),
    ("MissingRoller", "roller"): _whole(20),
    ("WornPocket", "pocket"): _whole(20),
    ("Waviness", "roller"): _left_out,
    ("Waviness", "orders"): _orders,
    ("Waviness", "amplitudes"): _within(0.0, 50.0),
    ("Mounting", "box_centre"): _vector(100.0, 0.2),
    ("Mounting", "suspension_centre"): _vector(200.0, 0.2),
    ("Mounting", "load_offset"): _vector(50.0, 0.2),
    ("Mounting", "axial_prop_stiffness"): _within(0.0, 50.0, 0.5),
    ("Mounting", "axial_prop_damping"): _within(0.0, 50.0, 0.3),
    ("Accelerometer", "name"): lambda chance: f"sensor_{int(chance.integers(10**6))}",
    ("Accelerometer", "position"): _vector(300.0, 0.8),
    ("Accelerometer", "type"): _named(SENSORS, 0.3),
    ("Accelerometer", "rate"): lambda chance: of((3.2, 6.4, 12.8, 25.6, 25.6, 51.2), chance),
    ("Accelerometer", "measured_paths"): _left_out,
    ("Background", "name"): lambda _chance: "background",
    ("Background", "description"): _left_out,
    ("Background", "sources"): _left_out,
}
