"""The table of mountings counts what is made of each mistake."""

from __future__ import annotations

from collections import Counter

from evidence.follow.mountings import AMONG, FAMILIAR, RIGHT, WRONG, mistakes, outcome
from test.follow.test_mounting import learnt, received


def test_mistakes_are_judged_by_kind_axes_and_amount() -> None:
    tried = {each.words: each for each in mistakes()}
    count = {
        words: Counter(outcome(received(seed), tried[words], learnt()) for seed in range(3000, 3010))
        for words in ("none", "channels x, z, y", "gain of y -10 dB")
    }
    assert count["none"][FAMILIAR] >= 8
    for words in ("channels x, z, y", "gain of y -10 dB"):
        assert count[words][RIGHT] + count[words][AMONG] >= 7, words
        assert count[words][WRONG] == 0
