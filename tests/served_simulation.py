"""A simulation in a thread of the test: with a server of rosbridge, or with a page."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Event, Thread

import pytest

from urdfkit.app.simulation.bridging.bridges import BridgeOptions, bridged
from urdfkit.app.simulation.bridging.real_time import RunControls, advance_in_real_time
from urdfkit.app.simulation.clock_rate import FRAME
from urdfkit.app.simulation.loop import DriveLoop
from urdfkit.bridges.websocket.address import Address
from urdfkit.sim import Simulator
from urdfkit.view.server.running_simulations import registered
from urdfkit.view.server.server import Server


@contextmanager
def rosbridge(simulator: Simulator) -> Iterator[str]:
    """Simulate in real time with a server of rosbridge; yield its address."""
    stopped: list[bool] = []
    options = BridgeOptions(rosbridge=Address("127.0.0.1", 0))
    with bridged(simulator, options, RunControls(simulator), pytest.fail) as bridges:
        (server,) = bridges._open
        thread = Thread(target=advance_in_real_time, args=(simulator, bridges, lambda: bool(stopped)))
        thread.start()
        try:
            yield server.urls[0].replace("ws://", "rosbridge://")  # type: ignore[attr-defined]
        finally:
            stopped.append(True)
            thread.join()


@contextmanager
def driven(simulator: Simulator, folder: Path) -> Iterator[DriveLoop]:
    """Simulate as `sim teleop` does, so that commands find the simulation.

    Args:
        simulator: the simulation.
        folder: for the address of the page.
    """
    over = Event()
    with pytest.MonkeyPatch.context() as patch, Server("sim", port=0) as server:
        patch.setenv("XDG_RUNTIME_DIR", str(folder))
        loop = DriveLoop(simulator, server)
        loop.show()

        def run() -> None:
            loop.pace.begin(simulator.t)
            while not over.wait(FRAME):
                loop.tick()

        thread = Thread(target=run)
        thread.start()
        try:
            with registered(server.port, server.url, simulator.name):
                yield loop
        finally:
            over.set()
            thread.join()
