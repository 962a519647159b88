"""Debian's Chromium without a window, driven by script: pages of the station's own are opened from their files.

No name is resolved and no proxy asked, so that a page that wants something from a network does not get it; what it
asked for is told by `requests`. WebGL is drawn by SwiftShader, and sound goes nowhere in its own time.
"""

import base64
import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from selenium.webdriver import Chrome, ChromeOptions, ChromeService
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

CHROMIUM, DRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
PATIENCE_S = 60.0
"""So long a page may take to do what is waited for, on a machine that is shared."""
_FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--no-proxy-server",
    "--host-resolver-rules=MAP * ~NOTFOUND",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--autoplay-policy=no-user-gesture-required",
    "--mute-audio",
)
_OWN = ("data:", "blob:", "about:")
"""Addresses whose contents the page carries itself."""
_OF_A_DRIVER = "GL Driver Message (OpenGL, Performance"
"""What SwiftShader says when the picture of a page is taken; the page has no part in it."""

Told = TypeVar("Told")


class Browser:
    """One Chromium; each page that is opened begins with an empty console and no requests."""

    def __init__(self, driver: Chrome) -> None:
        self.driver = driver
        self._page = ""

    def open(self, page: Path, *, dark: bool = False, size: tuple[int, int] = (1280, 900)) -> None:
        """Open a page from its file, in a window of so many pixels, by a reader who likes pages light or `dark`."""
        self.driver.get("about:blank")
        self.driver.set_window_size(*size)
        liked = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": liked})
        for log in ("browser", "performance"):
            self._told(log)  # of the page before
        self._page = page.resolve().as_uri()
        self.driver.get(self._page)

    def run(self, script: str, *arguments: object) -> Any:  # noqa: ANN401 whatever a script returns
        """What the body of a function of JavaScript returns, of `arguments` that JSON can tell."""
        return self.driver.execute_script(script, *arguments)

    def until(self, script: str, *arguments: object) -> Any:  # noqa: ANN401 whatever a script returns
        """What the script returns as soon as that is true in JavaScript's sense; raises `TimeoutException`."""
        return self.wait(lambda: self.run(script, *arguments))

    def wait(self, asked: Callable[[], Told]) -> Told:
        """What `asked` returns as soon as that is true; raises `TimeoutException`."""
        return WebDriverWait(self.driver, PATIENCE_S, poll_frequency=0.05).until(lambda _: asked())

    def press(self, selector: str, key: str = Keys.SPACE) -> None:
        """Press a key in the element that a CSS selector names."""
        self.driver.find_element("css selector", selector).send_keys(key)

    def click(self, selector: str) -> None:
        """Click the element that a CSS selector names."""
        self.driver.find_element("css selector", selector).click()

    def faults(self) -> list[str]:
        """Errors and warnings of the console since the page was opened or since the last call."""
        told = [entry["message"] for entry in self._told("browser") if entry["level"] in ("WARNING", "SEVERE")]
        return [message for message in told if _OF_A_DRIVER not in message]

    def requests(self) -> list[str]:
        """What the page asked for beside itself and what it carries, since it was opened or since the last call."""
        events = (json.loads(entry["message"])["message"] for entry in self._told("performance"))
        urls = [e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"]
        return [url for url in urls if url != self._page and not url.startswith(_OWN)]

    def _told(self, log: str) -> list[dict[str, str]]:
        return list(self.driver.get_log(log))  # type: ignore[no-untyped-call]  # selenium does not type its logs

    def picture(self, path: Path) -> None:
        """Write what the window shows as a PNG."""
        path.write_bytes(self.driver.get_screenshot_as_png())

    def whole_page(self, path: Path) -> None:
        """Write the page from top to bottom as a PNG."""
        drawn = self.driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True})
        path.write_bytes(base64.b64decode(drawn["data"]))


@contextmanager
def chromium(folder: Path) -> Iterator[Browser]:
    """A browser that keeps all its files in `folder`."""
    options = ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (*_FLAGS, f"--user-data-dir={folder / 'user'}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    places = {"HOME": str(folder), "TMPDIR": str(folder), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
    driver = Chrome(options, ChromeService(executable_path=DRIVER, env=places))
    try:
        yield Browser(driver)
    finally:
        driver.quit()
