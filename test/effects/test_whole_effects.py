"""No effect lacks what is easily forgotten: a rule of the automatic choice, a loss name, a share of heat."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from beardyn_core import effects
from beardyn_core.choice.choose import RULES
from beardyn_core.effects import About, EffectSet
from beardyn_core.effects.catalogue import Entry, abouts, catalogue
from beardyn_core.physics.bodies.losses import LOSS_NAMES
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


@pytest.mark.parametrize("about", abouts(), ids=lambda about: about.adds[:30])
def test_every_effect_says_what_its_loss_warms_as_others_with_that_loss_do(about: About) -> None:
    assert bool(about.heat) == bool(about.loss)
    if about.loss:
        assert set(about.heat) <= set(NODES)
        assert all(other.heat == about.heat for other in abouts() if other.loss == about.loss)


@pytest.mark.parametrize("about", abouts(), ids=lambda about: about.adds[:30])
def test_every_effect_needs_nothing_but_other_effects(about: About) -> None:
    assert set(about.needs) <= {field.name for field in fields(EffectSet)}


def test_every_loss_is_that_of_an_effect_or_of_the_suspension() -> None:
    options = [each for each in vars(effects).values() if hasattr(each, "about")]  # those of options, too
    assert {each.about.loss for each in options} - {""} == set(LOSS_NAMES) - OUTSIDE


@pytest.mark.parametrize("loss", LOSS_NAMES)
def test_every_loss_warms_something_with_all_of_it(loss: str) -> None:
    shares = heat_shares()[LOSS_NAMES.index(loss)]
    assert shares.shape == (len(NODES),)
    assert np.all(shares >= 0.0)
    assert shares.sum() == pytest.approx(0.0 if loss in OUTSIDE else 1.0)
