"""Chromium without a window, driven by its DevTools protocol over two pipes: clicks and typing as a person's."""

import base64
import json
import os
import shutil
import subprocess
import threading
import time

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Browser:
    """One page in one window."""

    def __init__(self, folder, width=1280, height=900):
        receive, to_chromium = os.pipe()
        from_chromium, send = os.pipe()

        def pipes():
            # DevTools reads file 3 and writes file 4.
            kept = [os.dup2(receive, 40), os.dup2(send, 41)]
            os.dup2(kept[0], 3)
            os.dup2(kept[1], 4)

        arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--remote-debugging-pipe"]
        command = [CHROMIUM, *arguments, f"--user-data-dir={folder}", f"--window-size={width},{height}", "about:blank"]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self.process = subprocess.Popen(command, preexec_fn=pipes, close_fds=False, **quiet)
        os.close(receive)
        os.close(send)
        self.into, self.out = os.fdopen(to_chromium, "wb", 0), os.fdopen(from_chromium, "rb")
        self.answers, self.heard, self.last, self.session = {}, [], 0, None
        self.changed = threading.Condition()
        threading.Thread(target=self._listen, daemon=True).start()
        targets = self.send("Target.getTargets")["targetInfos"]
        target = next(one["targetId"] for one in targets if one["type"] == "page")
        self.session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.send(f"{domain}.enable")
        self.size(width, height)

    def _listen(self):
        rest = b""
        while chunk := self.out.read1(1 << 16):
            *whole, rest = (rest + chunk).split(b"\0")
            for one in map(json.loads, whole):
                with self.changed:
                    if "id" in one:
                        self.answers[one["id"]] = one
                    else:
                        self.heard.append(one)
                    self.changed.notify_all()

    def send(self, method, **parameters):
        self.last += 1
        mine = self.last
        message = {"id": mine, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        self.into.write(json.dumps(message).encode() + b"\0")
        with self.changed:
            assert self.changed.wait_for(lambda: mine in self.answers, 120), method
            answer = self.answers.pop(mine)
        assert "error" not in answer, (method, answer)
        return answer["result"]

    def close(self):
        self.process.kill()
        self.process.wait()

    def size(self, width, height):
        # A picture of the whole page has no scroll bar: one must not take width from what is measured.
        self.send("Emulation.setScrollbarsHidden", hidden=True)
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def scheme(self, name):
        self.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])

    def open(self, address):
        self.send("Page.navigate", url=address)
        time.sleep(0.1)
        if self.evaluate("location.href") == "about:blank":
            # The first page of a new window came in between.
            self.send("Page.navigate", url=address)
        self.wait("document.documentElement.dataset.ready === 'true'")

    def evaluate(self, expression):
        answer = self.send("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait(self, expression, seconds=60):
        """Until an expression is true; its value. The page looks itself: a question from here costs more than an answer."""
        begin = time.monotonic()
        known = f"((found) => found instanceof Node || found)(document.body && ({expression}))"
        looked = (
            f"new Promise((done) => {{ let left = 20; const look = () => {{ const found = {known};"
            " if (found || --left === 0) done(found); else setTimeout(look, 40); }; look(); })"
        )
        while not (value := self.evaluate(looked)):
            assert time.monotonic() - begin < seconds, (
                f"{expression}: not within {seconds} s at {self.evaluate('location.href')}; {self.complaints()}"
            )
        return value

    def click(self, selector):
        """In the middle of an element, with the mouse."""
        place = self.evaluate(
            f"(() => {{ const one = document.querySelector({json.dumps(selector)}); one.scrollIntoView({{block: 'center'}});"
            " const box = one.getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; })()"
        )
        for kind in ("mousePressed", "mouseReleased"):
            self.send("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", clickCount=1)

    def key(self, name, text=None, modifiers=0):
        codes = {"Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "End": 35, "Home": 36, "ArrowLeft": 37, "ArrowRight": 39, "ArrowDown": 40, "a": 65}
        common = {"key": name, "code": name, "windowsVirtualKeyCode": codes.get(name, 0), "modifiers": modifiers}
        if text is None and name == "Enter":
            text = "\r"
        down = {"text": text} if text else {}
        self.send("Input.dispatchKeyEvent", type="keyDown", **common, **down)
        self.send("Input.dispatchKeyEvent", type="keyUp", **common)

    def choose(self, selector, value):
        """Another choice of a list, by the arrow keys."""
        select = f"document.querySelector({json.dumps(selector)})"
        self.evaluate(f"{select}.focus()")
        self.key("Home")
        for _ in range(self.evaluate(f"{select}.options.length")):
            if self.evaluate(f"{select}.value") == value:
                return
            self.key("ArrowDown")
        raise AssertionError(f"{selector} has no {value}")

    def type(self, selector, text):
        """Clicks into a field and types in place of what is there."""
        self.click(selector)
        self.key("a", modifiers=2)
        self.keys(text)

    def keys(self, text):
        for letter in text:
            self.send("Input.dispatchKeyEvent", type="keyDown", key=letter, text=letter)
            self.send("Input.dispatchKeyEvent", type="keyUp", key=letter)
            # A quick typist.
            time.sleep(0.08)

    def focus(self):
        return self.evaluate("document.activeElement?.id || document.activeElement?.tagName")

    def picture(self, path):
        """The whole page as PNG."""
        size = self.send("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], 6000), "scale": 1}
        data = self.send("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)["data"]
        path.write_bytes(base64.b64decode(data))

    def complaints(self):
        """Errors and warnings of the console, exceptions, requests that failed."""
        found = []
        for one in self.heard:
            of = one["params"]
            if one["method"] == "Runtime.exceptionThrown":
                found.append(of["exceptionDetails"])
            elif one["method"] == "Runtime.consoleAPICalled" and of["type"] in ("error", "warning"):
                found.append(of)
            elif one["method"] == "Log.entryAdded" and of["entry"]["level"] in ("error", "warning"):
                found.append(of["entry"])
        return found

    def requests(self):
        return [one["params"]["request"]["url"] for one in self.heard if one["method"] == "Network.requestWillBeSent"]
