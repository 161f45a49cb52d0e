"""A headless Chromium, driven through its DevTools pipe with nothing but Python's standard library."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

FLAGS = ["--headless=new", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--hide-scrollbars",
         "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--force-color-profile=srgb", "--remote-debugging-pipe", "about:blank"]


class PageError(Exception):
    """What a page did wrong."""


class Browser:
    """One page. Console errors, exceptions and requests of the network are collected in `complaints`."""

    def __init__(self, program=None, allowed=("file:", "data:", "about:")):
        self.complaints = []
        self._allowed = allowed
        self._profile = tempfile.mkdtemp(prefix="spincat-browser-")
        to_browser, self._out = os.pipe()
        self._in, from_browser = os.pipe()

        def set_pipes():  # the browser reads commands from descriptor 3 and writes to 4
            os.dup2(os.dup(to_browser), 3)
            os.dup2(os.dup(from_browser), 4)

        os.set_inheritable(to_browser, True)
        os.set_inheritable(from_browser, True)
        self._process = subprocess.Popen([program or find_chromium(), "--user-data-dir=" + self._profile] + FLAGS,
                                         close_fds=False, preexec_fn=set_pipes, stdout=subprocess.DEVNULL,
                                         stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self._buffer = b""
        self._count = 0
        self._session = None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(domain + ".enable")

    def close(self):
        self._process.kill()
        self._process.wait()
        os.close(self._out)
        os.close(self._in)
        shutil.rmtree(self._profile, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _next_message(self):
        while b"\0" not in self._buffer:
            chunk = os.read(self._in, 1 << 20)
            if not chunk:
                raise PageError("the browser ended")
            self._buffer += chunk
        message, self._buffer = self._buffer.split(b"\0", 1)
        return json.loads(message)

    def _note(self, message):
        method, values = message.get("method", ""), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.complaints.append("exception: " + json.dumps(values["exceptionDetails"])[:600])
        elif method == "Runtime.consoleAPICalled" and values["type"] in ("error", "assert"):
            self.complaints.append("console: " + json.dumps(values["args"])[:600])
        elif method == "Log.entryAdded" and values["entry"]["level"] == "error":
            self.complaints.append("log: " + values["entry"]["text"][:600])
        elif method == "Network.requestWillBeSent":
            url = values["request"]["url"]
            if not url.startswith(self._allowed):
                self.complaints.append("request: " + url[:200])

    def call(self, method, **params):
        self._count += 1
        wanted = self._count
        message = {"id": wanted, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next_message()
            self._note(answer)
            if answer.get("id") == wanted:
                if "error" in answer:
                    raise PageError(method + ": " + answer["error"]["message"])
                return answer["result"]

    def open(self, path, width=1280, height=900, dark=False):
        """Opens a file and waits until it is loaded."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                  mobile=width < 600)
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        self.wait_for("document.readyState === 'complete' && location.protocol === 'file:'")

    def visit(self, url):
        """Opens a page of a server that is among the allowed ones."""
        self.call("Page.navigate", url=url)
        self.wait_for("document.readyState === 'complete' && location.protocol === 'http:'")

    def run(self, script):
        """The value of a JavaScript expression."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise PageError(script + ": " + json.dumps(answer["exceptionDetails"])[:600])
        return answer["result"].get("value")

    def wait_for(self, script, seconds=60):
        end = time.monotonic() + seconds
        while not self.run(script):
            if time.monotonic() > end:
                raise PageError("waited in vain for " + script)
            time.sleep(0.02)

    def _middle(self, selector):
        return self.run("(() => { const e = document.querySelector(%s); e.scrollIntoView({block: 'center'});"
                        "const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()"
                        % json.dumps(selector))

    def swipe(self, selector, dx, dy):
        """Puts a finger on the middle of an element, moves it and lifts it."""
        x, y = self._middle(selector)
        for kind, points in (("touchStart", [(0, 0)]), ("touchMove", [(dx / 2, dy / 2)]), ("touchMove", [(dx, dy)]), ("touchEnd", [])):
            self.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x + a, "y": y + b} for a, b in points])

    def drag(self, selector, dx, dy):
        """Presses the mouse in the middle of an element, moves it and lets go."""
        box = self._middle(selector)
        steps = [("mousePressed", 0, 0), ("mouseMoved", dx / 2, dy / 2), ("mouseMoved", dx, dy), ("mouseReleased", dx, dy)]
        for kind, x, y in steps:
            self.call("Input.dispatchMouseEvent", type=kind, x=box[0] + x, y=box[1] + y, button="left", buttons=1,
                      clickCount=1)

    def picture(self, path, whole=False):
        """A screenshot as PNG."""
        clip = {}
        if whole:
            size = self.call("Page.getLayoutMetrics")["cssContentSize"]
            clip = {"clip": dict(size, scale=1), "captureBeyondViewport": True}
        data = self.call("Page.captureScreenshot", format="png", **clip)["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))


def find_chromium():
    """The program's name, or None."""
    return next((found for found in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if found), None)
