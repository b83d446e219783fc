"""Load at the steps of a block: linear between samples, to the bits of NumPy's interpolation."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.rail.load_buffer import LoadBuffer
from beardyn_core.scene.load import LoadHistory


def random_history(first_ns: int, count: int, seed: int) -> LoadHistory:
    random = np.random.default_rng(seed)
    times = first_ns + np.cumsum(random.integers(1, 3_000_000, count))
    return LoadHistory(
        times, 1e4 * random.normal(size=(count, 6)), 100.0 + random.normal(size=count),
        1e-3 * random.normal(size=(count, 3)),
    )  # fmt: skip


@pytest.mark.parametrize("parts", [1, 3])
@pytest.mark.parametrize("steps", [512, 2048])
def test_rows_are_those_of_numpy(parts: int, steps: int) -> None:
    """Before the first and after the last sample the load is held."""
    buffer, joined, end = LoadBuffer(), [], -30_000_000
    for seed in range(parts):
        part = random_history(end, 70, seed)
        assert buffer.append(part)
        joined.append(part)
        end = int(part.time_ns[-1])
    times = np.concatenate([part.time_ns for part in joined])
    columns = np.concatenate(
        [np.column_stack([part.wrench, part.shaft_speed, part.bogie]) for part in joined]
    )
    for start in range(-60_000_000, end + 40_000_000, 20_000_000):
        at = np.arange(steps + 1) * (20_000_000 / steps)
        seconds = (times - start).astype(float)
        expected = np.stack([np.interp(at, seconds, column) for column in columns.T], axis=-1)
        np.testing.assert_array_equal(
            buffer.copy().at_steps(start, start + 20_000_000, steps), expected, err_msg=str(start)
        )


@pytest.mark.parametrize("spacing_ns", [100_000, 3_000_000, 9_000_000])
def test_blocks_at_once_have_the_rows_of_one_after_the_other(spacing_ns: int) -> None:
    """Also where they begin before the first sample and end behind the last one; columns may be constant."""
    random = np.random.default_rng(spacing_ns)
    times = np.arange(0, 400_000_000, spacing_ns)
    wrench = 1e4 * random.normal(size=(len(times), 6))
    wrench[:, 4] = 3.0
    buffer = LoadBuffer(ended=True)
    assert buffer.append(LoadHistory(times, wrench, np.ones(len(times)), np.zeros((len(times), 3))))
    start, blocks, steps, block_ns = -40_000_000, 24, 512, 20_000_000
    whole = buffer.copy().at_steps(start, start + blocks * block_ns, steps, blocks)
    for block in range(blocks):
        begin = start + block * block_ns
        alone = buffer.copy().at_steps(begin, begin + block_ns, steps)
        first = block * steps + (block > 0)  # the end of a block before is a row of that
        np.testing.assert_array_equal(whole[first : (block + 1) * steps + 1], alone[int(block > 0) :])
