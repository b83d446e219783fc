"""Steps of the full tier compiled afresh for a scene, half a minute each, and the size of their code."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numba

from beardyn_core.base.jit import OPTIONS
from beardyn_core.physics.bodies.layout import CONTACT_OUTPUT, OUTPUT_FIELDS
from beardyn_core.physics.tiers.imex import advance
from beardyn_core.scene.scene import Scene
from test.kernels.rig import Float, Rig

ARITHMETIC = re.compile(r"v(add|sub|mul|div|sqrt|max|min|cmp|gather|fn?madd|fn?msub)[0-9a-z]*[sp]d\s")


@dataclass(frozen=True)
class Variant:
    """A run from balance with a kernel that was compiled for it."""

    rig: Rig
    signals: Float
    instructions: int

    def output(self, contact: int, field: int, count: int = 1) -> Float:
        first = CONTACT_OUTPUT + contact * OUTPUT_FIELDS + field
        return self.rig.fields()[first : first + count]


def instruction_count(dispatcher: Any) -> int:
    """Floating-point instructions of the compiled entry, moves and addresses left out."""
    (listing,) = dispatcher.inspect_asm().values()
    return sum(bool(ARITHMETIC.match(line.strip())) for line in listing.splitlines())


def run_afresh(scene: Scene, steps: int) -> Variant:
    """Run a scene from balance under 80 kN with a kernel that is compiled for it."""
    kernel = numba.njit(**OPTIONS)(advance.py_func)
    rig = Rig.at_equilibrium(scene)
    signals, _, _ = rig.run(steps, kernel=kernel)
    return Variant(rig, signals, instruction_count(kernel))
