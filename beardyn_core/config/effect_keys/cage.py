"""Keys of an effect: cage of each row."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import Field

from beardyn_core.config.file_model import (
    FileModel,
    Friction,
    NonNegative,
    Positive,
)
from beardyn_core.effects import Cage


class CageEffectKeys(FileModel):
    """Cage of each row, touched by every roller in its pocket."""

    friction: Friction = Cage.friction
    regularisation_speed_m_per_s: Positive = Cage.regularisation_speed
    bar_inclination_deg: Annotated[NonNegative, Field(lt=90.0)] = Field(
        math.degrees(Cage.bar_inclination), description="of the bar faces against the radial plane"
    )
    initial_speed_ratio: Annotated[NonNegative, Field(le=2.0)] = Field(
        Cage.initial_speed_ratio, description="speed of cages and rollers at the start over the kinematic one"
    )

    def noun(self) -> Cage:
        """The cage, SI."""
        return Cage(
            friction=self.friction,
            regularisation_speed=self.regularisation_speed_m_per_s,
            bar_inclination=math.radians(self.bar_inclination_deg),
            initial_speed_ratio=self.initial_speed_ratio,
        )
