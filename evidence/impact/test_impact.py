"""A spalled bearing in a ringing box: two events a crossing, more impulsive than a sound one."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.config import load_bearing
from evidence.impact.cases import BEARING, BOTH, GROWING, Case, across, every, healthy, over_width, ranged
from evidence.impact.crossing import BURST, crossing
from evidence.impact.edges import LAWS, load_of, sinks, sound_depth, strike
from evidence.impact.elastic import PLACE, approach, cup_radius, sink
from evidence.impact.page import cases_of_crossings, cases_received
from evidence.impact.study import RATE, over_noise, received
from test.examples import fast_ones


def test_every_case_of_the_page_is_run_once() -> None:
    cases = every()
    assert len(cases) == len(set(cases))
    assert {*cases_received(), *cases_of_crossings()} <= set(cases)
    assert len(ranged()) == len(set(ranged()))


def test_a_line_stands_out_of_noise_by_its_own_power() -> None:
    """A tone a has N a^2 / 4 S over a mean density of S, two thirds of it with a Hann window."""
    count = 1 << 16
    noise = np.random.default_rng(1).standard_normal(count)
    tone = 0.1 * np.sin(2.0 * np.pi * 200.0 * np.arange(count) / RATE)
    expected = 10.0 * np.log10(count * 0.1**2 / 4.0 / 1.5 / np.log(2.0))
    assert over_noise(noise + tone, 200.0) == pytest.approx(expected, abs=1.5)
    assert over_noise(noise, 200.0) < 12.0


@pytest.mark.parametrize("per_length", [1e5, 4e5])
def test_a_roller_on_a_sound_plane_approaches_as_hertz_says(per_length: float) -> None:
    """Johnson (1985), 2.25b under his 4.44: the middle of a Hertz contact, lengths in metres."""
    bearing = load_bearing(BEARING)
    modulus = 0.5 * bearing.material.contact_modulus
    half_width = math.sqrt(4.0 * per_length * cup_radius(bearing) / (math.pi * modulus))
    expected = 2.0 * per_length / (math.pi * modulus) * (math.log(2.0 / half_width) + 0.5)
    found = approach(bearing, np.ones(len(PLACE), bool), per_length)
    assert found == pytest.approx(expected, rel=2e-3)


def test_a_light_roller_bridges_a_slot_like_a_rigid_one_and_a_loaded_one_is_softer() -> None:
    bearing, width = load_bearing(BEARING), 1e-3
    rigid = [(0.5 * width - arc) ** 2 / (2.0 * cup_radius(bearing)) for arc in (0.0, 2e-4)]
    light = [sink(bearing, width, arc, 100.0) for arc in (0.0, 2e-4)]
    assert light == pytest.approx(rigid, rel=0.06)
    loaded = [sink(bearing, width, arc, 1e4) for arc in (0.0, 2e-4)]
    assert loaded[0] - loaded[1] < 0.7 * (rigid[0] - rigid[1])
    assert sink(bearing, width, 5.5e-4, 1e4) > 1e-7


@pytest.mark.parametrize("width", fast_ones([0.3e-3, 0.5e-3, 1e-3, 2e-3, 6e-3], 2))
def test_edges_of_the_twin_give_way_as_an_elastic_half_space(width: float) -> None:
    """2 to 20 kN: the sink to a fifth and a tenth of the depth e of a sound contact, the force to 11 %.

    The sink of the twin is linear in e, which the elastic one is not over a slot narrower than the contact;
    the force is that at e on a held roller, over that of a sound contact.
    """
    bearing, loads = load_bearing(BEARING), np.array([2e3, 5e3, 1e4, 2e4])
    depth = sound_depth(bearing, loads)
    for arc in np.linspace(max(0.5 * width - 7e-4, 0.0), 0.5 * width + 3e-4, 7):
        rigid, ours, elastic = (sinks(bearing, law, width, float(arc), loads) for law in LAWS)
        assert np.all(np.abs(ours - elastic) < 0.2 * elastic + 0.1 * depth)
        assert np.all(ours >= rigid)
        force = [load_of(bearing, law, width, float(arc)) for law in ("ours", "elastic")]
        at_depth = np.array([[law(float(each)) for each in depth] for law in force])
        assert np.all(np.abs(at_depth[0] - at_depth[1]) < 0.11 * loads)


@pytest.mark.slow
def test_narrow_spalls_strike_a_held_roller_as_elastic_edges_do_and_less_than_rigid_ones() -> None:
    """Of 10 kN, at 90 km/h; a spall of 1 mm strikes harder than one of 2 mm on a half-space, too."""
    rigid, ours, elastic = (
        np.array([strike(law, width, 1e4, 90.0) for width in (1e-3, 2e-3)]) for law in LAWS
    )
    assert ours == pytest.approx(elastic, rel=0.05)
    assert np.all(ours < 0.85 * rigid)
    assert elastic[0] > 1.5 * elastic[1]


@pytest.mark.slow
@pytest.mark.parametrize("speed", BOTH)
def test_spalls_of_every_width_from_3_mm_are_more_impulsive_than_a_sound_bearing(speed: float) -> None:
    sound = received(healthy(speed)).kurtosis
    for case in over_width(speed):
        assert received(case).status == "fine"
        if case.width >= 3e-3:
            assert received(case).kurtosis > sound


@pytest.mark.slow
def test_a_spall_of_3_mm_is_as_loud_as_one_of_2_mm_or_louder_at_90_km_h() -> None:
    two, three = (received(Case(width, 90.0)).peak for width in (2e-3, 3e-3))
    assert two <= three


@pytest.mark.slow
def test_a_spall_that_grows_in_both_directions_gets_louder_all_the_way() -> None:
    levels = [received(replace(case, speed=120.0)).rms for case in GROWING["twice as long, a tenth as deep"]]
    assert levels == sorted(levels)
    assert levels[-1] > 4.0 * levels[0]


@pytest.mark.slow
def test_a_deep_spall_over_the_whole_contact_gets_louder_from_1_to_6_mm() -> None:
    levels = [received(replace(case, speed=170.0)).rms for case in GROWING["whole contact, deep"]]
    assert 1.4 * levels[0] < levels[1] < levels[-1]


@pytest.mark.slow
def test_a_roller_that_is_unloaded_altogether_strikes_harder_than_it_left() -> None:
    case = across(200.0)[1]
    found = crossing(case)
    assert received(case).status == "fine"
    assert found.louder > 2.0
    assert found.spacing == pytest.approx(case.width, rel=0.25)
    assert found.power.max() * BURST > np.median(found.power)


@pytest.mark.slow
def test_a_spall_is_more_impulsive_than_a_sound_bearing() -> None:
    spalled, sound = received(Case()), received(healthy(200.0))
    assert spalled.kurtosis > 2.0 * sound.kurtosis
    assert spalled.ringing > 2.0 * sound.ringing
    assert spalled.line > sound.line + 10.0
