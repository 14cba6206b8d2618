"""Lidars and rangefinders: the plugins of Gazebo Classic's ray sensors, and the lidars of gz sim.

The scan (angles, samples, ranges, noise) is configured in the ``<sensor>`` that contains the plugin. Placeholders in
defaults are replaced per model: ``{world}``, ``{model}``, ``{link}`` and ``{sensor}`` are names.
"""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1, gazebo_ros_2, gz_sensor
from urdfkit.description.plugins.spec import Parameter

LASER_ROS_1 = gazebo_ros_1(
    "laser",
    "gazebo_ros_laser gazebo_ros_gpu_laser",
    Parameter("topic", "topicName", "/world", names="topic"),
    Parameter("frame", "frameName", "/world", names="frame"),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_laser.cpp and gazebo_ros_gpu_laser.cpp",
)

BLOCK_LASER_ROS_1 = gazebo_ros_1(
    "block_laser",
    "gazebo_ros_block_laser",
    Parameter("topic", "topicName", "/world", names="topic"),
    Parameter("frame", "frameName", "/world", names="frame"),
    Parameter("gaussian_noise", "gaussianNoise", "0", "[m]"),
    Parameter("min_intensity", "hokuyoMinIntensity", "101"),
    Parameter("update_rate", "updateRate", "0", "[Hz]"),
)
"""The plugin reads ``hokuyoMinIntensity`` and ``updateRate`` but does not use them."""

RANGE_ROS_1 = gazebo_ros_1(
    "range",
    "gazebo_ros_range",
    Parameter("topic", "topicName", "/range", names="topic"),
    Parameter("frame", "frameName", "/world", names="frame"),
    Parameter("radiation", "radiation", "ultrasound"),
    Parameter("field_of_view", "fov", "0.05", "[rad]"),
    Parameter("gaussian_noise", "gaussianNoise", "0", "[m]"),
    Parameter("update_rate", "updateRate", "0", "[Hz]"),
)

RAY_SENSOR_ROS_2 = gazebo_ros_2(
    "ray_sensor",
    "gazebo_ros_ray_sensor",
    Parameter("output_type", "output_type", "sensor_msgs/PointCloud2"),
    Parameter("frame", "frame_name", "{link}", names="frame"),
    Parameter("min_intensity", "min_intensity", "0"),
    Parameter("radiation", "radiation_type", "infrared"),
    source="gazebo_ros_pkgs ros2, gazebo_plugins/src/gazebo_ros_ray_sensor.cpp and "
    "gazebo_ros/include/gazebo_ros/conversions/sensor_msgs.hpp",
)
"""Publishes on ``~/out``, changed by ``<ros><remapping>`` only."""

VELODYNE = "gazebo_ros_velodyne_laser gazebo_ros_velodyne_gpu_laser"

VELODYNE_ROS_1 = gazebo_ros_1(
    "velodyne",
    VELODYNE,
    Parameter("topic", "topicName", "/points", names="topic"),
    Parameter("frame", "frameName", "/world", names="frame"),
    Parameter("min_range", "min_range", "0", "[m]"),
    Parameter("max_range", "max_range", unit="[m]"),
    Parameter("min_intensity", "min_intensity"),
    Parameter("gaussian_noise", "gaussianNoise", "0", "[m]"),
    Parameter("organize_cloud", "organize_cloud", "false"),
    source="velodyne_simulator master, velodyne_gazebo_plugins/src/GazeboRosVelodyneLaser.cpp",
)

VELODYNE_ROS_2 = gazebo_ros_2(
    "velodyne",
    VELODYNE,
    Parameter("frame", "frame_name", "/world", names="frame"),
    Parameter("min_range", "min_range", "0", "[m]"),
    Parameter("max_range", "max_range", unit="[m]"),
    Parameter("min_intensity", "min_intensity"),
    Parameter("gaussian_noise", "gaussian_noise", "0", "[m]"),
    Parameter("organize_cloud", "organize_cloud", "false"),
    source="velodyne_simulator foxy-devel, velodyne_gazebo_plugins/src/GazeboRosVelodyneLaser.cpp",
)
"""Publishes on ``~/out``."""

LIDAR_GZ = gz_sensor("gpu_lidar", "/scan", "Sensor.cc, src/Lidar.cc and src/GpuLidarSensor.cc")
"""Read from the ``<sensor>`` itself. The point cloud is published on the topic with the suffix ``/points``."""

LIDARS = (LASER_ROS_1, BLOCK_LASER_ROS_1, RANGE_ROS_1, RAY_SENSOR_ROS_2, VELODYNE_ROS_1, VELODYNE_ROS_2)
"""All lidar plugins."""

LIDAR_TYPES = ("ray", "gpu_ray", "lidar", "gpu_lidar")
"""Types of a lidar's ``<sensor>``."""
