"""Picture of a robot without a browser: its visuals from a given direction, rendered by ray casting."""

from collections.abc import Mapping
from math import cos, radians, sin, tan

from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import ModelError, UsageError

MAX_PIXELS = 2_000_000
"""Maximum number of pixels of a picture."""

_FIELD_OF_VIEW = radians(40)


def robot_picture(
    robot: Robot,
    *,
    joints: Mapping[str, float] | None = None,
    azimuth: float = radians(35),
    elevation: float = radians(25),
    width: int = 800,
    height: int = 600,
) -> bytes:
    """Return a picture of a robot as PNG.

    Args:
        robot: the robot.
        joints: joint → position [rad or m]; the neutral configuration for the others.
        azimuth: direction of the camera from the robot, about z from the x axis [rad].
        elevation: angle of that direction above the horizontal plane [rad].
        width: width [px].
        height: height [px].

    Raises:
        UsageError: the size of the picture is out of range.
        ModelError: the robot has no visuals and no collisions.
        KinematicsError: unknown joint, or a position outside of its limits.
    """
    from io import BytesIO

    import numpy as np
    from PIL import Image

    from urdfkit.description.sdf.reader.load import load_world
    from urdfkit.kinematics import Kinematics
    from urdfkit.scene.camera_model import Lens
    from urdfkit.scene.extent import bounds
    from urdfkit.scene.lights import lighting_of
    from urdfkit.scene.ray_renderer import RayRenderer
    from urdfkit.scene.rays.ray_scene import RayTable
    from urdfkit.scene.scene_table import scene_of

    if not (width >= 16 and height >= 16 and width * height <= MAX_PIXELS):
        raise UsageError(
            f"a picture of {width} × {height} px is out of range; use sides of at least 16 px and at most {MAX_PIXELS} "
            "pixels in total"
        )
    kinematics = Kinematics(robot)
    poses = kinematics.link_poses(kinematics.configuration(dict(joints or {})))
    pose_of = dict(zip(kinematics.link_names, poses, strict=True))
    scene = scene_of(robot, strict=False)
    role = "visual" if scene.with_role("visual") else "collision"
    placed = [pose_of[body] for body in scene.bodies]
    box = bounds(scene, placed, role=role)  # type: ignore[arg-type]
    if box is None:
        raise ModelError(f"robot `{robot.name}` has no visual or collision shapes to show")
    table = RayTable(scene, scene.with_role(role))  # type: ignore[arg-type]
    table.place(placed)
    center, radius = box.mean(axis=0), max(float(np.linalg.norm(box[1] - box[0])) / 2.0, 1e-3)
    smallest = min(_FIELD_OF_VIEW, 2.0 * np.arctan(tan(_FIELD_OF_VIEW / 2.0) * height / width))
    away = np.array([cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)])
    frame = np.eye(4)
    frame[:3, 0] = -away
    frame[:3, 1] = [sin(azimuth), -cos(azimuth), 0.0]
    frame[:3, 2] = np.cross(frame[:3, 0], frame[:3, 1])
    frame[:3, 3] = center + away * radius / sin(smallest / 2.0)
    renderer = RayRenderer(table, lighting_of(load_world("empty")))
    picture = renderer.take(Lens(width, height, _FIELD_OF_VIEW), frame, samples=8)
    file = BytesIO()
    Image.fromarray(picture.rgb).save(file, "PNG")
    return file.getvalue()
