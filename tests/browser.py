"""A headless Chromium in which tests open pages, without any network."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

_FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-dev-shm-usage", "--hide-scrollbars",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE localhost, EXCLUDE 127.0.0.1",
)  # fmt: skip


class Browser:
    """Pages opened from disk, their size and colours, and what they complain of.

    `driver` is Selenium's, for clicking and for scripts.
    """

    def __init__(self, driver: Any):
        self.driver = driver
        self.show()

    def open(self, page: Path | str) -> None:
        """Load a file or an address; returns when it is loaded."""
        self.errors()  # of the page before
        self.driver.get(page.resolve().as_uri() if isinstance(page, Path) else page)

    def show(self, width: int = 1200, height: int = 900, dark: bool = False) -> None:
        """Size of the window in CSS pixels, and which colours the system prefers."""
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600}
        colours = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [colours]})

    def errors(self) -> list[str]:
        """Errors on the console, failed requests among them, since they were last asked for."""
        logged = self.driver.get_log("browser")
        return [entry["message"] for entry in logged if entry["level"] == "SEVERE"]

    def run(self, script: str, *arguments: Any) -> Any:
        """What a script returns that is run in the page."""
        return self.driver.execute_script(script, *arguments)

    def overflow(self) -> int:
        """CSS pixels by which the page is wider than the window."""
        root = "document.documentElement"
        return int(self.run(f"return {root}.scrollWidth - {root}.clientWidth"))


@contextmanager
def chromium() -> Iterator[Browser]:
    """Chromium with an empty profile; skips where it, its driver or Selenium is missing."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="Selenium is not installed")
    found = {name: shutil.which(name) for name in ("chromium", "chromedriver")}
    if missing := [name for name, path in found.items() if path is None]:
        pytest.skip(f"{' and '.join(missing)} not installed")
    options = webdriver.ChromeOptions()
    options.binary_location = found["chromium"]
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        for flag in (*_FLAGS, f"--user-data-dir={profile}"):
            options.add_argument(flag)
        service = webdriver.ChromeService(executable_path=found["chromedriver"])
        driver = webdriver.Chrome(options=options, service=service)
        try:
            yield Browser(driver)
        finally:
            driver.quit()
