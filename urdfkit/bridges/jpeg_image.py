"""Images as JPEG, as image_transport's ``compressed`` transport publishes them."""

import io
from typing import Any

import numpy as np

IMAGE, COMPRESSED_IMAGE = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
CHANNELS = {"rgb8": 3, "bgr8": 3, "mono8": 1}
"""Encoding → channels of the images that JPEG represents; depths, labels and Bayer patterns would become wrong."""


def jpeg_image(message: Any, quality: int) -> Any:
    """Return an Image as CompressedImage; None for encodings without an entry in `CHANNELS`.

    Args:
        message: a message of type sensor_msgs/Image.
        quality: quality of the JPEG, 1 to 95.
    """
    from PIL import Image

    from urdfkit.messages import message_type

    channels = CHANNELS.get(message.encoding)
    if channels is None:
        return None
    lines = np.frombuffer(message.data.tobytes(), "u1").reshape(message.height, message.step)
    pixels = lines[:, : channels * message.width].reshape(message.height, message.width, channels)
    if message.encoding == "bgr8":
        pixels = pixels[:, :, ::-1]
    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels[:, :, 0] if channels == 1 else pixels)).save(
        file, format="JPEG", quality=quality
    )
    stored = "mono8" if channels == 1 else "bgr8"  # as image_transport names it
    data = np.frombuffer(file.getvalue(), dtype=np.uint8)
    return message_type(COMPRESSED_IMAGE)(message.header, f"{message.encoding}; jpeg compressed {stored}", data)
