"""Parameters of a camera from the ``<camera>`` of a ``<sensor>``; Image and CameraInfo messages."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.plugins.invalid_sensor_values import senseless_camera
from urdfkit.description.urdf.robot import SensorTag
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.linear_algebra import matmul
from urdfkit.messages import header, message_type
from urdfkit.scene.camera_model import Distortion, Lens
from urdfkit.sim.plugins.sensors.sensor_values import number, refuse

IMAGE = "sensor_msgs/msg/Image"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"

ENCODINGS = {
    "L8": "mono8",
    "L_INT8": "mono8",
    "R8G8B8": "rgb8",
    "RGB_INT8": "rgb8",
    "B8G8R8": "bgr8",
    "BGR_INT8": "bgr8",
    "L16": "mono16",
    "L_INT16": "mono16",
    "R16G16B16": "rgb16",
    "RGB_INT16": "rgb16",
    "R_FLOAT32": "rgb8",
    "BAYER_RGGB8": "bayer_rggb8",
    "BAYER_BGGR8": "bayer_bggr8",
    "BAYER_GBRG8": "bayer_gbrg8",
    "BAYER_GRBG8": "bayer_grbg8",
}
"""SDF image format → sensor_msgs encoding (gazebo_ros_camera_utils.cpp). Depth cameras of gz sim are configured
with R_FLOAT32, which is the format of their depth images in any case."""

MAX_PIXELS = 16_000_000

MAX_SAMPLES = 64
"""Most anti-aliasing samples per pixel."""

LUMA = np.array([0.299, 0.587, 0.114])
"""Weights of red, green and blue in a grey value (ITU-R BT.601)."""


@dataclass(frozen=True)
class Optics:
    """Parameters of a ``<camera>``; the defaults are sdformat's (camera.sdf).

    Attributes:
        lens: size, field of view and distortion.
        encoding: sensor_msgs encoding of its pictures.
        near: near clipping distance [m].
        far: far clipping distance [m].
        samples: anti-aliasing samples per pixel at edges.
        element: the ``<camera>``.
    """

    lens: Lens
    encoding: str
    near: float
    far: float
    samples: int
    element: Element


def cameras_of(sensor: SensorTag) -> list[Element]:
    """Return the ``<camera>`` elements of a sensor.

    Raises:
        SimulationError: the sensor has no ``<camera>``, with its position.
    """
    found = [child for child in sensor.element.children if child.tag == "camera"]
    if not found:
        raise SimulationError("a camera sensor has no <camera>", position=sensor.element.origin.position)
    return found


def optics_of(camera: Element) -> Optics:
    """Return the parameters of a ``<camera>``.

    Raises:
        SimulationError: a parameter is invalid, with its position.
    """
    refuse(senseless_camera(camera))
    image, clip = camera.find("image"), camera.find("clip")
    width, height = number(image, "width", 320.0, least=1.0), number(image, "height", 240.0, least=1.0)
    if width * height > MAX_PIXELS:
        raise SimulationError(
            f"a picture of {width:g} × {height:g} pixels cannot be rendered", position=(image or camera).origin.position
        )
    angle = number(camera, "horizontal_fov", 1.047)
    near, far = number(clip, "near", 0.1, least=0.0), number(clip, "far", 100.0, infinite=True)
    written = camera.find("distortion")
    distortion = Distortion(*(number(written, tag, 0.0) for tag in ("k1", "k2", "p1", "p2", "k3")))
    lens = Lens(int(width), int(height), angle, distortion)
    samples = number(image, "anti_aliasing", 1.0, least=0.0)
    if samples != int(samples) or samples > MAX_SAMPLES:
        message = f"<anti_aliasing> is {samples:g}; it must be a whole number of samples, at most {MAX_SAMPLES}"
        raise SimulationError(message, position=(image or camera).origin.position)
    return Optics(lens, _encoding(image), near, far, max(1, int(samples)), camera)


def _encoding(image: Element | None) -> str:
    written = None if image is None else image.find("format")
    name = "R8G8B8" if written is None or not written.text else written.text
    if name not in ENCODINGS:
        raise SimulationError(
            f"unsupported image format `{name}`"
            + did_you_mean(name, ENCODINGS)
            + f" (supported: {', '.join(ENCODINGS)})",
            position=None if written is None else written.origin.position,
        )
    return ENCODINGS[name]


def image(t: float, frame: str, rgb: NDArray[np.uint8], encoding: str) -> Any:
    """Return an Image.

    Args:
        t: time stamp [s].
        frame: frame id of the header.
        rgb: red, green and blue; shape (height, width, 3).
        encoding: one of `ENCODINGS`.
    """
    pixels = rgb
    if encoding == "bgr8":
        pixels = rgb[:, :, ::-1]
    elif encoding in ("rgb16", "mono16"):  # the same picture; white is 65535
        deep = rgb if encoding == "rgb16" else matmul(rgb, LUMA)
        pixels = np.rint(deep * 257.0).astype("<u2").view(np.uint8)
    elif encoding == "mono8":
        pixels = np.rint(matmul(rgb, LUMA)).astype(np.uint8)
    elif encoding.startswith("bayer_"):
        pixels = np.empty(rgb.shape[:2], dtype=np.uint8)
        for k, color in enumerate(encoding[6:10]):
            pixels[k // 2 :: 2, k % 2 :: 2] = rgb[k // 2 :: 2, k % 2 :: 2, "rgb".index(color)]
    height, width = rgb.shape[:2]
    content = np.ascontiguousarray(pixels).reshape(-1)
    return message_type(IMAGE)(header(t, frame), height, width, encoding, 0, len(content) // height, content)


def depth_image(t: float, frame: str, depth: NDArray[np.float32], *, millimetres: bool = False) -> Any:
    """Return a depth Image: 32FC1 in metres, or 16UC1 in millimetres, where zero means no measurement.

    Args:
        t: time stamp [s].
        frame: frame id of the header.
        depth: [m]; shape (height, width).
        millimetres: use 16UC1 instead of 32FC1.
    """
    height, width = depth.shape
    if millimetres:
        measured = np.where(np.isfinite(depth) & (depth > 0) & (depth < 65.535), depth, 0.0)
        content = np.rint(measured * 1000.0).astype("<u2")
    else:
        content = depth.astype("<f4")
    encoding = "16UC1" if millimetres else "32FC1"
    step = width * content.itemsize
    return message_type(IMAGE)(
        header(t, frame), height, width, encoding, 0, step, np.frombuffer(content.tobytes(), dtype=np.uint8)
    )


def camera_info(t: float, frame: str, lens: Lens, *, focal: float, cx: float, cy: float, baseline: float = 0.0) -> Any:
    """Return the CameraInfo of a camera with plumb_bob distortion and no rectification.

    Args:
        t: time stamp [s].
        frame: frame id of the header.
        lens: picture size and distortion.
        focal: focal length [px].
        cx: column of the principal point [px].
        cy: row of the principal point [px].
        baseline: distance to the left camera of a stereo pair [m].
    """
    d = lens.distortion
    region = message_type("sensor_msgs/msg/RegionOfInterest")(0, 0, 0, 0, False)
    return message_type(CAMERA_INFO)(
        header(t, frame), lens.height, lens.width, "plumb_bob",
        np.array([d.k1, d.k2, d.p1, d.p2, d.k3]),
        np.array([focal, 0, cx, 0, focal, cy, 0, 0, 1], dtype=float),
        np.eye(3).ravel(),
        np.array([focal, 0, cx, -focal * baseline, 0, focal, cy, 0, 0, 0, 1, 0], dtype=float),
        0, 0, region,
    )  # fmt: skip
