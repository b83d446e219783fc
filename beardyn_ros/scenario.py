"""What the load node replays, for one axlebox or for several: the load, and the truth about it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import read_object
from beardyn_core.rail.events import events_of
from beardyn_core.record.messages import Diagnostic
from beardyn_core.record.published import published_values
from beardyn_core.scene.axleboxes import Axleboxes, Box
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.diagnostics import OK, WARN
from beardyn_ros.replay import Replay
from beardyn_ros.rig import check_one_box

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene
    from beardyn_ros.message_guard import MessageGuard

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

    scene = read_scene(scene_name).scene  # of which only the load matters
    check_one_box(scene, scene_name, "load node", "node car_load has the loads of all")
    scene, length = _replayed(scene, csv, duration)
    history = load_of_scene(scene, length)
    return Scenario(history, scenario_events(replace(scene, duration=length)))


class CarScenario:
    """Loads of all boxes of a car out of one scene or CSV.

    Parameters
    ----------
    boxes : tuple of Box
    car : Axleboxes
    scene : str
    csv : str
        '' for the scene's operation.
    duration : float
        Of the streams, 0 for the scene's own, or the whole CSV, [s].

    Raises
    ------
    InputError
        The train does not get far enough, or turns back.
    """

    def __init__(self, boxes: tuple[Box, ...], car: Axleboxes, scene: str, csv: str, duration: float) -> None:
        from beardyn_core.config import read_scene
        from beardyn_core.rail.train import TrainLoads

        found, length = _replayed(read_scene(scene).scene, csv, duration)
        self._loads = TrainLoads(found, car, boxes, length)

    def of(self, box: Box) -> Scenario:
        """Make the load of one box, with the truth about it."""
        load = self._loads.of(box)
        events: Mapping[str, Any] = {
            **scenario_events(replace(load.scene, duration=self._loads.length)),
            "box": {
                "name": box.name,
                "behind_first_wheel_m": load.behind,
                "begins_in_scene_s": load.begins,
                "events_are_of": "the first wheel, in the time of the scene",
            },
        }
        return Scenario(load.history, events)


def _replayed(scene: Scene, csv: str, duration: float) -> tuple[Scene, float]:
    """Put a CSV in the place of a scene's operation; how long the load is, [s]."""
    from beardyn_core.rail.measured import read_measurement
    from beardyn_core.scene.operation import MeasuredOperation

    if not csv:
        return scene, duration or scene.duration
    if not duration:
        time_s = read_measurement(Path(csv)).time
        duration = float(time_s[-1] - time_s[0])
    return replace(scene, operation=MeasuredOperation(Path(csv))), duration


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


def load_diagnostic(
    name: str,
    state: str,
    replay: Replay,
    lead: float,
    lost_messages: int,
    sent: Mapping[str, int],
    guard: MessageGuard,
) -> Diagnostic:
    """Report the load node: where the stream stands in the scenario, how far ahead of the credit, [s]."""
    values = (
        ("state", state),
        ("position", f"{replay.position_s:.4f}"),
        ("sample", str(replay.next_sample)),
        ("stamp", f"{replay.next_ns * 1e-9:.4f}"),
        ("lead", f"{lead:.3f}"),
        ("passages", str(len(replay.passages))),
        ("loop", str(replay.loop).lower()),
        ("lost_messages", str(lost_messages)),
        *published_values(sent),
        *guard.values(),
    )
    said = "; ".join(filter(None, (f"the load is {state}", guard.sentence())))
    return Diagnostic(name, WARN if lost_messages or guard.total else OK, said, values)


def says_paused(truth: str) -> bool:
    """Check whether the sender of a ``load/truth`` is paused knowingly; False when it cannot be read."""
    try:
        replay = read_object(truth, {"replay": dict})["replay"]
    except InputError:
        return False
    return bool(replay.get("state") == PAUSED)
