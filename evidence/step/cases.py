"""Loads and time steps that the study compares."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

from beardyn_core.config import load_effects
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.physics.tiers.friction_steps import StepChoice
from beardyn_core.physics.tiers.step_choice import AUDIBLE_BAND, choose_steps
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.study.ladder import vary_start
from evidence.standard import standard_scene

EFFECTS = "standard"
LAMINAE = 6
COMPARED_STEPS = tuple(range(1, 9))


@dataclass(frozen=True)
class Point:
    """A steady load.

    Parameters
    ----------
    load : float
        Vertical, [N].
    speed : float
        Of the shaft, [rad/s].
    """

    load: float
    speed: float

    @property
    def name(self) -> str:
        """Such as ``60 kN``."""
        return f"{1e-3 * self.load:g} kN"


POINTS = (Point(6.0e4, 120.0), Point(1.5e5, 180.0))


@dataclass(frozen=True)
class Method:
    """How the time step is taken.

    Parameters
    ----------
    integrator : str
        ``implicit`` or ``explicit``.
    steps : int
        Per sample of 1/25600 s.
    """

    integrator: str
    steps: int

    @property
    def step(self) -> float:
        """[s]."""
        return 1.0 / (WAVEFORM_RATE * self.steps)

    @property
    def name(self) -> str:
        """Such as ``implicit 9.8 us``."""
        return f"{self.integrator} {1e6 * self.step:.2g} us"


REFERENCE = Method("explicit", 391)
# so near to the reference that their runs may be taken together (`unstable`), at a fifth of its cost
BRIDGE = Method("explicit", 78)
# too long for steep friction; the second is as long as implicit steps are
LONG_EXPLICIT = (Method("explicit", 20), Method("explicit", 4))


def scene_of(point: Point, method: Method, number: int = 0, effects: str = EFFECTS) -> Scene:
    """Build the steady scene of the convergence tests; runs of other numbers begin a hair apart."""
    scene = standard_scene("static_80kN")
    scene = replace(
        scene,
        effects=load_effects(effects),
        operation=ConstantOperation(force=(0.0, 0.0, point.load), speed=point.speed),
        mounting=Mounting(),
        sensors=tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors),
        numerics=replace(
            scene.numerics, laminae=LAMINAE, integrator=method.integrator, steps_per_sample=method.steps
        ),
    )
    return vary_start(scene, number)


@cache
def chosen(point: Point) -> dict[str, StepChoice]:
    """Choose the steps by the rule: for vibration up to 10 kHz, and without vibration."""
    scene = scene_of(point, REFERENCE)

    def choice(band: float) -> StepChoice:
        return choose_steps(
            scene.bearing, (point.load, point.load), (point.speed, point.speed), scene.effects,
            laminae=LAMINAE, end_play=scene.end_play, mounting=scene.mounting, band=band,
        )  # fmt: skip

    return {"vibration": choice(AUDIBLE_BAND), "torque": choice(0.0)}


def compared(point: Point, steps: tuple[int, ...] = COMPARED_STEPS) -> tuple[Method, ...]:
    """List every method but the reference, those chosen among them."""
    counts = {*steps, *(int(choice.steps_per_sample) for choice in chosen(point).values())}
    return (BRIDGE, *LONG_EXPLICIT, *(Method("implicit", count) for count in sorted(counts)))
