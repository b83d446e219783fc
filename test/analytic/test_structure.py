"""Finite elements of a box against closed forms; its modes against its finite elements."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.config import load_bearing
from beardyn_core.structure.box import Block, Box, Disc, Seat
from beardyn_core.structure.build import Built, load_zone, modes_of
from beardyn_core.structure.elastic import Elastic, elastic_body, stack_functionals
from beardyn_core.structure.mesh import mesh_of
from test.finite_elements import need_finite_elements

need_finite_elements()

BEARING = load_bearing("HS130x230")
STEEL = BEARING.material
TOP = (Seat("top", (0.0, 0.0, 0.125)),)


def ring(outer_diameter: float, length: float = BEARING.width) -> Box:
    """A plain ring of the cup's steel, the cup in it."""
    return Box(
        "ring",
        "HS130x230",
        outer_diameter,
        length,
        sensors=TOP,
        youngs_modulus=STEEL.youngs_modulus,
        poisson_ratio=STEEL.poisson_ratio,
        density=STEEL.density,
    )


@pytest.fixture(scope="module")
def thick() -> Elastic:
    """A ring whose roller tracks cover all but a millimetre at their ends."""
    width = 2.0 * BEARING.effective_length + 4e-3
    bearing = replace(BEARING, width=width, row_spacing=BEARING.effective_length + 1e-3)
    return elastic_body(ring(0.25, width), bearing, mesh_of(ring(0.25, width), bearing, 0.03))


def test_mass_and_inertia_are_those_of_a_hollow_cylinder(thick: Elastic) -> None:
    inner, outer, width = BEARING.cup_radius, 0.125, 2.0 * BEARING.effective_length + 4e-3
    mass = np.pi * STEEL.density * width * (outer**2 - inner**2)
    polar = 0.5 * mass * (outer**2 + inner**2)
    across = 0.5 * polar + mass * width**2 / 12.0
    expected = np.diag([mass, mass, mass, across, polar, across])
    assert thick.rigid_mass == pytest.approx(expected, rel=3e-4, abs=3e-4 * polar)


def test_rigid_motion_meets_no_stiffness(thick: Elastic) -> None:
    assert abs(thick.stiffness @ thick.rigid).max() < 1e-9 * abs(thick.stiffness).max()


def test_the_surface_encloses_the_ring_and_finds_its_motion(thick: Elastic) -> None:
    surface = thick.surface
    first, second, third = (surface.places[surface.triangles[:, i]] for i in range(3))
    volume = np.einsum("fi,fi->", first, np.cross(second, third)) / 6.0
    assert STEEL.density * volume == pytest.approx(thick.rigid_mass[0, 0], rel=0.05)  # flat triangles
    turned = thick.rigid[:, 4][surface.unknowns]
    assert turned == pytest.approx(np.cross([0.0, 1.0, 0.0], surface.places), abs=1e-12)


def test_pressure_inside_widens_the_ring_as_lame_says(thick: Elastic) -> None:
    """Lamé (1852), a tube with free ends: u = p a / E ((b^2 + a^2) / (b^2 - a^2) + nu)."""
    inner, outer = BEARING.cup_radius, 0.125
    pressure = 1e6
    force = pressure * 2.0 * np.pi * inner * BEARING.effective_length  # on a row
    widened = thick.bent(force * thick.raceway[:, 0, :1].sum(axis=0).T)
    ratio = (outer**2 + inner**2) / (outer**2 - inner**2)
    # the ends of the tracks carry nothing: 100 of 104 mm are loaded
    expected = pressure * inner / STEEL.youngs_modulus * (ratio + STEEL.poisson_ratio) * 100.0 / 104.0
    assert (thick.raceway[:, 0, 0] @ widened)[:, 0] == pytest.approx([expected, expected], rel=0.01)


@pytest.mark.slow
def test_a_ring_bends_in_waves_as_rayleigh_says() -> None:
    """Rayleigh (1894), art. 233, of a wall of a tenth of the radius: between a narrow ring and a plate."""
    inner, outer = BEARING.cup_radius, 0.1165
    thin = ring(2.0 * outer)
    found = elastic_body(thin, BEARING, mesh_of(thin, BEARING, 0.018)).modes(3000.0)[0]
    wall, radius = outer - inner, 0.5 * (inner + outer)
    for waves in (2, 3):
        narrow = (
            np.sqrt(STEEL.youngs_modulus / (12.0 * STEEL.density))
            * wall
            / radius**2
            * waves
            * (waves**2 - 1)
            / np.sqrt(waves**2 + 1)
            / (2.0 * np.pi)
        )
        plate = narrow / np.sqrt(1.0 - STEEL.poisson_ratio**2)
        nearest = found[np.argsort(abs(found - 0.5 * (narrow + plate)))[:2]]
        assert (nearest > narrow).all()
        assert (nearest < plate).all()
        assert nearest[0] == pytest.approx(nearest[1], rel=2e-3)  # a wave and its quarter turn


@pytest.fixture(scope="module")
def built() -> Built:
    box = Box(
        "small",
        "HS130x230",
        0.28,
        0.16,
        blocks=(Block((0.18, 0.0, 0.02), (0.14, 0.1, 0.08)), Block((0.0, 0.0, 0.15), (0.1, 0.1, 0.04))),
        discs=(Disc("outboard", 0.012),),
        sensors=(Seat("top", (0.0, 0.0, 0.17)),),
        suspension=(Seat("spring", (0.24, 0.0, 0.02), 0.04),),
    )
    return modes_of(box, BEARING, mesh=0.04, highest=8000.0)


@pytest.mark.slow
def test_modes_carry_no_rigid_motion_and_have_unit_mass(built: Built) -> None:
    frequency, shapes = built.body.modes(8000.0)
    assert frequency == pytest.approx(built.modes.frequency[: built.modes.free_count], rel=1e-9)
    assert shapes.T @ (built.body.mass @ shapes) == pytest.approx(np.eye(len(frequency)), abs=1e-8)
    assert abs(built.body.rigid.T @ (built.body.mass @ shapes)).max() < 1e-6
    assert (built.modes.frequency[built.modes.free_count :] > frequency[-1]).all()


@pytest.mark.slow
def test_static_bending_is_that_of_the_finite_elements(built: Built) -> None:
    """2 % are asked for; without residual modes several per cent are missing."""
    assert abs(built.static_error) < 2e-3
    zone = load_zone(len(built.modes.reads))
    strength = (zone @ built.modes.reads)[: built.modes.free_count]
    natural = 2.0 * np.pi * built.modes.frequency[: built.modes.free_count]
    assert (strength / natural) @ (strength / natural) < 0.98 * built.yielding[0]
    # from the load zone to the seats, and between the seats
    read = stack_functionals(built.body, ("top", "spring"))
    loads = np.stack([read.T @ zone, *read[-6:]], axis=1)
    exact = read[-6:] @ built.body.bent(loads)
    unit = np.concatenate([zone[None], np.eye(len(zone))[-6:]])
    found = [[built.modes.yielding(one, other) for other in unit] for one in unit[1:]]
    assert np.array(found) == pytest.approx(exact, abs=2e-3 * abs(exact).max())


@pytest.mark.slow
def test_the_answer_at_a_frequency_is_that_of_the_finite_elements(built: Built) -> None:
    """From the load zone to the sensor, off resonance, within 1 dB (the elastic part alone)."""
    from scipy.sparse.linalg import splu

    read = stack_functionals(built.body, ("top", "spring"))
    zone = load_zone(len(read))
    vertical = np.zeros(len(read))
    vertical[-4] = 1.0
    load = read.T @ zone
    rigid, mass = built.body.rigid, built.body.mass
    balanced = load - mass @ rigid @ np.linalg.solve(built.body.rigid_mass, rigid.T @ load)
    undamped = replace(built.modes, damping_ratio=np.zeros_like(built.modes.damping_ratio))
    for frequency in (300.0, 1100.0, 3300.0, 6000.0):
        square = (2.0 * np.pi * frequency) ** 2
        moved = splu((built.body.stiffness - square * mass).tocsc()).solve(balanced)
        exact = float(vertical @ read @ moved)
        found = complex(undamped.response(vertical, zone, np.array([frequency]))[0])
        assert abs(20.0 * np.log10(abs(found) / abs(exact))) < 1.0, frequency


def test_a_block_in_the_air_is_refused() -> None:
    box = replace(ring(0.25), blocks=(Block((0.5, 0.0, 0.0), (0.1, 0.1, 0.1)),))
    with pytest.raises(InputError, match="falls into 2 pieces; blocks must touch the housing"):
        mesh_of(box, BEARING, 0.04)


def test_a_housing_inside_of_the_cup_is_refused() -> None:
    with pytest.raises(InputError, match=r"outer_diameter_mm is 220; the cup of HS130x230 has 230"):
        mesh_of(ring(0.22), BEARING, 0.04)
