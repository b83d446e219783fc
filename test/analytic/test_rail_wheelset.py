"""Modes of a wheelset: closed forms, a transfer matrix, the dense beam, the rigid limit, what it refuses."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

from beardyn_core.base.errors import InputError
from beardyn_core.config import load_vehicle
from beardyn_core.rail import wheelset as subject
from beardyn_core.rail.build import RIDE_RATE, load_history
from beardyn_core.rail.vehicle import BODY, BOGIE, BOX, WHEEL, QuarterVehicle, quarter_vehicle, ride
from beardyn_core.rail.wheelset import DENSITY, SHEAR, YOUNG, Shaft, bending, half_shaft, torsion
from beardyn_core.scene.excitation import WheelFlat, WheelPolygon
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation
from beardyn_core.scene.wheelset import Wheelset
from test.analytic.rail_rides import ride_of
from test.examples import fast_ones

STEP = 1.0 / RIDE_RATE
MOUNTING = Mounting()
SMOOTH = QuarterVehicleOperation(
    load_vehicle("emu_300"), Irregularity("none"), ((0.0, 55.0),), wheelset="elastic"
)
RIGID = dataclasses.replace(SMOOTH, wheelset="rigid")


def half_of(
    operation: QuarterVehicleOperation = SMOOTH, mounting: Mounting = MOUNTING, box: float = 0.0
) -> Shaft:
    half = half_shaft(operation, mounting, box)
    assert half is not None
    return half


def bare(length: float, diameter: float) -> Shaft:
    """Half of a uniform bar."""
    node = np.linspace(0.0, 0.5 * length, 61)
    none = np.zeros(0)
    return Shaft(node, np.full(60, diameter), 0.0, 0.0, none.astype(int), none, none, 60, 60)


@pytest.mark.parametrize(
    ("symmetric", "roots"), [(True, (4.730041, 10.995608)), (False, (7.853205, 14.137166))]
)
def test_a_slender_bar_has_the_frequencies_of_euler(symmetric, roots):
    modes = bending(bare(2.0, 0.01), 1.0, symmetric)
    section = 0.01 / 4.0  # radius of gyration
    for frequency, root in zip(modes.frequency, roots, strict=False):
        euler = (root / 2.0) ** 2 * section * np.sqrt(YOUNG / DENSITY) / (2 * np.pi)
        assert frequency == pytest.approx(euler, rel=1e-3)


def test_a_bar_twists_as_a_wave():
    modes = torsion(bare(2.0, 0.1))
    for frequency, halves in zip(modes.frequency, (1, 3), strict=False):
        assert frequency == pytest.approx(halves * np.sqrt(SHEAR / DENSITY) / 4.0, rel=1e-3)


def end_forces(half: Shaft, frequency: float, symmetric: bool) -> float:
    """Determinant of the forces at the free end, from the exact solution of each element; 0 for a mode."""
    square = (2 * np.pi * frequency) ** 2
    # displacement, tilt, moment, shear; two of them are free in the middle
    state = np.eye(4)[:, [0, 2] if symmetric else [1, 3]]
    for node, length in enumerate([*np.diff(half.node), 0.0]):
        for body in np.flatnonzero(half.place == node):
            state[2] -= 0.5 * half.polar[body] * square * state[1]
            state[3] -= half.mass[body] * square * state[0]
        if length == 0.0:
            break
        outer, inner = half.outer[node], half.bore
        area, second = np.pi / 4 * (outer**2 - inner**2), np.pi / 64 * (outer**4 - inner**4)
        shears = SHEAR * subject._shear_share(inner / outer) * area
        along = np.array(
            [
                [0.0, 1.0, 0.0, 1.0 / shears],
                [0.0, 0.0, 1.0 / (YOUNG * second), 0.0],
                [0.0, -DENSITY * second * square, 0.0, -1.0],
                [-DENSITY * area * square, 0.0, 0.0, 0.0],
            ]
        )
        state = expm(along * length) @ state
    return float(np.linalg.det(state[2:] / np.array([[1e6], [1e6]])))


@pytest.mark.parametrize("symmetric", [True, False])
def test_modes_of_a_wheelset_are_those_of_its_transfer_matrix(symmetric):
    """The same beam and bodies by another method, without interpolation within elements."""
    half = half_of(box=0.0 if symmetric else 100.0)
    modes = bending(half, 900.0, symmetric)
    for frequency in modes.frequency[:5]:
        root = brentq(lambda f: end_forces(half, f, symmetric), 0.995 * frequency, 1.005 * frequency)
        assert frequency == pytest.approx(root, rel=2e-3)


def test_another_mesh_gives_the_same_modes(monkeypatch):
    coarse = bending(half_of(), 900.0, symmetric=True).frequency[:6]
    monkeypatch.setattr(subject, "_LONGEST_ELEMENT", 0.005)
    fine = bending(half_of(), 900.0, symmetric=True).frequency[:6]
    assert coarse == pytest.approx(fine, rel=2e-3)


@pytest.mark.parametrize(
    ("name", "total"), [("emu_300", 900.0), ("passenger_coach", 900.0), ("freight_y25", 675.0)]
)
def test_the_half_wheelset_has_the_mass_of_the_mounting(name, total):
    """The wheel has what axle and discs leave, and that is what a wheel may weigh."""
    operation = dataclasses.replace(SMOOTH, vehicle=load_vehicle(name))
    half = half_of(operation, dataclasses.replace(MOUNTING, journal_mass=total))
    _, mass = subject.beam_matrices(half)
    rigid = np.zeros(len(mass))
    rigid[0::2] = 1.0
    assert rigid @ mass @ rigid == pytest.approx(total, rel=1e-12)
    assert 300.0 < half.mass[-2] < 650.0


class DenseBeam:
    """The vehicle on its rail with every node of the half axle, for small oscillations."""

    def __init__(self, operation: QuarterVehicleOperation) -> None:
        self.vehicle: QuarterVehicle = quarter_vehicle(operation, MOUNTING)
        self.half = half_of(operation)
        beam_stiffness, beam_mass = subject.beam_matrices(self.half)
        keep = [n for n in range(len(beam_mass)) if n != 1]
        self.wheel = 3 + keep.index(2 * self.half.wheel)
        self.journal = 3 + keep.index(2 * self.half.journal)
        self.tilt = self.journal + 1
        count = 3 + len(keep)
        # body, bogie, box, then the axle
        order = [BODY, BOGIE, BOX]
        self.mass, stiffness, damping = np.zeros((3, count, count))
        self.mass[:3, :3] = np.diag(self.vehicle.mass[order])
        self.mass[3:, 3:] = beam_mass[np.ix_(keep, keep)]
        stiffness[3:, 3:] = beam_stiffness[np.ix_(keep, keep)]
        rigid = quarter_vehicle(dataclasses.replace(operation, wheelset="rigid"), MOUNTING)
        place = [0, 1, self.journal, 2]  # of BODY, BOGIE, WHEEL, BOX
        stiffness[np.ix_(place, place)] += rigid.stiffness
        damping[np.ix_(place, place)] += rigid.damping
        self.stiffness, self.damping = stiffness, damping

    def response(self, frequency: float) -> tuple[complex, complex, complex]:
        """Contact force, journal and tilt per unit of a small waviness of the rail."""
        omega = 2 * np.pi * frequency
        dynamic = self.stiffness + 1j * omega * self.damping - omega**2 * self.mass
        give = np.linalg.solve(dynamic, np.eye(len(dynamic))[self.wheel])
        vehicle = self.vehicle
        contact = 1.5 * vehicle.static_force ** (1 / 3) / vehicle.contact_flexibility
        force = 1.0 / (1.0 / contact + vehicle.rail.receptance(frequency) + give[self.wheel])
        return force, force * give[self.journal], force * give[self.tilt]


def measured(vehicle: QuarterVehicle, frequency: float) -> tuple[complex, complex, complex]:
    """The same of a ride over a wave of 10 nm, as its last second has it."""
    time = np.arange(int(14.0 / STEP)) * STEP
    response = ride(vehicle, 1e-8 * np.sin(2 * np.pi * frequency * time), STEP)
    last = time >= time[-1] - 1.0 + 0.5 * STEP
    wave = 2j * np.exp(-2j * np.pi * frequency * time[last]) / 1e-8
    signals = response.contact_force - vehicle.static_force, response.journal, response.tilt
    force, journal, tilt = (complex(np.mean(signal[last] * wave)) for signal in signals)
    return force, journal, tilt


def undamped(operation: QuarterVehicleOperation) -> QuarterVehicleOperation:
    assert operation.vehicle.wheelset is not None
    wheelset = dataclasses.replace(operation.vehicle.wheelset, damping_ratio=0.0)
    return dataclasses.replace(operation, vehicle=dataclasses.replace(operation.vehicle, wheelset=wheelset))


@pytest.mark.parametrize("frequency", fast_ones([50.0, 90.0, 200.0, 355.0, 560.0, 800.0], 1, 5))
def test_a_ride_answers_as_the_dense_beam(frequency):
    operation = undamped(SMOOTH)
    ours, theirs = (
        measured(quarter_vehicle(operation, MOUNTING), frequency),
        DenseBeam(operation).response(frequency),
    )
    rigid = measured(quarter_vehicle(RIGID, MOUNTING), frequency)
    for one, other in zip(ours, theirs, strict=True):
        assert abs(one - other) < 0.01 * abs(other)
    if frequency > 80.0:  # and bending matters
        assert abs(rigid[1] - theirs[1]) > 0.1 * abs(theirs[1])


def test_few_modes_and_what_yields_are_the_dense_beam(monkeypatch):
    """At 560 Hz a box yields on the short end of its axle, which cut-off modes know too little of."""
    operation = undamped(SMOOTH)
    exact = DenseBeam(operation).response(560.0)[1]

    def error() -> float:
        return abs(measured(quarter_vehicle(operation, MOUNTING), 560.0)[1] / exact - 1.0)

    assert error() < 0.005
    monkeypatch.setattr(subject, "_HIGHEST", 600.0)
    assert error() < 0.02
    monkeypatch.setattr(subject.Modes, "condense", lambda modes, highest, forces: modes.below(highest))
    assert error() > 0.2


def test_a_stiff_axle_is_the_rigid_half_wheelset(monkeypatch):
    """To the bit where all modes lie above what is kept, and nearly where the first is at 900 Hz."""
    rough = dataclasses.replace(SMOOTH, irregularity=Irregularity("german_low", short_waves="iso_3095"))

    def shaking(operation: QuarterVehicleOperation) -> np.ndarray:
        """Of the axlebox below 300 Hz."""
        spectrum = np.fft.rfft(np.diff(ride_of(operation, MOUNTING, 0.5, 1)[0].box, 2))
        return np.fft.irfft(spectrum * (np.arange(len(spectrum)) < 150))

    plain = shaking(dataclasses.replace(rough, wheelset="rigid"))
    apart = []
    for times in (1.0, 100.0, 1e5):
        monkeypatch.setattr(subject, "YOUNG", times * YOUNG)
        monkeypatch.setattr(subject, "SHEAR", times * SHEAR)
        apart.append(np.std(shaking(rough) - plain) / np.std(plain))
    assert apart[0] > 0.5
    assert apart[1] < 0.1
    assert apart[2] == 0.0


def test_a_rigid_wheelset_in_the_scene_is_a_vehicle_without_one():
    without = dataclasses.replace(SMOOTH.vehicle, wheelset=None)
    rough = dataclasses.replace(RIGID, irregularity=Irregularity("fra_5"), lateral=True)
    one = load_history(rough, MOUNTING, 1.0, 2)
    other = load_history(dataclasses.replace(rough, vehicle=without), MOUNTING, 1.0, 2)
    assert np.array_equal(one.columns(), other.columns())


def test_the_cut_moves_a_rigid_half_wheelset_as_the_journal():
    """What crosses to the twin accelerates 900 kg, against the bearing, as the bending axle's journal."""
    operation = dataclasses.replace(SMOOTH, wheel_defects=(WheelFlat(0.03), WheelPolygon(20, 10e-6)))
    response, step = ride_of(operation, MOUNTING, 0.6, 1)
    vehicle = quarter_vehicle(operation, MOUNTING)
    inner = slice(2, -2)

    def rate(signal, order=1):
        for _ in range(order):
            signal = np.gradient(signal, step)
        return signal

    squeeze = response.box - response.bogie
    primary = MOUNTING.stiffness[2] * squeeze + MOUNTING.damping[2] * rate(squeeze)
    # second differences of what is known at steps
    second = np.zeros((2, len(squeeze)))
    for row, signal in zip(second, (response.journal, response.box), strict=True):
        row[1:-1] = np.diff(signal, 2) / step**2
    pushed = vehicle.mass[WHEEL] * second[0] + vehicle.mass[BOX] * second[1] + primary
    given = response.contact_force - vehicle.static_force + response.flexing
    assert np.std(response.flexing) > 0.2 * np.std(given)
    assert np.std((pushed - given)[inner]) < 0.01 * np.std(given)


def test_bending_makes_no_force_in_the_mean():
    operation = dataclasses.replace(SMOOTH, irregularity=Irregularity("german_low"))
    response, _ = ride_of(operation, MOUNTING, 5.0, 3)
    assert abs(response.flexing.mean()) < 1e-3 * response.flexing.std()


def test_an_elastic_ride_dies_away_after_a_flight():
    vehicle = quarter_vehicle(SMOOTH, MOUNTING)
    time = np.arange(200_000) * STEP
    dip = -15e-3 * np.sin(np.pi * np.clip(time / 0.03, 0.0, 1.0)) ** 2
    response = ride(vehicle, dip, STEP)
    assert response.contact_force.min() == 0.0
    swing = [np.abs(response.flexing[n : n + 20_000]).max() for n in range(0, 200_000, 20_000)]
    assert swing[0] > 1e5
    assert (np.diff(swing) < 1e-6 * swing[0]).all()
    assert swing[-1] < 1e-3 * swing[0]


@pytest.mark.parametrize("speed_kmh", [40.0, 120.0, 300.0])
def test_half_of_the_step_changes_little(speed_kmh):
    operation = dataclasses.replace(SMOOTH, speed_profile=((0.0, speed_kmh / 3.6),))
    vehicle = quarter_vehicle(operation, MOUNTING)
    place = speed_kmh / 3.6 * np.arange(40_000) * STEP / 2
    bump = -1e-3 * np.clip(1.0 - np.abs(place - 2.0) / 0.05, 0.0, 1.0) ** 2
    whole, half = ride(vehicle, bump[::2], STEP), ride(vehicle, bump, 0.5 * STEP)
    assert whole.contact_force.max() == pytest.approx(half.contact_force.max(), rel=0.03)
    assert np.abs(whole.flexing).max() == pytest.approx(np.abs(half.flexing).max(), rel=0.05)


def test_a_free_journal_is_tilted_and_a_locked_one_is_not():
    operation = dataclasses.replace(SMOOTH, irregularity=Irregularity("german_low"), lateral=True)
    free = dataclasses.replace(MOUNTING, journal_tilt="free")
    tilted, straight = (load_history(operation, mounting, 1.0, 3) for mounting in (free, MOUNTING))
    assert (straight.wrench[:, 3:] == 0.0).all()
    assert tilted.wrench[:, 3].std() > 10.0
    assert (tilted.wrench[:, 4:] == 0.0).all()
    assert np.array_equal(tilted.wrench[:, :3], straight.wrench[:, :3])


def test_a_half_wheelset_lighter_than_its_axle_is_refused():
    with pytest.raises(InputError, match=r"journal_mass_kg is 250; half the axle and its discs weigh"):
        load_history(SMOOTH, dataclasses.replace(MOUNTING, journal_mass=250.0), 0.1, 1)


def test_an_axle_with_inboard_bearings_is_refused():
    guidance = dataclasses.replace(SMOOTH.vehicle.guidance, axlebox_spacing=1.2)
    inboard = dataclasses.replace(SMOOTH, vehicle=dataclasses.replace(SMOOTH.vehicle, guidance=guidance))
    with pytest.raises(InputError, match=r"axlebox_spacing_m of the vehicle is 1\.2; .* must be above 1\.68"):
        half_shaft(inboard, MOUNTING, 0.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"bore_diameter": 0.11}, "bore_diameter_mm is 110; it must be below 104"),
        ({"disc_places": (0.7,), "disc_mass": 100.0}, r"disc_places_mm\[0\] is 700; .* below 660"),
        ({"disc_places": (0.3,)}, "disc_mass_kg is missing"),
        ({"damping_ratio": 0.5}, "damping_ratio is 0.5"),
    ],
)
def test_a_wheelset_that_cannot_be_is_refused(change, words):
    good = Wheelset(axle_diameter=0.17, seat_diameter=0.19, collar_diameter=0.16, journal_diameter=0.13)
    with pytest.raises(InputError, match=words):
        dataclasses.replace(good, **change)
