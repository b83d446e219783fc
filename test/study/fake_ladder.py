"""A ladder of four levels whose runs have known errors, costs and scatter."""

from __future__ import annotations

import numpy as np

from beardyn_core.config import load_effects
from beardyn_core.scene.scene import Scene
from beardyn_core.study.ladder import climb
from beardyn_core.study.ladder_levels import Level, LevelList
from beardyn_core.study.ladder_result import Ladder
from beardyn_core.study.level_run import Comparison, Run
from beardyn_core.study.measures import MEASURES, Outcome

ASKED = ("force", "deflection", "roller_load", "torque", "vibration")
STANDARD = load_effects("standard")
SIZES = [2 * 20 if measure.weighed else len(measure.parts) for measure in MEASURES]


def level(name: str, tier: str = "full", laminae: int = 6, steps: int = 4) -> Level:
    return Level(name, tier, "standard", STANDARD, laminae, steps)


REFERENCE = level("reference", laminae=20, steps=16)
FAST, MIDDLE = level("fast", "lumped", 1, 1), level("middle", "quasistatic")
EXACT, SLOW = level("exact", steps=7), level("slow", steps=8)
LEVELS = LevelList(REFERENCE, SLOW, (FAST, MIDDLE, EXACT, SLOW))
# wall time per simulated second, error of the torque, level of all bands [dB]
TRUTH = {
    (1, 1): (0.1, 0.5, 4.0),
    (6, 4): (0.3, 0.02, 1.0),
    (6, 7): (1.0, 0.0, 0.0),
    (6, 8): (2.0, 0.0, 0.0),
    (20, 16): (9.0, 0.0, 0.0),
}


class FakeRuns:
    """Outcomes with known errors and a known scatter; the last choice invalid or interrupted if asked."""

    def __init__(
        self, scatter: float = 1e-3, invalid: int | None = None, interrupted: int | None = None
    ) -> None:
        self._generator = np.random.default_rng(5)
        self._scatter, self._invalid, self._interrupted = scatter, invalid, interrupted
        self.scenes: list[Scene] = []

    def __call__(self, scene: Scene, comparison: Comparison) -> Run:
        steps = round(scene.numerics.steps_per_sample)
        self.scenes.append(scene)
        if steps == self._interrupted:
            raise KeyboardInterrupt
        if steps == self._invalid:
            return Run(None, np.array([1.0]), "the run ended at 0.1 s: a number became NaN")
        wall, torque, level = TRUTH[scene.numerics.laminae, steps]
        windows = tuple(self._values(torque, level) for _ in range(5))
        whole = tuple(np.mean([window[i] for window in windows], axis=0) for i in range(len(MEASURES)))
        return Run(Outcome(whole, windows), np.full(5, wall), "complete")

    def _values(self, torque: float, level: float) -> tuple[np.ndarray, ...]:
        return tuple(
            np.full(size, 1.0 + (torque if m.quantity == "torque" else 0.0))
            + (120.0 + level if m.quantity == "vibration" else 0.0)
            + self._scatter * self._generator.standard_normal(size)
            for m, size in zip(MEASURES, SIZES, strict=True)
        )


def climbed(comparison: Comparison, runs: FakeRuns, accuracy: float = 0.05) -> Ladder:
    return climb(comparison, LEVELS, accuracy, ASKED, runner=runs)
