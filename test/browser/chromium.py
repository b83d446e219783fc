"""A headless Chromium on the DevTools pipe: open a page, wait in real time, take pictures."""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

EXECUTABLE = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

PATIENCE = 60.0


class Chromium:
    """A browser with one page.

    Parameters
    ----------
    profile : Path
        Folder for its files.
    width, height : int
        Of the page, [pixel].
    """

    def __init__(self, profile: Path, width: int, height: int) -> None:
        read_commands, self._commands = os.pipe()
        self._answers, write_answers = os.pipe()

        def wire() -> None:
            # The browser reads commands on descriptor 3 and answers on 4; dup first, they may overlap.
            low, high = os.dup(read_commands), os.dup(write_answers)
            os.dup2(low, 3)
            os.dup2(high, 4)

        self._process = subprocess.Popen(
            [
                str(EXECUTABLE),
                "--headless=new",
                "--remote-debugging-pipe",
                "--no-sandbox",
                "--disable-dev-shm-usage",
                "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader",
                "--ignore-gpu-blocklist",
                f"--user-data-dir={profile}",
                f"--window-size={width},{height}",
                "about:blank",
            ],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            preexec_fn=wire,
            close_fds=False,
        )
        os.close(read_commands)
        os.close(write_answers)
        self._buffer = b""
        self._number = 0
        targets = self._call("Target.getTargets")["targetInfos"]
        page = next(target["targetId"] for target in targets if target["type"] == "page")
        self._session = self._call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        self._call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )

    def open(self, url: str) -> None:
        """Go to a page and wait until it is loaded."""
        self._call("Page.navigate", url=url)
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            # While the page changes there is nothing to evaluate in; the browser then answers an error.
            with suppress(RuntimeError):
                state = self._call("Runtime.evaluate", expression="document.readyState + location.href")
                # A page may rewrite its own query.
                if str(state["result"].get("value")).startswith("complete" + url.split("?")[0]):
                    return
            time.sleep(0.1)
        raise TimeoutError(f"Chromium did not load {url} within {PATIENCE:.0f} s")

    def picture(self, target: Path) -> Path:
        """PNG of what is shown now."""
        target.write_bytes(base64.b64decode(self._call("Page.captureScreenshot", format="png")["data"]))
        return target

    def close(self) -> None:
        """End the browser."""
        self._process.terminate()
        try:
            self._process.wait(timeout=10.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._commands)
        os.close(self._answers)

    def _call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        command: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if hasattr(self, "_session"):
            command["sessionId"] = self._session
        os.write(self._commands, json.dumps(command).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            while b"\0" in self._buffer:
                text, self._buffer = self._buffer.split(b"\0", 1)
                answer = json.loads(text)
                if answer.get("id") == self._number:
                    if "error" in answer:
                        raise RuntimeError(f"{method}: {answer['error']['message']}")
                    return dict(answer["result"])
            if select.select([self._answers], [], [], 0.2)[0]:
                part = os.read(self._answers, 1 << 20)
                if not part:
                    raise RuntimeError(f"Chromium ended during {method}")
                self._buffer += part
        raise TimeoutError(f"Chromium did not answer {method} within {PATIENCE:.0f} s")
