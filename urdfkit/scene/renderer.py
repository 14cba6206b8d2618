"""Choice of the renderer: ray casting, which works everywhere, or OpenGL, which needs a working driver."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from typing import Any, Literal, Protocol, get_args

from numpy.typing import ArrayLike

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.gl.driver_probe import SECONDS, Found, on_processor, probe, probe_again
from urdfkit.scene.lights import Lighting
from urdfkit.scene.ray_renderer import Picture, RayRenderer
from urdfkit.scene.rays.ray_scene import RayTable

RendererName = Literal["auto", "ray", "gl"]
RENDERERS: tuple[str, ...] = get_args(RendererName)
"""The faster working renderer, see `renderer_of`; ray casting; OpenGL."""


class ImageRenderer(Protocol):
    """Interface of a renderer, as `RayRenderer`."""

    table: RayTable

    def take(
        self, lens: Lens, frame: ArrayLike, *, near: float = 0.0, far: float = ..., samples: int = 1, deep: bool = True
    ) -> Picture:
        """Render an image, see `RayRenderer.take`."""
        ...


LARGE = 150_000
"""Pixels from which on a software driver is faster than rays, with shadows.

CPU time per image of a driving robot: rays 60 µs per 1,000 pixels, a driver 6.5 ms and 13 µs per 1,000 pixels
(`tests/bench/latency` shows the effect).
"""

PATIENCE = 1.5
"""Seconds of waiting for a driver before a message to the user."""


def check(
    renderer: str, device: Callable[[], Found] = probe_again, *, note: Callable[[str], None] = lambda text: None
) -> None:
    """Check that a renderer exists and works.

    Args:
        renderer: one of `RENDERERS`.
        device: function that tests OpenGL.
        note: receives a message if the test takes long.

    Raises:
        SimulationError: the renderer is unknown, or OpenGL was selected and does not work here.
    """
    if renderer not in RENDERERS:
        raise SimulationError(
            f"unknown renderer `{renderer}`{did_you_mean(renderer, RENDERERS)} (available: {', '.join(RENDERERS)})"
        )
    if renderer == "gl" and not (found := _tried(device, note)).works:
        raise SimulationError(f"renderer `gl` does not work here: {found.name}; use `ray`")


def renderer_of(
    table: RayTable, lighting: Lighting, renderer: str, note: Callable[[str], None], device: Callable[[], Found] = probe
) -> ImageRenderer:
    """Return a renderer for the shapes of a table.

    With ``auto`` it is OpenGL on a graphics card, or if no light casts shadows; otherwise OpenGL for images of `LARGE`
    pixels or more, and ray casting for smaller ones, which need no driver and its 100 MB of memory then.

    Args:
        table: the shapes.
        lighting: the lights.
        renderer: one of `RENDERERS`.
        note: receives a message if OpenGL is installed and does not work.
        device: function that tests OpenGL.
    """
    if renderer == "ray":
        return RayRenderer(table, lighting)
    found = _tried(device, note)
    if not found.works:
        if "not installed" not in found.name:
            note(f"OpenGL does not work here ({found.name}); images are rendered by ray casting")
        return RayRenderer(table, lighting)
    if renderer == "auto" and on_processor(found.name) and lighting.has_shadows:
        return RendererBySize(RayRenderer(table, lighting), lambda: _with_driver(table, lighting, found, note))
    return _with_driver(table, lighting, found, note)


class RendererBySize:
    """Renders small images by ray casting and large images with a driver, which is started for the first large image.

    Args:
        rays: renderer of small images.
        start: returns the renderer of large images.
    """

    def __init__(self, rays: RayRenderer, start: Callable[[], ImageRenderer]) -> None:
        self.table = rays.table
        self._rays, self._start = rays, start
        self._driver: ImageRenderer | None = None

    def take(self, lens: Lens, frame: ArrayLike, **options: Any) -> Picture:
        """Render an image, see `RayRenderer.take`."""
        if lens.width * lens.height < LARGE:
            return self._rays.take(lens, frame, **options)
        if self._driver is None:
            self._driver = self._start()
        return self._driver.take(lens, frame, **options)


def _with_driver(table: RayTable, lighting: Lighting, found: Found, note: Callable[[str], None]) -> ImageRenderer:
    from urdfkit.scene.gl.gl_renderer import GlRenderer

    try:
        return GlRenderer(table, lighting, found.backend, note)
    except Exception as error:  # any error of the driver
        note(f"OpenGL does not work here ({_first_line(error)}); images are rendered by ray casting")
        return RayRenderer(table, lighting)


def _tried(device: Callable[[], Found], note: Callable[[str], None]) -> Found:
    """Return the result of the test; print a message if it takes long."""
    with ThreadPoolExecutor(max_workers=1) as trying:
        future = trying.submit(device)
        if not wait([future], timeout=PATIENCE).done:
            note(f"waiting for the graphics driver, at most {SECONDS:g} s")
        return future.result()


def _first_line(error: Exception) -> str:
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__
