"""The true bearing of a record is found among those that fit."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from beardyn_core.config import load_plate
from beardyn_core.config.catalogue import search_catalogue
from evidence.measured.bearing_ranks import place_of, searched
from evidence.measured.cases import MFPT, Listening, Record


def test_strikes_of_a_bearing_put_it_first_of_its_size_and_noise_puts_none() -> None:
    plate, rate, speed = load_plate("6205"), 12_000.0, 30.0
    time = np.arange(int(2.5 * rate)) / rate
    strikes = np.diff(np.floor(time * speed * plate.frequencies.bpfo), prepend=0.0)
    ring = np.exp(-np.arange(50) / rate / 6e-4) * np.sin(6e3 * np.pi * np.arange(50) / rate)
    noise = np.random.default_rng(4).normal(size=len(time))
    struck, quiet = (
        Listening(
            Record(MFPT, "made", Path("made.mat"), ""),
            *("", plate, "", rate, speed),
            noise + loud * np.convolve(strikes, ring)[: len(time)],
        )
        for loud in (30.0, 0.0)
    )
    entries = search_catalogue(bore=0.025, outer_diameter=0.052)
    assert place_of("6205", searched(struck, entries)) == 1
    assert searched(quiet, entries).answer == "cannot tell"
