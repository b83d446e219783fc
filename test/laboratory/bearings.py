"""The bearing of the tests."""

from functools import cache

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.config import load_bearing


@cache
def bearing() -> Bearing:
    """High-speed axlebox unit."""
    return load_bearing("HS130x230")
