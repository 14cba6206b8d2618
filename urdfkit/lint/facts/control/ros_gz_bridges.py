"""ros_gz_bridge: message type pairs, and the bridges configured in launch files and YAML."""

import re
from collections.abc import Iterator, Sequence

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launched_nodes import started
from urdfkit.lint.facts.control.yaml_tree import Node, documents, span_of, yamls
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_PAIRS = """
actuator_msgs/Actuators=Actuators builtin_interfaces/Time=Time geometry_msgs/Point=Vector3d geometry_msgs/Pose=Pose
geometry_msgs/PoseArray=Pose_V geometry_msgs/PoseStamped=Pose geometry_msgs/PoseWithCovariance=PoseWithCovariance
geometry_msgs/PoseWithCovarianceStamped=PoseWithCovariance geometry_msgs/Quaternion=Quaternion
geometry_msgs/Transform=Pose geometry_msgs/TransformStamped=Pose geometry_msgs/Twist=Twist
geometry_msgs/TwistStamped=Twist geometry_msgs/TwistWithCovariance=TwistWithCovariance
geometry_msgs/TwistWithCovarianceStamped=TwistWithCovariance geometry_msgs/Vector3=Vector3d geometry_msgs/Wrench=Wrench
geometry_msgs/WrenchStamped=Wrench gps_msgs/GPSFix=NavSat nav_msgs/Odometry=Odometry,OdometryWithCovariance
rcl_interfaces/ParameterValue=Any ros_gz_interfaces/Altimeter=Altimeter ros_gz_interfaces/Contact=Contact
ros_gz_interfaces/Contacts=Contacts ros_gz_interfaces/Dataframe=Dataframe ros_gz_interfaces/Entity=Entity
ros_gz_interfaces/EntityWrench=EntityWrench ros_gz_interfaces/Float32Array=Float_V
ros_gz_interfaces/GuiCamera=GUICamera ros_gz_interfaces/JointWrench=JointWrench ros_gz_interfaces/Light=Light
ros_gz_interfaces/ParamVec=Param,Param_V ros_gz_interfaces/SensorNoise=SensorNoise
ros_gz_interfaces/StringVec=StringMsg_V ros_gz_interfaces/TrackVisual=TrackVisual
ros_gz_interfaces/VideoRecord=VideoRecord ros_gz_interfaces/MaterialColor=MaterialColor
ros_gz_interfaces/WorldStatistics=WorldStatistics ros_gz_interfaces/LogicalCameraImage=LogicalCameraImage
rosgraph_msgs/Clock=Clock
sensor_msgs/BatteryState=BatteryState sensor_msgs/CameraInfo=CameraInfo sensor_msgs/FluidPressure=FluidPressure
sensor_msgs/Image=Image sensor_msgs/Imu=IMU sensor_msgs/JointState=Model sensor_msgs/Joy=Joy
sensor_msgs/LaserScan=LaserScan sensor_msgs/MagneticField=Magnetometer sensor_msgs/NavSatFix=NavSat
sensor_msgs/PointCloud2=PointCloudPacked sensor_msgs/Range=LaserScan marine_acoustic_msgs/Dvl=DVLVelocityTracking
std_msgs/Bool=Boolean std_msgs/ColorRGBA=Color std_msgs/Empty=Empty std_msgs/Float32=Float std_msgs/Float64=Double
std_msgs/Header=Header std_msgs/Int32=Int32 std_msgs/String=StringMsg std_msgs/UInt32=UInt32 tf2_msgs/TFMessage=Pose_V
trajectory_msgs/JointTrajectory=JointTrajectory vision_msgs/Detection2D=AnnotatedAxisAligned2DBox
vision_msgs/Detection2DArray=AnnotatedAxisAligned2DBox_V vision_msgs/Detection3D=AnnotatedOriented3DBox
vision_msgs/Detection3DArray=AnnotatedOriented3DBox_V
"""

KEYS = (
    *("topic_name", "ros_topic_name", "gz_topic_name", "ros_type_name", "gz_type_name", "subscriber_queue"),
    *("publisher_queue", "lazy", "direction", "service_name", "gz_req_type_name", "gz_rep_type_name", "qos_profile"),
    *("ign_topic_name", "ign_type_name"),
)
REQUIRED = {
    "ros_type_name": ("service_name",),
    "gz_type_name": ("ign_type_name", "service_name"),
    "ros_topic_name": ("topic_name", "gz_topic_name", "ign_topic_name", "service_name"),
}
"""Required key → keys that stand for it."""

_OF_IMAGES = ("sensor_msgs/msg/Image", "gz.msgs.Image", "GZ_TO_ROS")
"""Types and direction of the topics of image_bridge (ros_gz_image, README)."""

_ARGUMENT = r"([^@\s]+)@([\w/.]+)([@\[\]])([\w.:/]+)"
"""Matches an argument of parameter_bridge: topic, ROS type, direction and Gazebo type."""

DIRECTIONS = ("BIDIRECTIONAL", "GZ_TO_ROS", "ROS_TO_GZ", "IGN_TO_ROS", "ROS_TO_IGN")
"""Directions in the YAML files of ros_gz_bridge (Humble to Rolling)."""


def pairs() -> dict[str, tuple[str, ...]]:
    """Return ROS message type → Gazebo message types that the bridge converts it to (README of ros_gz_bridge)."""
    found = {}
    for word in _PAIRS.split():
        ros, _, gazebo = word.partition("=")
        found["/msg/".join(ros.split("/"))] = tuple(f"gz.msgs.{name}" for name in gazebo.split(","))
    return found


@record(eq=False)
class Bridged:
    """One bridged topic.

    Attributes:
        topic: name of the Gazebo topic; None if it is not written.
        ros: ROS message type.
        gazebo: Gazebo message type.
        direction: one of `DIRECTIONS`, or the source text.
        published: name of the ROS topic; None if it is that of Gazebo.
    """

    topic: Named | None
    ros: Named | None
    gazebo: Named | None
    direction: Named | None
    published: Named | None = None


def in_yaml(source: Source) -> Iterator[tuple[Bridged, tuple[Node, ...]]]:
    """Yield the bridges in a YAML file, each with its key nodes."""

    def named(entry: Node, *keys: str) -> Named | None:
        node = next((node for key in keys if (node := entry.find(key)) is not None), None)
        if node is None or not node.text or "$" in node.text:
            return None
        span = span_of(source, node)
        return Named(node.text, source.offset(span.line, span.column))

    roots = documents(source)
    for entry in (item for root in roots for item in root.items):
        keys = tuple(key for key, _ in entry.entries)
        if any(key.text in ("ros_type_name", "gz_type_name", "gz_topic_name", "ign_type_name") for key in keys):
            topic = named(entry, "gz_topic_name", "ign_topic_name", "topic_name", "ros_topic_name")
            types = named(entry, "ros_type_name"), named(entry, "gz_type_name", "ign_type_name")
            yield Bridged(topic, *types, named(entry, "direction"), named(entry, "ros_topic_name")), keys


def bridged_topics(model: Model) -> Iterator[tuple[str, str, bool]]:
    """Yield the ROS topic of each bridge without slashes at its ends, its ROS type and whether Gazebo reads it."""
    from urdfkit.description.packages.related_files import LAUNCH

    for source in yamls(model):
        for entry in (item for root in documents(source) for item in root.items):
            keys = ("ros_topic_name", "topic_name", "gz_topic_name", "ign_topic_name")
            topic = next((node for key in keys if (node := entry.find(key)) is not None), None)
            kind, direction = entry.find("ros_type_name"), entry.find("direction")
            if topic is not None and kind is not None:
                is_read = direction is None or not direction.text.endswith("_TO_ROS")
                yield topic.text.strip("/"), kind.text, is_read
    for name, source in model.related_files.items():
        for bridge in in_launch(source) if name.endswith(LAUNCH) and "_bridge" in source.text else ():
            if bridge.topic is not None and bridge.ros is not None and bridge.direction is not None:
                yield bridge.topic.name.strip("/"), bridge.ros.name, bridge.direction.name != "GZ_TO_ROS"


def malformed_in_launch(source: Source) -> Iterator[Named]:
    """Yield the arguments of a bridge that have a ROS message type but no Gazebo type."""
    for node in started(source):
        for word in node.arguments if node.program == "parameter_bridge" else ():
            if word is not None and re.fullmatch(r"[^@\s]+@\w+/msg/\w+", word.name):
                yield word


def in_launch(source: Source) -> Iterator[Bridged]:
    """Yield the bridges in the node arguments of a launch file: ``topic@ros_type[gz_type``, or topics of images."""
    for node in started(source):
        if node.program not in ("parameter_bridge", "image_bridge"):
            continue
        for word in node.arguments:
            if node.program == "image_bridge":
                if word is not None and re.fullmatch(r"/?[\w/]+", word.name):
                    yield Bridged(word, *(Named(name, word.start) for name in _OF_IMAGES))
                continue
            at = re.fullmatch(_ARGUMENT, word.name) if word is not None else None
            if word is None or at is None:
                continue
            yield _bridged(at, [word.start + index for index in range(len(word.name) + 1)])
        for text, offsets in node.computed:
            if (at := re.fullmatch(_ARGUMENT, text)) is not None:
                yield _bridged(at, offsets)


def _bridged(at: re.Match[str], offsets: Sequence[int]) -> Bridged:
    # A topic such as `/{name}` begins before the constant that names it.
    topic, ros, way, gazebo = (
        Named(at[group], offsets[at.end(group) - 1] + 1 - len(at[group])) for group in (1, 2, 3, 4)
    )
    direction = {"[": "GZ_TO_ROS", "]": "ROS_TO_GZ"}.get(way.name, "BIDIRECTIONAL")
    return Bridged(topic, ros, gazebo, Named(direction, way.start, way.end))
