"""Static equilibrium of both rows, or of one: every roller between cup, cone and ribs.

Unknown are the displacement of the cone relative to the cup and, when it is free, its tilt about x and z,
and the amplitudes of the modes of the box when it is not rigid. A spherical roller bearing leaves the tilt
open: nothing depends on it. The rollers follow (`roller_equilibrium`);
what is left is a nearly convex problem in three or five unknowns and one for each mode.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.one_thread import in_one_thread
from beardyn_core.bearing.consistency import require_sound
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import MOST_END_PLAY, Bearing
from beardyn_core.bearing.roller_bearing import ROW_COUNT, RollerBearing
from beardyn_core.effects import LaminaCoupling
from beardyn_core.physics.hertz_pressure import pressure_law
from beardyn_core.physics.lamina_table import lamina_pressure
from beardyn_core.physics.modal_body import ModalBody
from beardyn_core.physics.statics.possible_loads import (
    ACCEPTABLE,
    ACCEPTABLE_FORCE,
    require_held,
    require_possible,
)
from beardyn_core.physics.statics.roller_contacts import ConePose, ContactModel, contact_model
from beardyn_core.physics.statics.roller_equilibrium import RollerState, solve_rollers

Place = tuple[tuple[float, ...], tuple[float, ...]]
"""Of the cone with the bending of the box, and of every roller: a point to begin a search at."""

TILT_MODES = ("locked", "free")

_ITERATIONS = 300
_TOLERANCE = 1.0e-11
_ROUNDING_FORCE = 1.0e-8
# Longest step of the cone; it also carries a cone that touches nothing through its play.
_LONGEST_STEP = 1.0e-4
_REFERENCE_STIFFNESS = 1.0e9
_DAMPING, _DAMPING_NEAR = 10.0, 1.0e-4  # first, of a search from nowhere and from a place near by
# A pose in which a roller is out of balance by this share of the largest load is one that rollers have no
# place in; a search that meets more of them than this, one after the other, finds none.
_OUT_OF_BALANCE = 1.0e-3
_MOST_OUT_OF_BALANCE = 10
# Beyond its play a cone gives way by up to 0.02 of the pitch diameter along the axle under what it can bear;
# one that is farther off drives away, into poses that no contact law is for and that cost the most.
_FARTHEST = 0.03


@dataclass(frozen=True)
class StaticSolution:
    """Static equilibrium, axlebox frame.

    Parameters
    ----------
    displacement : float64 array, shape [3]
        Cone relative to cup at the bearing centre, [m].
    tilt : float64 array, shape [2]
        Rotation of the cone about x and z, [rad].
    cup_load, cone_load, rib_load : float64 arrays, shape [row, roller]
        Contact forces of each roller, laminae summed; the last with the ribs of the cone, [N].
    cup_lamina_load, cone_lamina_load : float64 arrays, shape [row, roller, lamina]
        Contact forces of the laminae, from the small to the large end, [N].
    roller_radial, roller_axial : float64 arrays, shape [row, roller]
        Displacement of the roller's mid-length from its nominal place, where it touches both raceways
        and the rib without end play (a cylinder the cone, half-way between its ribs): radial outwards, axial
        outwards along its row, [m]; of barrels against the cone.
    roller_tilt : float64 array, shape [row, roller]
        Rotation of the roller axis in its meridian plane, + when the large end moves outwards, [rad].
    stiffness_tilt_held, stiffness_tilt_free : float64 arrays, shape [3, 3]
        Change of the load with the displacement, tilt of the cone held or following, [N/m]; one and the same
        for spherical roller bearings, whose tilt the axle alone holds.
    iterations : int
        Newton steps of the cone.
    residual : float
        What is left of the load, [N].
    bending : float64 array, shape [mode]
        Amplitudes of the modes of the box, [m sqrt(kg)].
    cup_rib_load : float64 array, shape [row, roller]
        Contact forces of the roller ends with ribs of the cup, [N]; empty where it has none.
    cup_pressure, cone_pressure, rib_pressure : float64 arrays, shape [row, roller]
        Largest Hertz pressure of each roller on cup, cone and rib of the cone, [Pa]: of the slice that is
        pressed hardest. With one slice the load is spread evenly along the roller; some 40 of them show what
        tilt, profile and, where they are coupled, edges add. NaN of ribs that the cone lacks.

    Notes
    -----
    A roller between rings with play that touches nothing is placed against cup and rib, which is where a
    turning bearing carries it.
    """

    displacement: Float
    tilt: Float
    cup_load: Float
    cone_load: Float
    rib_load: Float
    cup_lamina_load: Float
    cone_lamina_load: Float
    roller_radial: Float
    roller_axial: Float
    roller_tilt: Float
    stiffness_tilt_held: Float
    stiffness_tilt_free: Float
    iterations: int
    residual: float
    bending: Float = field(default_factory=lambda: np.zeros(0))
    cup_rib_load: Float = field(default_factory=lambda: np.zeros((0, 0)))
    cup_pressure: Float = field(default_factory=lambda: np.zeros((0, 0)))
    cone_pressure: Float = field(default_factory=lambda: np.zeros((0, 0)))
    rib_pressure: Float = field(default_factory=lambda: np.zeros((0, 0)))

    @property
    def place(self) -> Place:
        """Where cone and rollers are, for a search near by."""
        rollers = np.stack([self.roller_radial, self.roller_axial, self.roller_tilt], axis=-1)
        cone = (*self.displacement.tolist(), *self.tilt.tolist(), *self.bending.tolist())
        return cone, tuple(rollers.ravel().tolist())

    @property
    def loaded_roller_count(self) -> tuple[int, ...]:
        """Count the rollers of each row that the cone presses."""
        return tuple(np.count_nonzero(self.cone_load > 0.0, axis=1).tolist())

    @property
    def largest_roller_load(self) -> float:
        """Find the largest load between a roller and the cup, [N]."""
        return float(self.cup_load.max())

    @property
    def largest_pressure(self) -> float:
        """Find the largest Hertz pressure between a roller and a raceway, [Pa]."""
        return float(max(self.cup_pressure.max(initial=0.0), self.cone_pressure.max(initial=0.0)))

    def __repr__(self) -> str:
        """Give displacement and roller loads in one line."""
        x, y, z = self.displacement * 1e6
        return (
            f"StaticSolution: cone displaced by {x:.4g}, {y:.4g}, {z:.4g} um along x, y, z; "
            f"{sum(self.loaded_roller_count)} of {self.cup_load.size} rollers carry, at most "
            f"{self.largest_roller_load * 1e-3:.4g} kN, {self.largest_pressure * 1e-9:.3g} GPa"
        )


@in_one_thread
def solve(
    bearing: RollerBearing,
    force: ArrayLike,
    moment: ArrayLike = (0.0, 0.0, 0.0),
    *,
    end_play: float | None,
    tilt: str = "locked",
    laminae: int = 1,
    speed: float = 0.0,
    roller_phase: float = 0.0,
    coupling: LaminaCoupling | None = None,
    oversize: Float | None = None,
    body: ModalBody | None = None,
    modal_load: ArrayLike = (),
    tilt_stiffness: ArrayLike = (0.0, 0.0),
    axial_stiffness: float = 0.0,
    rows: int = ROW_COUNT,
    missing: Sequence[tuple[int, int]] = (),
    crown: ArrayLike | None = None,
    near: Place | None = None,
) -> StaticSolution:
    """Find the static equilibrium under a load on the cone.

    Parameters
    ----------
    force, moment : array_like, shape [3]
        On the cone at the bearing centre, axlebox frame, [N], [N m]. The component of the moment about
        the axle is the shaft's and must be 0; the others matter only when tilt is free.
    end_play : float or None
        Total axial travel, negative for preload, [m]; ``None``: that of the bearing. With the cone centred
        each row of tapered rollers has the normal gap end_play/2 sin(cup angle), which lies between roller
        and cup; cylinders have it at their ribs, and barrels have none of their own.
    tilt : str
        ``locked`` or ``free``: tilt of the cone against the cup.
    laminae : int
        Laminae of each raceway contact. With 1 the rollers do not tilt; barrels need some.
    speed : float
        Shaft speed for centrifugal force and gyroscopic moment of the rollers at epicyclic speed, [rad/s].
    roller_phase : float
        Azimuth of roller 0 of both rows, [rad].
    coupling : LaminaCoupling or None
        Coupling of the laminae along the rollers.
    oversize : float64 array, shape [row, roller], optional
        Radius error of each roller, [m].
    body : ModalBody or None
        How the box bends; without it the cup is rigid.
    modal_load : array_like, shape [mode]
        What else but the rollers pushes its modes, [N/sqrt(kg)].
    tilt_stiffness : array_like, shape [2]
        Of whatever restrains the free tilt of the cone against the cup about x and z, [N m/rad].
    axial_stiffness : float
        Of a prop that holds the cone against the cup along the axle, [N/m].
    rows : int
        2, or 1 for row 0 alone; a cone leans on it towards +y only, cylinders as their ribs hold them.
    missing : sequence of pairs of int
        Row and roller of those that are not there; their loads are 0.
    crown : array_like, shape [row, roller], optional
        Error of each roller's profile: drop over the squared distance from mid-length, [1/m].
    near : Place or None
        Of an equilibrium under nearly the same conditions, where the search begins: it takes fewer steps.

    Raises
    ------
    InputError
        When an argument makes no sense, all of them at once.
    ValidityError
        When no equilibrium is found.

    Notes
    -----
    Without friction. A cage holds the rollers along the pitch circle; what little force that takes when the
    cone is off centre (1e-4 of the roller load) is not part of the balance of the rollers. The tangent
    stiffness leaves out the turning of the normals, which is smaller by the same order.
    """
    if isinstance(bearing, CylindricalBearing) and end_play is not None:
        bearing = replace(bearing, end_play=end_play)
    if end_play is None or not isinstance(bearing, Bearing):
        end_play = bearing.end_play if isinstance(bearing, Bearing) else 0.0
    load = _checked_load(force, moment, end_play, tilt, laminae, speed, roller_phase)
    require_sound(bearing)
    require_possible(bearing, load, laminae, coupling)
    modal = np.zeros(0) if body is None else body.stiffness
    springs = np.concatenate(
        [[0.0, axial_stiffness, 0.0], np.asarray(tilt_stiffness, dtype=np.float64), modal]
    )
    model = contact_model(
        bearing, end_play, laminae, speed, roller_phase, coupling, oversize, body, rows, missing,
        crown,
    )  # fmt: skip
    require_held(model, load, axial_stiffness)
    moving = 5 if tilt == "free" and not bearing.self_aligning else 3
    load = np.concatenate([load, np.asarray(modal_load, dtype=np.float64)])
    cone = _Cone(model, load, moving, springs)
    farthest = np.full(5, _FARTHEST * bearing.pitch_diameter + abs(end_play))
    if axial_stiffness > 0.0:  # a prop gives way under load and thrust, which opens the rows across, too
        backed = float(np.abs(load[:3]).sum()) / axial_stiffness
        farthest[:3] += backed * np.array([math.tan(bearing.cup_angle), 1.0, math.tan(bearing.cup_angle)])
    try:
        state, unknowns, iterations = _equilibrium(cone, farthest, near)
    except ValidityError:
        if near is None:
            raise
        state, unknowns, iterations = _equilibrium(cone, farthest, None)
    residual = cone.residual(unknowns, state)
    held, free = _stiffness(_bending_follows(state.cone_stiffness + np.diag(springs)))
    free = held.copy() if bearing.self_aligning else free
    return StaticSolution(
        displacement=unknowns[:3].copy(),
        tilt=unknowns[3:5].copy(),
        cup_load=state.cup.force.sum(axis=-1),
        cone_load=state.cone.force.sum(axis=-1),
        rib_load=state.rib.force.sum(axis=-1),
        cup_lamina_load=state.cup.force.copy(),
        cone_lamina_load=state.cone.force.copy(),
        roller_radial=state.position[..., 0].copy(),
        roller_axial=state.position[..., 1].copy(),
        roller_tilt=state.position[..., 2].copy(),
        stiffness_tilt_held=held,
        stiffness_tilt_free=free,
        iterations=iterations,
        residual=float(np.abs(residual).max()),
        bending=unknowns[5:].copy(),
        cup_rib_load=np.zeros((0, 0)) if state.cup_rib is None else state.cup_rib.force.sum(axis=-1),
        cup_pressure=lamina_pressure(bearing, state.cup.force, "cup").max(axis=-1),
        cone_pressure=lamina_pressure(bearing, state.cone.force, "cone").max(axis=-1),
        rib_pressure=pressure_law(bearing, "rib").of(state.rib.force.sum(axis=-1)),
    )


class _Cone:
    """Energy of the loaded cone and of the springs on it as a function of its pose and the box's bending."""

    def __init__(self, model: ContactModel, load: Float, moving: int, springs: Float) -> None:
        self.model = model
        self.load = np.concatenate([load, np.zeros(springs.size - load.size)])
        self.springs = springs
        self.active = np.concatenate([np.arange(moving), np.arange(5, springs.size)])
        lever = model.bearing.tilt_lever
        # modes count as far as they open a raceway, so that steps and residuals are metres and newtons
        modal = np.sqrt((model.bending**2).mean(axis=(0, 1)))
        self.scale = np.concatenate([[1.0, 1.0, 1.0, lever, lever], np.maximum(modal, 1e-3)])

    def at(self, unknowns: Float, guess: Float | None) -> RollerState:
        pose = ConePose(unknowns[:3], _rotation(unknowns[3], unknowns[4]), unknowns[5:])
        return solve_rollers(self.model, pose, guess)

    def energy(self, unknowns: Float, state: RollerState) -> float:
        stored = 0.5 * float(self.springs @ unknowns**2)
        return state.energy + stored - float(self.load @ unknowns)

    def residual(self, unknowns: Float, state: RollerState) -> Float:
        """Load that is not balanced, moments as forces at the pressure centres; shape [active]."""
        left = self.load + state.cone_force - self.springs * unknowns
        return np.asarray((left / self.scale)[self.active])

    def off(self, unknowns: Float) -> Float:
        """Work out how far off its place the cone is, tilt as motion at the pressure centres, [5], [m]."""
        return np.asarray(np.abs((unknowns * self.scale)[:5]))

    def step(self, unknowns: Float, state: RollerState, damping: float) -> Float:
        """Take a damped Newton step of the unknowns, no longer than the longest step."""
        active = self.active
        scaled = (state.cone_stiffness + np.diag(self.springs)) / np.outer(self.scale, self.scale)
        matrix = scaled[np.ix_(active, active)] + damping * _REFERENCE_STIFFNESS * np.eye(active.size)
        step = np.linalg.solve(matrix, self.residual(unknowns, state))
        length = float(np.linalg.norm(step))
        if length > _LONGEST_STEP:
            step *= _LONGEST_STEP / length
        full = np.zeros(self.scale.size)
        full[active] = step / self.scale[active]
        return full


def _equilibrium(cone: _Cone, farthest: Float, near: Place | None) -> tuple[RollerState, Float, int]:
    """Find the pose of the cone at which the load is balanced, no farther off than ``farthest``, [5], [m]."""
    unknowns, rollers, damping = np.zeros(cone.scale.size), None, _DAMPING
    if near is not None:
        unknowns, damping = np.array(near[0]), _DAMPING_NEAR
        rollers = np.reshape(near[1], (*cone.model.radial.shape[:2], 3))
    state = cone.at(unknowns, rollers)
    energy = cone.energy(unknowns, state)
    stalled = lost = 0
    smallest = math.inf
    for iteration in range(_ITERATIONS):
        size = float(np.abs(cone.residual(unknowns, state)).max())
        smallest = min(smallest, size)
        scale = float(np.abs(cone.load / cone.scale).max()) + 0.1 * float(state.cup.force.sum())
        if size <= _TOLERANCE * scale + _ROUNDING_FORCE or (
            (stalled > 3 or iteration > 60) and size <= ACCEPTABLE * scale + ACCEPTABLE_FORCE
        ):
            return state, unknowns, iteration
        if np.any(cone.off(unknowns) > farthest) or lost > _MOST_OUT_OF_BALANCE:
            break
        step = cone.step(unknowns, state, damping)
        moved = unknowns + step
        guess = state.position + state.follow @ step
        trial = cone.at(moved, guess)
        lost = lost + 1 if trial.residual > _OUT_OF_BALANCE * trial.cup.force.sum(axis=-1).max() else 0
        trial_energy = cone.energy(moved, trial)
        # one that is only smaller than the last leads in circles, with steps that lower the energy in between
        smaller = float(np.abs(cone.residual(moved, trial)).max()) < smallest
        lower = trial_energy < energy - 1.0e-12 * abs(energy)
        if lower or smaller:
            unknowns, state, energy = moved, trial, trial_energy
            damping = max(0.1 * damping, 1.0e-12)
            stalled = 0
        else:
            damping = min(20.0 * damping, 1.0e6)
            stalled += 1
    force = np.array2string(cone.load[:3], precision=1)
    placeless = ", where rollers have no place," if lost > _MOST_OUT_OF_BALANCE else ""
    bearing = cone.model.bearing
    raise ValidityError(
        f"static equilibrium of {bearing.name} under {force} N was not found: after "
        f"{iteration + 1} steps the cone is {1e3 * cone.off(unknowns).max():.2g} mm off its place{placeless} "
        f"and {size:.3g} N are left. Check load, {bearing.play_words} and tilt; a moment needs free "
        f"tilt and both rows in contact; {bearing.single_row_hint}."
    )


def _rotation(about_x: float, about_z: float) -> Float:
    """Make the rotation by the vector (about_x, 0, about_z), [rad]."""
    angle = math.hypot(about_x, about_z)
    cross = np.array([[0.0, -about_z, 0.0], [about_z, 0.0, -about_x], [0.0, about_x, 0.0]])
    first = float(np.sinc(angle / math.pi))
    second = 0.5 * float(np.sinc(0.5 * angle / math.pi)) ** 2
    return np.asarray(np.eye(3) + first * cross + second * (cross @ cross))


def _bending_follows(stiffness: Float) -> Float:
    """Reduce the stiffness to the cone pose with the bending of the box following, shape [5, 5]."""
    pose, coupling, bending = stiffness[:5, :5], stiffness[:5, 5:], stiffness[5:, 5:]
    if bending.size == 0:
        return pose
    return np.asarray(pose - coupling @ np.linalg.solve(bending, coupling.T))


def _stiffness(stiffness: Float) -> tuple[Float, Float]:
    """Reduce the stiffness to displacement, with tilt held and with tilt following."""
    held = stiffness[:3, :3]
    coupling, tilting = stiffness[:3, 3:], stiffness[3:, 3:]
    free = held - coupling @ np.linalg.pinv(tilting, hermitian=True) @ coupling.T
    return held.copy(), 0.5 * (free + free.T)


def _checked_load(
    force: ArrayLike,
    moment: ArrayLike,
    end_play: float,
    tilt: str,
    laminae: int,
    speed: float,
    roller_phase: float,
) -> Float:
    """Load as (force, moment about x and z); refuses what makes no sense, all at once."""
    force, moment = np.asarray(force, dtype=np.float64), np.asarray(moment, dtype=np.float64)
    problems = []
    for name, vector in (("force", force), ("moment", moment)):
        if vector.shape != (3,) or not np.isfinite(vector).all():
            problems.append(f"{name} is {vector.tolist()}; three finite numbers are needed.")
    if not problems and moment[1] != 0.0:
        problems.append(f"moment about the axle is {moment[1]:g} N m; without friction it must be 0.")
    if not (math.isfinite(end_play) and abs(end_play) <= MOST_END_PLAY):
        problems.append(f"end_play is {end_play:g} m; it must lie within +-{MOST_END_PLAY:g} m.")
    if tilt not in TILT_MODES:
        problems.append(f"tilt is {tilt!r}; allowed are {', '.join(TILT_MODES)}.")
    if not (isinstance(laminae, int | np.integer) and 1 <= laminae <= 1000):
        problems.append(f"laminae is {laminae!r}; a whole number from 1 to 1000 is needed.")
    for name, value in (("speed", speed), ("roller_phase", roller_phase)):
        if not math.isfinite(value):
            problems.append(f"{name} is {value:g}; a finite number is needed.")
    if problems:
        raise InputError(problems)
    return np.array([*force, moment[0], moment[2]])
