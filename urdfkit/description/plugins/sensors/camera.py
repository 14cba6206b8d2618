"""Cameras: the plugins of Gazebo Classic's camera and depth sensors, and the cameras of gz sim.

Placeholders in defaults are replaced per model: ``{world}``, ``{model}``, ``{link}`` and ``{sensor}`` are names.
"""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1, gazebo_ros_2, gz_sensor
from urdfkit.description.plugins.spec import Parameter, PluginSpec

_INTRINSICS_ROS_1 = (
    Parameter("frame", "frameName", names="frame"),
    Parameter("camera", "cameraName"),
    Parameter("update_rate", "updateRate", "0", "[Hz]"),
    Parameter("trigger_topic", "triggerTopicName", names="topic"),
    Parameter("focal_length", "focalLength", "0", "[px]"),
    Parameter("cx", "Cx", "0", "[px]"),
    Parameter("cy", "Cy", "0", "[px]"),
    Parameter("cx_prime", "CxPrime", "0", "[px]"),
    Parameter("baseline", "hackBaseline", "0", "[m]"),
    Parameter("k1", "distortionK1", "0"),
    Parameter("k2", "distortionK2", "0"),
    Parameter("k3", "distortionK3", "0"),
    Parameter("p1", "distortionT1", "0"),
    Parameter("p2", "distortionT2", "0"),
    Parameter("auto_distortion", "autoDistortion", "false"),
    Parameter("border_crop", "borderCrop", "true"),
)

_CAMERA_ROS_1 = (
    Parameter("image_topic", "imageTopicName", "image_raw", names="topic"),
    Parameter("info_topic", "cameraInfoTopicName", "camera_info", names="topic"),
    *_INTRINSICS_ROS_1,
)

CAMERA_ROS_1 = gazebo_ros_1(
    "camera",
    "gazebo_ros_camera",
    *_CAMERA_ROS_1,
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_camera_utils.cpp",
)
"""Topics are relative to ``robotNamespace`` and ``cameraName``."""

MULTICAMERA_ROS_1 = gazebo_ros_1("multicamera", "gazebo_ros_multicamera", *_CAMERA_ROS_1)
"""Like `CAMERA_ROS_1`, with ``/left`` and ``/right`` after ``cameraName``; the baseline applies to the right camera."""

_DEPTH_ROS_1 = (
    Parameter("depth_topic", "depthImageTopicName", "depth/image_raw", names="topic"),
    Parameter("depth_info_topic", "depthImageCameraInfoTopicName", "depth/camera_info", names="topic"),
    Parameter("cloud_topic", "pointCloudTopicName", "points", names="topic"),
    Parameter("min_depth", "pointCloudCutoff", "0.4", "[m]"),
    Parameter("millimetres", "useDepth16UC1Format", "false"),
    *_INTRINSICS_ROS_1,
)

OPENNI_KINECT_ROS_1 = gazebo_ros_1(
    "openni_kinect",
    "gazebo_ros_openni_kinect",
    Parameter("image_topic", "imageTopicName", "ir/image_raw", names="topic"),
    Parameter("info_topic", "cameraInfoTopicName", "ir/camera_info", names="topic"),
    Parameter("max_depth", "pointCloudCutoffMax", "5", "[m]"),
    *_DEPTH_ROS_1,
)

DEPTH_CAMERA_ROS_1 = gazebo_ros_1(
    "depth_camera",
    "gazebo_ros_depth_camera",
    Parameter("image_topic", "imageTopicName", "image_raw", names="topic"),
    Parameter("info_topic", "cameraInfoTopicName", "camera_info", names="topic"),
    *_DEPTH_ROS_1,
)

CAMERA_ROS_2 = gazebo_ros_2(
    "camera",
    "gazebo_ros_camera",
    Parameter("camera", "camera_name", "{sensor}"),
    Parameter("frame", "frame_name", "{link}", names="frame"),
    Parameter("triggered", "triggered", "false"),
    Parameter("focal_length", "focal_length", "0", "[px]"),
    Parameter("cx", "cx", "0", "[px]"),
    Parameter("cy", "cy", "0", "[px]"),
    Parameter("baseline", "hack_baseline", "0", "[m]"),
    Parameter("auto_distortion", "autoDistortion", "false"),
    Parameter("border_crop", "border_crop", "true"),
    Parameter("min_depth", "min_depth", "0.4", "[m]"),
    Parameter("max_depth", "max_depth", unit="[m]"),
)
"""Topics are ``CAMERA/image_raw``, ``CAMERA/camera_info`` and for a sensor of type depth ``CAMERA/depth/…`` and
``CAMERA/points``, changed by ``<ros><remapping>`` only."""


def _gz(kind: str, topic: str) -> PluginSpec:
    return gz_sensor(kind, topic, "CameraSensor.cc and related files", meaning="image_topic")


CAMERA_GZ = _gz("gz_camera", "/image")
DEPTH_CAMERA_GZ = _gz("gz_depth_camera", "/depth_image")
RGBD_CAMERA_GZ = _gz("gz_rgbd_camera", "")
SEGMENTATION_CAMERA_GZ = _gz("gz_segmentation_camera", "/segmentation")
BOUNDING_BOX_CAMERA_GZ = _gz("gz_bounding_box_camera", "/boundingbox")

CAMERAS = (CAMERA_ROS_1, MULTICAMERA_ROS_1, OPENNI_KINECT_ROS_1, DEPTH_CAMERA_ROS_1, CAMERA_ROS_2)
"""All camera plugins."""
