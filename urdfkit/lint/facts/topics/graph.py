"""The topics that the nodes, plugins, controllers and bridges of a workspace publish, after remapping.

Sources: gazebo_ros_pkgs (noetic-devel and ros2: gazebo_plugins/src), ros2_controllers (diff_drive_controller.cpp,
steering_controllers_library.cpp, tricycle_controller.cpp). The packages in `_WITHOUT_SENSORS` are not compared with
sources.
"""

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.ros_gz_bridges import bridged_topics
from urdfkit.lint.facts.control.yaml_tree import yamls
from urdfkit.lint.facts.gazebo.plugins import plugins, spec_of
from urdfkit.lint.facts.gazebo.sensor_topics import depth_clouds, published
from urdfkit.lint.facts.launch.actions import launch_files
from urdfkit.lint.facts.launch.receivers import receiver
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes
from urdfkit.lint.facts.topics.node_topics import CAMERAS, may_publish, topics_of
from urdfkit.lint.facts.topics.own_nodes import own_publications
from urdfkit.lint.facts.topics.robot_topics import last
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document

_CONTROLLERS = (
    (r"diff_drive_controller/|tricycle_controller/|four_wheel_steering_controller/", "odom", "Odometry"),
    (r"(?<!four_wheel)_steering_controller/|mecanum_drive_controller/", "odometry", "Odometry"),
    (r"imu_sensor_broadcaster/", "imu", "Imu"),
    (r"force_torque_sensor_broadcaster/", "wrench", "WrenchStamped"),
)
"""Pattern of the type of a controller → its topic and the type of the messages."""

_WITHOUT_SENSORS = """
controller_manager gazebo_ros image_proc image_transport joint_state_publisher joint_state_publisher_gui joy joy_linux
joy_teleop map_server move_base moveit_ros_move_group moveit_servo nav2_amcl nav2_behaviors nav2_bt_navigator
nav2_collision_monitor nav2_controller nav2_lifecycle_manager nav2_map_server nav2_planner nav2_recoveries nav2_smoother
nav2_velocity_smoother nav2_waypoint_follower amcl octomap_server opennav_docking robot_localization
robot_state_publisher ros_gz_bridge ros_gz_image ros_gz_sim ros_ign_bridge ros_ign_gazebo ros_ign_image rqt_graph
rqt_gui rqt_image_view rqt_robot_steering rviz rviz2 slam_toolbox teleop_twist_joy teleop_twist_keyboard tf tf2_ros
twist_mux explore_lite gmapping hector_mapping slam_gmapping
"""
"""Packages whose nodes publish no sensor messages and no odometry but those of `node_topics`."""

_INCLUDED = ("nav2_bringup", "slam_toolbox", "gazebo_ros", "ros_gz_sim", "ros_ign_gazebo")
_NAMESPACES = r"namespace\s*=|PushRos\w*Namespace|push[-_]ros[-_]namespace|<node\b[^<>]*\bns\s*="
_REMAPS = r"SetRemap\s*\(|<set_remap\b"


def published_by_type(model: Model, of_sensors_only: bool = False) -> dict[str, set[str]]:
    """Return ROS type without package → topics, without slashes at their ends."""
    found: dict[str, set[str]] = {}
    for topic, kind in (*_of_sensors(model), *(() if of_sensors_only else _of_nodes(model))):
        found.setdefault(kind, set()).add(topic)
    return found


def is_closed(model: Model, type: str) -> bool:
    """Return whether the launch files start only nodes of which the topics with messages of a type are known."""
    names = set(_WITHOUT_SENSORS.split())
    nodes = launched_nodes(model)
    open_nodes = [node for node in nodes if topics_of(node.package, node.program) is None]
    calls = [call for file in launch_files(model) for call in file.includes]
    is_listed = all(receiver(call, model) is not None or call.package in _INCLUDED for call in calls)
    cameras = {package for package in CAMERAS if not may_publish(package, type)}
    others = {node.package for node in open_nodes} - names - cameras
    if type == "Image" and (_has_camera_plugin(model) or _matches(model, _OF_IMAGES)):
        return False
    are_readable = all(own_publications(model, package) is not None for package in sorted(others))
    return bool(nodes or calls) and is_listed and are_readable


_OF_IMAGES = r"\bimage_proc\b|\bimage_transport\b|image_bridge"
_COMPONENTS = r"[Cc]omposable_?[Nn]ode|\bnodelet\b"


def starts_components(model: Model) -> bool:
    """Return whether a launch file starts components or nodelets, which `launched_nodes` does not return."""
    return _matches(model, _COMPONENTS)


def _matches(model: Model, pattern: str) -> bool:
    return any(re.search(pattern, file.source.text) for file in launch_files(model))


def _has_camera_plugin(model: Model) -> bool:
    """Return whether a plugin of Gazebo Classic publishes images, which `published` gives no type."""
    specs = (spec_of(plugin, model.target) for plugin, _, sensor in plugins(model.robot) if sensor is not None)
    return any(spec is not None and spec.generation != "gz" and re.search("camera|kinect", spec.kind) for spec in specs)


def has_namespaces(model: Model) -> bool:
    """Return whether a launch file starts nodes in a namespace, so that relative names of topics differ."""
    return _matches(model, _NAMESPACES) or any(_has_group(file.source) for file in launch_files(model))


def _has_group(source: Source) -> bool:
    """Return whether an XML launch file starts nodes in a group with a namespace, which may also be for parameters."""
    groups = [tag for tag in Document(source).walk() if tag.name == "group"] if "<group" in source.text else ()
    named = [group for group in groups if "ns" in group.attributes]
    return any(tag.name in ("node", "include") for group in named for tag in group.walk() if tag is not group)


def remaps_groups(model: Model) -> bool:
    """Return whether a launch file remaps topics of all nodes in a group."""
    return _matches(model, _REMAPS)


def remapped(node: LaunchedNode, topic: str) -> str:
    """Return the topic that a node uses instead of one of its own, without slashes at its ends."""
    names = {old.name.removeprefix("~").strip("/"): new.name for old, new in node.remappings}
    return names.get(topic, topic).strip("/")


def drive_topics(model: Model, meaning: str) -> Iterator[str]:
    """Yield the ROS topics of drives of Gazebo Classic with their namespaces, those by default too.

    Args:
        model: the linted model.
        meaning: ``command_topic`` or ``odometry_topic``.
    """
    from urdfkit.description.plugins import read

    default = {"command_topic": "cmd_vel", "odometry_topic": "odom"}[meaning]
    for plugin, _, _ in plugins(model.robot):
        spec = spec_of(plugin, model.target)
        if spec is None or not re.search(r"drive|planar_move", spec.kind) or spec.generation == "gz":
            continue
        ros = plugin.element.find("ros") if spec.generation == "ros2" else None
        texts = read(plugin, spec)
        parameter = spec.by_meaning(meaning)
        topic, space = texts.get(meaning) or default, texts.get("namespace", "")
        if spec.generation == "ros1" and parameter is None:
            continue
        for rule in (*ros.find_all("remapping"), *ros.find_all("argument")) if ros is not None else ():
            old, _, new = rule.text.partition(":=")
            topic = new.strip() if old.strip().strip("/") == default and new else topic
        if ros is not None and (written := ros.find("namespace")) is not None:
            space = written.text
        if "$" not in f"{space}{topic}":
            yield topic.strip("/") if topic.startswith("/") else f"{space.strip('/')}/{topic}".strip("/")


def _of_sensors(model: Model) -> Iterator[tuple[str, str]]:
    """Yield topic and type of the messages of sensors and bridges, and of odometry on a topic that is chosen."""
    for publication in published(model):
        if publication.type and publication.is_ros:
            yield publication.topic.strip("/"), publication.type
    for topic, kind, is_read in bridged_topics(model):
        if not is_read:
            yield topic, last(kind)
    yield from ((topic, "PointCloud2") for topic in depth_clouds(model))
    yield from ((topic, "Odometry") for topic in drive_topics(model, "odometry_topic") if topic != "odom")


def _of_nodes(model: Model) -> Iterator[tuple[str, str]]:
    """Yield topic and type of the messages of drives, controllers and nodes."""
    yield from ((topic, "Odometry") for topic in drive_topics(model, "odometry_topic"))
    for source in yamls(model):
        for one in settings(source):
            for pattern, topic, kind in _CONTROLLERS:
                if one.kind and re.search(pattern, one.kind):
                    yield f"{one.name}/{topic}", kind
    for node in launched_nodes(model):
        topics = topics_of(node.package, node.program)
        is_listed = topics is not None or node.package in _WITHOUT_SENSORS.split()
        listed = tuple(topics.published.items()) if topics is not None else ()
        for topic, kind in listed if is_listed else own_publications(model, node.package) or ():
            yield remapped(node, topic), kind
