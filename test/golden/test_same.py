"""The harness of `make same` sees a difference of one bit, and sees none where there is none."""

from __future__ import annotations

import dataclasses
import subprocess
import sys
from pathlib import Path

import numpy as np

from beardyn_core.choice import load_scene
from test.golden.same import RUNS, TIERS, _bytes_of, _canonical, compare, digest, digests_of_run

ROOT = Path(__file__).resolve().parents[2]


def test_one_bit_of_a_state_is_seen() -> None:
    state = np.linspace(0.0, 1.0, 7)
    moved = state.copy()
    moved[3] = np.nextafter(moved[3], 1.0)
    assert digest(_bytes_of(state)) == digest(_bytes_of(state.copy()))
    assert digest(_bytes_of(state)) != digest(_bytes_of(moved))


def test_one_bit_of_a_noun_is_seen() -> None:
    scene = load_scene("static_80kN")
    assert _canonical(scene) == _canonical(load_scene("static_80kN"))
    moved = dataclasses.replace(scene, temperature=float(np.nextafter(scene.temperature, 400.0)))
    assert _canonical(scene) != _canonical(moved)


def test_what_differs_is_gone_or_is_new_is_named() -> None:
    found = compare({"a": "1", "b": "2", "c": "3"}, {"a": "1", "b": "4", "d": "5"})
    assert found == ["differs  b", "gone     c", "new      d"]


def test_runs_cover_every_tier_and_have_names_of_their_own() -> None:
    names = [run[0] for run in RUNS]
    assert len(set(names)) == len(names)
    assert {run[2] for run in RUNS} == set(TIERS)


def test_a_run_gives_the_same_digests_twice() -> None:
    run = ("twice", "static_80kN", "lumped", "")
    first = digests_of_run(run)
    assert len(first) > 20
    assert compare(first, digests_of_run(run)) == []


def test_a_filter_that_meets_nothing_is_no_proof() -> None:
    words = [sys.executable, "-m", "test.golden.same", "HEAD", "--only", "no such name"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "nothing that is compared has this text" in done.stderr
