"""`urdfkit view --image` and `--video`: a picture or a film instead of the page."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note
from urdfkit.errors import MissingDependencyError, UsageError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.app.viewer.shown_robot import ShownRobot

IMAGES = (".png", ".jpg", ".jpeg", ".webp")
MOST_PIXELS = 2**25
SIZES = {"image": (1200, 900), "video": (480, 360)}
CAMERA, MOTION, SECONDS = "corner", "turn", 6.0
"""Defaults of the options."""
NEEDS = {
    **dict.fromkeys(("size", "camera", "joint"), ("image", "video")),
    "transparent": ("image",),
    **dict.fromkeys(("motion", "seconds"), ("video",)),
}
"""Option → options that use it."""
MANY_TRIANGLES = 20_000
"""Number of triangles from which on a picture takes seconds and is announced."""


def add_picture_options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    group = parser.add_argument_group("pictures")
    group.add_argument("--image", metavar="FILE", help="write a picture (.png, .jpg, .webp) and exit; needs no browser")
    group.add_argument(
        "--video", metavar="FILE", help="write an animated picture (.gif, .png, .webp) or, with ffmpeg, a video (.mp4, "
        ".webm) and exit",
    )  # fmt: skip
    group.add_argument("--size", metavar="W,H", help="width and height in pixels (default 1200,900; video 480,360)")
    group.add_argument(
        "--camera", metavar="VIEW", help="corner (default), front, back, left, right, top, or "
        "AZIMUTH,ELEVATION[,ZOOM] in degrees",
    )  # fmt: skip
    group.add_argument(
        "--joint", metavar="NAME=VALUE", action="append", default=[], help="joint positions of the picture in rad or m"
    )
    group.add_argument("--transparent", action="store_true", help="transparent background, with shadows, for --image")
    group.add_argument(
        "--motion",
        metavar="MOTION",
        help="turn (default): the camera moves around the robot; joints: the joints move one after the other",
    )
    group.add_argument("--seconds", type=float, metavar="T", help="length of the video in seconds (default 6)")


def set_picture_defaults(arguments: argparse.Namespace) -> None:
    """Replace unset options by their defaults.

    Raises:
        UsageError: an option has no effect.
    """
    for option, needed in NEEDS.items():
        value = getattr(arguments, option)
        is_unset = value is None or value is False or value == []
        if not is_unset and all(getattr(arguments, each) is None for each in needed):
            raise UsageError(f"--{option} is an option of {' and '.join(f'--{each} FILE' for each in needed)}")
    for option, default in (("camera", CAMERA), ("motion", MOTION), ("seconds", SECONDS)):
        if getattr(arguments, option) is None:
            setattr(arguments, option, default)


def check_picture_options(arguments: argparse.Namespace) -> None:
    """Check the options before the robot is loaded.

    Raises:
        UsageError: an option has an invalid value.
        MissingDependencyError: numba or ffmpeg is missing.
    """
    from importlib.util import find_spec

    from urdfkit.app.pictures.camera_placement import camera_direction
    from urdfkit.app.pictures.films import MOTIONS, check_film
    from urdfkit.atomic import check_output_files

    for option in ("image", "video"):
        if (name := getattr(arguments, option)) is None:
            continue
        check_output_files(f"--{option}", [Path(name)])
        _size(arguments.size, option)
    if arguments.image is not None and Path(arguments.image).suffix.lower() not in IMAGES:
        raise UsageError(f"--image: `{arguments.image}` has no supported format; supported: {' '.join(IMAGES)}")
    if arguments.transparent and Path(arguments.image or "").suffix.lower() in (".jpg", ".jpeg"):
        raise UsageError("--transparent: JPEG pictures cannot be transparent; use .png or .webp")
    if arguments.video is not None:
        check_film(Path(arguments.video))
    if arguments.motion not in MOTIONS:
        raise UsageError(
            f"--motion: unknown motion `{arguments.motion}`{did_you_mean(arguments.motion, MOTIONS)} "
            f"(motions: {', '.join(MOTIONS)})"
        )
    if not 0.1 <= arguments.seconds <= 60.0:
        raise UsageError(f"--seconds: {arguments.seconds:g} s is not between 0.1 and 60 s")
    camera_direction(arguments.camera)
    if find_spec("numba") is None:
        raise MissingDependencyError("--image and --video need numba: pip install 'urdfkit[sim]'")


def _size(text: str | None, option: str) -> tuple[int, int]:
    if text is None:
        return SIZES[option]
    try:
        width, height = (int(word) for word in text.lower().replace("x", ",").split(","))
    except ValueError:
        raise UsageError(f"--size expects W,H in pixels, got `{text}`") from None
    if min(width, height) < 16 or width * height > MOST_PIXELS:
        raise UsageError(
            f"--size: {width} × {height} pixels are not supported: at least 16 each, at most 2^25 together"
        )
    return width, height


def write_pictures(arguments: argparse.Namespace, shown: ShownRobot) -> None:
    """Write the picture and the film.

    Raises:
        UsageError: the robot has no shapes.
        KinematicsError: an unknown joint.
        ResourceError: a file cannot be written.
    """
    from urdfkit.app.pictures.camera_placement import camera_direction
    from urdfkit.app.pictures.films import encoded, frames
    from urdfkit.app.pictures.studio import FILM, Studio, camera_of
    from urdfkit.atomic import write_bytes
    from urdfkit.cli.robot_arguments.joint_positions import joint_positions
    from urdfkit.view.content.joint_panel import home

    kinematics = shown.kinematics
    if not shown.scene.shapes:
        raise UsageError(f"robot `{kinematics.robot.name}` has no shapes to show")
    positions = home(kinematics) | joint_positions(arguments.joint, "view: --joint")
    poses = kinematics.link_poses(kinematics.configuration(positions))
    direction = camera_direction(arguments.camera)
    if arguments.image is not None:
        size, file = _size(arguments.size, "image"), Path(arguments.image)
        studio = Studio(shown.scene, poses)
        if studio.triangle_count > MANY_TRIANGLES and not arguments.quiet:
            note(f"rendering {size[0]} × {size[1]} pixels of {studio.triangle_count:,} triangles …")
        camera = camera_of(studio, [poses], size, direction)
        pixels = studio.picture(poses, camera, *size, is_transparent=arguments.transparent)
        write_bytes(file, _image(pixels, file))
        _wrote(arguments, file)
    if arguments.video is not None:
        size, file = _size(arguments.size, "video"), Path(arguments.video)
        options = {"size": size, "direction": direction, "motion": arguments.motion, "seconds": arguments.seconds}
        studio = Studio(shown.scene, poses, FILM)
        write_bytes(file, encoded(list(frames(studio, kinematics, positions, **options)), file))
        _wrote(arguments, file)


def _image(pixels: Any, file: Path) -> bytes:
    import io

    from PIL import Image

    buffer = io.BytesIO()
    kind = {".png": "PNG", ".webp": "WEBP"}.get(file.suffix.lower(), "JPEG")
    Image.fromarray(pixels).save(buffer, format=kind, quality=92)
    return buffer.getvalue()


def _wrote(arguments: argparse.Namespace, file: Path) -> None:
    if not arguments.quiet:
        note(f"wrote {file} ({file.stat().st_size / 1e3:.0f} kB)")
