"""Names of frames, one tree for each axlebox.

The frame of an axlebox has its origin at the bearing centre: x forwards, y left along the axle, z up
(REP-103). Parts and sensors have frames below it, ``<frame>/cone``, ``<frame>/axlebox_top``.
"""

from __future__ import annotations

from re import fullmatch

from beardyn_core.base.errors import InputError
from beardyn_core.record.topics import FRAME
from beardyn_ros.parameters import NodeParameter

FRAME_ID = NodeParameter(
    "frame_id",
    "",
    "frame of the axlebox, origin at the bearing centre; empty: the namespace, so that several boxes differ",
)


def frame_of(namespace: str, frame_id: str = "") -> str:
    """Choose the frame of an axlebox: as given, or its namespace without the leading slash.

    Parameters
    ----------
    namespace : str
        Of the node, ``/car/axle_1_left``.
    frame_id : str
        The parameter; '' for the namespace.

    Raises
    ------
    InputError
        The name is none that tf2 takes.
    """
    name = frame_id or namespace.strip("/") or FRAME
    if not fullmatch(r"[A-Za-z0-9_.-]+(/[A-Za-z0-9_.-]+)*", name):
        raise InputError(
            f"parameter 'frame_id': '{name}' is no name of a frame; letters, digits, _ . - and single "
            "slashes in between are allowed, none at the start (tf2 refuses it)"
        )
    return name
