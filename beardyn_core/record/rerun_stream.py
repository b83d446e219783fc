"""Where a live rerun view goes: a window, a page in the browser, a file."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import rerun as rr

from beardyn_core.errors import InputError
from beardyn_core.record.viewer import require_display, web_viewer

APPLICATION = "beardyn"


@dataclass(frozen=True)
class LiveStream:
    """A rerun stream to a window, a web page or a file."""

    stream: rr.RecordingStream
    where: A[str, "for a person: the page to open, the file, or ``a window``"]


@contextmanager
def live_stream(target: str, path: Path | None = None, port: int = 0) -> Iterator[LiveStream]:
    """Open a stream to a viewer for as long as the context lasts.

    Parameters
    ----------
    target : str
        ``window``, ``web`` (on this machine only) or ``file``.
    path : Path, optional
        Of the ``.rrd`` file.
    port : int
        Of the page; 0: a free one.

    Raises
    ------
    InputError
        No display for a window, no free port, or the file cannot be written.
    """
    stream = rr.RecordingStream(APPLICATION)
    with ExitStack() as stack:
        where = "a window"
        if target == "window":
            require_display()
            stream.spawn()
        elif target == "web":
            page = stack.enter_context(web_viewer(port=port))
            stream.connect_grpc(page.stream_url)
            where = page.url
        else:
            if path is None:
                raise InputError("a live view into a file needs the path of an .rrd file")
            _check_writable(path)
            where = str(path)
            stream.save(where)
        try:
            yield LiveStream(stream, where)
        finally:
            stream.flush()
            stream.disconnect()


@contextmanager
def rerun_file(path: Path, name: str, layout: Any) -> Iterator[rr.RecordingStream]:
    """Open a recording into an ``.rrd`` file, with its blueprint, for as long as the context lasts.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    _check_writable(path)
    stream = rr.RecordingStream(APPLICATION, recording_id=name)
    stream.save(path, default_blueprint=layout)
    yield stream
    stream.flush()
    stream.disconnect()


def _check_writable(path: Path) -> None:
    try:
        path.open("ab").close()
    except OSError as error:
        raise InputError(f"{path}: cannot write the rerun file ({error.strerror})") from error
