"""Who takes pictures: rays, which work everywhere, or OpenGL, where a driver works."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from typing import Literal, Protocol, get_args

from numpy.typing import ArrayLike

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.gl.driver_probe import SECONDS, Found, on_processor, probe, probe_anew
from urdfkit.scene.lights import Lighting
from urdfkit.scene.ray_images import Painter, Picture
from urdfkit.scene.rays.ray_scene import RayTable

Renderer = Literal["auto", "ray", "gl"]
RENDERERS: tuple[str, ...] = get_args(Renderer)
"""Whichever is quicker of those that work, see `painter_of`; rays; OpenGL."""


class TakesPictures(Protocol):
    """A `Painter`, by whatever means."""

    table: RayTable

    def take(
        self, lens: Lens, frame: ArrayLike, *, near: float = 0.0, far: float = ..., samples: int = 1, deep: bool = True
    ) -> Picture:
        """Return a picture, see `Painter.take`."""
        ...


PATIENCE = 1.5
"""Seconds of trying a driver before the user is told what is waited for."""


def check(
    renderer: str, device: Callable[[], Found] = probe_anew, *, note: Callable[[str], None] = lambda text: None
) -> None:
    """Refuse a renderer that there is not.

    Args:
        renderer: one of `RENDERERS`.
        device: tries whether OpenGL works.
        note: tells the user that this takes long.

    Raises:
        SimulationError: there is no such renderer, or OpenGL is asked for and does not work here.
    """
    if renderer not in RENDERERS:
        raise SimulationError(
            f"no renderer `{renderer}`{did_you_mean(renderer, RENDERERS)} (there are {', '.join(RENDERERS)})"
        )
    if renderer == "gl" and not (found := _tried(device, note)).works:
        raise SimulationError(f"renderer `gl` does not work here: {found.name}; `ray` does everywhere")


def painter_of(
    table: RayTable,
    lighting: Lighting,
    renderer: str,
    note: Callable[[str], None],
    device: Callable[[], Found] = probe,
) -> TakesPictures:
    """Return what takes pictures of a table's shapes.

    With ``auto`` it is OpenGL where a graphics card draws, or no light casts shadows; else rays, which are quicker with
    shadows than a driver that draws on the processor, and need 60 MB less (`tests/bench/bench_pictures.py`).

    Args:
        table: the shapes.
        lighting: what shines.
        renderer: one of `RENDERERS`.
        note: tells the user that OpenGL is there and does not work.
        device: tries whether OpenGL works.
    """
    if renderer == "ray":
        return Painter(table, lighting)
    found = _tried(device, note)
    if not found.works:
        if "not installed" not in found.name:
            note(f"OpenGL does not work here ({found.name}): pictures are taken by casting rays")
        return Painter(table, lighting)
    if renderer == "auto" and on_processor(found.name) and lighting.has_shadows:
        return Painter(table, lighting)
    from urdfkit.scene.gl.gl_renderer import GlPainter

    try:
        return GlPainter(table, lighting, found.backend, note)
    except Exception as error:  # whatever the driver raises
        note(f"OpenGL does not work here ({_first_line(error)}): pictures are taken by casting rays")
        return Painter(table, lighting)


def _tried(device: Callable[[], Found], note: Callable[[str], None]) -> Found:
    """Return what came of trying; a driver that takes long is spoken of meanwhile."""
    with ThreadPoolExecutor(max_workers=1) as trying:
        future = trying.submit(device)
        if not wait([future], timeout=PATIENCE).done:
            note(f"trying the graphics driver, which does not answer: {SECONDS:g} s at most")
        return future.result()


def _first_line(error: Exception) -> str:
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__
