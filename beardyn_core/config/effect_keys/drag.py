"""Keys of an effect: drag and churning of the rollers."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from beardyn_core.config.file_model import (
    FileModel,
    Fraction,
    NonNegative,
)
from beardyn_core.effects import Drag


class DragKeys(FileModel):
    """Drag on the orbit and churning on the spin of the rollers."""

    fill: Fraction = Field(Drag.fill, description="lubricant in the free space where the rollers run")
    drag_coefficient: Annotated[NonNegative, Field(le=10.0)] = Drag.drag_coefficient
    churning: Annotated[NonNegative, Field(le=10.0)] = Field(
        Drag.churning, description="churning over that of a roller alone in the medium"
    )

    def noun(self) -> Drag:
        """The drag, SI."""
        return Drag(fill=self.fill, drag_coefficient=self.drag_coefficient, churning=self.churning)
