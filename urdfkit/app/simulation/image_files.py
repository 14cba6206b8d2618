"""``sim run --save-image``: write the last image of a topic as PNG."""

import io
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from urdfkit.app.simulation import save_options
from urdfkit.app.simulation.save_options import TopicFile
from urdfkit.errors import MissingDependencyError, UsageError
from urdfkit.sim.simulator import Simulator

IMAGE = "sensor_msgs/msg/Image"


def find_topics(simulator: Simulator, wanted: Sequence[TopicFile]) -> list[tuple[str, Path]]:
    """Return topic and file of each ``--save-image``.

    Raises:
        UsageError: the topic is unknown or carries no images, or the default is ambiguous.
        MissingDependencyError: Pillow is not installed.
    """
    from importlib.util import find_spec

    if wanted and find_spec("PIL") is None:
        raise MissingDependencyError("--save-image needs Pillow: pip install 'urdfkit[sim]'")
    return save_options.find_topics(
        simulator, wanted, option="--save-image", types=(IMAGE,), what="images", suffix=".png"
    )


def contents(simulator: Simulator, wanted: Sequence[tuple[str, Path]]) -> Iterator[tuple[Path, bytes]]:
    """Yield each file and its content, the last image of its topic.

    Raises:
        UsageError: no image has been published.
    """
    for topic, file in wanted:
        message = simulator.bus.latest(topic)
        if message is None:
            raise UsageError(f"--save-image: no image was published on {topic} in {simulator.t:g} s; increase --for")
        yield file, png(message)


def png(message: Any) -> bytes:
    """Return an Image as PNG.

    Depths are converted to 16-bit millimetres, zero where unknown, as in 16UC1. Bayer patterns stay grey.

    Args:
        message: a message of type sensor_msgs/Image.
    """
    import numpy as np
    from PIL import Image

    def rows(kind: str, channels: int = 1) -> Any:
        lines = np.frombuffer(message.data.tobytes(), "u1").reshape(message.height, message.step)
        size = np.dtype(kind).itemsize * channels * message.width
        image = np.ascontiguousarray(lines[:, :size]).view(kind).reshape(message.height, message.width, channels)
        return image[:, :, 0] if channels == 1 else image

    match message.encoding:
        case "rgb8":
            pixels = rows("u1", 3)
        case "bgr8":
            pixels = rows("u1", 3)[:, :, ::-1]
        case "rgb16":
            pixels = (rows("<u2", 3) >> 8).astype(np.uint8)  # PNG libraries support 16 bits only for grey
        case "32FC1":
            depth = rows("<f4")
            valid = np.isfinite(depth) & (depth > 0) & (depth < 65.535)
            pixels = np.rint(np.where(valid, depth, 0.0) * 1000.0).astype(np.uint16)
        case "16UC1" | "mono16":
            pixels = rows("<u2")
        case _:
            pixels = rows("u1")
    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(file, format="PNG")
    return file.getvalue()
