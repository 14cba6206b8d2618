"""Contact and force sensors: bumpers, contact sensors, touch sensors and force/torque sensors of joints."""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1, gazebo_ros_2, gz_sensor
from urdfkit.description.plugins.spec import Parameter, PluginSpec

BUMPER_ROS_1 = gazebo_ros_1(
    "bumper",
    "gazebo_ros_bumper",
    Parameter("topic", "bumperTopicName", "bumper_states", names="topic"),
    Parameter("frame", "frameName", "world", names="frame"),
)
"""All values are in world axes, independent of ``frameName``."""

BUMPER_ROS_2 = gazebo_ros_2("bumper", "gazebo_ros_bumper", Parameter("frame", "frame_name", "world", names="frame"))
"""Publishes on ``bumper_states``, changed by ``<ros><remapping>`` only."""

CONTACT_GZ = PluginSpec(
    kind="gz_contact",
    generation="gz",
    filenames=(),
    class_names=(),
    parameters=(
        Parameter("topic", "topic", "/world/{world}/model/{model}/link/{link}/sensor/{sensor}/contact", names="topic"),
    ),
    source="gz-sim main, src/systems/contact/Contact.cc",
)
"""Read from the ``<sensor>`` itself; a ``<topic>`` inside its ``<contact>`` takes precedence."""

FORCE_TORQUE_ROS_1 = gazebo_ros_1(
    "force_torque",
    "gazebo_ros_ft_sensor",
    Parameter("joint", "jointName", names="joint"),
    Parameter("topic", "topicName", names="topic"),
    Parameter("gaussian_noise", "gaussianNoise", "0", "[N, N·m]"),
    Parameter("update_rate", "updateRate", "0", "[Hz]"),
)

FORCE_TORQUE_ROS_2 = gazebo_ros_2(
    "force_torque",
    "gazebo_ros_ft_sensor",
    Parameter("joint", "joint_name", names="joint"),
    Parameter("body", "body_name", names="link"),
    Parameter("frame", "frame_name", names="frame"),
    Parameter("gaussian_noise", "gaussian_noise", "0", "[N, N·m]"),
    Parameter("update_rate", "update_rate", "0", "[Hz]"),
)
"""Publishes on ``wrench``, changed by ``<ros><remapping>`` only; ``body_name`` selects the wrench on that link."""

FORCE_TORQUE_GZ = gz_sensor(
    "gz_force_torque",
    "/forcetorque",
    "ForceTorqueSensor.cc; gz-sim main, src/systems/force_torque/ForceTorque.cc",
    part="joint",
)
"""Read from the ``<sensor>`` itself."""

TOUCH_GZ = PluginSpec(
    kind="gz_touch",
    generation="gz",
    filenames=("gz-sim-touchplugin-system", "ignition-gazebo-touchplugin-system"),
    class_names=("gz::sim::systems::TouchPlugin", "ignition::gazebo::systems::TouchPlugin"),
    parameters=(
        Parameter("target", "target"),
        Parameter("namespace", "namespace"),
        Parameter("time", "time", unit="[s]"),
        Parameter("enabled", "enabled", "false"),
    ),
    source="gz-sim main, src/systems/touch_plugin/TouchPlugin.cc",
)
"""A plugin of the model; it uses the model's contact sensors."""

TOUCH = (BUMPER_ROS_1, BUMPER_ROS_2, FORCE_TORQUE_ROS_1, FORCE_TORQUE_ROS_2, TOUCH_GZ)
"""All contact and force plugins."""
