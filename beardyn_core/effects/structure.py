"""Bending of the axlebox with the cup in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import About


@dataclass(frozen=True)
class RingStructure:
    """Ovalisation of the cup and of the housing wall around it.

    The cup and the wall are two thin rings that bend together without sticking to each other, so their
    bending stiffnesses add.
    """

    kind: ClassVar[str] = "rings"
    about: ClassVar[About] = About(
        loss="structure",
        heat={"axlebox": 1.0},
        adds="Bending of the cup in its housing: it opens under the loaded rollers.",
        states="2 positions and 2 velocities per number of waves, the same for both rows",
        cost="medium",
        validity="Thin ring without stretching or shear, up to a wall of about a fifth of its radius (above "
        "that too stiff); uniform along the axle; the cone on its journal is rigid; sensors see none of it.",
        source="Rayleigh (1894), The theory of sound, art. 233; Roark's formulas for stress and strain, "
        "circular rings, case 1",
    )

    highest_mode: A[int, At(ge=2, le=12), "waves around the circumference, 2 to this number"] = 4
    housing_wall: A[float, At("mm", ge=0.0, le=200.0), "0 for a cup that stands alone"] = 0.025
    housing_modulus: A[float, At("GPa", gt=0.0), "Young's modulus of the housing"] = 170.0e9
    housing_density: A[float, At("kg_per_m3", gt=0.0), "of the housing"] = 7100.0
    stiffness_factor: A[float, At(gt=0.0), "on every mode, for a housing measured or computed"] = 1.0
    damping_ratio: A[float, SHARE, "damping of every mode over the critical one"] = 0.03


@dataclass(frozen=True)
class ModalStructure:
    """The modes of a whole axlebox with the cup in it, from the table that ``beardyn structure`` writes.

    Mass, centre of mass and inertia of the box are those of the table. Rollers bend it at the raceways, the
    suspension at its seats, and accelerometers read its motion at theirs. A cup that is held is held
    everywhere alike: its box rings as a free one.
    """

    kind: ClassVar[str] = "modes"
    about: ClassVar[About] = About(
        loss="structure",
        heat={"axlebox": 1.0},
        adds="Modes of the axlebox: it bends under rollers and springs, and rings where its sensors sit.",
        states="1 position and 1 velocity per mode",
        cost="high",
        validity="Up to the highest free mode of the table; linear; raceways bend in their middle planes and "
        "neither tilt nor turn there; one damping ratio a mode; wheelset, cages and seals see a rigid box.",
        source="Rubin (1975), AIAA J. 13, 995, for the residual modes; "
        "finite elements: docs/evidence/structure.md",
    )

    table: A[
        str,
        At(longest=400),
        "name of a shipped box, or path of a table, ending in .csv, relative to the file that names it",
    ]
    highest: A[
        float | None,
        At("Hz", gt=0.0),
        "what lies above becomes residual modes with the same static bending; all modes when left out",
    ] = None
    stiffness_factor: A[float, At(gt=0.0), "on every mode, for a box measured or unlike its drawing"] = 1.0
    damping_factor: A[float, At(ge=0.0), "on the damping ratio of every mode, for the same"] = 1.0
    content: A[
        str, At(absent=True), "the table itself, packed, as a recording has it; goes before the file"
    ] = ""


Structure = RingStructure | ModalStructure
