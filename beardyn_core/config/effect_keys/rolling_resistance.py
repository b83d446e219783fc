"""Keys of an effect: resistance of the raceway contacts against rolling."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import Field, StrictBool, model_validator

from beardyn_core.config.file_model import (
    FileModel,
    Fraction,
    NonNegative,
    Positive,
    problem,
)
from beardyn_core.effects import RollingResistance
from beardyn_core.effects.rolling_resistance import RollingKind


class RollingResistanceKeys(FileModel):
    """Couple of the raceway contacts against rolling."""

    kind: RollingKind = Field(RollingResistance.kind, description="law of the film's couple")
    supply: Fraction = Field(RollingResistance.supply, description="couple over that of a flooded inlet")
    thermal: StrictBool = Field(RollingResistance.thermal, description="heating of the inlet")
    hysteresis: Annotated[NonNegative, Field(le=0.1)] = Field(
        RollingResistance.hysteresis, description="share of the elastic energy lost in a cycle"
    )
    regularisation_speed_m_per_s: Positive = RollingResistance.regularisation_speed

    @model_validator(mode="after")
    def _some_loss(self) -> Self:
        if self.kind == "hysteresis" and self.hysteresis == 0.0:
            raise problem(
                "kind is hysteresis, but hysteresis is 0; give the share of the elastic energy lost in a "
                "cycle, 0.005 to 0.01 for bearing steel"
            )
        return self

    def noun(self) -> RollingResistance:
        """The rolling resistance, SI."""
        return RollingResistance(
            kind=self.kind,
            supply=self.supply,
            thermal=self.thermal,
            hysteresis=self.hysteresis,
            regularisation_speed=self.regularisation_speed_m_per_s,
        )
