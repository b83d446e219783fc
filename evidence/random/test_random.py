"""Random scenes: drawn from what the configuration declares, judged by how they end."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.edge import At
from beardyn_core.base.errors import ValidityError
from beardyn_core.experiments import ThisProcess
from beardyn_core.scene.operation import ConstantOperation, QuarterVehicleOperation, SteppedOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from evidence.random import book, trial
from evidence.random.__main__ import main
from evidence.random.drawing import draw, undrawable
from evidence.random.page import page, plain
from evidence.random.scenes import KERNELS, OWN, case
from evidence.random.trial import ENDS, FAILED, FINITE, Tried, judged, not_finite

DRAWN_LATER: dict[tuple[str, str], Any] = {
    ("ConstantOperation", "force"): None,
    ("SteppedOperation", "steps"): None,
}


@dataclass(frozen=True)
class _Noun:
    """A noun with a key that nobody can draw."""

    name: A[str, "of it"]
    size: A[float, At("mm", gt=0.0, le=2.0), "of it"]


def _simple(**keys: object) -> Scene:
    """Take a scene whose kernel the other tests compile as well."""
    from beardyn_core.choice import scene_from_text
    from beardyn_core.config.yaml_text import write_mapping

    usual = {
        "scene": "plain",
        "bearing": "HS130x230",
        "lubricant": "L055",
        "duration_s": 0.02,
        "tier": "lumped",
        "effects": "standard",
        "operation": {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 1000},
    }
    return scene_from_text(write_mapping({**usual, **keys}), "plain")


@pytest.mark.parametrize(
    "noun",
    [Scene, ConstantOperation, SteppedOperation, QuarterVehicleOperation],
    ids=lambda noun: noun.__name__,
)
def test_every_key_of_a_scene_can_be_drawn(noun: type) -> None:
    """A key that is added to a noun without limits has to say here what is sensible."""
    assert list(undrawable(noun, {**OWN, **DRAWN_LATER})) == []


def test_a_key_that_nobody_can_draw_is_named() -> None:
    assert list(undrawable(_Noun, {})) == ["_Noun.name"]


def test_numbers_stay_within_what_is_declared() -> None:
    chance = np.random.default_rng(1)
    sizes = [draw(_Noun, chance, {("_Noun", "name"): lambda _: "a"})["size_mm"] for _ in range(300)]
    assert min(sizes) > 0.0
    assert max(sizes) == 2.0  # the limit itself comes, too
    assert np.median(sizes) < 0.1  # decades, not a span


@pytest.mark.parametrize("speed", KERNELS)
def test_the_same_number_and_seed_are_the_same_legal_scene(speed: str) -> None:
    one, again, other = case(5, 1, speed), case(5, 1, speed), case(5, 2, speed)
    assert one.text == again.text != other.text
    assert one.scene.tier == one.kernel.tier


def test_a_traceback_and_a_number_that_is_none_are_failures(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = _simple()
    assert judged(scene).verdict == FINITE

    def lost(_block: Block) -> list[str]:
        return ["force_waveform"]

    monkeypatch.setattr(trial, "not_finite", lost)
    assert judged(scene)[:2] == (FAILED, "not finite, status 0: force_waveform")

    def broken(_scene: Scene) -> None:
        raise IndexError("out of bounds")

    monkeypatch.setattr(trial, "start", broken)
    assert judged(scene).verdict == FAILED
    assert "IndexError" in judged(scene).says


def test_an_end_needs_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    def ends(words: str) -> None:
        def raising(_scene: Scene) -> None:
            raise ValidityError(words)

        monkeypatch.setattr(trial, "start", raising)

    ends("no")
    assert judged(_simple()).verdict == FAILED
    ends("the load cannot be carried by this bearing: make it smaller")
    assert judged(_simple()).verdict == ENDS


def test_not_finite_names_the_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    from beardyn_core.run import start

    block = next(start(_simple()).blocks())
    assert not_finite(block) == []
    spoilt = block.force_waveform.copy()
    spoilt[3, 1] = np.nan
    assert not_finite(replace(block, force_waveform=spoilt)) == ["force_waveform"]


def test_results_are_kept_and_only_the_missing_are_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked: list[int] = []

    def some(number: int, _seed: int, speed: str) -> Tried:
        asked.append(number)
        return Tried(number, speed, "lumped", "standard", "sound", FAILED if number == 3 else FINITE)

    monkeypatch.setattr(book, "tried", some)
    monkeypatch.setattr(book, "Engine", lambda _cluster: nullcontext(ThisProcess()))
    words = ["--full", "0", "-o", str(tmp_path), "--jobs", "1"]
    assert main([*words, "--fast", "3"]) == 0
    assert main([*words, "--fast", "5"]) == 1
    assert asked == [0, 1, 2, 3, 4]
    assert "fast: 5 scenes: 4 finite, 1 FAILED" in capsys.readouterr().out
    with (tmp_path / "fast.jsonl").open("a") as file:
        file.write('{"number": 5, "ver')  # killed while it wrote
    assert main([*words, "--fast", "5"]) == 1
    assert asked == [0, 1, 2, 3, 4]
    stored = json.loads((tmp_path / "fast.jsonl").read_text().splitlines()[0])
    assert stored["code"] == book.code() == book.last_code(tmp_path, "fast")


def test_results_are_of_all_modules_that_a_run_goes_through() -> None:
    """Except for the engine of compilation, and what files of an estimator and a fleet are read by."""
    asked = "import sys, evidence.random.trial as t; t.tried(3, 1, 'fast'); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True).stdout
    files = {path.as_posix() for path in book.sources()}
    ours = [name for name in loaded.split() if name.startswith("beardyn_core.")]
    missing = [name for name in ours if not any(f"/{name.replace('.', '/')}" in path for path in files)]
    assert {name.split(".")[1] for name in missing} <= {"study", "follow", "monitor", "fleet"}
    assert len(ours) > 100


def test_page_counts_alike_sentences_together() -> None:
    ends = ["at 0.02 s: 3.1e+03 N are left of HS130x230", "at 0.04 s: 7 N are left of METRO120x220"]
    every = [Tried(n, "fast", "lumped", "standard", "sound", ENDS, says) for n, says in enumerate(ends)]
    every.append(Tried(9, "fast", "lumped", "standard", "sound", FAILED, "IndexError"))
    text = page(every)
    assert "3 scenes: 2 ends, 1 FAILED" in text
    assert "| at … s: … N are left of the bearing | 2 |" in text
    assert "- `fast 9`: IndexError" in text
    assert plain("[ 0.  -2.5 3.] N") == "… N"
