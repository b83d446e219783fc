"""The rerun view of a twin that is running, or of a follower: fed with messages, drawn in batches."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Mapping
from time import monotonic
from typing import Any

import rerun as rr

from beardyn_core.record.description import RunDescription
from beardyn_core.record.messages import decode_diagnostics, decode_string, decode_told, header_stamp
from beardyn_core.record.reading import run_of_messages
from beardyn_core.record.rerun_bearing import log_loads, log_motion, log_parts, roller_loads
from beardyn_core.record.rerun_follower import log_estimates, log_residual, quantities_of
from beardyn_core.record.rerun_plots import log_curves, log_spectrum, log_styles, order_spectrum
from beardyn_core.record.rerun_scale import log_scale
from beardyn_core.record.rerun_values import DRAWN, log_value
from beardyn_core.record.rerun_view import blueprint

BATCH_SECONDS = 0.25
SPECTRUM_SECONDS = 2.0
SPECTRUM_WINDOW_NS = 4_000_000_000
SPECTRUM_TOPICS = ("vibration", "shaft")
FOLLOWED = ("follower/estimate", "follower/residual")
MONITORED = tuple(each.topic for each in DRAWN)


class LiveView:
    """Draws a running twin into a rerun stream.

    The caller has connected the stream to where it goes (``spawn``, ``serve_grpc``, ``save``) and calls
    `feed` with every message, and `flush` at the end or from a timer. Messages before the first
    ``truth`` are dropped: without it the bearing is not known. What a follower says is drawn at once, for a
    real axlebox has no ``truth``.
    """

    def __init__(self, stream: rr.RecordingStream) -> None:
        self._stream = stream
        self._run: RunDescription | None = None
        self._batch: dict[str, list[bytes]] = defaultdict(list)
        self._window: dict[str, deque[bytes]] = {name: deque() for name in SPECTRUM_TOPICS}
        self._drawn = self._spectrum_drawn = monotonic()
        self._largest = 0.0
        self._estimates: tuple[str, ...] = ()
        self._monitored = False
        self.dropped = 0

    def feed(self, name: str, cdr: bytes) -> None:
        """Take a message.

        Parameters
        ----------
        name : str
            Name in the topic table.
        """
        if name == "truth":
            self._describe(RunDescription.from_json(decode_string(cdr)))
            return
        if name in FOLLOWED:
            self._follow(name, decode_told(cdr))
            return
        if name in MONITORED:
            self._log_number(name, cdr)
            return
        if self._run is None:
            self.dropped += 1
            return
        if name == "monitor/result":
            self._log_result(cdr)
            return
        self._batch[name].append(cdr)
        if name in self._window:
            kept = self._window[name]
            kept.append(cdr)
            while header_stamp(kept[0]) < header_stamp(cdr) - SPECTRUM_WINDOW_NS:
                kept.popleft()
        if monotonic() - self._drawn >= BATCH_SECONDS:
            self.flush()

    def flush(self) -> None:
        """Draw the messages that have arrived."""
        self._drawn = monotonic()
        if self._run is None or not self._batch:
            return
        batch, self._batch = self._batch, defaultdict(list)
        part = run_of_messages(batch, self._run)
        if len(part.bodies):
            load = roller_loads(part)
            largest = float(load.max())
            if largest > self._largest:
                self._largest = largest
                log_scale(self._stream, largest)
            log_motion(self._stream, part)
            log_loads(self._stream, part, self._largest)
        log_curves(self._stream, part)
        if self._drawn - self._spectrum_drawn >= SPECTRUM_SECONDS:
            self._spectrum_drawn = self._drawn
            self._draw_spectrum(self._run)

    def _describe(self, run: RunDescription) -> None:
        if self._run is not None and self._run.to_json() == run.to_json():
            return
        self._run = run
        self._largest = 0.0
        self._batch.clear()
        for kept in self._window.values():
            kept.clear()
        self._lay_out()
        log_parts(self._stream, run)
        log_styles(self._stream, run.sensor_names)

    def _lay_out(self) -> None:
        self._stream.send_blueprint(
            blueprint(self._run, follow=True, estimates=self._estimates, monitored=self._monitored)
        )

    def _follow(self, name: str, told: Mapping[str, Any]) -> None:
        """Draw what a follower says; the page for it is laid out when the first numbers come."""
        if name == FOLLOWED[1]:
            log_residual(self._stream, told)
            return
        if told.get("final"):  # the last word, which repeats what was said
            return
        quantities = quantities_of((told,))
        if quantities and quantities != self._estimates:
            self._estimates = quantities
            self._lay_out()
        log_estimates(self._stream, (told,))

    def _log_number(self, name: str, cdr: bytes) -> None:
        """Draw a number of the monitor; the page for them is laid out when the first one comes."""
        if not self._monitored:
            self._monitored = True
            self._lay_out()
        log_value(self._stream, name, cdr)

    def _draw_spectrum(self, run: RunDescription) -> None:
        window = run_of_messages({name: list(kept) for name, kept in self._window.items()}, run)
        spectrum = order_spectrum(window)
        if spectrum is not None:
            log_spectrum(self._stream, spectrum, run.shape.fault_frequencies)

    def _log_result(self, cdr: bytes) -> None:
        _, statuses = decode_diagnostics(cdr)
        lines = [f"## {status.name}\n\n{status.message}" for status in statuses]
        document = rr.TextDocument("\n\n".join(lines), media_type=rr.MediaType.MARKDOWN)
        self._stream.log("about", document, static=True)
