"""Where Aihara's traction of a fluid film was fitted."""

from __future__ import annotations

from typing import Annotated as A

# All of the fit holds from twice this largest Hertz pressure on, the lowest of its tests; below it is
# blended away.
NO_LONGER_FITTED: A[float, "[Pa]"] = 0.25e9
