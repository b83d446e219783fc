"""Keys of an effect: lubricant film of the raceway contacts."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictBool

from beardyn_core.config.file_model import (
    FileModel,
    Fraction,
)
from beardyn_core.effects import LineFilm


class LineFilmKeys(FileModel):
    """Elastohydrodynamic film of the raceway contacts."""

    starvation: Annotated[Fraction, Field(gt=0.0)] = Field(
        LineFilm.starvation, description="film over the fully flooded film"
    )
    formula: Literal["dowson_higginson", "pan_hamrock", "pan_hamrock_central", "dowson_toyoda"] = Field(
        "dowson_higginson", description="minimum film, or the central one of the last two"
    )
    thermal: Literal["none", "murch_wilson", "wilson", "gupta_cheng"] = Field(
        "none", description="reduction by shear heating of the inlet"
    )
    isoviscous: StrictBool = Field(
        LineFilm.isoviscous, description="light contacts have the film of rigid surfaces where it is thicker"
    )
    thickening: Literal["barus", "roelands"] = Field(
        "barus", description="viscosity at pressure, for film tractions that ask for it"
    )

    def noun(self) -> LineFilm:
        """The line film, SI."""
        return LineFilm(
            starvation=self.starvation,
            formula=self.formula,
            thermal=self.thermal,
            isoviscous=self.isoviscous,
            thickening=self.thickening,
        )
