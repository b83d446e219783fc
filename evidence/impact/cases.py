"""The runs of the study: a ringing box at constant speed and load, with one spall or none."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

from beardyn_core.choice import load_scene
from beardyn_core.config import load_bearing
from beardyn_core.effects import ContactDamping, ModalStructure
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import RATES, Accelerometer
from beardyn_core.scene.surface import SHORTEST_WAVE
from beardyn_core.structure.mounted_box import modes_of_effects, mounting_of

BOX = "high_speed"
EFFECTS = "full"
BEARING = "HS130x230"
WHEEL_RADIUS = 0.46  # of emu_300, [m]
HALF = 25e-3  # length of the spall in `cup_spall`, half of the contact, [m]
WHOLE = load_bearing(BEARING).effective_length
DEPTH = 100e-6
DEEP = 400e-6  # no roller that passes falls so far, up to 6 mm
# a charge amplifier behind a piezoelectric accelerometer: 0.05 pC rms (Ono Sokki, CH-1200A) over an assumed
# band of 30 kHz, at 1 pC per m/s^2; range of Bruel & Kjaer type 4391
NOISE, RANGE = 2.9e-4, 20_000.0

WIDTHS = tuple(1e-3 * each for each in (1.0, 2.0, 3.0, 4.0, 6.0, 10.0, 15.0))
SPEEDS = (40.0, 90.0, 200.0, 300.0)
LOADS = tuple(1e3 * each for each in (40.0, 80.0, 120.0))
BOTH = (90.0, 200.0)  # speeds at which everything but the speed is varied, [km/h]
# over which levels are taken, for single speeds beat, [km/h]
SPEED_RANGE = (60.0, 85.0, 120.0, 170.0, 240.0)
SQUARES = tuple((1e-3 * w, 1e-3 * length) for w, length in ((3.0, 10.0), (6.0, 20.0), (15.0, 50.0)))


@dataclass(frozen=True)
class Case:
    """One run; a width of 0 is a healthy bearing."""

    width: A[float, "of the spall in rolling direction, [m]"] = 6e-3
    speed: A[float, "of the train, [km/h]"] = 200.0
    load: A[float, "on the bearing, upwards on the journal, [N]"] = 8e4
    on: A[str, "surface of the spall"] = "cup"
    length: A[float, "of the spall along the roller, [m]"] = HALF
    caged: A[bool, "with cages; without, the rollers keep their distance by themselves"] = True
    damping: A[float | None, "time of the contact damping, the usual one if None, [s]"] = None
    depth: A[float, "of the floor of the spall, [m]"] = DEPTH
    end_play: A[float, "below 0: preload, every roller carries, [m]"] = 1e-4
    shortest_wave: A[float, "where the waves of all surfaces end, [m]"] = SHORTEST_WAVE
    waves: A[bool, "raceways and rollers have waves"] = True
    steps: A[int, "a sample of 25.6 kHz"] = 8
    bearing: A[int, "of the lot; 0 that of the scene"] = 0

    def scene(self) -> Scene:
        """Make the scene of the run, from `cup_spall` with its scatter of grade G1."""
        scene = load_scene("cup_spall", effects=EFFECTS, tier="full")
        effects = replace(scene.effects, structure=ModalStructure(BOX))
        if self.damping is not None:
            effects = replace(effects, contact_damping=ContactDamping(self.damping))
        if not self.caged:
            effects = replace(effects, cage=None)
        modes = modes_of_effects(effects)
        assert modes is not None
        patch = Patch(
            on=self.on, row=0, azimuth=0.0, width=self.width, depth=self.depth, length=self.length
        )  # fmt: skip
        assert scene.scatter is not None
        scatter = replace(scene.scatter, shortest_wave=self.shortest_wave)
        scatter = replace(scatter, seed=self.bearing or scatter.seed)
        if not self.waves:
            scatter = replace(scatter, raceway_waviness=0.0, roller_waviness=0.0)
        return replace(
            scene,
            scatter=scatter,
            end_play=self.end_play,
            name=f"{self.on} {1e3 * self.width:g} mm",
            effects=effects,
            mounting=mounting_of(modes, scene.mounting, scene.bearing),
            operation=ConstantOperation(
                force=(0.0, 0.0, self.load), speed=self.speed / 3.6 / WHEEL_RADIUS
            ),
            defects=(patch,) if self.width > 0.0 else (),
            sensors=(Accelerometer(noise_density=NOISE, range=RANGE, rate=RATES[1]),),
            numerics=replace(scene.numerics, steps_per_sample=self.steps),
        )  # fmt: skip


def over_width(speed: float) -> tuple[Case, ...]:
    """List the widths of a cup spall at a speed [km/h]."""
    return tuple(Case(width, speed) for width in WIDTHS)


def healthy(speed: float, load: float = 8e4) -> Case:
    """Give the run of a healthy bearing beside those at a speed [km/h] and load [N]."""
    return Case(0.0, speed, load)


# what makes strikes of a healthy bearing, taken away one by one
LEFT_OUT: dict[str, Case] = {
    "healthy": healthy(90.0),
    "waves to 1 mm": replace(healthy(90.0), shortest_wave=1e-3),
    "waves to 0.5 mm": replace(healthy(90.0), shortest_wave=5e-4),
    "no cages": replace(healthy(90.0), caged=False),
    "no cages, half the step": replace(healthy(90.0), caged=False, steps=16),
    "no cages, damping of 25 us": replace(healthy(90.0), caged=False, damping=25e-6),
    "no cages, 0.2 mm of preload": replace(healthy(90.0), caged=False, end_play=-2e-4),
    "no cages, no waves": replace(healthy(90.0), caged=False, waves=False),
    "no cages, no waves, 0.2 mm of preload": replace(healthy(90.0), caged=False, waves=False, end_play=-2e-4),
    "no cages, waves to 1 mm": replace(healthy(90.0), caged=False, shortest_wave=1e-3),
    "200 km/h": healthy(200.0),
    "200 km/h, waves to 1 mm": replace(healthy(200.0), shortest_wave=1e-3),
}

OVER_SPEED = tuple(Case(speed=speed) for speed in SPEEDS)
PARTS = ("cup", "cone", "roller")
TIMES = (2.5e-6, 5e-6, 12e-6, 25e-6)  # of the contact damping, its quoted range


def over_load(speed: float) -> tuple[Case, ...]:
    """List the loads of a cup spall at a speed [km/h]."""
    return tuple(Case(speed=speed, load=load) for load in LOADS)


def over_area(speed: float) -> tuple[Case, ...]:
    """List spalls that grow in both directions, as those of a rig do, at a speed [km/h]."""
    return tuple(Case(width, speed, length=length) for width, length in SQUARES)


def across(speed: float, damping: float | None = None) -> tuple[Case, ...]:
    """List spalls over the whole contact, which unload a roller altogether, at a speed [km/h]."""
    return tuple(Case(width, speed, length=WHOLE, damping=damping) for width in WIDTHS if width >= 6e-3)


def over_range(case: Case) -> tuple[Case, ...]:
    """List a case at all speeds of `SPEED_RANGE`."""
    return tuple(replace(case, speed=speed) for speed in SPEED_RANGE)


def _natural(width: float) -> Case:
    return Case(width, length=min(2.0 * width, WHOLE), depth=min(0.1 * width, DEEP))


GROWING: dict[str, tuple[Case, ...]] = {
    "whole contact, deep": tuple(
        Case(width, length=WHOLE, depth=DEEP) for width in (1e-3, 2e-3, 3e-3, 4e-3, 6e-3)
    ),
    "whole contact, 100 um": tuple(Case(width, length=WHOLE) for width in (4e-3, 6e-3, 10e-3)),
    "twice as long, a tenth as deep": tuple(
        _natural(width) for width in (1e-3, 2e-3, 4e-3, 6e-3, 10e-3, 15e-3)
    ),
    "25 mm long, 100 um": tuple(Case(width) for width in (1e-3, 2e-3, 3e-3, 4e-3, 6e-3, 10e-3)),
}
LOADED: dict[str, tuple[Case, ...]] = {
    "6 mm, whole contact": tuple(Case(load=load, length=WHOLE) for load in LOADS),
    "6 mm, 25 mm long": tuple(Case(load=load) for load in LOADS),
}


def ranged() -> list[Case]:
    """List all runs of `GROWING`, `LOADED` and a healthy bearing over `SPEED_RANGE`, each once."""
    kinds = [case for series in (GROWING, LOADED) for cases in series.values() for case in cases]
    return list(dict.fromkeys(each for case in [Case(0.0), *kinds] for each in over_range(case)))


def every() -> list[Case]:
    """List all runs, each once, those first that share kernels."""
    found = [healthy(speed) for speed in SPEEDS]
    found += [healthy(speed, load) for speed in BOTH for load in LOADS]
    found += OVER_SPEED
    for speed in BOTH:
        found += [*over_width(speed), *over_load(speed), *over_area(speed), *across(speed)]
        found += [Case(speed=speed, on=part) for part in PARTS]
    found += [Case(10e-3, length=WHOLE, damping=time) for time in TIMES]
    found += [case for speed in BOTH for case in across(speed, TIMES[0])]
    found += LEFT_OUT.values()
    return list(dict.fromkeys(found))
