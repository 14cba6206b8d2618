"""Animated pictures and videos of a robot: one turn of the camera, or each joint through its range."""

import io
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from math import cos, isfinite, pi
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from urdfkit.app.pictures.camera_placement import lens_of, placement
from urdfkit.app.pictures.studio import Studio, camera_of
from urdfkit.errors import MissingDependencyError, UsageError
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array

ANIMATED = (".gif", ".png", ".webp")
"""Animated pictures, which Pillow writes; ``.png`` is APNG."""
VIDEOS = (".mp4", ".webm")
"""Videos, which ffmpeg writes."""
MOTIONS = ("turn", "joints")
RATE = 20
"""Pictures per second."""
REACH = pi / 2
"""Motion of a joint without limits [rad or m]."""


def check_film(file: Path) -> None:
    """Check that a film can be written in the format of a file.

    Raises:
        UsageError: unknown format.
        MissingDependencyError: the format needs ffmpeg, and it is not installed.
    """
    suffix = file.suffix.lower()
    if suffix not in (*ANIMATED, *VIDEOS):
        formats = (*ANIMATED, *VIDEOS)
        raise UsageError(f"--video: `{file.name}` has no supported format; supported: {' '.join(formats)}")
    if suffix in VIDEOS and shutil.which("ffmpeg") is None:
        raise MissingDependencyError(
            f"--video: {suffix} needs the program ffmpeg, which is not installed; use .webp or .gif"
        )


def frames(
    studio: Studio,
    kinematics: Kinematics,
    positions: dict[str, float],
    *,
    size: tuple[int, int],
    direction: tuple[float, float, float],
    motion: str,
    seconds: float,
) -> Iterator[NDArray[np.uint8]]:
    """Yield the pictures of a film that ends where it begins, `RATE` per second.

    Args:
        studio: renders them.
        kinematics: the robot.
        positions: joint positions [rad or m].
        size: width and height [px].
        direction: azimuth and elevation [degrees] and zoom of the camera.
        motion: one of `MOTIONS`.
        seconds: length of the film.
    """
    count = max(round(RATE * seconds), 2)
    poses = [
        kinematics.link_poses(kinematics.configuration(each)) for each in _steps(kinematics, positions, motion, count)
    ]
    for k, pose in enumerate(poses):
        if motion == "turn":
            frame = _turned(studio, pose, size, direction, 360.0 * k / count)
        else:
            frame = camera_of(studio, poses[:: max(count // 24, 1)], size, direction) if k == 0 else frame
        yield studio.picture(pose, frame, *size, samples=4)


def _turned(
    studio: Studio, pose: Array, size: tuple[int, int], direction: tuple[float, float, float], turn: float
) -> Array:
    """Return the camera of one picture of a turn: all pictures have the same distance and centre."""
    azimuth, elevation, zoom = direction
    points = studio.points(pose)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    sides = [placement(points, lens_of(*size), azimuth + each, elevation) for each in (0.0, 90.0, 180.0, 270.0)]
    distance = max(float(np.linalg.norm(frame[:3, 3] - middle)) for frame in sides) / zoom
    found = placement(points, lens_of(*size), azimuth + turn, elevation)
    found[:3, 3] = middle - distance * found[:3, 0]
    return found


def _steps(kinematics: Kinematics, positions: dict[str, float], motion: str, count: int) -> list[dict[str, float]]:
    """Return the joint positions of each picture."""
    moving = (
        [name for name in kinematics.variable_names if name in kinematics.joint_names] if motion == "joints" else []
    )
    if not moving:
        return [positions] * count
    found = []
    for k in range(count):
        phase = k / count * len(moving)
        name, part = moving[int(phase)], phase % 1.0
        found.append({**positions, name: _swept(kinematics.limits(name), positions[name], part)})
    return found


def _swept(limits: tuple[float, float], start: float, part: float) -> float:
    """Return a position on the way from `start` to both limits and back."""
    lower, upper = (
        limit if isfinite(limit) else start + sign * REACH for limit, sign in zip(limits, (-1, 1), strict=True)
    )
    share = (1.0 - cos(4.0 * pi * part)) / 2.0
    return start + share * ((upper if part < 0.5 else lower) - start)


def encoded(pictures: Sequence[NDArray[np.uint8]], file: Path) -> bytes:
    """Return a film in the format of a file.

    Raises:
        UsageError: ffmpeg fails.
    """
    suffix = file.suffix.lower()
    if suffix in VIDEOS:
        return _video(pictures, suffix)
    from PIL import Image

    images = [Image.fromarray(picture) for picture in pictures]
    buffer = io.BytesIO()
    if suffix == ".gif":  # one palette for all pictures, so that colours do not flicker
        palette = images[0].quantize(255, method=Image.Quantize.MEDIANCUT)
        images = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    options = {"quality": 80, "method": 4} if suffix == ".webp" else {}
    images[0].save(
        buffer, format={".gif": "GIF", ".png": "PNG", ".webp": "WEBP"}[suffix], save_all=True, loop=0,
        append_images=images[1:], duration=1000 // RATE, **options,
    )  # fmt: skip
    return buffer.getvalue()


def _video(pictures: Sequence[NDArray[np.uint8]], suffix: str) -> bytes:
    height, width = pictures[0].shape[:2]
    codec = ["-c:v", "libx264", "-pix_fmt", "yuv420p"] if suffix == ".mp4" else ["-c:v", "libvpx-vp9", "-b:v", "2M"]
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / f"film{suffix}"
        command = [
            "ffmpeg", "-v", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(RATE),
            "-i", "-", "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", *codec, str(target),
        ]  # fmt: skip
        done = subprocess.run(
            command, input=b"".join(each.tobytes() for each in pictures), capture_output=True, check=False
        )
        if done.returncode or not target.is_file():
            reason = done.stderr.decode(errors="replace").strip().splitlines()
            raise UsageError(f"--video: ffmpeg cannot write {suffix}: {reason[-1] if reason else 'no reason'}")
        return target.read_bytes()
