"""Legal scenes at random: finite with a closed energy balance, or a status with a sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.choice import scene_from_text
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file, write_mapping
from beardyn_core.physics.bodies.layout import LOSS_DAMPING
from beardyn_core.physics.tiers.status import SENTENCES, Status, describe
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import SMALLEST_LOSS
from beardyn_core.twin import Twin
from evidence.hard.case import Point, through
from evidence.hard.case_scene import history, merged
from evidence.hard.watch import Watch

# Effect sets and tiers that the other fast tests compile as well.
KERNELS: tuple[dict[str, Any], ...] = (
    {"tier": "full", "effects": "standard"},
    {"tier": "full", "effects": "dry"},
    {"tier": "full", "effects": "full"},
    {"tier": "lumped", "effects": "standard"},
    {"tier": "quasistatic", "effects": "standard"},
)
BLOCKS = 4
LARGEST_RESIDUAL = 1e-2
# The audit books the damping of contacts that open fast only roughly: a listed known failure of the battery.
ROUGH_SHARE_OF_DAMPING = 0.5
# What the time step gives and friction takes where heavily loaded rollers stand still is booked within this:
# with four rollers of 24 kN it falls to a thousandth at half the step, and so does the power, 0.4 W.
ROUGH_SHARE_OF_STEP = 0.05


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_subnormal=False)


@st.composite
def scenes(draw: st.DrawFn) -> dict[str, Any]:
    """Keys of a scene: every number within what the configuration allows."""
    suspended = draw(st.booleans())
    count = draw(st.integers(4, 21))  # more would overlap, and are refused
    changes: dict[str, Any] = {
        "scene": "random",
        "bearing": "HS130x230",
        "lubricant": draw(st.sampled_from(["L055", "EP220", "SHC100", "FVA3"])),
        "temperature_C": draw(numbers(-40.0, 130.0)),
        "end_play_mm": draw(numbers(-0.1, 0.8)),
        "mounting": {
            "cup": "suspended" if suspended else "held",
            "journal_tilt": draw(st.sampled_from(["locked", "free"])),
            "journal_mass_kg": draw(numbers(100.0, 2000.0)),
        },
        "numerics": {"laminae": draw(st.integers(2, 12)), "steps_per_sample": draw(st.sampled_from([4, 8]))},
        "operation": {"kind": "constant", "force_kN": [0, 0, 1], "speed_rpm": 100},
        "defects": [
            {"kind": "diameter", "row": draw(st.integers(0, 1)), "roller": draw(st.integers(0, count - 1)),
             "diameter_um": draw(numbers(-200.0, 30.0))}
        ] if draw(st.booleans()) else [],
    }  # fmt: skip
    changes["rollers"] = count
    return {**changes, **draw(st.sampled_from(KERNELS))}


@st.composite
def loads(draw: st.DrawFn) -> tuple[Point, ...]:
    """Two or three levels, at least 10 ms apart; speeds change by no more than 20 krpm a second."""
    points, at, speed = [], 0.0, draw(numbers(-300.0, 300.0))
    for _ in range(draw(st.integers(1, 3))):
        force = (draw(numbers(-2e4, 2e4)), draw(numbers(-2e4, 2e4)), draw(numbers(-1e5, 1.5e5)))
        points.append(Point(at, force, speed))
        pause = draw(numbers(0.01, 0.03))
        at, speed = at + pause, speed + draw(numbers(-2000.0, 2000.0)) * pause
    return through(*points)


def scene_of(keys: dict[str, Any]) -> Scene:
    given_keys = dict(keys)
    count = given_keys.pop("rollers")
    given_keys["bearing"] = merged(read_file(find("bearings", "HS130x230")), {"roller_count": count})
    return scene_from_text(write_mapping(given_keys), "random")


def ended(twin: Twin, watch: Watch, load: tuple[Point, ...]) -> Exception | None:
    """Run some blocks; what the run ended with, if it did."""
    try:
        twin.start(history(load))
        for _ in range(BLOCKS):
            before = twin.snapshot()
            watch.see(twin, twin.advance(), before)
    except (InputError, ValidityError) as error:
        return error
    return None


def balanced(twin: Twin) -> bool:
    """Whether the next block's audit closes, but for what is known to be booked roughly."""
    audit = twin.advance().audit
    assert audit is not None
    missing = audit.residual * max(audit.dissipated, SMALLEST_LOSS)
    rough = ROUGH_SHARE_OF_DAMPING * audit.losses[LOSS_DAMPING] + ROUGH_SHARE_OF_STEP * abs(audit.numerical)
    return missing <= LARGEST_RESIDUAL * max(audit.dissipated, SMALLEST_LOSS) + rough


def finite_and_audited_or_told(keys: dict[str, Any], load: tuple[Point, ...]) -> str:
    """The claim; says how the run went."""
    scene = scene_of(keys)
    twin, watch = Twin(scene), Watch(scene)
    error = ended(twin, watch, load)
    if error is not None:
        assert len(str(error)) > 20
        block = getattr(error, "block", None)
        assert block is None or describe(block.status) in str(error)
        return f"{scene.tier}: ends"
    measures = watch.measures()
    assert measures.finite
    assert Status(measures.status) in Status(sum(SENTENCES))
    assert measures.quaternion_error is not None
    assert measures.quaternion_error < 1e-12
    assert measures.axis_error is not None
    assert measures.axis_error < 1e-12
    if scene.tier == "full":
        assert measures.momentum_residual is not None
        assert measures.momentum_residual < 1e-9
        try:
            assert balanced(twin) or measures.status, measures
        except ValidityError:  # the block of the audit may be the one that ends the run
            return f"{scene.tier}: ends"
    return f"{scene.tier}: {'reports' if measures.status else 'fine'}"


@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
@given(scenes(), loads())
def test_random_scene_is_finite_and_audited_or_says_why_not(
    keys: dict[str, Any], load: tuple[Point, ...]
) -> None:
    event(finite_and_audited_or_told(keys, load))


@pytest.mark.slow
@settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
@given(scenes(), loads())
def test_many_random_scenes(keys: dict[str, Any], load: tuple[Point, ...]) -> None:
    event(finite_and_audited_or_told(keys, load))


def test_wrong_momentum_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The claim can fail."""
    keys = {
        "scene": "random", "bearing": "HS130x230", "lubricant": "L055", "rollers": 17,
        "operation": {"kind": "constant", "force_kN": [0, 0, 1], "speed_rpm": 100}, **KERNELS[0],
    }  # fmt: skip
    load = through(Point(0.0, (0.0, 0.0, 5e4), 100.0))
    finite_and_audited_or_told(keys, load)
    seen = Watch.measures

    def off(watch: Watch) -> Any:
        return replace(seen(watch), momentum_residual=1e-6)

    monkeypatch.setattr(Watch, "measures", off)
    with pytest.raises(AssertionError):
        finite_and_audited_or_told(keys, load)
