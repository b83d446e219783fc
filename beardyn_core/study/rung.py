"""A rung of the ladder: one choice of tier, effects, laminae and step for a scene."""

from __future__ import annotations

from dataclasses import dataclass, replace

from beardyn_core.effects import EffectSet
from beardyn_core.scene.scene import Numerics, Scene
from beardyn_core.scene.sensor import RATES


@dataclass(frozen=True)
class Rung:
    """One choice of what a scene is computed with.

    Parameters
    ----------
    name : str
        Names the rung in tables and pictures.
    tier : str
        Name of a tier, see `scene.tier`.
    effects_name : str
        What the set of effects is called.
    effects : EffectSet
    laminae : int
        Of each roller.
    steps_per_sample : float
        Time steps per waveform sample (25.6 kHz), [-].
    """

    name: str
    tier: str
    effects_name: str
    effects: EffectSet
    laminae: int
    steps_per_sample: float

    def applied(self, scene: Scene) -> Scene:
        """The scene with this choice; bearing, load, faults and seed stay, sensors all run at 25.6 kHz.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        Scene
        """
        numerics = Numerics(self.laminae, self.steps_per_sample)
        sensors = tuple(replace(sensor, rate=RATES[0]) for sensor in scene.sensors)
        return replace(scene, tier=self.tier, effects=self.effects, numerics=numerics, sensors=sensors)
