"""Registry of running simulations, with which commands find their pages.

While `sim teleop` runs, a file that only this user can read contains the URL of its page, with the token. The file is
in the folder of the tokens (see `saved_tokens`), is named after the port, and is removed when the simulation ends. If
no private file can be written, the simulation is not registered and its URL has to be passed.
"""

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from urllib.parse import urlsplit

from urdfkit.atomic import is_alive
from urdfkit.errors import ResourceError, UsageError, did_you_mean
from urdfkit.view.server.saved_tokens import private_folder, read_private, write_private

NONE = "no simulation is running; start one with `urdfkit sim teleop ROBOT`, or pass its address with --url"


@dataclass(frozen=True, slots=True)
class Running:
    """A running simulation.

    Attributes:
        url: URL of its page, with the token.
        robot: name of the first robot.
        process: process ID.
    """

    url: str
    robot: str
    process: int

    @property
    def origin(self) -> str:
        """The URL without the token."""
        return origin(self.url)


def origin(url: str) -> str:
    """Return scheme, host and port of a URL."""
    parts = urlsplit(url)
    return f"{parts.scheme}://{parts.netloc}"


@contextmanager
def registered(port: int, url: str, robot: str) -> Iterator[None]:
    """Register a running simulation for the duration of the block."""
    path = _write(port, Running(url, robot, os.getpid()))
    try:
        yield
    finally:
        if path is not None:
            with contextlib.suppress(OSError):
                path.unlink()


def _write(port: int, running: Running) -> Path | None:
    if sys.platform == "win32":
        return None
    try:
        path = private_folder() / f"running-{port}.json"
        for _, each in _registered(path.parent, lives=False):
            each.unlink(missing_ok=True)
        write_private(path, json.dumps(asdict(running)))
    except OSError:
        return None
    return path


def all_running() -> list[Running]:
    """Return the running simulations of this user, in the order of their ports."""
    if sys.platform == "win32":
        return []
    try:
        return [running for running, _ in _registered(private_folder(), lives=True)]
    except OSError:
        return []


def find(url: str | None = None) -> str:
    """Return the URL, with the token, of the simulation to connect to.

    Args:
        url: the printed URL; the token may be omitted if the simulation is registered. None for the only simulation.

    Raises:
        ResourceError: no simulation or several simulations are running.
        UsageError: `url` is invalid, or has no token and belongs to no registered simulation.
    """
    simulations = all_running()
    if url is None:
        if not simulations:
            raise ResourceError(NONE)
        if len(simulations) > 1:
            names = ", ".join(f"{each.origin} ({each.robot})" for each in simulations)
            raise ResourceError(f"{len(simulations)} simulations are running: {names}; select one with --url")
        return simulations[0].url
    try:
        parts = urlsplit(url if "://" in url else f"http://{url}")
        valid = parts.scheme == "http" and parts.hostname and parts.port
    except ValueError:
        valid = False
    if not valid:
        raise UsageError(f"--url {url}: invalid address; expected http://HOST:PORT/?token=TOKEN")
    if parts.query:
        return parts.geturl()
    place = f"http://{parts.netloc}"
    for each in simulations:
        if each.origin == place.replace("localhost", "127.0.0.1"):
            return each.url
    near = did_you_mean(place, [each.origin for each in simulations])
    raise UsageError(
        f"--url {url}: you have no simulation running at this address; include the token in the address{near}"
    )


def _registered(folder: Path, *, lives: bool) -> Iterator[tuple[Running, Path]]:
    """Yield the registered simulations whose process is running (`lives`) or has ended."""
    for path in sorted(folder.glob("running-*.json")):
        try:
            found = json.loads(read_private(path) or "")
            running = Running(str(found["url"]), str(found["robot"]), int(found["process"]))
        except (OSError, ValueError, KeyError, TypeError):
            continue
        if (running.process > 0 and is_alive(running.process)) == lives:
            yield running, path
