"""Drag and churning of the rollers in grease, oil and air."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import About
from beardyn_core.effects.grease import SETTLED_FILL, aged_fill


@dataclass(frozen=True)
class Drag:
    """Drag on the orbit and churning on the spin of the rollers; the medium rests on the cup."""

    about: ClassVar[About] = About(
        loss="drag",
        heat={"grease": 1.0},
        adds="Drag on the orbit and churning on the spin of the rollers.",
        states="none",
        cost="low",
        validity="A homogeneous medium at rest on the cup; neither wakes nor the cage are seen.",
        source="Gupta (1984), drag and disc; Theodorsen and Regier (1944), cylinder",
    )

    fill: A[float, SHARE, "lubricant in the free space where the rollers run"] = SETTLED_FILL
    million_revolutions: A[
        float | None,
        At(ge=0.0, le=1e4),
        "of the shaft since the grease was filled in, which leave less of the fill",
    ] = None
    drag_coefficient: A[
        float, At(ge=0.0, le=10.0), "of a roller across its orbit, over its length and diameter"
    ] = 1.2
    churning: A[float, At(ge=0.0, le=10.0), "churning over that of a roller alone in the medium"] = 1.0

    @property
    def present_fill(self) -> float:
        """Lubricant in the free space after the running so far."""
        if self.million_revolutions is None:
            return self.fill
        return aged_fill(self.fill, self.million_revolutions)
