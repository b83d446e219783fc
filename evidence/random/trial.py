"""One random scene from its draw to its verdict: finite, or a sentence that says why not."""

from __future__ import annotations

import re
import time
import traceback
import warnings
from dataclasses import dataclass
from functools import reduce
from operator import or_
from typing import Annotated as A
from typing import NamedTuple

import numba
import numpy as np

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.status import SENTENCES, Status, describe
from beardyn_core.physics.tiers.tiers import TIERS
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.study.compiling import warm_once
from evidence.random.scenes import case

FINITE, REPORTS, ENDS, REFUSED, FAILED = "finite", "reports", "ends", "refused", "FAILED"
VERDICTS = {
    FINITE: "went to its end, every number of every block finite, no status bit",
    REPORTS: "the same, with a status bit whose sentence the user sees",
    ENDS: "ended early with a sentence: the model left its validity, or there is no equilibrium",
    REFUSED: "was refused with a sentence when it began: the load of its ride cannot be made",
    FAILED: "a traceback, a number that is none without a status, a status or an end without a sentence",
}
SHORTEST_SENTENCE = 20  # characters


@dataclass(frozen=True)
class Tried:
    """What became of one random scene."""

    number: int
    speed: str
    tier: str
    effects: str
    faults: str
    verdict: str
    says: A[str, "its sentence, or what failed"] = ""
    bits: A[int, "every status bit that was set"] = 0
    blocks: int = 0
    redrawn: A[int, "draws that the configuration refused before it"] = 0
    warned: A[str, "the first warning of a number out of range; empty without one"] = ""
    seconds: A[float, "processor time of drawing and running, [s]"] = 0.0


def tried(number: int, seed: int, speed: str) -> Tried:
    """Draw a scene and run it; nothing that happens in it is raised here.

    Parameters
    ----------
    number, seed : int
    speed : str
        ``fast`` or ``full``, as in `scenes.KERNELS`.
    """
    began = time.process_time()
    drawn = case(number, seed, speed)
    with warnings.catch_warnings(record=True) as received:
        warnings.simplefilter("always")
        found = judged(drawn.scene)
    numeric = [each for each in received if issubclass(each.category, RuntimeWarning)]
    kernel = drawn.kernel
    return Tried(
        number=number,
        speed=speed,
        tier=kernel.tier,
        effects=kernel.effects,
        faults=f"{kernel.faults}{', off centre' if kernel.off_centre else ''}",
        verdict=found.verdict,
        says=found.says,
        bits=found.bits,
        blocks=found.blocks,
        redrawn=len(drawn.refused),
        warned=f"{numeric[0].message} ({_place(numeric[0])})" if numeric else "",
        seconds=round(time.process_time() - began, 4),
    )


class Judged(NamedTuple):
    """What a run came to."""

    verdict: str
    says: str
    bits: int
    blocks: int


def judged(scene: Scene) -> Judged:
    """Run a scene and judge it."""
    blocks = list[Block]()
    verdict, says, told = FINITE, "", True
    try:
        _warm(scene)
        blocks.extend(start(scene).blocks())
    except InputError as error:
        verdict, says = REFUSED, str(error)
    except ValidityError as error:
        verdict, says = ENDS, str(error)
        if isinstance(error.block, Block):
            blocks.append(error.block)
            told = describe(error.block.status) in says
    except Exception:
        verdict, says = FAILED, traceback.format_exc(limit=-3)
    bits = reduce(or_, (block.status for block in blocks), 0)
    lost = sorted({name for block in blocks for name in not_finite(block)})
    if Status(bits) not in Status(sum(SENTENCES)):
        verdict, says = FAILED, f"status {bits} has no sentence"
    elif verdict in (ENDS, REFUSED) and (len(says) < SHORTEST_SENTENCE or not told):
        verdict, says = FAILED, f"ended without the sentence of its status {bits}: {says!r}"
    elif verdict == FINITE and lost:
        verdict, says = FAILED, f"not finite, status {bits}: {', '.join(lost)}"
    elif verdict == FINITE and bits:
        verdict, says = REPORTS, describe(bits)
    return Judged(verdict, says, bits, len(blocks))


def not_finite(block: Block) -> list[str]:
    """List the arrays of a block that hold a number which is none."""
    return [name for name, values in block.arrays().items() if not np.isfinite(values).all()]


def _warm(scene: Scene) -> None:
    """Compile the kernel of a scene, or read it, once in this process."""
    parameters = build_parameters(
        scene,
        Arrangement(scene.bearing.roller_count, LANE_WIDTH, scene.rows, scene.missing_places),
        np.zeros(6),
    )
    warm_once(scene, f"{scene.tier}: {numba.typeof(TIERS[scene.tier].parameters(scene, parameters))}")


def _place(received: warnings.WarningMessage) -> str:
    name = re.sub(r"^.*/(beardyn_core|numpy|scipy)/", r"\1/", str(received.filename))
    return f"{name}:{received.lineno}"
