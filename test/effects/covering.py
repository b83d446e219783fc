"""Sets of choices in which every pair of choices of two factors occurs: a covering array of strength 2."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

Row = dict[str, int]


def covering_array(sizes: Mapping[str, int], seed: int = 1, trials: int = 60) -> list[Row]:
    """Rows of choices, one index a factor; greedy, the best of several candidates at each row."""
    random_ = random.Random(seed)
    names = list(sizes)
    missing = {
        ((a, i), (b, j)) for a, b in combinations(names, 2) for i in range(sizes[a]) for j in range(sizes[b])
    }
    rows: list[Row] = []
    while missing:
        best: Row = {}
        covered: set[Any] = set()
        for _ in range(trials):
            candidate = _candidate(names, sizes, missing, random_)
            gain = missing & pairs_of(candidate)
            if len(gain) > len(covered):
                best, covered = candidate, gain
        rows.append(best)
        missing -= covered
    return rows


def pairs_of(row: Row) -> set[Any]:
    """All pairs of choices in a row."""
    return set(combinations(row.items(), 2))


def _candidate(names: Sequence[str], sizes: Mapping[str, int], missing: set[Any], random_: Any) -> Row:
    """A row that begins with a missing pair; the other factors, in random order, take what covers most."""
    (a, i), (b, j) = random_.choice(sorted(missing))
    chosen = {a: i, b: j}
    others = [name for name in names if name not in chosen]
    random_.shuffle(others)
    for name in others:
        gains = []
        for choice in range(sizes[name]):
            new = [
                tuple(sorted(((name, choice), item), key=lambda x: names.index(x[0])))
                for item in chosen.items()
            ]
            gains.append((sum(pair in missing for pair in new), random_.random(), choice))
        chosen[name] = max(gains)[2]
    return {name: chosen[name] for name in names}
