"""The rerun viewer as a process: a window, a page in the browser, a picture without a screen."""

from __future__ import annotations

import importlib.util
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from typing import Annotated as A

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from rerun.experimental import ViewerClient

SOFTWARE_DRIVERS = ("/usr/share/vulkan/icd.d/lvp_icd.x86_64.json", "/usr/share/vulkan/icd.d/lvp_icd.json")
PICTURE_SECONDS = 120.0
START_SECONDS = 30.0
SETTLING_SECONDS = 5.0  # until the new time is drawn and the viewer's own notices are gone
TIMELINE = "time"  # of a recording
THIS_MACHINE = ("--bind", "127.0.0.1")  # else the viewer takes streams from the whole network


def viewer_executable() -> str:
    """Find the ``rerun`` program that came with rerun-sdk.

    Raises
    ------
    InputError
        It is not installed.
    """
    # The command ``rerun`` is a wrapper that outlives or is outlived by the viewer; this is the viewer.
    package = importlib.util.find_spec("rerun_cli")
    folders = list(package.submodule_search_locations or ()) if package is not None else []
    for folder in folders:
        for name in ("rerun", "rerun.exe"):
            if (Path(folder) / name).is_file():
                return str(Path(folder) / name)
    found = shutil.which("rerun")
    if found is None:
        raise InputError("the program rerun is not installed: pip install rerun-sdk")
    return found


def has_display() -> bool:
    """Check whether a window can be opened here."""
    return sys.platform in ("darwin", "win32") or bool(
        os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    )


def require_display() -> None:
    """Refuse where no window can be opened.

    Raises
    ------
    InputError
        There is no display; says what else can be done.
    """
    if not has_display():
        raise InputError(
            "no display is set (DISPLAY, WAYLAND_DISPLAY): use --web for a page in a browser, "
            "--save FILE.rrd to take the recording elsewhere, or --screenshot FILE.png for a picture"
        )


def open_window(recording: Path, at: float | None = None) -> int:
    """Open a recording in a window, wait until it is closed, return the viewer's exit code.

    Parameters
    ----------
    recording : Path
        An ``.rrd`` file.
    at : float, optional
        Time that is shown first, [s]; by default the beginning.
    """
    require_display()
    port = _free_port()
    command = [viewer_executable(), str(recording), "--port", str(port), *THIS_MACHINE]
    process = subprocess.Popen(command)
    try:
        if at is not None:
            _wait_for(process, port)
            _set_time(port, at)
        return process.wait()
    except BaseException:
        process.terminate()
        raise


def _set_time(port: int, at: float) -> ViewerClient:
    """Move the time of a viewer as soon as its recording is there, and pause."""
    from rerun.experimental import ViewerClient

    client = ViewerClient.connect(f"rerun+http://127.0.0.1:{port}/proxy")
    deadline = time.monotonic() + START_SECONDS
    while time.monotonic() < deadline:
        state = client.get_state()
        ranges = [each for one in state.recordings for each in one.timelines if each.name == TIMELINE]
        if ranges and not state.loading and any((each.end or 0) >= 1e9 * at for each in ranges):
            client.set_time(TIMELINE, duration=at, play_state="paused")
            return client
        time.sleep(0.2)
    raise InputError(f"the viewer did not show its recording within {START_SECONDS:.0f} s")


def waiting_window() -> str:
    """Open a window that waits for a recording stream, and return where the stream connects.

    Raises
    ------
    InputError
        The viewer did not start.
    """
    port = _free_port()
    process = subprocess.Popen(
        [viewer_executable(), "--port", str(port), *THIS_MACHINE],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,  # it stays when this process ends, and after a Ctrl-C
    )
    _wait_for(process, port)
    return f"rerun+http://127.0.0.1:{port}/proxy"


@dataclass(frozen=True)
class WebViewer:
    """A running web viewer."""

    url: A[str, "the page"]
    stream_url: A[str, "where a recording stream connects to be shown"]
    process: subprocess.Popen[bytes]


@contextmanager
def web_viewer(recording: Path | None = None, port: int | None = None) -> Iterator[WebViewer]:
    """Serve the viewer on this machine only, while the context lasts.

    Parameters
    ----------
    recording : Path, optional
        An ``.rrd`` file to show; without one the page waits for a stream.
    port : int, optional
        Of the page; a free one by default.

    Raises
    ------
    InputError
        The server did not start, or the port is taken.
    """
    if port and not _is_free(port):
        raise InputError(f"port {port} is in use; choose another, or none for a free one")
    page, data = port or _free_port(), _free_port()
    command = [viewer_executable(), *([str(recording)] if recording else []), "--serve-web"]
    command += ["--port", str(data), "--web-viewer-port", str(page), *THIS_MACHINE]
    # In a session of its own a Ctrl-C in the terminal does not reach it before it is ended here.
    process = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    )
    try:
        _wait_for(process, page)
        _wait_for(process, data)
        source = f"rerun%2Bhttp%3A%2F%2F127.0.0.1%3A{data}%2Fproxy"
        yield WebViewer(
            f"http://127.0.0.1:{page}/?url={source}&theme=dark",
            f"rerun+http://127.0.0.1:{data}/proxy",
            process,
        )
    finally:
        _end_session(process)


def picture_problem() -> str | None:
    """Say why no picture can be taken here; ``None`` when it can."""
    if has_display():
        return None
    missing = [name for name in ("xvfb-run", "xauth") if shutil.which(name) is None]
    if missing or _software_driver() is None:
        return (
            "a picture needs a display, or Xvfb and a software renderer: "
            "apt-get install --no-install-recommends xvfb xauth mesa-vulkan-drivers libvulkan1"
        )
    return None


def take_picture(
    recording: Path, target: Path, size: tuple[int, int] = (1600, 900), at: float | None = None
) -> Path:
    """Take a picture of the viewer with a recording open.

    Parameters
    ----------
    recording : Path
        An ``.rrd`` file.
    target : Path
        PNG.
    size : tuple of 2 ints
        Of the window, in its own units.
    at : float, optional
        Time that is shown, [s]; by default the beginning.

    Raises
    ------
    InputError
        No display and no Xvfb here, or the viewer made no picture.
    """
    problem = picture_problem()
    if problem is not None:
        raise InputError(problem)
    port = _free_port()
    command = [viewer_executable(), str(recording), "--port", str(port), *THIS_MACHINE]
    command += ["--window-size", f"{size[0]}x{size[1]}"]
    environment = dict(os.environ)
    if not has_display():
        # The pointer rests in the middle of the screen; on a wide one that is outside the window, where
        # it makes no tooltip.
        command = ["xvfb-run", "-a", "-s", f"-screen 0 {5 * size[0]}x{5 * size[1]}x24", *command]
        environment["VK_DRIVER_FILES"] = _software_driver() or ""
    target.unlink(missing_ok=True)
    output = (
        _picture_at_once(command, environment, target)
        if at is None
        else (_picture_at(command, environment, target, port, at))
    )
    if not target.exists():
        last = output.strip().splitlines()[-1:] or ["it printed nothing"]
        raise InputError(f"{target}: the viewer made no picture ({last[0]})")
    return target


def _picture_at_once(command: list[str], environment: dict[str, str], target: Path) -> str:
    """Let the viewer take a picture of its first sight and end; what it printed."""
    command = [*command, "--screenshot-to", str(target)]
    try:
        return subprocess.run(
            command, env=environment, capture_output=True, timeout=PICTURE_SECONDS, check=False, text=True
        ).stderr
    except subprocess.TimeoutExpired:
        return f"no picture within {PICTURE_SECONDS:.0f} s"


def _picture_at(command: list[str], environment: dict[str, str], target: Path, port: int, at: float) -> str:
    """Let the viewer take a picture at a time [s], and end it; what went wrong, if anything."""
    process = subprocess.Popen(
        command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    )
    try:
        _wait_for(process, port)
        client = _set_time(port, at)
        time.sleep(SETTLING_SECONDS)
        client.save_screenshot(str(target.resolve()))
    except RuntimeError as error:  # of the viewer's own client
        return str(error)
    finally:
        _end_session(process)
    return ""


def _software_driver() -> str | None:
    return next((driver for driver in SOFTWARE_DRIVERS if Path(driver).exists()), None)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) != 0


def _end_session(process: subprocess.Popen[bytes]) -> None:
    if not hasattr(os, "killpg"):  # Windows
        process.kill()
        process.wait()
        return
    for number in (signal.SIGTERM, signal.SIGKILL):
        with suppress(ProcessLookupError):
            os.killpg(process.pid, number)
        with suppress(subprocess.TimeoutExpired):
            process.wait(timeout=5.0)
            return


def _wait_for(process: subprocess.Popen[bytes], port: int) -> None:
    deadline = time.monotonic() + START_SECONDS
    while time.monotonic() < deadline:
        if process.poll() is not None:
            raise InputError(f"the viewer ended with code {process.returncode} before it could serve")
        if not _is_free(port):
            return
        time.sleep(0.05)
    raise InputError(f"the viewer did not answer on port {port} within {START_SECONDS:.0f} s")
