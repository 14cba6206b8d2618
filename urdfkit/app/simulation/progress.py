"""Progress of long operations before a simulation starts, in the terminal and on the page."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from urdfkit.app.page import note
from urdfkit.sim.engine.compiling_process import CompilingProcess
from urdfkit.view.content.display_interface import StatusDisplay
from urdfkit.view.server.server import Server

PATIENCE = 1.0
"""Seconds that an operation may take before it is reported."""


RAYS = "compiling the sensor kernels; the page shows sensor data afterwards …"
"""Label of the compilation of the ray-casting kernels."""


class Compilation:
    """Compilation of kernels in other processes, while the physics is interpreted; reported on the page.

    Args:
        server: the page.
        renderer: renderer of the cameras, whose driver is tested before sensors are shown.

    Attributes:
        kernels: the physics kernels.
    """

    def __init__(self, server: Server, renderer: str) -> None:
        from urdfkit.sim.engine.kernel_cache import LiveKernels

        self._server, self._renderer = server, renderer
        self._label: str | None = None
        self._rays: CompilingProcess | None = None
        self._loading: threading.Thread | None = None
        self.kernels = LiveKernels(self._report, self._warn)

    def show(self) -> None:
        """Show the present state on the page, after the progress of something else."""
        self._server.publish_latched("progress", label=self._label)

    def rays_are_compiled(self) -> bool:
        """Compile the ray-casting kernels after that of the physics, and load them; return whether that has ended."""
        from urdfkit.sim.engine.compiling_process import CompilingProcess

        if self._label is None and self._rays is None:
            self._rays = CompilingProcess("rays")
            self._report(RAYS)
        if self._rays is None or not self._rays.ended:
            return False
        if self._loading is None:
            if fault := self._rays.fault:
                self._warn(f"the ray kernels cannot be compiled in another process: {fault}")
            self._loading = threading.Thread(target=self._load_rays, name="urdfkit-rays", daemon=True)
            self._loading.start()
        if self._loading.is_alive():
            return False
        if self._label == RAYS:
            self._report(None)
        return True

    def _load_rays(self) -> None:
        from urdfkit.scene.gl.driver_probe import probe
        from urdfkit.scene.rays import warmup

        warmup()
        if self._renderer != "ray":
            probe()

    def close(self) -> None:
        """End the processes."""
        self.kernels.close()
        if self._rays is not None:
            self._rays.close()

    def _report(self, label: str | None) -> None:
        self._label = label
        if label is not None:
            note(label)
        self.show()

    def _warn(self, text: str) -> None:
        note(text)
        self._server.broadcast("notice", text=text, tone="warning")


@contextmanager
def progress(server: StatusDisplay, label: str) -> Iterator[None]:
    """Report an operation in the terminal and on the page if it takes longer than `PATIENCE`.

    Args:
        server: the page.
        label: name of the operation.
    """
    over, reported = threading.Lock(), False

    def report() -> None:
        nonlocal reported
        with over:
            if not timer.finished.is_set():
                reported = True
                note(label)
                server.publish_latched("progress", label=label)

    timer = threading.Timer(PATIENCE, report)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        with over:
            if reported:
                server.publish_latched("progress", label=None)
