"""``urdfkit new sensor``: add a sensor to an existing description."""

import argparse
import sys

from urdfkit.cli.new.change_workflow import add_description, apply, description, number, vector
from urdfkit.defect_message import Suggestion
from urdfkit.errors import UsageError, did_you_mean

SUMMARY = "a sensor for an existing description"
_KINDS = ("lidar", "lidar3d", "camera", "depth", "imu", "gps")
_ALIASES = {
    **dict.fromkeys(("laser", "laserscan", "hokuyo", "rplidar", "sick", "scan"), "lidar"),
    **dict.fromkeys(("velodyne", "ouster", "vlp16", "vlp-16", "pointcloud"), "lidar3d"),
    **dict.fromkeys(("webcam", "rgb", "rgb_camera", "mono"), "camera"),
    **dict.fromkeys(("realsense", "kinect", "rgbd", "depth_camera", "d435", "zed", "stereo"), "depth"),
    **dict.fromkeys(("gnss", "navsat"), "gps"),
}
"""Other names and product names → kind of sensor."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.description = "add a sensor: a macro in a separate file, one include, one call; other lines stay unchanged"
    parser.epilog = (
        "examples:\n"
        "  urdfkit new sensor lidar --into scout_description\n"
        "  urdfkit new sensor camera --into arm.urdf.xacro --parent tool0 --xyz 0.05 0 0"
    )
    parser.add_argument("sensor", nargs="?", metavar="SENSOR", help=", ".join(_KINDS))
    add_description(parser)
    parser.add_argument(
        "--name", help="name of the sensor and prefix of its links (default: the kind, such as lidar, then lidar_2 …)"
    )
    parser.add_argument(
        "--parent", metavar="LINK", help="link to mount the sensor on (default: base_link, or the heaviest link)"
    )
    parser.add_argument(
        "--xyz",
        nargs=3,
        metavar="M",
        help="position in LINK [m] (default: a free place on top, or at the front for cameras)",
    )
    parser.add_argument("--rpy", nargs=3, metavar="RAD", default=["0", "0", "0"], help="roll, pitch, yaw [rad]")
    parser.add_argument("--topic", help="topic of the sensor; for cameras, the prefix of the topics")
    parser.add_argument("--update-rate", metavar="HZ", help="measurements per second [Hz]")


def run(arguments: argparse.Namespace) -> int:
    """Load the description, add the sensor, lint, print or write the change.

    Raises:
        UrdfkitError: the sensor could not be added; nothing was written.
    """
    from urdfkit.scaffold.additions.sensor import SensorRequest, add_sensor

    if arguments.sensor is None:
        raise UsageError(f"new sensor: pass a sensor: {', '.join(_KINDS)}")
    if arguments.sensor not in _KINDS:
        called = _ALIASES.get(arguments.sensor.lower())
        near = Suggestion(called) or did_you_mean(arguments.sensor, _KINDS)
        raise UsageError(f"new sensor: unknown sensor `{arguments.sensor}`{near or '; use ' + ', '.join(_KINDS)}")
    model, robot, generation = description(arguments)
    rate = None
    if arguments.update_rate is not None:
        rate = number(arguments.update_rate, "--update-rate")
        if not 0 < rate <= 10000:
            raise UsageError(
                f"--update-rate {arguments.update_rate} is out of range: expected more than 0 and at most 10000"
            )
    request = SensorRequest(
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
