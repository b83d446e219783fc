"""No effect lacks what is easily forgotten: a rule of the automatic choice, a loss name, a share of heat."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from beardyn_core import effects
from beardyn_core.choice.choose import RULES
from beardyn_core.effects import EffectSet
from beardyn_core.effects.catalogue import Entry, catalogue
from beardyn_core.physics.bodies.layout import LOSS_NAMES
from beardyn_core.physics.thermal import NODES, heat_shares

# decided by the rule of another effect
DECIDED_WITH = {"film": "traction"}
OUTSIDE = {"suspension"}  # warms nothing of the bearing


@pytest.mark.parametrize("effect", [field.name for field in fields(EffectSet)])
def test_every_effect_has_a_rule_in_the_automatic_choice(effect: str) -> None:
    assert DECIDED_WITH.get(effect, effect) in {rule.__name__ for rule in RULES}


@pytest.mark.parametrize("entry", catalogue(), ids=lambda entry: entry.options.__name__)
def test_every_effect_names_its_loss_or_says_that_it_has_none(entry: Entry) -> None:
    assert entry.about.loss in ("", *LOSS_NAMES)


def test_every_loss_is_that_of_an_effect_or_of_the_suspension() -> None:
    options = [each for each in vars(effects).values() if hasattr(each, "about")]  # those of options, too
    assert {each.about.loss for each in options} - {""} == set(LOSS_NAMES) - OUTSIDE


@pytest.mark.parametrize("loss", LOSS_NAMES)
def test_every_loss_warms_something_with_all_of_it(loss: str) -> None:
    shares = heat_shares()[LOSS_NAMES.index(loss)]
    assert shares.shape == (len(NODES),)
    assert np.all(shares >= 0.0)
    assert shares.sum() == pytest.approx(0.0 if loss in OUTSIDE else 1.0)
