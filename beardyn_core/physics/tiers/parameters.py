"""Kernel parameters: named tuples of numbers and arrays; an absent effect is ``None``.

Kernels are specialised by the types of these members, so ``None`` compiles to nothing. Every number is a
``float`` and every array is writable and C-contiguous: anything else would be a new specialisation.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.physics.barrel_line import BarrelParams
from beardyn_core.physics.cage.parameters import CageParams
from beardyn_core.physics.contact_damping import DampingParams
from beardyn_core.physics.defect import FaultParams
from beardyn_core.physics.drag import DragParams
from beardyn_core.physics.dry_friction import CoulombParams
from beardyn_core.physics.film import FilmParams
from beardyn_core.physics.flanges import FlangeParams
from beardyn_core.physics.lamina_coupling import CouplingParams
from beardyn_core.physics.rib import RibParams
from beardyn_core.physics.ring_modes import StructureParams
from beardyn_core.physics.rolling_resistance import RollingParams
from beardyn_core.physics.seal import SealParams
from beardyn_core.physics.small_rib import SmallRibParams
from beardyn_core.physics.suspension import MountingParams
from beardyn_core.physics.traction import LoadSharingParams, MixedParams


class RacewayParams(NamedTuple):
    """One raceway: cone angle as sine and cosine, +1 for the cup and -1 for the cone, normal gap [m]."""

    sine: float
    cosine: float
    side: float
    gap: float  # less what the raceway's radius is at the apex, with the sign of the side [m]
    barrel: BarrelParams | None = None  # arcs of spherical roller bearings


class RollerParams(NamedTuple):
    """Rigid roller: mass [kg], inertia about and across the axis [kg m^2], shape [m]."""

    mass: float
    axial_inertia: float
    transverse_inertia: float
    radius: float  # of the cone at the centre of mass
    taper: float  # tangent of the half angle
    apex: float  # axial place of the raceway apex, or of the middle of a cylinder
    half_length: float
    mass_offset: float


class GravityParams(NamedTuple):
    """Free fall."""

    acceleration: float


class AuditParams(NamedTuple):
    """Energy balance is kept."""

    kept: float


class ExplicitParams(NamedTuple):
    """Contact forces of the beginning of the step instead of implicit ones: for references only."""

    taken: float


class HeldParams(NamedTuple):
    """Friction of the raceways that is worked out in every few steps, see `bodies.friction_substeps`."""

    steps: float  # from one time to the next
    memory: Any  # [2 x block + ring, HELD_COEFFICIENT + lamina, lane]


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
    rib: RibParams | None  # of tapered rollers
    flanges: FlangeParams | None  # of cylindrical ones
    small_rib: SmallRibParams | None
    cage: CageParams | None
    structure: StructureParams | None
    seal: SealParams | None
    cage_drag: Any  # parameters of each effect that brakes the cages, see `physics.cage.drag`, or None
    gravity: GravityParams | None
    faults: FaultParams
    audit: AuditParams | None
    timers: Any  # [CYCLES + TIMED_STEPS, TIMER_SLOTS], see `physics.bodies.step_stages`, None without


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
    held: HeldParams | None = None
