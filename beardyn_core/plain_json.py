"""What strict JSON can hold: no NaN, no infinity, no arrays."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any


def strict_text(content: Mapping[str, Any], indent: int | None = None) -> str:
    """Write one strict JSON object; what it cannot hold is converted as by `plain`."""
    return json.dumps(plain(content), indent=indent, allow_nan=False)


def plain(value: Any) -> Any:
    """Convert a value to what strict JSON can hold: NaN and infinity to null, arrays and tuples to lists."""
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if hasattr(value, "tolist"):  # an array or a number of NumPy
        return plain(value.tolist())
    if isinstance(value, (list, tuple, set, frozenset)):
        return [plain(each) for each in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int, str)):
        return value
    return str(value)
