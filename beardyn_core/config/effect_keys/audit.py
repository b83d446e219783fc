"""Keys of an effect: energy balance."""

from __future__ import annotations

from beardyn_core.config.file_model import (
    FileModel,
)
from beardyn_core.effects import Audit


class AuditKeys(FileModel):
    """Energy balance kept while the model runs."""

    def noun(self) -> Audit:
        """The audit, SI."""
        return Audit()
