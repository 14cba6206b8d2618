"""Topics that the nodes of well-known packages read and publish, under the names that launch files remap.

Sources: robot_localization (ros_filter.cpp, navsat_transform.cpp), nav2_velocity_smoother (velocity_smoother.cpp),
phidgets_drivers (phidgets_spatial/README.md, phidgets_gyroscope/README.md). The other rows were not compared with the
sources.
"""

from __future__ import annotations

from functools import cache

from urdfkit.record import record

_TABLE = """
amcl nav2_amcl slam_toolbox gmapping|scan:LaserScan|
move_base|odom:Odometry|cmd_vel:Twist
nav2_bt_navigator|odom:Odometry|
octomap_server|cloud_in:PointCloud2|
nav2_velocity_smoother|cmd_vel:Twist odom:Odometry|cmd_vel_smoothed:Twist
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
"""Packages, with the programs if only some of them are meant, then topics that they read and those they publish."""

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


@cache
def _rows() -> dict[str, NodeTopics]:
    found: dict[str, NodeTopics] = {}
    for row in _TABLE.strip().splitlines():
        nodes, read, published = row.split("|")
        topics = NodeTopics(*(dict(each.split(":") for each in part.split()) for part in (read, published)))
        for node in nodes.split():
            package, _, programs = node.partition("/")
            found |= {f"{package}/{program}": topics for program in programs.split(",")}
    return found


def topics_of(package: str, program: str) -> NodeTopics | None:
    """Return the topics of a node; None if it is unknown."""
    rows = _rows()
    return rows.get(f"{package}/{program}") or rows.get(f"{package}/")


def may_publish(package: str, type: str) -> bool:
    """Return whether a package of cameras may publish messages of a type."""
    return package in CAMERAS and type in _OF_CAMERAS
