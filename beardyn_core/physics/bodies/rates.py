"""How often things are computed: samples of waveforms, steps of blocks."""

from __future__ import annotations

WAVEFORM_RATE = 25_600


BLOCK_NS = 20_000_000


SAMPLES_PER_BLOCK = 512
