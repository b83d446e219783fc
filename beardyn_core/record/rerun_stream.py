"""Where a live rerun view goes: a window, a page in the browser, a file."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import rerun as rr

from beardyn_core.errors import InputError
from beardyn_core.record.viewer import _free_port, _is_free, _wait_for, require_display, viewer_executable

APPLICATION = "beardyn"


@dataclass(frozen=True)
class LiveStream:
    """A rerun stream that leads somewhere.

    Parameters
    ----------
    stream : rerun.RecordingStream
    where : str
        For a person: the page to open, the file, or ``a window``.
    """

    stream: rr.RecordingStream
    where: str


@contextmanager
def live_stream(target: str, path: Path | None = None, port: int = 0) -> Iterator[LiveStream]:
    """Stream to a viewer for as long as the context lasts.

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
    server: subprocess.Popen[bytes] | None = None
    where = "a window"
    if target == "window":
        require_display()
        stream.spawn()
    elif target == "web":
        server, page, data = _serve(port)
        stream.connect_grpc(f"rerun+http://127.0.0.1:{data}/proxy")
        where = f"http://127.0.0.1:{page}?url=rerun%2Bhttp%3A%2F%2F127.0.0.1%3A{data}%2Fproxy"
    else:
        where = str(_writable(path))
        stream.save(where)
    try:
        yield LiveStream(stream, where)
    finally:
        stream.flush()
        stream.disconnect()
        if server is not None:
            server.terminate()
            server.wait()


def _serve(port: int) -> tuple[subprocess.Popen[bytes], int, int]:
    if port and not _is_free(port):
        raise InputError(f"port {port} is in use; choose another, or 0 for a free one")
    page, data = port or _free_port(), _free_port()
    command = [viewer_executable(), "--serve-web", "--bind", "127.0.0.1"]
    command += ["--port", str(data), "--web-viewer-port", str(page)]
    server = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        _wait_for(server, page)
        _wait_for(server, data)
    except InputError:
        server.kill()
        server.wait()
        raise
    return server, page, data


def _writable(path: Path | None) -> Path:
    if path is None:
        raise InputError("a live view into a file needs the path of an .rrd file")
    try:
        path.open("ab").close()
    except OSError as error:
        raise InputError(f"{path}: cannot write the rerun file ({error.strerror})") from error
    return path
