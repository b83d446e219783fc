"""Which parts of a scene the automatic choice may set."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated as A

from beardyn_core.effects import EffectSet

EFFECTS = tuple(field.name for field in fields(EffectSet))


@dataclass(frozen=True)
class Free:
    """Parts of a scene that the automatic choice may set; the rest stays as written."""

    tier: bool = True
    laminae: bool = True
    steps: bool = True
    effects: A[frozenset[str], "members of the effect set"] = frozenset(EFFECTS)

    @property
    def anything(self) -> bool:
        """Whether any part may be chosen."""
        return self.tier or self.laminae or self.steps or bool(self.effects)


NOTHING = Free(tier=False, laminae=False, steps=False, effects=frozenset())
