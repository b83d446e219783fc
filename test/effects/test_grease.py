"""What running leaves of a fill of grease."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.effects import Drag, LineFilm
from beardyn_core.effects.grease import (
    CHURNING,
    FRESH,
    GREASE_LIFE,
    LAYERS,
    SETTLED,
    SETTLED_FILL,
    aged_fill,
    aged_layer,
)
from beardyn_core.physics.drag import drag_params
from test.scenes import standard_scene


def test_running_goes_from_fresh_by_settled_to_channelled() -> None:
    assert (LAYERS["fresh"], LAYERS["settled"]) == (FRESH, SETTLED)
    assert aged_layer(0.0) == FRESH
    assert aged_layer(10.0 * CHURNING) == pytest.approx(SETTLED, rel=0.01)
    assert aged_layer(GREASE_LIFE) == pytest.approx(LAYERS["channelled"], rel=1e-9)
    assert aged_layer(10.0 * GREASE_LIFE) == aged_layer(GREASE_LIFE)
    layers = [aged_layer(each) for each in np.geomspace(1e-3, GREASE_LIFE, 60)]
    assert (np.diff(layers) < 0.0).all()


def test_churning_is_over_after_some_hours_of_a_rig() -> None:
    """Within 40 % to 10 % of what is churned away, in 2 to 5 hours at 1000 rpm."""
    left = [(aged_layer(hours * 0.06) - SETTLED) / (FRESH - SETTLED) for hours in (2.0, 5.0)]
    assert 0.1 < left[0] < 0.4
    assert left[1] < 0.1


def test_fill_is_pushed_aside_and_does_not_come_back() -> None:
    assert aged_fill(0.3, 0.0) == 0.3
    assert aged_fill(0.3, 5.0) == pytest.approx(SETTLED_FILL)
    assert aged_fill(0.01, 5.0) == 0.01
    half = Drag(fill=0.3, million_revolutions=CHURNING)
    assert half.present_fill == pytest.approx(SETTLED_FILL + (0.3 - SETTLED_FILL) * np.exp(-1.0))


def test_ageing_reaches_film_and_drag() -> None:
    film = LineFilm(supply="ageing", million_revolutions=CHURNING)
    assert film.oil_layer == aged_layer(CHURNING)
    scene = standard_scene()
    late = replace(scene, effects=replace(scene.effects, drag=Drag(fill=0.3, million_revolutions=5.0)))
    settled = replace(scene, effects=replace(scene.effects, drag=Drag()))
    late_law, settled_law = drag_params(late), drag_params(settled)
    assert late_law is not None
    assert settled_law is not None
    assert late_law.orbit == pytest.approx(settled_law.orbit, rel=1e-9)


def with_grease(film: str, drag: str) -> str:
    """Write the scene with other options of film and drag."""
    lines = scene_text(load_scene("static_80kN")).splitlines()
    kept = [line for line in lines if not line.startswith(("  film:", "  drag:"))]
    return "\n".join(kept).replace("effects:\n", f"effects:\n  film: {film}\n  drag: {drag}\n", 1)


def test_scene_keeps_the_age_of_its_grease() -> None:
    film = "{supply: ageing, million_revolutions: 0.05}"
    scene = scene_from_text(with_grease(film, "{fill: 0.3, million_revolutions: 0.05}"))
    assert scene_from_text(scene_text(scene)).effects == scene.effects
    assert scene.effects.film is not None
    assert scene.effects.film.oil_layer == aged_layer(0.05)


@pytest.mark.parametrize(
    ("film", "drag", "message"),
    [
        ("{supply: ageing}", "{}", "give both or neither"),
        ("{million_revolutions: 1}", "{million_revolutions: 1}", "give both or neither"),
        ("{supply: ageing, million_revolutions: 1}", "{}", "of film and drag differ"),
        *(
            (f"{{supply: ageing, million_revolutions: 1, {key}: 0.5}}", "{million_revolutions: 1}", key)
            for key in ("layer_um", "starvation")
        ),
    ],
)
def test_one_grease_has_one_age(film: str, drag: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        scene_from_text(with_grease(film, drag))
