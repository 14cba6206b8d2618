"""Executables of packages: of those next to the robot's package from their build files, and of released packages."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import launch_reader, parsed
from urdfkit.description.packages.related_files import manifest
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.record import record

_RELEASED = """
robot_state_publisher: robot_state_publisher; joint_state_publisher: joint_state_publisher;
joint_state_publisher_gui: joint_state_publisher_gui; rviz: rviz; rviz2: rviz2; rqt_gui: rqt_gui; rqt_graph:
rqt_graph; controller_manager: spawner spawner.py unspawner unspawner.py hardware_spawner hardware_spawner.py
ros2_control_node controller_manager controller_group; gazebo_ros: gazebo gzserver gzclient spawn_model
spawn_entity.py debug perf gdbrun urdf2gazebo libcommon.sh; ros_gz_sim: create remove gzserver set_entity_pose
delete_entity spawn_entity gz_simulation_interfaces; ros_ign_gazebo: create; ros_gz_bridge: parameter_bridge
static_bridge bridge_node ros_gz_bridge; ros_ign_bridge: parameter_bridge static_bridge; ros_gz_image: image_bridge;
ros_ign_image: image_bridge; tf: static_transform_publisher tf_echo tf_monitor view_frames tf_change_notifier
tf_empty_listener transform_listener; tf2_ros: static_transform_publisher buffer_server tf2_echo tf2_monitor tf2_py;
xacro: xacro xacro.py; moveit_ros_move_group: move_group list_move_group_capabilities; moveit_servo: servo_node
servo_node_main servo_server pose_tracking_example demo_pose demo_twist demo_joint_jog; moveit_ros_warehouse:
moveit_warehouse_services moveit_init_demo_warehouse moveit_save_to_warehouse mongo_wrapper_ros.py; joy: joy_node
game_controller_node joy_enumerate_devices; teleop_twist_joy: teleop_node; teleop_twist_keyboard:
teleop_twist_keyboard teleop_twist_keyboard.py; key_teleop: key_teleop.py key_teleop; twist_mux: twist_mux
twist_marker joystick_relay.py joystick_relay; twist_stamper: twist_stamper; robot_localization: ekf_node ukf_node
navsat_transform_node robot_localization_listener_node ekf_localization_node ukf_localization_node; slam_toolbox:
async_slam_toolbox_node sync_slam_toolbox_node lifelong_slam_toolbox_node localization_slam_toolbox_node
map_and_localization_slam_toolbox_node merge_maps_kinematic decentralized_multirobot_slam_toolbox_node; nav2_amcl:
amcl; nav2_map_server: map_server map_saver_cli map_saver_server costmap_filter_info_server; nav2_planner:
planner_server; nav2_controller: controller_server; nav2_bt_navigator: bt_navigator; nav2_behaviors: behavior_server;
nav2_recoveries: recoveries_server; nav2_smoother: smoother_server; nav2_lifecycle_manager: lifecycle_manager;
nav2_waypoint_follower: waypoint_follower; nav2_velocity_smoother: velocity_smoother; nav2_collision_monitor:
collision_monitor collision_detector; nav2_costmap_2d: nav2_costmap_2d nav2_costmap_2d_markers nav2_costmap_2d_cloud;
cartographer_ros: cartographer_node cartographer_occupancy_grid_node occupancy_grid_node cartographer_offline_node
cartographer_assets_writer cartographer_pbstream_map_publisher cartographer_rosbag_validate; map_server: map_server
map_saver crop_map;
octomap_server: octomap_color_server_node octomap_server_node color_octomap_server_node octomap_saver_node
octomap_saver octomap_server_static octomap_server_static_node octomap_server_multilayer octomap_server_multilayer_node
tracking_octomap_server_node octomap_tracking_server_node octomap_eraser_cli.py;
rclcpp_components: component_container component_container_mt component_container_isolated
component_container_event; nodelet: nodelet list_nodelets declared_nodelets;
amcl: amcl; move_base: move_base; gmapping: slam_gmapping;
hector_mapping: hector_mapping;
topic_tools: relay mux throttle drop transform relay_field switch_mux mux_add mux_delete mux_list mux_select demux
delay; rosbag: record play rosbag; image_transport: republish list_transports; image_view: image_view image_saver
stereo_view video_recorder extract_images disparity_view; usb_cam: usb_cam_node usb_cam_node_exe; v4l2_camera:
v4l2_camera_node; depthimage_to_laserscan: depthimage_to_laserscan depthimage_to_laserscan_node;
pointcloud_to_laserscan: pointcloud_to_laserscan_node laserscan_to_pointcloud_node;
imu_filter_madgwick: imu_filter_node imu_filter_madgwick_node;
nmea_navsat_driver: nmea_serial_driver nmea_socket_driver nmea_topic_driver nmea_topic_serial_reader; sllidar_ros2:
sllidar_node sllidar_client; rplidar_ros: rplidar_node rplidar_composition rplidarNode rplidarNodeClient; urg_node:
urg_node_driver urg_node getID set_urg_configuration; velodyne_driver: velodyne_driver_node velodyne_node;
realsense2_camera: realsense2_camera_node; phidgets_spatial: phidgets_spatial_node; rosserial_python: serial_node.py
message_info_service.py; apriltag_ros: apriltag_node apriltag_ros_continuous_node apriltag_ros_single_image_server_node;
laser_filters: scan_to_cloud_filter_chain scan_to_scan_filter_chain generic_laser_filter_node;
"""
"""Package: executables; of Noetic, Humble, Jazzy and Rolling (their CMakeLists.txt and setup.py).

Those of rplidar_ros, sllidar_ros2, urg_node, velodyne_driver, phidgets_spatial and apriltag_ros are not compared with
these files; only similar names are reported.
"""

_COMPONENTS = """
depth_image_proc: ConvertMetricNode CropForemostNode DisparityNode PointCloudXyzNode PointCloudXyzRadialNode
PointCloudXyziNode PointCloudXyziRadialNode PointCloudXyzrgbNode PointCloudXyzrgbRadialNode RegisterNode; image_proc:
CropDecimateNode CropNonZeroNode DebayerNode RectifyNode ResizeNode TrackMarkerNode; stereo_image_proc: DisparityNode
PointCloudNode; depthimage_to_laserscan: DepthImageToLaserScanROS; pointcloud_to_laserscan: PointCloudToLaserScanNode
LaserScanToPointCloudNode; realsense2_camera: RealSenseNodeFactory; usb_cam: UsbCamNode; v4l2_camera: V4L2Camera; joy:
Joy GameController; teleop_twist_joy: TeleopTwistJoy; robot_state_publisher: RobotStatePublisher; nav2_amcl: AmclNode;
nav2_controller: ControllerServer; nav2_planner: PlannerServer; nav2_smoother: SmootherServer; nav2_bt_navigator:
BtNavigator; nav2_waypoint_follower: WaypointFollower; nav2_velocity_smoother: VelocitySmoother; nav2_lifecycle_manager:
LifecycleManager; nav2_map_server: MapServer MapSaver CostmapFilterInfoServer VectorObjectServer;
nav2_collision_monitor: CollisionMonitor CollisionDetector
"""
"""Package: classes of its components in ROS 2, in the namespace of the package (Humble to Rolling).

Other releases and copies of these packages have further components, so only similar names are reported.
"""

_ONLY_IN = {
    1: """controller_manager: controller_manager controller_group; xacro:
    xacro.py; gazebo_ros: gazebo spawn_model debug perf gdbrun urdf2gazebo libcommon.sh; teleop_twist_keyboard:
    teleop_twist_keyboard.py; robot_localization: ekf_localization_node ukf_localization_node; imu_filter_madgwick:
    imu_filter_node; usb_cam: usb_cam_node; rplidar_ros: rplidarNode rplidarNodeClient""",
    2: """controller_manager: ros2_control_node hardware_spawner spawner.py unspawner.py hardware_spawner.py;
    gazebo_ros: spawn_entity.py; robot_localization: ekf_node ukf_node
    robot_localization_listener_node; teleop_twist_keyboard: teleop_twist_keyboard;
    imu_filter_madgwick: imu_filter_madgwick_node; usb_cam: usb_cam_node_exe; rplidar_ros: rplidar_node
    rplidar_composition""",
}
"""Version of ROS → executables that no release of the other version has."""

_UNTIL_GALACTIC = "controller_manager: spawner.py unspawner.py hardware_spawner.py"
_SINCE_HUMBLE = (
    *("gz_ros2_control", "ros_gz_sim", "ros_gz_bridge", "moveit_configs_utils", "admittance_controller"),
    *("nav2_behaviors", "nav2_smoother", "nav2_velocity_smoother", "nav2_collision_monitor"),
)
"""Packages that no release before Humble has."""

_REPLACED = {"nav2_recoveries": ("nav2_behaviors", "behavior_server")}
"""Package until Galactic → its replacement since Humble, and a name that only the replacement has."""

_COMPLETE = frozenset(
    (
        *(
            "amcl",
            "move_base",
            "joint_state_publisher_gui",
            "nav2_amcl",
            "nav2_behaviors",
            "nav2_bt_navigator",
            "nav2_controller",
        ),
        *(
            "nav2_lifecycle_manager",
            "nav2_planner",
            "nav2_smoother",
            "nav2_velocity_smoother",
            "nav2_waypoint_follower",
        ),
        *("imu_filter_madgwick", "robot_localization", "ros_gz_bridge", "ros_ign_bridge", "slam_toolbox", "twist_mux"),
        *("rviz", "rviz2", "ros_gz_image", "ros_ign_image", "teleop_twist_joy", "teleop_twist_keyboard"),
    )
)
"""Packages of the table whose executables are the same in all releases."""

_LITERAL = r"\b(?:add_executable|ament_auto_add_executable|catkin_add_executable)\s*\(\s*([^\s()]+)"
_ENTRY_POINT = r"(?m)[\"']?\b([\w.-]+)\s*=\s*[\w.]+:\w+"
_MAX_FILES = 3_000


@record(eq=False)
class Executables:
    """The executables of a package.

    Attributes:
        names: names from its build files, or of a released package.
        words: further words in its build files, and names of its files, that may be executables.
        is_complete: whether no other executable can exist.
    """

    names: tuple[str, ...]
    words: frozenset[str]
    is_complete: bool


@cache
def released() -> Mapping[str, Executables]:
    """Return package → the executables of common released packages; others may exist in other releases."""
    table = _names(_RELEASED).items()
    return {name: Executables(tuple(names), frozenset(), name in _COMPLETE) for name, names in table}


@cache
def package_of(program: str, other: str) -> str | None:
    """Return the released package, of the family of another one, that has an executable; None if several have it."""
    found = [name for name, executables in released().items() if program in executables.names]
    family = [name for name in found if name.partition("_")[0] == other.partition("_")[0]]
    return (family or found)[0] if len(family or found) == 1 else None


def replacement_of(package: str, texts: Iterable[str]) -> str | None:
    """Return the package that replaces one of an old release in a workspace for a newer one; None if none does."""
    new, word = _REPLACED.get(package, (None, ""))
    return new if new is not None and any(word in text for text in texts) else None


def is_of_other_release(package: str, program: str, version: int, texts: Iterable[str]) -> bool:
    """Return whether only releases that a workspace cannot use have an executable of a released package.

    Args:
        package: a released package.
        program: one of its executables in any release.
        version: version of ROS that reads the launch file; 0 if it is unknown.
        texts: texts of files of the workspace, which can name packages of Humble and later.
    """
    if version and program in _names(_ONLY_IN[3 - version]).get(package, ()):
        return True
    is_old = version == 2 and program in _names(_UNTIL_GALACTIC).get(package, ())
    return is_old and any(name in text for text in texts for name in _SINCE_HUMBLE)


def wrong_components(source: Source) -> Iterator[tuple[Named, str]]:
    """Yield the plugins of components that their released packages do not have, with the message."""
    from urdfkit.lint.fix_builders import nearest

    table = _names(_COMPONENTS) if "plugin" in source.text else {}
    for package, plugin in (
        (_in_python(source) if source.file.endswith(".py") else _in_elements(source)) if table else ()
    ):
        names = [f"{package}::{name}" for name in table.get(package, ())]
        if names and plugin.name not in names and re.fullmatch(r"[\w:/]+", plugin.name):
            lower = {re.sub(r"[\W_]|Node$", "", name).lower(): name for name in names}
            near = lower.get(re.sub(r"[\W_]|Node$", "", plugin.name).lower())
            # Compared without the package, which makes all names similar. Other releases can have further components.
            kinds = {name.rpartition(":")[2]: name for name in names}
            near = near or kinds.get(nearest(re.split("[:/]", plugin.name)[-1], kinds, cutoff=0.8) or "")
            if near is not None:
                yield plugin, f"package `{package}` has no component `{plugin.name}`" + Suggestion(near, plugin.name)


def _in_elements(source: Source) -> Iterator[tuple[str, Named]]:
    for element in all_elements(source):
        at = element.attributes
        if element.tag == "composable_node" and {"pkg", "plugin"} <= at.keys():
            yield at["pkg"].name, at["plugin"]


def _in_python(source: Source) -> Iterator[tuple[str, Named]]:
    import ast

    tree = parsed(source)
    reader = launch_reader(tree) if tree is not None else None
    for call in ast.walk(tree) if tree is not None else ():
        words = {word.arg: word.value for word in call.keywords} if isinstance(call, ast.Call) else {}
        if reader is None or not {"package", "plugin"} <= words.keys():
            continue
        package, plugin = (reader.text(words[key]) for key in ("package", "plugin"))
        if package is not None and plugin is not None and isinstance(words["plugin"], ast.Constant):
            yield package, Named(plugin, place(source, words["plugin"])[0] + 1)


@cache
def _names(table: str) -> dict[str, list[str]]:
    pairs = (entry.partition(":") for entry in table.strip(";\n").split(";"))
    return {name.strip(): names.split() for name, _, names in pairs}


def executables_of(package: Path, name: str) -> Executables | None:
    """Return the executables of a package in source form; None if it has no build files."""
    texts = []
    for file in filter(Path.is_file, (package / part for part in ("CMakeLists.txt", "setup.py", "setup.cfg"))):
        try:
            texts.append(re.sub(r"#.*", "", file.read_text("utf-8", "replace")))
        except OSError:
            continue
    if not texts:
        return None
    text = re.sub(r"\$\{(?:PROJECT_NAME|CMAKE_PROJECT_NAME)\}", name, "\n".join(texts))
    targets = re.findall(_LITERAL, text)
    scripts = [word.rpartition("/")[2] for word in re.findall(r"(?<![\w./-])[\w./-]+\.(?:py|sh|bash)\b", text)]
    files = frozenset(_files(package, text))
    is_complete = not any("$" in target for target in targets) and "foreach" not in text and "GLOB" not in text
    scripts += [file for file in sorted(files) if file.endswith(".py")]
    names = (*(target for target in targets if "$" not in target), *re.findall(_ENTRY_POINT, text), *scripts)
    words = frozenset(re.findall(r"[\w.-]+", text)) - {"python", "setup", name} | files
    words |= {word.rpartition("/")[2] for word in re.findall(r"(?<![\w./-])[\w./-]+/[\w.-]+", text)}
    if name in targets or any(name == one for one in names):
        words |= {name}
    return Executables(tuple(dict.fromkeys(names)), words, is_complete)


def _files(package: Path, text: str) -> list[str]:
    """Return the names of files that can be executables: for catkin all, else those in installed folders."""
    is_catkin = ">catkin<" in re.sub(r"\s", "", manifest(package))
    folders = re.findall(r"install\s*\(\s*DIRECTORY\s+([^()]*?)\s+DESTINATION\s+[^()]*(?:lib|BIN)", text)
    places = [package] if is_catkin else [package / word for found in folders for word in found.split()]
    found: list[str] = []
    for inner in places:
        for path in inner.rglob("*") if inner.is_dir() else ():
            if len(found) > _MAX_FILES:
                break
            found.append(path.name)
    return found
