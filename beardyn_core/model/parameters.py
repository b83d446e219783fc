"""Kernel parameters: named tuples of numbers and arrays; an absent effect is ``None``.

Kernels are specialised by the types of these members, so ``None`` compiles to nothing. Every number is a
``float`` and every array is writable and C-contiguous: anything else would be a new specialisation.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.model.contact_parameters import (
    CoulombParams,
    CouplingParams,
    DampingParams,
    DragParams,
    FilmParams,
    LoadSharingParams,
    MixedParams,
    RacewayParams,
    RollerParams,
    RollingParams,
)
from beardyn_core.model.fault_parameters import (
    FaultParams,
)
from beardyn_core.model.guide_parameters import (
    CageParams,
    RibParams,
    SmallRibParams,
)


class SealParams(NamedTuple):
    """Both seals on the shaft."""

    torque: float  # [N m]
    speed_coefficient: float  # [N m s/rad]
    regularisation: float  # [rad/s]


class FlexibilityParams(NamedTuple):
    """Bending modes of the cup, from two waves upwards, each in two directions."""

    mass: Any  # [mode], [kg]
    stiffness: Any  # [mode], [N/m]
    damping: Any  # [mode], [N s/m]


class GravityParams(NamedTuple):
    """Free fall."""

    acceleration: float


class AuditParams(NamedTuple):
    """Energy balance is kept."""

    kept: float


class ExplicitParams(NamedTuple):
    """Contact forces of the beginning of the step instead of implicit ones: for references only."""

    taken: float


class EffectParams(NamedTuple):
    """All switchable effects; ``None`` is absent."""

    damping: DampingParams | None
    coupling: CouplingParams | None
    film: FilmParams | None
    coulomb: CoulombParams | None
    mixed: MixedParams | None
    load_sharing: LoadSharingParams | None
    rolling: RollingParams | None
    drag: DragParams | None
    rib: RibParams | None
    small_rib: SmallRibParams | None
    cage: CageParams | None
    ring_flexibility: FlexibilityParams | None
    seal: SealParams | None
    gravity: GravityParams | None
    faults: FaultParams
    audit: AuditParams | None
    timers: Any  # [CYCLES + TIMED_STEPS, TIMER_SLOTS], see `model.stages`, None without


class BoxCoupling(NamedTuple):
    """Box whose centre of mass or whose springs are not at the bearing centre: full matrices about it."""

    mass: Any  # [6, 6]
    inverse_mass: Any  # [6, 6]
    stiffness: Any  # [6, 6]
    damping: Any  # [6, 6]
    weight: Any  # [6], force and moment at 1 m/s^2 of gravity


class MountingParams(NamedTuple):
    """Rings and suspension, world axes."""

    cup_moves: float
    journal_tilts: float
    box_mass: float  # with the cup [kg]
    box_inertia: Any  # [3]
    journal_mass: float  # with the cones [kg]
    journal_inertia: float
    stiffness: Any  # [6], force then moment
    damping: Any  # [6]
    preload: Any  # [6], suspension force at rest
    coupling: BoxCoupling | None
    prop_stiffness: float  # axial, of journal against ground [N/m]
    prop_damping: float  # [N s/m]


class Parameters(NamedTuple):
    """Everything constant during a run."""

    step: float  # [s]
    spring_time: float  # share of the step over which a contact's spring is implicit [s]
    roller: RollerParams
    cup: RacewayParams
    cone: RacewayParams
    laminae: Any  # [row of the table, lamina]
    lamina_loads: Any  # [1, 2 x lamina, lane], work space
    rollers: Any  # [block, ROLLER_CONSTANTS, lane]
    mounting: MountingParams
    effects: EffectParams
    explicit: ExplicitParams | None = None
