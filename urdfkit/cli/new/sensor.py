"""``urdfkit new sensor``: add a sensor to a description that is there."""

from __future__ import annotations

import argparse
import sys

from urdfkit.cli.new.description_changes import add_description, apply, description, number, vector
from urdfkit.errors import UsageError, did_you_mean

SUMMARY = "a sensor, added to a description that is there"
_KINDS = ("lidar", "lidar3d", "camera", "depth", "imu", "gps")
_CALLED = {
    **dict.fromkeys(("laser", "laserscan", "hokuyo", "rplidar", "sick", "scan"), "lidar"),
    **dict.fromkeys(("velodyne", "ouster", "vlp16", "vlp-16", "pointcloud"), "lidar3d"),
    **dict.fromkeys(("webcam", "rgb", "rgb_camera", "mono"), "camera"),
    **dict.fromkeys(("realsense", "kinect", "rgbd", "depth_camera", "d435", "zed", "stereo"), "depth"),
    **dict.fromkeys(("gnss", "navsat"), "gps"),
}
"""What some call them, makers included."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.description = "Add a sensor: a macro in a file of its own, one include, one call; nothing else is touched."
    parser.epilog = (
        "examples:\n"
        "  urdfkit new sensor lidar --into scout_description\n"
        "  urdfkit new sensor camera --into urdf/arm.urdf.xacro --name wrist --parent tool0 --xyz 0.05 0 0 --diff"
    )
    parser.add_argument("sensor", nargs="?", metavar="SENSOR", help=", ".join(_KINDS))
    add_description(parser)
    parser.add_argument(
        "--name", help="of the sensor; its links begin with it (default: the kind, with a number from the second on)"
    )
    parser.add_argument("--parent", metavar="LINK", help="it is mounted on (default: base_link, or the heaviest)")
    parser.add_argument(
        "--xyz",
        nargs=3,
        metavar="M",
        help="where, in LINK [m] (default: on top, cameras at the front, where nothing else is)",
    )
    parser.add_argument("--rpy", nargs=3, metavar="RAD", default=["0", "0", "0"], help="roll, pitch, yaw [rad]")
    parser.add_argument("--topic", help="where it publishes; of cameras, what its topics begin with")
    parser.add_argument("--update-rate", metavar="HZ", help="measurements per second")


def run(arguments: argparse.Namespace) -> int:
    """Load, add, lint, show or write.

    Raises:
        UrdfkitError: it could not be done; nothing was written then.
    """
    from urdfkit.scaffold.additions.sensor import Request, add_sensor

    if arguments.sensor is None:
        raise UsageError(f"new sensor: the following arguments are required: SENSOR ({', '.join(_KINDS)})")
    if arguments.sensor not in _KINDS:
        called = _CALLED.get(arguments.sensor.lower())
        near = f"; the nearest is `{called}`" if called else did_you_mean(arguments.sensor, _KINDS)
        raise UsageError(f"new sensor: there is no `{arguments.sensor}`{near}; there is: {', '.join(_KINDS)}")
    model, robot, generation = description(arguments)
    rate = None
    if arguments.update_rate is not None:
        rate = number(arguments.update_rate, "--update-rate")
        if not 0 < rate <= 10000:
            raise UsageError(
                f"--update-rate {arguments.update_rate} is out of range: more than 0, up to 10000 per second"
            )
    request = Request(
        arguments.sensor,
        arguments.name,
        arguments.parent,
        None if arguments.xyz is None else vector(arguments.xyz, "--xyz"),
        vector(arguments.rpy, "--rpy"),
        arguments.topic,
        rate,
    )
    alterations, notes = add_sensor(robot, model.path, request, generation=generation)
    for note in () if arguments.quiet else notes:
        print(f"urdfkit: {note}", file=sys.stderr)
    return apply(alterations, model, arguments)
