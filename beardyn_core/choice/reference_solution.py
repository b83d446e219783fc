"""Facts on which the rules decide: the reference scene with its loads, equilibria, losses and costs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated as A

import numpy as np

from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.kinematics import centrifugal_force
from beardyn_core.choice.costs import Costs, measured_costs
from beardyn_core.choice.load_cases import Circumstances, circumstances
from beardyn_core.choice.losses import Losses
from beardyn_core.choice.ringing import Bounce, bounce
from beardyn_core.choice.statics import Statics
from beardyn_core.effects import ModalStructure
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.tiers.step_choice import AUDIBLE_BAND
from beardyn_core.scene.defect import WornPocket, every_patch
from beardyn_core.scene.operation import ConstantOperation, QuarterVehicleOperation, SteppedOperation
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import PASSBAND, RATES

MOST_DB = 20.0
REFERENCE_LAMINAE = 40
_SLICES_FROM = (
    60.0  # turns of the shaft, above which slices can be the loudest: `waviness` at 400 and 1165 rpm
)


@dataclass(frozen=True)
class Difference:
    """What two static solutions differ by."""

    deflection: A[float, "relative to the typical load's, [-]"]
    roller_load: A[float, "relative to the typical load's, [-]"]
    stiffness: A[float, "stiffness along the load over that of the reference, [-]"]

    def influence(self) -> dict[str, float]:
        """Convert to errors of the quantities; vibration changes with the ratio of stiffness."""
        return {
            "deflection": self.deflection,
            "roller_load": self.roller_load,
            "vibration": decibels(self.stiffness),
        }


def decibels(ratio: float) -> float:
    """Convert a ratio of amplitudes to its size in decibels, at most `MOST_DB`, [dB]."""
    if not 0.0 < ratio < math.inf:
        return MOST_DB
    return min(abs(20.0 * math.log10(ratio)), MOST_DB)


def third_octave_end(centre: float) -> float:
    """Compute where the third octave around a frequency [Hz] ends, [Hz]."""
    return 10.0**0.05 * centre


# Change of the torque in runs over the estimate: without film in the pockets 1.7 in smooth_run and 1.4 in
# freight_100, without weight 2.3 in smooth_run (`test/choice/test_verified.py`).
_PRESSED_BY_BOX = 2.4


class Evidence:
    """Facts about a scene in the full tier with the reference's effects, each computed once when asked for.

    Raises
    ------
    ValidityError
        When the typical load has no equilibrium: there is nothing to judge by.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.costs: Costs = measured_costs()
        self.loads: Circumstances = circumstances(scene)
        self.statics = Statics(scene)
        typical = self.statics.at(self.loads.typical, bending=self.statics.flexible)
        if typical is None:
            raise ValidityError(f"{scene.name}: the typical load has no static equilibrium")
        self.typical: StaticSolution = typical
        self.losses = Losses(scene, self.loads.typical, typical)

    @property
    def patches(self) -> tuple[Patch, ...]:
        """Patches on raceways and rollers."""
        return every_patch(self.scene.defects, self.scene.bearing)

    @property
    def patch_shares(self) -> tuple[float, ...]:
        """Part of the contact length that each patch takes, at most 1."""
        length = self.scene.bearing.effective_length
        return tuple(min(patch.length / length, 1.0) for patch in self.patches)

    @property
    def worn_pockets(self) -> tuple[WornPocket, ...]:
        """Worn pockets."""
        return tuple(defect for defect in self.scene.defects if isinstance(defect, WornPocket))

    @property
    def moves(self) -> bool:
        """Whether the axlebox can move, so that there is a vibration."""
        return self.scene.mounting.cup == "suspended"

    @property
    def struck(self) -> bool:
        """Whether wheel or rail has defects that strike."""
        operation = self.scene.operation
        if not isinstance(operation, QuarterVehicleOperation):
            return False
        return bool(operation.wheel_defects or operation.rail_defects)

    @property
    def shaken_by_slices(self) -> bool:
        """Whether slices that meet a raceway one after the other are the loudest that a box rings with.

        No fault, surface, wheel, rail or background shakes its modes at the frequencies that are asked for.
        """
        scene = self.scene
        turns = abs(self.loads.typical.speed) / (2.0 * math.pi)
        if not isinstance(scene.effects.structure, ModalStructure) or self.band <= _SLICES_FROM * turns:
            return False
        steady = isinstance(scene.operation, ConstantOperation | SteppedOperation)
        made = scene.scattered is not None and scene.scattered.made_surface != "none"
        forces = scene.background is not None and scene.background.forces
        return steady and not (made or forces or self.patches)

    @property
    def band(self) -> float:
        """Highest third octave asked of the vibration: what the fastest sensor measures, or less, [Hz]."""
        received = AUDIBLE_BAND * max(sensor.rate for sensor in self.scene.sensors) / RATES[0]
        return min(received, self.scene.vibration_to or received)

    @property
    def edge(self) -> float:
        """Where that third octave ends, or the reception of the fastest sensor, [Hz]."""
        reception = PASSBAND * max(sensor.rate for sensor in self.scene.sensors)
        return min(reception, third_octave_end(self.band))

    @cached_property
    def losses_without_weight(self) -> Losses:
        """Those of rollers without weight, which idle ones do not lay on the cage."""
        return Losses(self.scene, self.loads.typical, self.typical, gravity=0.0)

    @property
    def pressed(self) -> float:
        """Bound what rollers press on their bars over the estimate, which is of idle ones.

        In a box by modes more than 1: between its two lobes of load rollers push the cage.
        """
        return _PRESSED_BY_BOX if isinstance(self.scene.effects.structure, ModalStructure) else 1.0

    @cached_property
    def torque(self) -> float:
        """Torque of the reference under the typical load, [N m]."""
        return self.losses.total

    @property
    def torque_of_rigid_cup(self) -> float:
        """Torque of the reference with a rigid cup, [N m]."""
        rigid = self.statics.at(self.loads.typical)
        return self.torque if rigid is None else Losses(self.scene, self.loads.typical, rigid).total

    def slipping(self, orbit: float) -> dict[str, float]:
        """Compute the errors that an error of the orbit speed causes, by centrifugal force of the rollers."""
        force = centrifugal_force(self.scene.bearing, self.loads.typical.speed)
        share = 2.0 * orbit * force / max(self.typical.largest_roller_load, 1.0e-3)
        return {"cage_speed": orbit, "roller_load": share, "deflection": share}

    def torque_share(self, torque: float) -> float:
        """Compute the ratio of a torque to that of the reference; 0 with the shaft at rest."""
        return abs(torque) / self.torque if self.torque > 0.0 else 0.0

    @cached_property
    def stiffness(self) -> float:
        """Stiffness of the bearing along the typical load, [N/m]."""
        return max(self.along_load(self.typical), 1.0)

    def along_load(self, static: StaticSolution) -> float:
        """Compute the stiffness along the typical load, [N/m]."""
        force = np.asarray(self.loads.typical.force)
        size = float(np.linalg.norm(force))
        direction = force / size if size > 0.0 else np.array([0.0, 0.0, 1.0])
        return float(direction @ static.stiffness_tilt_free @ direction)

    @cached_property
    def bounce(self) -> Bounce:
        """Resonance of axlebox and cup on the stiffness of the bearing, and on the axle where that bends."""
        bending = bounce(self.scene, self.typical, np.asarray(self.loads.typical.force))
        if bending is not None:
            return bending
        box = self.scene.mounting.box_mass + self.scene.bearing.cup_mass
        journal = self.scene.mounting.journal_mass + self.scene.bearing.cone_mass
        reduced = box * journal / (box + journal)
        return Bounce(math.sqrt(self.stiffness / reduced) / (2.0 * math.pi), 1.0, 0.0)

    def difference(
        self, first: dict[str, object], second: dict[str, object], heavy: bool = False
    ) -> Difference:
        """Find the largest difference between two solutions over the load cases; `heavy`: of the heaviest."""
        cases = self.loads.cases
        if heavy:
            cases = (max(cases, key=lambda case: case.size),)
        deflection_scale = max(float(np.linalg.norm(self.typical.displacement)), 1.0e-9)
        load_scale = max(self.typical.largest_roller_load, 1.0e-3)
        found = Difference(0.0, 0.0, 1.0)
        for case in cases:
            one = self.statics.at(case, **first)  # type: ignore[arg-type]
            two = self.statics.at(case, **second)  # type: ignore[arg-type]
            if one is None or two is None:
                continue
            ratio = self.along_load(one) / max(self.along_load(two), 1.0)
            farther = abs(math.log(max(ratio, 1.0e-9))) > abs(math.log(found.stiffness))
            found = Difference(
                max(
                    found.deflection,
                    float(np.linalg.norm(one.displacement - two.displacement)) / deflection_scale,
                ),
                max(found.roller_load, abs(one.largest_roller_load - two.largest_roller_load) / load_scale),
                max(ratio, 1.0e-9) if farther else found.stiffness,
            )
        return found
