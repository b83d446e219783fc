"""Rating life as text and as the object that ``--json`` prints."""

from __future__ import annotations

import math
from typing import Any

from beardyn_core.integrate.rating_life import RatingLife

_MILLION = 1.0e6


def _millions(revolutions: float) -> str:
    return f"{revolutions / _MILLION:,.0f}" if math.isfinite(revolutions) else "endless"


def life_sentence(life: RatingLife) -> str:
    """The lives in one line."""
    return (
        f"basic {_millions(life.basic)} (ISO 281), {_millions(life.reference_basic)} (ISO 16281); modified "
        f"{_millions(life.modified)}, {_millions(life.reference_modified)} million revolutions"
    )


def life_object(life: RatingLife) -> dict[str, Any]:
    """The lives for ``--json``; endless ones are null."""

    def millions(revolutions: float) -> float | None:
        return revolutions / _MILLION if math.isfinite(revolutions) else None

    return {
        "equivalent_load_N": life.equivalent_load,
        "L10_million_rev": millions(life.basic),
        "L10m_million_rev": millions(life.modified),
        "L10r_million_rev": millions(life.reference_basic),
        "L10mr_million_rev": millions(life.reference_modified),
        "viscosity_ratio": life.viscosity_ratio,
        "contamination": life.contamination,
        "load_classes": life.classes,
    }


def life_lines(life: RatingLife) -> list[str]:
    """The lives as lines of text."""
    return [
        "Rating life, million revolutions at 90 % reliability",
        f"  ISO 281    basic {_millions(life.basic)}, modified {_millions(life.modified)}; "
        f"equivalent load {life.equivalent_load / 1e3:.1f} kN",
        f"  ISO 16281  basic {_millions(life.reference_basic)}, "
        f"modified {_millions(life.reference_modified)}",
        f"  viscosity ratio {life.viscosity_ratio:.2f}, contamination {life.contamination:g}",
    ]
