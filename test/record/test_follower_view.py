"""What a follower says in the rerun view: live, beside a bearing and without one, and from a recording."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
import rerun as rr

from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.config import load_plate
from beardyn_core.follow.descriptors import AXES, THIRDS
from beardyn_core.follow.estimate_json import residual_object, step_object
from beardyn_core.follow.estimator_choice import estimator_for
from beardyn_core.follow.following import Follower
from beardyn_core.follow.residual import residual_of
from beardyn_core.follow.shipped import shipped_estimators
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import encode_string, encode_told
from beardyn_core.record.reading import read_run
from beardyn_core.record.rerun_live import LiveView
from beardyn_core.record.topics import NAMESPACE
from beardyn_core.record.viewer import viewer_executable
from test.record.synthetic_run import description

STRETCHES = 4
ENTITIES = (
    "/follower/estimates/end_play_m",
    "/follower/estimates/lateral_load_N",
    "/follower/estimates/width_m",
    "/follower/health",
    "/follower/residual/curves",
)


@pytest.fixture(scope="module")
def messages() -> list[tuple[str, int, bytes]]:
    """What a follower publishes of signals about the middle of those learnt from, as the node does."""
    estimator = estimator_for(load_plate("HS130x230"), known=shipped_estimators())
    random = np.random.default_rng(3)
    noise = random.normal(0.0, 0.3, (STRETCHES, len(estimator.middle)))
    rows = estimator.middle + noise * estimator.spread
    follower, told = Follower(estimator), []
    for k, row in enumerate(rows):
        step = follower.take(row, 1.5 * (k + 1))
        told.append(("follower/estimate", round(1e9 * step.time), {"final": False, **step_object(step)}))
    residual = residual_object(residual_of(estimator, rows, rows + 3.0))
    told.append(("follower/residual", 6_000_000_000, {"time_s": 6.0, **residual}))
    told.append(("follower/estimate", 6_100_000_000, {**told[-2][2], "final": True}))
    return [(name, stamp, encode_told(each)) for name, stamp, each in told]


def entities_of(path: Path) -> str:
    words = [viewer_executable(), "rrd", "print", str(path)]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("known", [True, False], ids=["beside a twin", "of a real axlebox"])
def test_estimates_are_drawn_as_they_come(
    known: bool, messages: list[tuple[str, int, bytes]], tmp_path: Path
) -> None:
    stream = rr.RecordingStream("beardyn")
    stream.save(tmp_path / "live.rrd")
    live = LiveView(stream)
    if known:
        live.feed("truth", encode_string(description().to_json()))
    for name, _, cdr in messages:
        live.feed(name, cdr)
    live.flush()
    stream.flush()
    stream.disconnect()
    assert live.dropped == 0
    listing = entities_of(tmp_path / "live.rrd")
    for entity in ENTITIES:
        assert entity in listing, entity
    assert ("/bearing/cup" in listing) == known


def test_a_recording_keeps_what_the_follower_said_and_the_view_draws_it(
    messages: list[tuple[str, int, bytes]], tmp_path: Path
) -> None:
    path = tmp_path / "run.mcap"
    writer = McapWriter(path, NAMESPACE)
    writer.describe(description())
    for name, stamp, cdr in messages:
        writer.add(name, stamp, cdr)
    writer.close()
    run = read_run(path)
    assert [each["time_s"] for each in run.followed] == [1.5 * (k + 1) for k in range(STRETCHES)]
    assert run.residuals[0]["axes"] == list(AXES)
    assert np.shape(run.residuals[0]["twin_dB"]) == (len(AXES), len(THIRDS))
    assert command.main(["view", str(path), "--save", str(tmp_path / "run.rrd")]) == 0
    listing = entities_of(tmp_path / "run.rrd")
    for entity in (*ENTITIES, "/bearing/cup"):
        assert entity in listing, entity


def test_a_message_that_is_no_object_is_refused() -> None:
    live = LiveView(rr.RecordingStream("beardyn"))
    for text in ("nonsense", "[1]"):
        with pytest.raises(InputError, match="should be a JSON object"):
            live.feed("follower/estimate", encode_string(text))
