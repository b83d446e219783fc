"""Rollers of tier `quasistatic` that move in the pockets of their cages."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import cage_speed_ratio
from beardyn_core.effects import (
    Cage,
    CoulombTraction,
    LineFilm,
    LoadSharingTraction,
    MixedTraction,
    ShearedFilmTraction,
    Traction,
)
from beardyn_core.physics.cage.play import loose_params
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from test.tiers.runs import scene_of


def healthy(tier: str) -> Scene:
    """A healthy bearing as drawn on a track."""
    scene = replace(scene_of("smooth_run", tier), scatter=None)
    return replace(scene, numerics=replace(scene.numerics, steps_per_sample=4.0 if tier == "full" else 1.0))


def test_rollers_stay_in_their_pockets_and_the_cage_slips_by_the_play() -> None:
    """A leaning bar yields to a roller by a few micrometres, wherever the cage is; cages are slower than
    rolling by no more than play and sag over a load zone of a quarter."""
    scene = healthy("quasistatic")
    bearing = scene.bearing
    assert isinstance(scene.effects.cage, Cage)
    radius, play = 0.5 * bearing.pitch_diameter, 0.5 * bearing.cage.circumferential_clearance
    done = list(blocks(scene, 0.6))
    trend, shown = (
        np.concatenate([getattr(each, name) for each in done])
        for name in ("trend_time_ns", "snapshot_time_ns")
    )
    _, at_trend, at_shown = np.intersect1d(trend, shown, return_indices=True)
    rollers = np.concatenate([each.roller_angle for each in done])[at_trend]
    turned = np.concatenate([each.cage_angle for each in done])[at_trend]
    shaft = np.concatenate([each.shaft_angle for each in done])[at_trend]
    poses = np.concatenate([each.body_pose for each in done])[at_shown]
    steps = len(rollers)
    assert steps > 50
    across = poses[:, 2:4, :3] - poses[:, :1, :3]
    pockets = turned[:, :, None] + 2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count
    ahead = radius * ((rollers - pockets + np.pi) % (2.0 * np.pi) - np.pi)
    ahead -= np.cos(rollers) * across[:, :, :1] - np.sin(rollers) * across[:, :, 2:]
    centres = poses[:, 4:, :3].reshape(steps, 2, -1, 3) - poses[:, None, :1, :3]
    outward = np.hypot(centres[..., 0], centres[..., 2]) - radius
    outward -= np.cos(rollers) * across[:, :, 2:] + np.sin(rollers) * across[:, :, :1]
    lean = scene.effects.cage.bar_inclination
    depth = np.cos(lean) * (np.abs(ahead) - play) + np.sin(lean) * outward
    assert 0.0 < depth.max() < 10e-6
    assert ahead.std() > 0.2 * play
    half = steps // 2
    ratio = (turned[-1] - turned[half]) / (shaft[-1] - shaft[half]) / cage_speed_ratio(bearing)
    # a roller gets ahead of its pocket by the play, and by twice what the cage is beside its centre
    longest = 2.0 * play + 2.0 * np.hypot(across[..., 0], across[..., 2]).max()
    assert longest < 20.0 * play
    assert (ratio < 1.0).all()
    assert ((1.0 - ratio) < longest / (0.5 * np.pi * radius)).all()


def test_without_a_cage_rollers_keep_their_places() -> None:
    scene = healthy("quasistatic")
    assert isinstance(scene.effects.cage, Cage)
    done = list(blocks(replace(scene, effects=replace(scene.effects, cage=None)), 0.1))
    angles = np.concatenate([each.roller_angle for each in done])
    shaft = np.concatenate([each.shaft_angle for each in done])
    way = angles[-1] - angles[0]
    turned = cage_speed_ratio(scene.bearing) * (shaft[-1] - shaft[0])
    np.testing.assert_allclose(way, turned, rtol=1e-6)


@pytest.mark.slow
@pytest.mark.usefixtures("shipped_configuration")
def test_slip_spacing_lines_and_torque_are_those_of_the_full_tier() -> None:
    """Nothing is fitted: slip within a quarter, scatter of spacing within 40 %, lines of the rollers' passing
    over their surroundings within 3 dB on average and 4 dB rms, third octaves, 32 Hz to 5 kHz, within 4 dB.
    Torque is within 3 %: a box by modes presses rollers on their bars, and the film there carries them. Means
    of eight runs: a line of one run scatters by up to 4 dB in either tier.
    """
    from beardyn_core.choice import load_trial
    from beardyn_core.choice.trial import with_choices
    from evidence.trial.pockets import move_often
    from evidence.trial.pockets import scene_of as trial_scene_of

    trial = with_choices(load_trial("healthy"))
    full, fast = (move_often(trial_scene_of(trial, tier, 200.0)) for tier in ("full", "quasistatic"))
    assert fast.slip == pytest.approx(full.slip, rel=0.25)
    assert fast.spacing == pytest.approx(full.spacing, rel=0.4)
    assert fast.torque == pytest.approx(full.torque, rel=0.03)
    apart = fast.lines - full.lines
    assert abs(apart.mean()) < 3.0
    assert np.sqrt((apart**2).mean()) < 4.0
    from beardyn_core.study.measures import BAND_CENTRES

    received = (BAND_CENTRES > 30.0) & (BAND_CENTRES < 5_500.0)
    assert np.abs(fast.levels - full.levels)[received].max() < 4.0


@pytest.mark.parametrize(
    ("traction", "film", "limit"),
    [
        (CoulombTraction(0.12), LineFilm(), 0.12),
        (MixedTraction(boundary_friction=0.11), None, 0.11),
        (MixedTraction(), LineFilm(), 0.045),
        (ShearedFilmTraction(limiting_shear=0.06), LineFilm(), 0.06),
        (LoadSharingTraction(film_traction="bair_winer", limiting_shear=0.03), LineFilm(), 0.03),
        (LoadSharingTraction(), LineFilm(), 0.045),
        (None, LineFilm(), 0.045),
    ],
)
def test_both_raceways_drive_a_loose_roller_up_to_the_limit_of_the_scene(
    traction: Traction | None, film: LineFilm | None, limit: float
) -> None:
    scene = healthy("quasistatic")
    effects = replace(scene.effects, traction=traction, film=film)
    loose = loose_params(replace(scene, effects=effects), 1.0 / 51_200.0)
    assert loose is not None
    assert loose.traction == 2.0 * limit
