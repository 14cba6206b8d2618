"""Which simulations are running: a note of each, so that a command finds it.

While a simulation is driven, a file that only this user can read says where its page is, with the key. It lies beside
the keys of pages (see `saved_tokens`), is named by the port and goes when the simulation ends. Where no file can be
kept safely there is no note, and the address has to be given.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from urllib.parse import urlsplit

from urdfkit.errors import ResourceError, UsageError, did_you_mean
from urdfkit.view.server.saved_tokens import private_folder, read_private, write_private

NONE = "no simulation is running; start one with `urdfkit sim teleop ROBOT`, or name its address with --url"


@dataclass(frozen=True, slots=True)
class Running:
    """A simulation that is running.

    Attributes:
        url: of its page, with the key.
        robot: the first robot's name.
        process: number of the process.
    """

    url: str
    robot: str
    process: int

    @property
    def origin(self) -> str:
        """The address without the key."""
        return origin(self.url)


def origin(url: str) -> str:
    """Return an address without what comes after host and port."""
    parts = urlsplit(url)
    return f"{parts.scheme}://{parts.netloc}"


@contextmanager
def noted(port: int, url: str, robot: str) -> Iterator[None]:
    """Keep a note of a running simulation for as long as the block runs."""
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
        for _, each in _notes(path.parent, lives=False):
            each.unlink(missing_ok=True)
        write_private(path, json.dumps(asdict(running)))
    except OSError:
        return None
    return path


def all_running() -> list[Running]:
    """Return the simulations of this user that are running, in the order of their ports."""
    if sys.platform == "win32":
        return []
    try:
        return [running for running, _ in _notes(private_folder(), lives=True)]
    except OSError:
        return []


def find(url: str | None = None) -> str:
    """Return the address, with the key, of the simulation to talk to.

    Args:
        url: names it: the address as it was printed, or without the key that its note has; None for the only one.

    Raises:
        ResourceError: none is running, or several are.
        UsageError: `url` is no address, or lacks a key that no note has.
    """
    known = all_running()
    if url is None:
        if not known:
            raise ResourceError(NONE)
        if len(known) > 1:
            names = ", ".join(f"{each.origin} ({each.robot})" for each in known)
            raise ResourceError(f"{len(known)} simulations are running: {names}; name one with --url")
        return known[0].url
    try:
        parts = urlsplit(url if "://" in url else f"http://{url}")
        fits = parts.scheme == "http" and parts.hostname and parts.port
    except ValueError:
        fits = False
    if not fits:
        raise UsageError(f"--url {url}: an address is as `sim teleop` prints it, http://HOST:PORT/?token=KEY")
    if parts.query:
        return parts.geturl()
    place = f"http://{parts.netloc}"
    for each in known:
        if each.origin == place.replace("localhost", "127.0.0.1"):
            return each.url
    near = did_you_mean(place, [each.origin for each in known])
    raise UsageError(f"--url {url}: no running simulation of yours is known there, so the address needs its key{near}")


def _notes(folder: Path, *, lives: bool) -> Iterator[tuple[Running, Path]]:
    """Yield what is noted of simulations whose process lives, or is gone."""
    for path in sorted(folder.glob("running-*.json")):
        try:
            found = json.loads(read_private(path) or "")
            running = Running(str(found["url"]), str(found["robot"]), int(found["process"]))
        except (OSError, ValueError, KeyError, TypeError):
            continue
        if _lives(running.process) == lives:
            yield running, path


def _lives(process: int) -> bool:
    if process <= 0:
        return False
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True
