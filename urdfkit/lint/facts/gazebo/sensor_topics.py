"""Topics that sensors publish on: topics in the description, else the defaults of the plugins."""

from collections.abc import Iterator

from urdfkit.description.plugins import PluginSpec
from urdfkit.description.urdf.robot import Plugin, SensorTag
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.gazebo.plugins import plugins, spec_of
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_TOPICS = ("topic", "image_topic", "depth_topic", "cloud_topic")
"""Meanings of ROS 1 plugin parameters that name a topic; camera_info accompanies the image."""

_ROS_2 = {
    "ray_sensor": ("~/out",),
    "velodyne": ("~/out",),
    "imu_sensor": ("~/out",),
    "gps": ("~/out",),
    "camera": ("{camera}/image_raw",),
}
"""Kind of a ROS 2 plugin → its default topics before remapping."""

_SHARED = frozenset(("range", "hector_sonar", "sonar", "bumper"))
"""Kinds whose messages identify the sensor by frame; several sensors often share a topic."""

_GZ = {
    "rgbd": ("/image", "/depth_image", "/points"),
    "rgbd_camera": ("/image", "/depth_image", "/points"),
    "depth": ("", "/points"),
    "depth_camera": ("", "/points"),
    "gpu_lidar": ("", "/points"),
    "gpu_ray": ("", "/points"),
    "lidar": ("", "/points"),
    "ray": ("", "/points"),
}
"""Sensor type of gz sim → suffixes of its topics (gz-sensors)."""

_TYPES = {
    **dict.fromkeys(("gpu_lidar", "gpu_ray", "lidar", "ray"), "LaserScan"),
    **dict.fromkeys(("camera", "depth", "depth_camera", "rgbd", "rgbd_camera"), "Image"),
    "imu": "IMU",
    "magnetometer": "Magnetometer",
    "navsat": "NavSat",
}
"""Sensor type of gz sim → type of its messages."""

_ROS_TYPES = {
    "laser": "LaserScan",
    **dict.fromkeys(("imu", "imu_sensor", "hector_imu"), "Imu"),
    **dict.fromkeys(("gps", "hector_gps"), "NavSatFix"),
}
"""Kind of a plugin of Gazebo Classic → ROS type of its messages."""

_OF_MEANINGS = {"cloud_topic": "PointCloud2"}
"""Meaning of a parameter in ROS 1 → ROS type of the messages."""


@record(eq=False)
class Published:
    """A topic and its publisher.

    Attributes:
        topic: name of the topic with its namespace.
        name: name of the sensor or plugin.
        key: identity of the sensor; duplicates of one sensor have the same key and are reported separately.
        element: the element that names the topic; the plugin or sensor for a default topic.
        type: type of the message without its package, in Gazebo for gz sim, else in ROS; empty if unknown.
        is_ros: whether the topic is in ROS; gz sim needs a bridge.
    """

    topic: str
    name: str
    key: tuple[str, str]
    element: Element
    type: str = ""
    is_ros: bool = True


def published(model: Model) -> Iterator[Published]:
    """Yield the topics of the robot's sensors; sensors without a Gazebo Classic plugin publish as in gz sim."""
    classic: set[int] = set()
    for plugin, block, sensor in plugins(model.robot):
        spec = spec_of(plugin, model.target)
        if sensor is not None and (plugin.filename or "").strip():
            classic.add(id(sensor))
        if spec is None or spec.generation == "gz" or spec.kind in _SHARED:
            continue
        name = (sensor.name if sensor is not None else None) or plugin.name or ""
        key = (block.reference or "", name)
        is_ros1 = spec.generation == "ros1"
        found = _of_ros_1(plugin, spec) if is_ros1 else (("", *each) for each in _of_ros_2(plugin, spec, sensor))
        for meaning, topic, element in found:
            if not model.is_unresolved(element) and "$" not in topic:
                kind = _OF_MEANINGS.get(meaning) or _ROS_TYPES.get(spec.kind, "")
                kind = _of_rays(plugin) if spec.kind == "ray_sensor" else kind
                yield Published(topic, name, key, element, kind)
    for block in model.robot.gazebo:
        for sensor in block.sensors:
            written = sensor.element.find("topic")
            if written is None or not written.text or "$" in written.text or id(sensor) in classic:
                continue
            for behind in _GZ.get(sensor.type or "", ("",)):
                topic = f"/{written.text.strip('/')}{behind}"
                kind = "PointCloudPacked" if behind == "/points" else _TYPES.get((sensor.type or "").strip(), "")
                key = (block.reference or "", sensor.name or "")
                yield Published(topic, sensor.name or "", key, written, kind, False)


def depth_clouds(model: Model) -> Iterator[str]:
    """Yield the topics of point clouds of depth cameras of Gazebo Classic in ROS 2, without slashes at their ends."""
    for plugin, _, sensor in plugins(model.robot):
        spec = spec_of(plugin, model.target)
        if spec is not None and spec.generation == "ros2" and spec.kind == "camera" and sensor is not None:
            for topic, _ in _of_ros_2(plugin, spec, sensor) if sensor.type == "depth" else ():
                if topic.endswith("/image_raw") and "$" not in topic:
                    yield topic.strip("/").removesuffix("image_raw") + "points"


def _of_ros_1(plugin: Plugin, spec: PluginSpec) -> Iterator[tuple[str, str, Element]]:
    """Yield meaning of the parameter, topic and element."""
    from urdfkit.description.plugins import read

    texts = read(plugin, spec)
    for meaning in _TOPICS:
        parameter = spec.by_meaning(meaning)
        if parameter is not None and meaning in texts:
            below = (texts.get("namespace", ""), texts.get("camera", ""))
            yield meaning, _absolute(texts[meaning], *below), plugin.element.find(parameter.tag) or plugin.element


def _of_ros_2(plugin: Plugin, spec: PluginSpec, sensor: SensorTag | None) -> Iterator[tuple[str, Element]]:
    written = plugin.element.find("camera_name")
    camera = written.text if written is not None else (sensor.name if sensor is not None else "") or ""
    kind = plugin.element.find("output_type")
    if kind is not None and kind.text.endswith("Range"):
        return
    ros = plugin.element.find("ros")
    space = ros.find("namespace") if ros is not None else None
    namespace = space.text if space is not None else ""
    for default in _ROS_2.get(spec.kind, ()):
        own = default.format(camera=camera).replace("~", plugin.name or "")
        topic, element = own, plugin.element
        for rule in (*ros.find_all("remapping"), *ros.find_all("argument")) if ros is not None else ():
            old, _, new = rule.text.partition(":=")
            if old.strip().replace("~", plugin.name or "").rpartition("/")[2] == own.rpartition("/")[2] and new:
                topic, element = new.strip().replace("~", plugin.name or ""), rule
        yield _absolute(topic, namespace), element


def _of_rays(plugin: Plugin) -> str:
    """Return the type of the messages of libgazebo_ros_ray_sensor.so (gazebo_ros_pkgs, gazebo_ros_ray_sensor.cpp)."""
    written = plugin.element.find("output_type")
    return "PointCloud2" if written is None else written.text.strip().rpartition("/")[2]


def _absolute(topic: str, *below: str) -> str:
    if topic.startswith("/"):
        return f"/{topic.strip('/')}"
    return "/" + "/".join(part.strip("/") for part in (*below, topic) if part.strip("/"))
