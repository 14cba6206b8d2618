"""Defects of the lines in files of messages, services and actions.

Sources: genmsg (msg_loader.py, msgs.py), rosidl_adapter (parser.py), and the messages of common_interfaces and
rcl_interfaces.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect
from urdfkit.lint.facts.ros_packages import is_slip, names
from urdfkit.lint.fix_builders import nearest

_NUMBERS = [f"{kind}{bits}" for kind in ("int", "uint") for bits in (8, 16, 32, 64)]
_BUILT_IN = {
    1: (*_NUMBERS, "bool", "float32", "float64", "string", "byte", "char", "time", "duration", "Header"),
    2: (*_NUMBERS, "bool", "float32", "float64", "string", "wstring", "byte", "char"),
}
"""Version of ROS → its types without a package."""

_RELEASED = """
std_msgs: Bool Byte Char ColorRGBA Empty Float32 Float32MultiArray Float64 Float64MultiArray Header Int16 Int32 Int64
Int8 MultiArrayDimension MultiArrayLayout String UInt16 UInt32 UInt64 UInt8 ByteMultiArray Int16MultiArray
Int32MultiArray Int64MultiArray Int8MultiArray UInt16MultiArray UInt32MultiArray UInt64MultiArray UInt8MultiArray Time
Duration; builtin_interfaces: Time Duration; geometry_msgs: Accel AccelStamped AccelWithCovariance
AccelWithCovarianceStamped Inertia InertiaStamped Point Point32 PointStamped Polygon PolygonInstance
PolygonInstanceStamped PolygonStamped Pose Pose2D PoseArray PoseStamped PoseWithCovariance PoseWithCovarianceStamped
Quaternion QuaternionStamped Transform TransformStamped Twist TwistStamped TwistWithCovariance
TwistWithCovarianceStamped Vector3 Vector3Stamped VelocityStamped Wrench WrenchStamped; nav_msgs: GridCells
MapMetaData OccupancyGrid Odometry Path Goals Trajectory TrajectoryPoint; sensor_msgs: BatteryState CameraInfo
ChannelFloat32 CompressedImage FluidPressure Illuminance Image Imu JointState Joy JoyFeedback JoyFeedbackArray
LaserEcho LaserScan MagneticField MultiDOFJointState MultiEchoLaserScan NavSatFix NavSatStatus PointCloud PointCloud2
PointField Range RegionOfInterest RelativeHumidity Temperature TimeReference; trajectory_msgs: JointTrajectory
JointTrajectoryPoint MultiDOFJointTrajectory MultiDOFJointTrajectoryPoint
"""
"""Package: names of its messages in all releases of ROS 1 and ROS 2."""

_LINE = (
    r"(?m)^[ \t]*(?P<type>(?:(?P<package>[\w-]+)/)?(?P<name>\w+)(?:<=\d+)?(?:\[[<=\d]*\])?)"
    r"[ \t]+(?P<field>\w+)(?=[ \t]*(?:=|#|$)|[ \t])"
)
_FIELD = r"(?!.*__)(?!.*_$)[a-z][a-z0-9_]*"
"""Matches the names of fields in ROS 2; without nested repetitions, which take exponential time."""

_SEPARATORS = {".msg": 0, ".srv": 1, ".action": 2}


def interface_defects(
    files: BuildFiles, texts: list[tuple[Path, str]], dependencies: set[str], version: int
) -> Iterator[BuildDefect]:
    """Yield unknown types, invalid names of fields, and missing separators in files of messages.

    Args:
        files: the build files of the package.
        texts: the files of messages, services and actions of the package, with their texts.
        dependencies: the packages in ``DEPENDENCIES``.
        version: version of ROS.
    """
    own = {path.stem for path, _ in texts if path.suffix == ".msg"}
    near = neighbours(files.folder) if texts else {}
    for path, text in texts:
        code = re.sub(r"#[^\n]*", lambda comment: " " * len(comment[0]), text)
        source = Source(shown_path(path), text)
        separators = [at.start() for at in re.finditer(r"(?m)^---[ \t]*\r?$", code)]
        expected = _SEPARATORS[path.suffix]
        if len(separators) != expected:
            at = separators[expected] if len(separators) > expected else 0
            message = f"{path.suffix} files have {expected} lines `---`, but this file has {len(separators)}"
            yield BuildDefect(source, at, text[at:].partition("\n")[0], message)
        seen: dict[str, int] = {}
        for line in re.finditer(_LINE, code):
            is_constant = re.match(r"[ \t]*=", code[line.end() :]) is not None
            yield from _type(source, line, own, near, dependencies, files, version)
            part = sum(at < line.start() for at in separators)
            field = line["field"]
            if seen.get(field) == part:
                yield BuildDefect(source, line.start("field"), field, f"second field `{field}`")
            seen[field] = part
            if version == 2 and not is_constant and not re.fullmatch(_FIELD, field):
                lower = re.sub(r"(?<=[a-z0-9])([A-Z])", r"_\1", field).lower().replace("__", "_").strip("_")
                message = f"invalid name `{field}` of a field; ROS 2 needs lower case" + Suggestion(lower, field)
                yield BuildDefect(source, line.start("field"), field, message)


def _type(
    source: Source,
    line: re.Match[str],
    own: set[str],
    near: Mapping[str, Path],
    dependencies: set[str],
    files: BuildFiles,
    version: int,
) -> Iterator[BuildDefect]:
    """Yield the defect of a type."""
    package, name = line["package"], line["name"]
    at = line.start("name")
    if package is None:
        if name in own or name in _BUILT_IN[version]:
            return
        holder = next((key for key, messages in _messages().items() if name in messages), None)
        if name == "Header" or holder is not None:
            yield BuildDefect(source, at, name, f"type `{name}` has no package" + Suggestion(f"{holder}/{name}", name))
            return
        candidates = [*own, *_BUILT_IN[version]]
        meant = next((each for each in candidates if is_slip(name, each)), nearest(name, candidates, cutoff=0.7))
        yield BuildDefect(source, at, name, f"unknown type `{name}`" + Suggestion(meant, name))
        return
    folder = near.get(package)
    if package not in dependencies and package not in near and package not in names():
        meant = next((each for each in (*dependencies, files.name) if is_slip(package, each)), None)
        if meant is not None:
            message = f"unknown package `{package}`" + Suggestion(meant, package)
            yield BuildDefect(source, line.start("package"), package, message)
        return
    if package == files.name:
        messages = own
    elif folder is not None:
        messages = {path.stem for path in (folder / "msg").glob("*.msg")}
        if not messages or is_file(folder / "msg" / f"{name}.idl"):
            return
    else:
        messages = set(_messages().get(package, ()))
    if messages and name not in messages:
        meant = next((each for each in sorted(messages) if is_slip(name, each)), None)
        if meant is not None or package == files.name or folder is not None:
            message = f"package `{package}` has no message `{name}`" + Suggestion(meant, name)
            yield BuildDefect(source, at, name, message)


def _messages() -> dict[str, list[str]]:
    entries = (entry.partition(":") for entry in _RELEASED.split(";"))
    return {package.strip(): words.split() for package, _, words in entries}
