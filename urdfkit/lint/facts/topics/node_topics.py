"""Topics that the nodes of well-known packages read and publish, under the names that launch files remap.

Sources: robot_localization (ros_filter.cpp, navsat_transform.cpp), nav2_velocity_smoother (velocity_smoother.cpp),
nav2_util (twist_publisher.hpp), twist_mux (twist_mux.cpp), teleop_twist_joy (README.md), image_proc (rectify.cpp),
phidgets_drivers (phidgets_spatial/README.md, phidgets_gyroscope/README.md). The other rows were not compared with the
sources.
"""

from __future__ import annotations

from functools import cache

from urdfkit.record import record

_TABLE = """
amcl nav2_amcl slam_toolbox gmapping|scan:LaserScan|
move_base|odom:Odometry|
nav2_bt_navigator|odom:Odometry|
octomap_server|cloud_in:PointCloud2|
image_proc/rectify_node|image:Image|image_rect:Image
nav2_velocity_smoother|odom:Odometry|
robot_localization/ekf_node,ukf_node,ekf_localization_node,ukf_localization_node||odometry/filtered:Odometry
robot_localization/navsat_transform_node|imu:Imu odometry/filtered:Odometry gps/fix:NavSatFix|odometry/gps:Odometry\
 gps/filtered:NavSatFix
imu_filter_madgwick imu_complementary_filter|imu/data_raw:Imu imu/mag:MagneticField|imu/data:Imu
depthimage_to_laserscan|depth:Image depth_camera_info:CameraInfo|scan:LaserScan
pointcloud_to_laserscan|cloud_in:PointCloud2|scan:LaserScan
laser_filters|scan:LaserScan|scan_filtered:LaserScan
rplidar_ros sllidar_ros sllidar_ros2 urg_node urg_node2 ydlidar_ros2_driver hls_lfcd_lds_driver ldlidar||scan:LaserScan
ldlidar_stl_ros2 ldlidar_ros2 lms1xx LMS1xx sick_tim sick_safetyscanners hokuyo_node urg_node_ros2||scan:LaserScan
sick_scan sick_scan2 sick_scan_xd||scan:LaserScan cloud:PointCloud2
velodyne_pointcloud||velodyne_points:PointCloud2
velodyne_laserscan|velodyne_points:PointCloud2|scan:LaserScan
usb_cam v4l2_camera||image_raw:Image
nmea_navsat_driver||fix:NavSatFix
phidgets_spatial phidgets_gyroscope||imu/data_raw:Imu
phidgets_imu||imu/data_raw:Imu
xsens_driver bno055 microstrain_inertial_driver um7||imu/data:Imu
"""
"""Package, or package and some of its programs → the topics that they subscribe to, and the topics that they publish.

Those of velocity commands are in `_COMMANDS`.
"""

_COMMANDS = """
move_base nav2_recoveries teleop_twist_keyboard|||cmd_vel
nav2_behaviors nav2_controller opennav_docking|enable_stamped_cmd_vel||cmd_vel
nav2_velocity_smoother|enable_stamped_cmd_vel|cmd_vel|cmd_vel_smoothed
nav2_collision_monitor|enable_stamped_cmd_vel|cmd_vel_in_topic|cmd_vel_out_topic
teleop_twist_joy|publish_stamped_twist||cmd_vel
twist_mux|use_stamped||cmd_vel_out
"""
"""Packages, their flag for stamped velocity commands, the topic of velocity commands that they read, and publish.

Names that end in ``_topic`` are parameters with the topic.
"""

_CAMERAS = """
realsense2_camera depthai_ros_driver depthai_examples zed_wrapper orbbec_camera astra_camera openni2_launch
openni2_camera freenect_launch azure_kinect_ros_driver
"""
CAMERAS = frozenset(_CAMERAS.split())
"""Packages of cameras, whose topics depend on their parameters; they publish neither scans nor positions."""

_OF_CAMERAS = frozenset(("Image", "PointCloud2", "Imu", "CameraInfo"))


@record(eq=False)
class NodeTopics:
    """Topics of a node: names without slashes at their ends → the type of the messages without its package."""

    read: dict[str, str]
    published: dict[str, str]


@record(eq=False)
class CommandTopics:
    """Velocity commands of a node: its flag for stamped commands, and the topics or parameters of these commands.

    The texts are empty without a flag or topic.
    """

    flag: str
    read: str
    published: str


@cache
def command_topics() -> dict[str, CommandTopics]:
    """Return package → its topics of velocity commands."""
    rows = [row.split("|") for row in _COMMANDS.strip().splitlines()]
    return {package: CommandTopics(*row[1:]) for row in rows for package in row[0].split()}


@cache
def published_commands() -> dict[str, str]:
    """Return package → the topic on which its node publishes velocity commands, unless a parameter has it."""
    every = command_topics().items()
    return {package: each.published for package, each in every if not each.published.endswith("_topic")}


@cache
def _rows() -> dict[str, NodeTopics]:
    found: dict[str, NodeTopics] = {}
    for row in _TABLE.strip().splitlines():
        nodes, read, published = row.split("|")
        topics = NodeTopics(*(dict(each.split(":") for each in part.split()) for part in (read, published)))
        for node in nodes.split():
            package, _, programs = node.partition("/")
            commands = command_topics().get(package)
            own = NodeTopics(*(dict(each) for each in (topics.read, topics.published)))
            for names, name in ((own.read, commands.read), (own.published, commands.published)) if commands else ():
                names |= {name: "Twist"} if name else {}
            found |= {f"{package}/{program}": own for program in programs.split(",")}
    return found


def topics_of(package: str, program: str) -> NodeTopics | None:
    """Return the topics of a node; None if it is unknown."""
    rows = _rows()
    return rows.get(f"{package}/{program}") or rows.get(f"{package}/")


def may_publish(package: str, type: str) -> bool:
    """Return whether a package of cameras may publish messages of a type."""
    return package in CAMERAS and type in _OF_CAMERAS
