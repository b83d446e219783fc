"""What the load node replays: the load, and the truth about it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import read_object
from beardyn_core.rail.events import events_of
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.replay import Replay

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene

PLAYING = "playing"
PAUSED = "paused"
ENDED = "ended"
PASSAGES_TOLD = 100


@dataclass(frozen=True)
class Scenario:
    """A load to be replayed.

    Parameters
    ----------
    history : LoadHistory
    events : mapping
        JSON-able: where the load comes from, irregularity, seed, defects of wheel and rail.
    """

    history: LoadHistory
    events: Mapping[str, Any]


def scene_scenario(scene_name: str, csv: str, duration: float) -> Scenario:
    """Compute the load of a scene's operation, or read that of a CSV file in its place.

    Parameters
    ----------
    scene_name : str
    csv : str
        '' for the scene's operation.
    duration : float
        0 for the scene's own, or the whole CSV, [s].

    Raises
    ------
    InputError
        With every mistake in the scene, or it has several axleboxes.
    """
    from beardyn_core.config import read_scene
    from beardyn_core.rail.build import load_of_scene
    from beardyn_core.rail.measured import read_measurement
    from beardyn_core.scene.operation import MeasuredOperation
    from beardyn_ros.one_box import check_one_box

    scene = read_scene(scene_name).scene  # of which only the load matters
    check_one_box(scene, scene_name, "load node", "node car_load has the loads of all")
    length = duration or scene.duration
    if csv:
        path = Path(csv)
        scene = replace(scene, operation=MeasuredOperation(path))
        if not duration:
            time_s = read_measurement(path).time
            length = float(time_s[-1] - time_s[0])
    history = load_of_scene(scene, length)
    return Scenario(history, scenario_events(replace(scene, duration=length)))


def scenario_events(scene: Scene) -> dict[str, Any]:
    """List what a scene does to the load, JSON-able, in SI units."""
    return {"scene": scene.name, "seed": scene.seed, **events_of(scene)}


def truth_text(scenario: Scenario, replay: Replay, state: str, run_id: str) -> str:
    """Write ``load/truth``: the events of the scenario, and where in it the stream stands when.

    Parameters
    ----------
    scenario : Scenario
    replay : Replay
    state : str
        `PLAYING`, `PAUSED` or `ENDED`.
    run_id : str
        Of the twin's run that the stream feeds, '' when not known.
    """
    passages = [
        {
            "sample": passage.sample,
            "stamp_s": passage.stamp_ns / 1e9,
            "position_s": passage.position_s,
            "fade_s": passage.fade_s,
        }
        for passage in replay.passages[-PASSAGES_TOLD:]
    ]
    content = {
        **scenario.events,
        "run_id": run_id,
        "replay": {
            "state": state,
            "length_s": replay.length_s,
            "sample_spacing_s": replay.spacing_ns / 1e9,
            "loop": replay.loop,
            "passage_count": len(replay.passages),
            "passages": passages,
        },
    }
    return json.dumps(content, default=str)


def says_paused(truth: str) -> bool:
    """Check whether the sender of a ``load/truth`` is paused knowingly; False when it cannot be read."""
    try:
        replay = read_object(truth, {"replay": dict})["replay"]
    except InputError:
        return False
    return bool(replay.get("state") == PAUSED)
