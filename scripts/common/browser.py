"""Headless Chromium, driven through its debugging protocol over two pipes: no port, no other package."""
import base64
import fcntl
import io
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

import numpy as np
from PIL import Image

# Software rendering, so that pictures do not depend on the machine; nothing of its own over the network.
FLAGS = ["--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--ignore-gpu-blocklist", "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--mute-audio", "about:blank"]


def program():
    """The path of Chromium, None where there is none."""
    return os.environ.get("BEM_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")


class NoBrowser(Exception):
    """There is no Chromium."""


def _high(fd):
    """The same file under a number above those that Chromium takes."""
    moved = fcntl.fcntl(fd, fcntl.F_DUPFD, 10)
    os.close(fd)
    return moved


class Browser:
    """One page. Requests for anything but files and data are refused and kept in `requests`."""

    def __init__(self, width=900, height=700, scale=1, dark=False, mobile=False):
        if not program():
            raise NoBrowser("Chromium is missing: install it (scripts/setup.sh --test), or name it in BEM_CHROMIUM")
        self._profile = tempfile.mkdtemp(prefix="bem_chromium_")
        commands, self._to = map(_high, os.pipe())
        self._from, answers = map(_high, os.pipe())
        self._process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{commands} 4>&{answers}', "bash", program(), *FLAGS, f"--user-data-dir={self._profile}",
             f"--window-size={width},{height}"],
            pass_fds=(commands, answers), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(commands)
        os.close(answers)
        self._waiting, self._number, self._session = b"", 0, None
        self.requests, self.errors = [], []
        target, = [t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page"]
        self._session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        self.call("Fetch.enable", patterns=[{"urlPattern": "*"}])
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=mobile)
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}, {"name": "prefers-reduced-motion", "value": "reduce"}])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        try:
            self._session = None
            self.call("Browser.close")
            self._process.wait(10)
        except (OSError, RuntimeError, TimeoutError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._to)
        os.close(self._from)
        shutil.rmtree(self._profile, ignore_errors=True)

    def _send(self, method, parameters):
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self._to, data):]
        return self._number

    def _receive(self, seconds):
        """The next message, None after some time."""
        end = time.monotonic() + seconds
        while b"\0" not in self._waiting:
            if not select.select([self._from], [], [], max(0, end - time.monotonic()))[0]:
                return None
            data = os.read(self._from, 1 << 20)
            if not data:
                raise RuntimeError("Chromium has ended")
            self._waiting += data
        message, self._waiting = self._waiting.split(b"\0", 1)
        return json.loads(message)

    def _note(self, message):
        method, parameters = message.get("method"), message.get("params", {})
        if method == "Fetch.requestPaused":
            url = parameters["request"]["url"]
            if url.startswith(("file:", "data:", "blob:", "about:")):
                self._send("Fetch.continueRequest", {"requestId": parameters["requestId"]})
            else:
                self.requests.append(url)
                self._send("Fetch.failRequest", {"requestId": parameters["requestId"], "errorReason": "AccessDenied"})
        elif method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] == "error":
            self.errors.append(" ".join(str(a.get("value", a.get("description"))) for a in parameters["args"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(parameters["entry"]["text"])

    def call(self, method, seconds=60, **parameters):
        """A command of the protocol, and its answer."""
        number, end = self._send(method, parameters), time.monotonic() + seconds
        while time.monotonic() < end:
            message = self._receive(end - time.monotonic())
            if message is None:
                break
            if message.get("id") == number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']['message']}")
                return message["result"]
            self._note(message)
        raise TimeoutError(f"{method}: no answer for {seconds} s; {self.errors}")

    def evaluate(self, expression):
        found = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise RuntimeError(found["exceptionDetails"]["exception"]["description"])
        return found["result"].get("value")

    def wait_for(self, expression, seconds=60):
        end = time.monotonic() + seconds
        while not self.evaluate(expression):
            if time.monotonic() > end:
                raise TimeoutError(f"{expression}: not within {seconds} s; {self.errors}")
            time.sleep(0.05)

    def open(self, path):
        """Opens a page of bemview and waits until all of it is there."""
        self.call("Page.navigate", url=pathlib.Path(path).resolve(strict=True).as_uri())
        self.wait_for("document.body && ['ready', 'failed'].includes(document.body.dataset.state)")

    def place_of(self, selector, across=0.5, down=0.5):
        box = self.evaluate(f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
                            " return [b.x, b.y, b.width, b.height]; })()")
        return box[0] + across * box[2], box[1] + down * box[3]

    def click(self, selector, across=0.5, down=0.5):
        """A real click, where the element is."""
        x, y = self.place_of(selector, across, down)
        self.drag((x, y), (x, y))

    def drag(self, start, end, steps=1):
        mouse = lambda kind, at, **more: self.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", **more)
        mouse("mousePressed", start, clickCount=1, buttons=1)
        for step in range(1, steps + 1) if start != end else []:
            mouse("mouseMoved", [a + (b - a) * step / steps for a, b in zip(start, end)], buttons=1)
        mouse("mouseReleased", end, clickCount=1)

    def press(self, key, code=None, text=None):
        known = {" ": 32, "ArrowLeft": 37, "ArrowRight": 39, "Home": 36, "End": 35}
        number = known.get(key, ord(key.upper()) if len(key) == 1 else 0)
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=code or key, windowsVirtualKeyCode=number)

    def screenshot(self, path=None):
        """The page as an array [height, width, 3]; also as a PNG file."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        image = Image.open(io.BytesIO(data)).convert("RGB")
        if path:
            image.save(path, optimize=True)
        return np.asarray(image)
