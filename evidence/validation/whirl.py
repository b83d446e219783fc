"""Trends of cage whirl under pure axial load.

Standard effects with a dry cage, without weight across the axis, which pins a cage of 0.4 kg at rail speeds.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from itertools import pairwise

from beardyn_core.choice import load_scene
from evidence.validation.anchor import Finding, Trend
from evidence.validation.cage_whirl import Whirl, WhirlCase, cage_whirl

SAKAGUCHI = "Sakaguchi and Harada 2006, J. Tribol. 128 (10.1115/1.2197527), abstract"
SPEEDS = (60.0, 122.0, 240.0, 480.0)
AXIAL = 2e3
LOADS = (2e3, 1e4, 4e4)
LOADED_SPEEDS = (60.0, 240.0)
RADIAL = (0.0, 5e3, 2e4, 8e4)
COMBINED_AXIAL = 1e4
COMBINED_SPEED = 240.0
# Whirl is chaotic: a change of step or of rounding moves a radius by up to a tenth.
SCATTER = 0.1
GIVE = 10e-6  # what a bar yields under the impacts that stop the cage, m


@lru_cache
def whirl(case: WhirlCase) -> Whirl:
    """Run a case once and measure the whirl of its cages."""
    scene = load_scene("static_80kN")
    return cage_whirl(replace(scene, effects=replace(scene.effects, gravity=None)), [case])


def over_speed() -> list[Whirl]:
    """Run all speeds under axial load alone."""
    return [whirl(WhirlCase(speed, AXIAL)) for speed in SPEEDS]


def over_load(speed: float) -> list[Whirl]:
    """Run all axial loads at one speed."""
    return [whirl(WhirlCase(speed, load)) for load in LOADS]


def over_radial() -> list[Whirl]:
    """Run all radial loads added to an axial load."""
    return [whirl(WhirlCase(COMBINED_SPEED, COMBINED_AXIAL, radial)) for radial in RADIAL]


def microns(cases: list[Whirl], part: str = "amplitude") -> list[float]:
    """Read one measure of each run, [um]."""
    return [1e6 * float(getattr(case, part)[0]) for case in cases]


def shown(values: list[float]) -> str:
    """Write lengths as text, in um."""
    return ", ".join(f"{value:.0f}" if value >= 10.0 else f"{value:.1f}" for value in values) + " um"


def present() -> Finding:
    """Check that cages whirl under axial load alone."""
    found = over_speed()
    values = microns(found)
    turns = [float(case.frequency[0]) for case in found]
    return Finding(
        min(values) > 1.0 and min(turns) > 0.0,
        f"Under {AXIAL / 1e3:g} kN axial and without weight the cage's centre goes round its mean place at "
        f"{', '.join(f'{turn:.2f}' for turn in turns)} of the cage speed, rms radius {shown(values)}, at "
        f"{', '.join(f'{speed:g}' for speed in SPEEDS)} rad/s.",
    )


def grows_with_speed() -> Finding:
    """Check that the whirl radius grows with speed."""
    values = microns(over_speed())
    holds = all(later > (1.0 - SCATTER) * earlier for earlier, later in pairwise(values))
    return Finding(
        holds and values[-1] > 2.0 * values[0],
        f"Rms radius {shown(values)} at {', '.join(f'{speed:g}' for speed in SPEEDS)} rad/s, "
        f"{AXIAL / 1e3:g} kN; a tenth is taken as scatter.",
    )


def grows_with_load() -> Finding:
    """Check that the whirl radius grows with axial load."""
    sentences, holds = [], True
    for speed in LOADED_SPEEDS:
        values = microns(over_load(speed))
        holds &= all(later > (1.0 + SCATTER) * earlier for earlier, later in pairwise(values))
        sentences.append(f"{shown(values)} at {speed:g} rad/s")
    return Finding(
        holds,
        f"Rms radius under {', '.join(f'{load / 1e3:g}' for load in LOADS)} kN: {'; '.join(sentences)}.",
    )


def ends_at_the_play() -> Finding:
    """Check that no cage goes farther than the radial play of its pockets."""
    cases = [*over_speed(), *(case for speed in LOADED_SPEEDS for case in over_load(speed))]
    reach = max(microns(cases, "reach"))
    play = 1e6 * cases[0].radial_play
    return Finding(
        reach < play + 1e6 * GIVE and microns(over_speed())[-1] > 0.8 * play,
        f"Farthest {reach:.0f} um from the axis, with a radial play of {play:.0f} um in the pockets.",
    )


def smaller_under_combined_load() -> Finding:
    """Check that radial load makes the whirl smaller."""
    values = microns(over_radial())
    return Finding(
        max(values[1:]) < values[0],
        f"Rms radius {shown(values)} under {', '.join(f'{load / 1e3:g}' for load in RADIAL)} kN radial added "
        f"to {COMBINED_AXIAL / 1e3:g} kN axial, {COMBINED_SPEED:g} rad/s.",
    )


def spacing_evened() -> Finding:
    """Check that radial load makes the spacing of the rollers more even."""
    values = microns(over_radial(), "spacing")
    return Finding(
        max(values[1:]) < values[0],
        f"Deviation of the roller spacing from an even one: rms {shown(values)} under "
        f"{', '.join(f'{load / 1e3:g}' for load in RADIAL)} kN radial added to {COMBINED_AXIAL / 1e3:g} kN "
        "axial.",
    )


TRENDS = (
    Trend("cage whirl", "cages whirl under pure axial load", SAKAGUCHI, present, picture="whirl.png"),
    Trend("cage whirl", "whirl grows with speed", SAKAGUCHI, grows_with_speed),
    Trend(
        "cage whirl",
        "whirl grows with axial load",
        SAKAGUCHI,
        grows_with_load,
        misses="at 60 rad/s it is largest in the middle; at 240 rad/s the radius is the same within the "
        "scatter, which the dry friction of the pockets sets there and not the load",
    ),
    Trend(
        "cage whirl", "whirl ends at the radial clearance of rollers and pockets", SAKAGUCHI, ends_at_the_play
    ),
    Trend(
        "cage whirl",
        "whirl is smaller under combined load",
        SAKAGUCHI,
        smaller_under_combined_load,
        misses="rollers that enter and leave the load zone push the cage, and there is nothing of its weight "
        "or of a pocket film to hold it",
    ),
    Trend(
        "cage whirl",
        "combined load evens the spacing of the rollers",
        SAKAGUCHI,
        spacing_evened,
        misses="ours starts evenly spaced and axial load keeps it so, while a load zone makes rollers run "
        "ahead and fall behind; those of the source were uneven before",
    ),
)
