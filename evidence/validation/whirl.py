"""Trends of cage whirl under pure axial load.

Standard effects with a dry cage and a bearing of grade G2, without weight across the axis, which pins a cage
of 0.4 kg at rail speeds. Rollers of unlike diameter drift through the play of their pockets for hundreds of
revolutions, so runs last that long, and are looked at in their last quarter.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from beardyn_core.scene.scatter import Scatter
from evidence.standard import standard_scene
from evidence.validation.anchor import HOLDS_FROM, Finding, Trend, falls, rises
from evidence.validation.cage_whirl import Whirl, WhirlCase, cage_whirl

SAKAGUCHI = "Sakaguchi and Harada 2006, J. Tribol. 128 (10.1115/1.2197527), abstract"
SPEEDS = (60.0, 122.0, 240.0, 480.0)
AXIAL = 2e3
LOADS = (2e3, 1e4, 4e4)
LOADED_SPEED = 480.0
RADIAL = (0.0, 5e3, 2e4, 8e4)
COMBINED_AXIAL = 1e4
COMBINED_SPEED = 240.0
# Revolutions of the shaft until the spacing of the rollers has settled: the more the load, the more it takes.
REVOLUTIONS, LOADED_REVOLUTIONS, COMBINED_REVOLUTIONS = 300.0, 1200.0, 600.0
SHORT_S = 4.0


SCATTER = Scatter("G2", 1)


@lru_cache
def whirl(case: WhirlCase, duration: float, scatter: Scatter | None = SCATTER) -> Whirl:
    """Run a case for a time in s and measure the whirl of its cages in the last quarter."""
    scene = standard_scene("static_80kN")
    scene = replace(scene, effects=replace(scene.effects, gravity=None), scatter=scatter)
    return cage_whirl(scene, [case], duration=duration, settled=0.75 * duration)


def turned(case: WhirlCase, revolutions: float) -> Whirl:
    """Run a case for some revolutions of the shaft."""
    return whirl(case, revolutions * 2.0 * np.pi / case.shaft_speed)


def over_speed() -> list[Whirl]:
    """Run all speeds under axial load alone, for the same number of revolutions."""
    return [turned(WhirlCase(speed, AXIAL), REVOLUTIONS) for speed in SPEEDS]


def over_load() -> list[Whirl]:
    """Run all axial loads at one speed."""
    return [turned(WhirlCase(LOADED_SPEED, load), LOADED_REVOLUTIONS) for load in LOADS]


def over_radial() -> list[Whirl]:
    """Run all radial loads added to an axial load."""
    cases = [WhirlCase(COMBINED_SPEED, COMBINED_AXIAL, radial) for radial in RADIAL]
    return [turned(case, COMBINED_REVOLUTIONS) for case in cases]


def microns(cases: list[Whirl], part: str = "amplitude") -> list[float]:
    """Read one measure of each run, [um]."""
    return [1e6 * float(getattr(case, part)[0]) for case in cases]


def play() -> float:
    """Look up the radial play of the pockets, [um]."""
    return 1e6 * over_speed()[0].radial_play


def within_play(values: list[float]) -> list[float]:
    """Cut radii at the play: what is beyond is the give of bars."""
    return [min(value, play()) for value in values]


def shown(values: list[float]) -> str:
    """Write lengths as text, in um."""
    return ", ".join(f"{value:.0f}" if value >= 10.0 else f"{value:.1f}" for value in values) + " um"


LISTED_SPEEDS = f"at {', '.join(f'{speed:g}' for speed in SPEEDS)} rad/s"
LISTED_LOADS = f"under {', '.join(f'{load / 1e3:g}' for load in LOADS)} kN"
LISTED_RADIAL = (
    f"under {', '.join(f'{load / 1e3:g}' for load in RADIAL)} kN radial added to "
    f"{COMBINED_AXIAL / 1e3:g} kN axial, {COMBINED_SPEED:g} rad/s, after {COMBINED_REVOLUTIONS:g} revolutions"
)


def present() -> Finding:
    """Check that cages whirl under axial load alone."""
    found = over_speed()
    turns = [float(case.frequency[0]) for case in found]
    return Finding(
        min(microns(found)) > HOLDS_FROM * play() and min(turns) > HOLDS_FROM,
        f"Under {AXIAL / 1e3:g} kN axial and without weight the cage's centre goes round its mean place at "
        f"{', '.join(f'{turn:.2f}' for turn in turns)} of the cage speed, rms radius "
        f"{shown(microns(found))}, {LISTED_SPEEDS} after {REVOLUTIONS:g} revolutions.",
    )


def grows_with_speed() -> Finding:
    """Check that the whirl radius grows with speed."""
    values = microns(over_speed())
    early = microns([whirl(WhirlCase(speed, AXIAL), SHORT_S) for speed in SPEEDS])
    return Finding(
        rises(within_play(values)),
        f"Rms radius {shown(values)} {LISTED_SPEEDS}, {AXIAL / 1e3:g} kN, after {REVOLUTIONS:g} revolutions, "
        f"with a play of {play():.0f} um; after {SHORT_S:g} s at every speed: {shown(early)}.",
    )


def grows_with_load() -> Finding:
    """Check that the whirl radius grows with axial load."""
    values = microns(over_load())
    early, identical = (
        microns([whirl(WhirlCase(LOADED_SPEED, load), SHORT_S, scatter) for load in LOADS])
        for scatter in (SCATTER, None)
    )
    return Finding(
        rises(within_play(values)),
        f"Rms radius {shown(values)} {LISTED_LOADS} at {LOADED_SPEED:g} rad/s after "
        f"{LOADED_REVOLUTIONS:g} revolutions, with a play of {play():.0f} um; after {SHORT_S:g} s: "
        f"{shown(early)}, with identical rollers {shown(identical)}.",
    )


def ends_at_the_play() -> Finding:
    """Check that cages come to the radial play that their pockets have as made, and not beyond it."""
    reach = microns([*over_speed(), *over_load()], "reach")
    bearing = standard_scene("static_80kN").bearing
    made = 1.0 + SCATTER.deviations(bearing).pocket_clearance / bearing.cage.circumferential_clearance
    least, most = play() * float(made.min()), play() * float(made.max())
    return Finding(
        min(reach) > (1.0 - HOLDS_FROM) * least and max(reach) < (1.0 + HOLDS_FROM) * most,
        f"Farthest {min(reach):.0f} to {max(reach):.0f} um from the axis, with a radial play of {play():.0f} "
        f"um in the pockets as drawn, {least:.0f} to {most:.0f} um as made.",
    )


def smaller_under_combined_load() -> Finding:
    """Check that radial load makes the whirl smaller."""
    values = within_play(microns(over_radial()))
    return Finding(
        all(falls([values[0], value]) for value in values[1:]),
        f"Rms radius {shown(microns(over_radial()))} {LISTED_RADIAL}.",
    )


def spacing_evened() -> Finding:
    """Check that radial load makes the spacing of the rollers more even."""
    values = microns(over_radial(), "spacing")
    return Finding(
        all(falls([values[0], value]) for value in values[1:]),
        f"Deviation of the roller spacing from an even one: rms {shown(values)} {LISTED_RADIAL}.",
    )


ALL_PRESSED = (
    "up to 20 kN the axial load still presses every roller of the row, which drift as they do without radial "
    "load; under 80 kN, which leaves a load zone, it does"
)
TRENDS = (
    Trend("cage whirl", "cages whirl under pure axial load", SAKAGUCHI, present, picture="whirl.png"),
    Trend(
        "cage whirl",
        "whirl grows with speed",
        SAKAGUCHI,
        grows_with_speed,
        misses="rollers of unlike diameter drift until the cage lies at its play, at every speed; it grows "
        "in a run of a few seconds, too short for the slow ones to get there",
    ),
    Trend(
        "cage whirl",
        "whirl grows with axial load",
        SAKAGUCHI,
        grows_with_load,
        misses="rollers of unlike diameter drift until the cage lies at its play, under every load; with "
        "identical ones it does not grow either, so no cause was found",
    ),
    Trend(
        "cage whirl", "whirl ends at the radial clearance of rollers and pockets", SAKAGUCHI, ends_at_the_play
    ),
    Trend(
        "cage whirl",
        "whirl is smaller under combined load",
        SAKAGUCHI,
        smaller_under_combined_load,
        misses=ALL_PRESSED,
    ),
    Trend(
        "cage whirl",
        "combined load evens the spacing of the rollers",
        SAKAGUCHI,
        spacing_evened,
        misses=ALL_PRESSED,
    ),
)
