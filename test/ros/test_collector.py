"""What the compiler has made is no work for the garbage collector."""

from __future__ import annotations

import gc
import time

from beardyn_ros.run_state import READY, SessionOptions
from beardyn_ros.session import TwinSession
from test.ros.fake_twin import fake_rig

OPTIONS = SessionOptions("lockstep", 5.0, 5.0, 1.0, 10**10, 10**8, False, 10.0, "axlebox", "one")


def test_compiled_twin_is_left_alone_by_the_garbage_collector() -> None:
    """A full collection among all that a compiler has made holds the run for a quarter of a second."""
    session = TwinSession(fake_rig("fake", "scene"), OPTIONS, 0.0, lambda: None)
    before = gc.get_freeze_count()
    session.compile()
    try:
        deadline = time.monotonic() + 20.0
        while session.report().state != READY:
            assert time.monotonic() < deadline
            time.sleep(0.01)
        assert gc.get_freeze_count() - before > 0.9 * len(gc.get_objects())
    finally:
        session.end(5.0)
        gc.unfreeze()
