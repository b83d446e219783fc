"""Messages that nobody should send: random content of the right type, cut, bent, in the name of others."""

from __future__ import annotations

import json
import random
import struct
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from beardyn_core.record.clouds import CLOUD, encode_points
from beardyn_core.record.messages import (
    CLOCK,
    DIAGNOSTICS,
    STRING,
    TIME,
    Diagnostic,
    decode_string,
    encode_diagnostics,
    encode_string,
)
from beardyn_core.record.topics import Topic

_STAMP = struct.Struct("<iI")
STAMPS = ((0, 0), (0, 1), (2**31 - 1, 999_999_999), (-(2**31), 0), (3, 2**32 - 1), (-1, 999_999_999))
NUMBERS = (float("nan"), float("inf"), -float("inf"), 1e300, 0.0, -1e9)
KINDS = ("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8")
NAMES = ("sample", "t", "ax", "fx", "fz", "body", "row", "roller", "kind", "x", "", "shaft_speed", "ä")
PARTS = ("twin", "load", "recorder", "monitor", "follower", "viewer", "lag")


class Hostile:
    """Makes hostile messages of any topic.

    Parameters
    ----------
    seed : int
    received : callable
        ``received(name)`` gives true messages of a topic so far, to be bent.
    """

    def __init__(self, seed: int, received: Callable[[str], Sequence[bytes]]) -> None:
        self._random = random.Random(seed)
        self._received = received

    def message(self, entry: Topic) -> bytes:
        """Make one message of a topic."""
        true = self._received(entry.name)
        ways: list[Callable[[Topic], bytes]] = [self._noise]
        if true:
            ways += [self._bent, self._cut, self._another_time, self._another_time, self._repeated]
        own = {CLOUD: self._cloud, STRING: self._text, DIAGNOSTICS: self._statuses}
        if entry.type in own:
            ways += [own[entry.type]] * 4
        elif entry.type in (TIME, CLOCK):
            ways += [self._time] * 4
        else:
            ways += [self._numbers] * 2
        return self._random.choice(ways)(entry)

    # --- of any type -------------------------------------------------------------------------------

    def _true(self, entry: Topic) -> bytes:
        return self._random.choice(self._received(entry.name)[-50:])

    def _noise(self, entry: Topic) -> bytes:
        # the middleware drops what is longer than a type of fixed length: on one side or on the other
        most = _STAMP.size if entry.type in (TIME, CLOCK) else 200
        return b"\x00\x01\x00\x00" + self._random.randbytes(self._random.randrange(most + 1))

    def _bent(self, entry: Topic) -> bytes:
        cdr = bytearray(self._true(entry))
        for _ in range(self._random.choice((1, 3, 30))):
            cdr[self._random.randrange(4, len(cdr))] = self._random.randrange(256)
        return bytes(cdr)

    def _cut(self, entry: Topic) -> bytes:
        cdr = self._true(entry)
        return cdr[: self._random.randrange(4, len(cdr))] if self._random.random() < 0.7 else cdr + cdr

    def _repeated(self, entry: Topic) -> bytes:
        return self._true(entry)

    def _another_time(self, entry: Topic) -> bytes:
        cdr = bytearray(self._true(entry))
        if entry.type != STRING and len(cdr) >= 12:
            _STAMP.pack_into(cdr, 4, *self._stamp())
        return bytes(cdr)

    def _numbers(self, entry: Topic) -> bytes:
        """Bend the numbers of a stamped message."""
        if not self._received(entry.name):
            return self._noise(entry)
        cdr = bytearray(self._true(entry))
        for _ in range(3):
            at = 8 * self._random.randrange(2, max(len(cdr) // 8, 3)) + 4
            if at + 8 <= len(cdr):
                struct.pack_into("<d", cdr, at, self._random.choice(NUMBERS))
        return bytes(cdr)

    def _stamp(self) -> tuple[int, int]:
        near = (self._random.randrange(60), self._random.randrange(10**9))
        return self._random.choice((*STAMPS, near, near, near))

    def _time(self, _entry: Topic) -> bytes:
        return b"\x00\x01\x00\x00" + _STAMP.pack(*self._stamp())

    # --- of one type -------------------------------------------------------------------------------

    def _cloud(self, entry: Topic) -> bytes:
        """Make a cloud of random columns, or the true columns with random numbers."""
        true, pick = self._received(entry.name), self._random.choice
        if true and self._random.random() < 0.5:
            from beardyn_core.record.cloud_layout import cloud_points

            points = cloud_points(self._true(entry)).copy()
            for name in points.dtype.names or ():
                if self._random.random() < 0.3 and len(points):
                    whole = points.dtype[name].kind in "iu"
                    with np.errstate(all="ignore"):
                        points[name] = pick((0, 1, 200)) if whole else pick(NUMBERS)
            frame = pick(("axlebox", "x"))
            return encode_points(points[: pick((0, 1, len(points)))], self._stamp_ns(), frame)
        names = self._random.sample(NAMES, self._random.randrange(1, 6))
        dtype = np.dtype([(name or f"_{k}", f"<{pick(KINDS)}") for k, name in enumerate(names)])
        data = self._random.randbytes(dtype.itemsize * self._random.randrange(20))
        return encode_points(np.frombuffer(data, dtype), self._stamp_ns(), "axlebox")

    def _stamp_ns(self) -> int:
        seconds, nanoseconds = self._stamp()
        return seconds * 10**9 + nanoseconds % 10**9

    def _text(self, entry: Topic) -> bytes:
        pick, run_id = self._random.choice, self._random.choice(("0badcafe-0", "", "../../x", "é\n"))
        texts: tuple[Callable[[], str], ...] = (
            lambda: pick(("[", '{"a":', '[{"b":[')) * pick((100, 5000, 200_000)),
            lambda: pick(("hello", "", "null", "3", '"x"', "[1]", '{"a": NaN}', '{"run_id": "\\ud800"}')),
            lambda: json.dumps({"run_id": run_id, "scene": pick(("x", "/etc/x", "../x", "\0", "a" * 5000))}),
            lambda: json.dumps({"final": True, "health": 3, "estimates": {"x": None}, "steps": [[]]}),
            lambda: json.dumps({"replay": pick((None, [], {"state": "paused"}, {"state": []}))}),
            lambda: '{"x": "' + "y" * (5_000_000 if self._random.random() < 0.05 else 1000) + '"}',
            lambda: '{"x": ' + "9" * 6000 + "}",
            lambda: self._changed_object(entry, run_id),
            lambda: self._changed_object(entry, None),
        )
        return encode_string(pick(texts)())

    def _changed_object(self, entry: Topic, run_id: str | None) -> str:
        """Change values of a true text in place, down to any depth."""
        if not self._received(entry.name):
            return "{}"
        found = json.loads(decode_string(self._true(entry)))
        place: Any = found
        while isinstance(place, (dict, list)) and place:
            key: Any = self._random.choice(list(place) if isinstance(place, dict) else range(len(place)))
            if not isinstance(place[key], (dict, list)) or self._random.random() < 0.3:
                place[key] = self._random.choice((None, -1, 1e308, "x", [], {}, True))
                break
            place = place[key]
        return json.dumps(found if run_id is None else {**found, "run_id": run_id})

    def _statuses(self, entry: Topic) -> bytes:
        pick = self._random.choice
        keys = ("state", "run_id", "instance", "since", "final", "messages force", "simulated_time")
        words = ("finished", "stopped", "running", "", "0badcafe-0", "true", "9" * 5000, "-1", "nan", "²")
        values = tuple((pick(keys), pick(words)) for _ in range(self._random.randrange(6)))
        status = Diagnostic(f"axlebox/{pick(PARTS)}", pick((0, 1, 2, 3, 100)), pick(words), values)
        return encode_diagnostics(self._stamp_ns(), "axlebox", [status] * pick((0, 1, 1, 3)))
