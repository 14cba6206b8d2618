"""Names of released ROS packages and of rosdep keys, to find misspelt dependencies."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache

_NAMES = """
ackermann_msgs ackermann_steering_controller action_msgs actionlib actionlib_msgs actuator_msgs admittance_controller
amcl ament_cmake ament_cmake_auto ament_cmake_copyright ament_cmake_cppcheck ament_cmake_flake8 ament_cmake_gmock
ament_cmake_gtest ament_cmake_lint_cmake ament_cmake_pep257 ament_cmake_pytest ament_cmake_python ament_cmake_ros
ament_cmake_uncrustify ament_cmake_xmllint ament_copyright ament_flake8 ament_index_cpp ament_index_python
ament_lint_auto ament_lint_common ament_pep257 ament_python angles apriltag_ros aruco_ros bicycle_steering_controller
bond bond_core builtin_interfaces camera_calibration camera_info_manager cartographer cartographer_ros catkin
catkin_virtualenv class_loader cmake_modules common_interfaces compressed_image_transport control_msgs control_toolbox
controller_interface controller_manager controller_manager_msgs costmap_2d cv_bridge depth_image_proc
depthimage_to_laserscan diagnostic_aggregator diagnostic_msgs diagnostic_updater diff_drive_controller
dwa_local_planner dynamic_reconfigure effort_controllers eigen eigen_conversions example_interfaces fake_localization
filters force_torque_sensor_broadcaster force_torque_sensor_controller forward_command_controller
four_wheel_steering_msgs gazebo_dev gazebo_msgs gazebo_plugins gazebo_ros gazebo_ros2_control gazebo_ros_control
gazebo_ros_pkgs generate_parameter_library geographic_msgs geometry_msgs global_planner gmapping gps_msgs
gripper_controllers gtest gz_ros2_control hardware_interface hector_gazebo_plugins hector_mapping
hector_sensors_description ign_ros2_control image_common image_geometry image_pipeline image_proc image_transport
image_transport_plugins image_view imu_complementary_filter imu_filter_madgwick imu_sensor_broadcaster
imu_sensor_controller imu_tools interactive_markers joint_limits joint_limits_interface joint_state_broadcaster
joint_state_controller joint_state_publisher joint_state_publisher_gui joint_trajectory_controller joy joy_teleop
kdl_parser kdl_parser_py key_teleop laser_filters laser_geometry laser_proc launch launch_param_builder launch_pytest
launch_ros launch_testing launch_testing_ament_cmake launch_testing_ros launch_xml launch_yaml libgazebo
libpcl-all-dev lifecycle_msgs map_msgs map_server mavros mavros_msgs mecanum_drive_controller message_filters
message_generation message_runtime move_base move_base_msgs moveit moveit_commander moveit_common moveit_configs_utils
moveit_core moveit_fake_controller_manager moveit_kinematics moveit_msgs moveit_planners moveit_planners_chomp
moveit_planners_ompl moveit_py moveit_resources moveit_ros moveit_ros_benchmarks moveit_ros_control_interface
moveit_ros_move_group moveit_ros_perception moveit_ros_planning moveit_ros_planning_interface
moveit_ros_robot_interaction moveit_ros_visualization moveit_ros_warehouse moveit_servo moveit_setup_assistant
moveit_simple_controller_manager moveit_visual_tools nav2_amcl nav2_behavior_tree nav2_behaviors nav2_bringup
nav2_bt_navigator nav2_collision_monitor nav2_common nav2_controller nav2_core nav2_costmap_2d nav2_dwb_controller
nav2_lifecycle_manager nav2_map_server nav2_mppi_controller nav2_msgs nav2_navfn_planner nav2_planner nav2_recoveries
nav2_regulated_pure_pursuit_controller nav2_rviz_plugins nav2_simple_commander nav2_smac_planner nav2_smoother
nav2_util nav2_velocity_smoother nav2_waypoint_follower nav_core nav_msgs navfn navigation navigation2
nmea_navsat_driver nodelet octomap octomap_msgs octomap_ros octomap_server ompl orocos_kdl parallel_gripper_controller
pcl_conversions pcl_msgs pcl_ros pick_ik pid_controller pilz_industrial_motion_planner plotjuggler pluginlib
pointcloud_to_laserscan position_controllers python-numpy python3-matplotlib python3-numpy python3-opencv python3-pip
python3-pytest python3-scipy python3-serial python3-setuptools python3-yaml python_qt_binding range_sensor_broadcaster
rcl_interfaces rclcpp rclcpp_action rclcpp_components rclcpp_lifecycle rclpy rcutils realsense2_camera
realsense2_description realtime_tools resource_retriever rmw robot_localization robot_pose_ekf robot_state_publisher
robot_upstart ros2_control ros2_control_test_assets ros2_controllers ros2_controllers_test_nodes ros2bag ros2cli
ros2control ros2controlcli ros2launch ros2param ros2run ros2topic ros_base ros_control ros_controllers ros_core ros_gz
ros_gz_bridge ros_gz_image ros_gz_interfaces ros_gz_sim ros_ign ros_ign_bridge ros_ign_gazebo ros_ign_image
ros_testing rosbag rosbag2 rosbash rosconsole roscpp roscpp_serialization rosgraph_msgs rosidl_default_generators
rosidl_default_runtime roslaunch roslib roslint rosnode rosout rosparam_shortcuts rospy rosserial rosservice rostest
rostopic rosunit rqt rqt_common_plugins rqt_controller_manager rqt_graph rqt_gui rqt_gui_py rqt_image_view
rqt_joint_trajectory_controller rqt_plot rqt_robot_steering rqt_tf_tree rviz rviz2 rviz_common rviz_default_plugins
rviz_imu_plugin rviz_visual_tools sensor_msgs sensor_msgs_py serial shape_msgs simulation_interfaces slam_gmapping
slam_toolbox smach smach_ros spatio_temporal_voxel_layer srdfdom std_msgs std_srvs steering_controllers_library
stereo_image_proc stereo_msgs teb_local_planner teleop_twist_joy teleop_twist_keyboard tf tf2 tf2_eigen
tf2_geometry_msgs tf2_kdl tf2_msgs tf2_py tf2_ros tf2_ros_py tf2_sensor_msgs tf2_tools tf_conversions
tf_transformations tinyxml tinyxml2 topic_tools trac_ik_kinematics_plugin trajectory_msgs transmission_interface
tricycle_controller tricycle_steering_controller twist_mux twist_stamper ur_client_library ur_controllers
ur_description ur_msgs urdf urdf_launch urdf_parser_plugin urdf_tutorial urdfdom urdfdom_headers urdfdom_py urg_node
usb_cam v4l2_camera velocity_controllers velodyne velodyne_description velodyne_driver velodyne_gazebo_plugins
velodyne_pointcloud velodyne_simulator vision_msgs vision_opencv visp visualization_msgs warehouse_ros
warehouse_ros_mongo warehouse_ros_sqlite web_video_server xacro yaml-cpp yaml_cpp_vendor yocs_cmd_vel_mux
"""
"""Common names in distribution.yaml of Noetic, Humble and Jazzy, and in rosdep/*.yaml (ros/rosdistro)."""


_METAPACKAGES = {
    "gazebo_ros_pkgs": "gazebo_dev gazebo_msgs gazebo_plugins gazebo_ros",
    "common_interfaces": "actionlib_msgs diagnostic_msgs geometry_msgs nav_msgs sensor_msgs shape_msgs std_msgs"
    " std_srvs stereo_msgs trajectory_msgs visualization_msgs",
    "geometry": "angles eigen_conversions kdl_conversions tf tf_conversions",
    "geometry2": "tf2 tf2_*",
    "image_pipeline": "camera_calibration depth_image_proc image_proc image_publisher image_rotate image_view"
    " stereo_image_proc",
    "moveit": "moveit_commander moveit_core moveit_kinematics moveit_planners* moveit_plugins moveit_ros*"
    " moveit_setup_assistant moveit_*controller_manager pilz_industrial_motion_planner*",
    "moveit_planners": "moveit_planners_* pilz_industrial_motion_planner*",
    "moveit_plugins": "moveit_*controller_manager moveit_ros_control_interface",
    "moveit_ros": "moveit_core moveit_kinematics moveit_ros_*",
    "nav2_bringup": "launch_ros nav2_* navigation2 slam_toolbox",
    "navigation": "amcl base_local_planner carrot_planner clear_costmap_recovery costmap_2d dwa_local_planner"
    " fake_localization global_planner map_server move_base move_base_msgs move_slow_and_clear nav_core navfn"
    " robot_pose_ekf rotate_recovery voxel_grid",
    **dict.fromkeys(("nav2_controller", "nav2_planner"), "nav2_costmap_2d"),
    "navigation2": "nav2_[!b]* nav2_b[!r]*",
    "ros2_control": "controller_interface controller_manager* hardware_interface joint_limits ros2controlcli"
    " ros2_control_test_assets transmission_interface",
    "ros2_controllers": "ackermann_steering_controller admittance_controller bicycle_steering_controller"
    " diff_drive_controller effort_controllers *_broadcaster forward_command_controller gpio_controllers"
    " gripper_controllers joint_state_controller joint_trajectory_controller mecanum_drive_controller"
    " parallel_gripper_controller pid_controller position_controllers tricycle_controller"
    " tricycle_steering_controller velocity_controllers",
    "ros_control": "control_toolbox controller_interface controller_manager* hardware_interface joint_limits_interface"
    " realtime_tools transmission_interface",
    "ros_controllers": "ackermann_steering_controller diff_drive_controller effort_controllers"
    " force_torque_sensor_controller forward_command_controller gripper_action_controller imu_sensor_controller"
    " joint_state_controller joint_trajectory_controller position_controllers velocity_controllers",
    "ros_gz": "ros_gz_*",
    "ros_ign": "ros_ign_*",
    "slam_gmapping": "gmapping openslam_gmapping",
    "velodyne": "velodyne_driver velodyne_laserscan velodyne_msgs velodyne_pointcloud",
    "velodyne_simulator": "velodyne_description velodyne_gazebo_plugins",
}
"""Packages that consist of dependencies → patterns of these, and of what these need at run time.

The source is package.xml in the repositories of the packages (ros-navigation/navigation2, ros-controls/ros2_controllers
and so on), over their releases: a package that one release lists is accepted for all.
"""


def is_in_metapackage(name: str, dependencies: Iterable[str]) -> bool:
    """Return whether a package is a dependency of one of the metapackages among the dependencies."""
    from fnmatch import fnmatchcase

    patterns = (each for other in dependencies for each in _METAPACKAGES.get(other, "").split())
    return any(fnmatchcase(name, each) for each in patterns)


@cache
def names() -> frozenset[str]:
    """Return the names of common released packages and rosdep keys; there are many others."""
    return frozenset(_NAMES.split())


_OF_ONE_PROJECT = r"(?:ament|joint_state|launch|moveit|nav2|ros_gz|ros2|rviz)_"
"""Matches names of packages that one project releases, so that a package without the final ``s`` does not exist."""

_SUCCESSORS = {"rviz": "rviz2", "tf": "tf2_ros"}
"""ROS 1 package → the ROS 2 package with the same executables."""

RENAMED = {"ros_ign_bridge": "ros_gz_bridge", "ros_ign_gazebo": "ros_gz_sim", "ros_ign_image": "ros_gz_image"}
"""Package of Ignition Gazebo → its name from Humble on; Jazzy has no packages with the old names."""


def misspelling_of(name: str, others: Iterable[str], version: int = 0) -> str | None:
    """Return the package that a name misspells by one letter or two swapped letters; None if it misspells none.

    Names that differ by a digit or a final ``s`` can be two packages, as can short names of Python modules.

    Args:
        name: the name in the file.
        others: further valid names, such as the packages of the workspace.
        version: version of ROS that reads the file, which lacks some packages of the other version; 0 if it is unknown.
    """
    valid = names() | set(others)
    if version == 2 and name in _SUCCESSORS and name not in others:
        return _SUCCESSORS[name]
    if version == 2 and RENAMED.get(name, name) in others and name not in others:
        return RENAMED[name]
    if name in valid or len(name) < 4 or re.fullmatch(r"python3?-\w{1,4}", name):
        return None
    from urdfkit.errors import similar

    if f"{name}s" in names() and re.match(_OF_ONE_PROJECT, name):
        return f"{name}s"
    return next((near for near in similar(name, valid, count=3, cutoff=0.75) if is_slip(name, near)), None)


def is_slip(name: str, other: str) -> bool:
    """Return whether two names differ by a letter, by separators and case, or by the order of letters in one place."""
    if name.replace("_", "").lower() == other.replace("_", "").lower() or name.replace("-", "_") == other.replace(
        "-", "_"
    ):
        return True
    if abs(len(name) - len(other)) > 1:
        return False
    start = next((at for at, (a, b) in enumerate(zip(name, other, strict=False)) if a != b), min(len(name), len(other)))
    left, right = name[start:], other[start:]
    while left and right and left[-1] == right[-1]:
        left, right = left[:-1], right[:-1]
    if start > 0 and name[start - 1].isdigit():  # ur5 and ur5e are two robots
        return False
    end = name[start + len(left) :]
    is_plural = {left, right} == {"", "s"} and end[:1] in ("", "_", "-") and not name.endswith("_msg")
    if is_plural or not (left + right).isalpha():
        return False
    return max(len(left), len(right)) <= 1 or sorted(left) == sorted(right)
