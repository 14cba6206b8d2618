"""Commands that serve a page, run as a user runs them, and a real browser to look at it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.cli.lab import write
from tests.processes import running
from tests.time_limit import PATIENCE

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserContext, Page

CHROMIUM = Path("/usr/bin/chromium")
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--use-angle=swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
]
READY = "body[data-ready=true]:is([data-mode=view], [data-running=true])"
"""The robot is seen, and what moves it is there."""
ARTIFACTS = Path(__file__).parents[2] / "artifacts"


@dataclass
class Served:
    """A running command that serves a page."""

    process: subprocess.Popen[str]
    url: str
    errors: Path

    @property
    def origin(self) -> str:
        return self.url.split("/?")[0]

    def end(self, how: signal.Signals = signal.SIGINT) -> int:
        self.process.send_signal(how)
        return self.process.wait(timeout=PATIENCE)


@pytest.fixture(scope="session", autouse=True)
def own_folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep the keys of servers on a port of their own out of the user's folder."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_RUNTIME_DIR", str(tmp_path_factory.mktemp("runtime")))
        yield


@contextmanager
def serving(folder: Path) -> Iterator[Callable[..., Served]]:
    """Yield what starts ``urdfkit …`` and waits for the address on its first line; Ctrl-C at the end must be clean."""
    started: list[Served] = []

    def start(*words: str, ignored: Sequence[signal.Signals] = ()) -> Served:
        errors = folder / f"stderr-{len(started)}"
        command = [sys.executable, "-m", "urdfkit", *words, "--port", "0", "--no-browser"]
        with errors.open("w") as stderr:
            program = running(
                command,
                ignored=ignored,
                stdout=subprocess.PIPE,
                stderr=stderr,
                text=True,
                cwd=folder,
                env=os.environ | {"XDG_RUNTIME_DIR": str(folder)},  # what is noted of it is not the user's
            )
            process = programs.enter_context(program)
        line = process.stdout.readline().strip() if process.stdout else ""
        served = Served(process, line, errors)
        started.append(served)
        assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=[\w-]{32}", line), errors.read_text()
        return served

    with ExitStack() as programs:
        yield start
        codes = [served.end() if served.process.poll() is None else served.process.returncode for served in started]
        for served in started:
            assert "Traceback" not in served.errors.read_text()
            if served.process.stdout:
                assert served.process.stdout.read() == ""
        assert set(codes) <= {0, 130}, [(served.process.args, served.errors.read_text()) for served in started]


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Callable[..., Served]]:
    """Starts ``urdfkit …`` for one test."""
    with serving(tmp_path) as start:
        yield start


@pytest.fixture(scope="module")
def serve_for_all(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Served]]:
    """Starts ``urdfkit …`` for all tests of a module."""
    with serving(tmp_path_factory.mktemp("served")) as start:
        yield start


# Not for the whole session: while Playwright runs, this thread's event loop counts as running, and no other test could
# have one.
@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield launched
        launched.close()


@dataclass
class Visits:
    """Opens pages and remembers what went wrong in them."""

    browser: Browser
    contexts: list[BrowserContext] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def open(self, url: str, *, ready: bool = True, **context: object) -> Page:
        made = self.browser.new_context(**{"viewport": {"width": 1280, "height": 800}} | context)
        made.set_default_timeout(PATIENCE * 1000)
        self.contexts.append(made)
        page = made.new_page()
        page.on("pageerror", lambda error: self.problems.append(str(error)))
        page.on("console", lambda message: self._heard(message.type, message.text))
        page.on("request", lambda request: self.requests.append(request.url))
        page.goto(url)
        if ready:
            page.wait_for_selector(READY)
        return page

    def _heard(self, kind: str, text: str) -> None:
        if kind == "error":
            self.problems.append(text)


@pytest.fixture
def visits(browser: Browser) -> Iterator[Visits]:
    made = Visits(browser)
    yield made
    for context in made.contexts:
        context.close()


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file of a robot with all there is to see."""
    return write(tmp_path_factory.mktemp("lab"))


@pytest.fixture(scope="module")
def lab_served(serve_for_all: Callable[..., Served], lab: Path) -> Served:
    """The viewer of that robot."""
    return serve_for_all("view", str(lab))


@pytest.fixture(scope="module")
def lab_visits(browser: Browser) -> Iterator[Visits]:
    """One window for all tests of a module."""
    made = Visits(browser)
    yield made
    for context in made.contexts:
        context.close()


@pytest.fixture
def lab_page(lab_served: Served, lab_visits: Visits, until: Callable[..., object]) -> Iterator[Page]:
    """The viewer as it opens, every joint at zero; nothing may go wrong in it, and it asks nobody else for anything."""
    if not lab_visits.contexts:
        opened = lab_visits.open(lab_served.url)
    else:
        opened = lab_visits.contexts[0].pages[0]
        # The page must not save its layout again before it is left.
        opened.evaluate("Storage.prototype.setItem = () => {}; localStorage.clear()")
        opened.goto(f"{lab_served.origin}/")
        opened.wait_for_selector(READY)
    opened.get_by_role("button", name="Zero all").click()
    until(lambda: opened.evaluate("Object.values(urdfkit.page.values).every((x) => x === 0)"))
    yield opened
    assert lab_visits.problems == []
    assert all(url.startswith((lab_served.origin, "data:", "blob:")) for url in lab_visits.requests)


@pytest.fixture
def keep(request: pytest.FixtureRequest) -> Callable[[Page, str], None]:
    """Keeps a screenshot in artifacts/."""

    def screenshot(page: Page, name: str) -> None:
        ARTIFACTS.mkdir(exist_ok=True)
        page.screenshot(path=ARTIFACTS / f"{request.module.__name__.split('.')[-1].removeprefix('test_')}-{name}.png")

    return screenshot
