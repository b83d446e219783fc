"""How many rollers of an axlebox bearing carry, as strain gauges on its cup saw them.

Zhao et al. (2026) ran HS130x230 under 80 kN radial and 15 kN axial at 2000 rpm, seven places of either row
instrumented, and moved the load outwards along the axle. Conditions, what counts as loaded, and tolerances
were written before the first run. Ours is the static equilibrium of the scene of `posture`: the box held
against tilt by its rig, rings that bend, end play closed by the temperature; the load is moved towards the
row that the axial force presses, as on the rig.
"""

from __future__ import annotations

from functools import cache, partial

import numpy as np

from beardyn_core.choice.circumstances import circumstances
from beardyn_core.choice.statics import Statics
from evidence.validation.anchor import Anchor
from evidence.validation.posture import Condition, scene_of

TOPIC = "roller loads"
ZHAO = (
    "Zhao et al. 2026, J. Braz. Soc. Mech. Sci. Eng. 48:241, section 5.1, measured by strain gauges: 80 kN, "
    "15 kN axial, 2000 rpm"
)
# The source repeats its loads within 2 % and tells less from noise.
NOTICED: float = 0.02
# Whether a roller stands at the edge of the zone depends on where the set stands.
PLACES = 1.0
MISSES: dict[tuple[float, str], str] = {}


@cache
def loads(eccentricity: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Solve the loads on the cones of the pressed row and of the other, for a load moved by some mm, [N]."""
    scene = scene_of(Condition(eccentricity=eccentricity))
    statics = Statics(scene)
    static = statics.at(circumstances(scene).typical, bending=statics.flexible)
    assert static is not None
    fuller = int(np.argmax(static.cone_load.sum(axis=1)))
    return tuple(static.cone_load[fuller]), tuple(static.cone_load[1 - fuller])


def loaded(eccentricity: float, row: int) -> float:
    """Count the rollers of the pressed row, 0, or the other, 1, that carry noticeably."""
    both = loads(eccentricity)
    return float(np.count_nonzero(np.array(both[row]) > NOTICED * max(map(max, both))))


ANCHORS = tuple(
    Anchor(
        TOPIC,
        f"rollers that carry in the row {name} the axial force, load moved by {eccentricity:g} mm",
        measured,
        "",
        ZHAO,
        partial(loaded, eccentricity, row),
        absolute=PLACES,
        misses=MISSES.get((eccentricity, name), ""),
        measured=True,
    )
    for eccentricity, name, row, measured in (
        (0.0, "pressed by", 0, 5.0),
        (0.0, "relieved by", 1, 5.0),
        (40.0, "pressed by", 0, 7.0),
        (40.0, "relieved by", 1, 5.0),
    )
)
