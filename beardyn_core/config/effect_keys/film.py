"""Keys of an effect: lubricant film of the raceway contacts."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from beardyn_core.config.file_model import (
    FileModel,
    Fraction,
)
from beardyn_core.effects import LineFilm


class LineFilmKeys(FileModel):
    """Elastohydrodynamic film of the raceway contacts."""

    starvation: Annotated[Fraction, Field(gt=0.0)] = Field(
        0.7, description="film over the fully flooded film"
    )

    def noun(self) -> LineFilm:
        """The line film, SI."""
        return LineFilm(starvation=self.starvation)
