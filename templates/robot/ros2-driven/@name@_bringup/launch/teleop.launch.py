"""Drive with a joystick: ros2 launch @name@_bringup teleop.launch.py.

To drive with the keyboard, use a separate terminal: ros2 run teleop_twist_keyboard teleop_twist_keyboard
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description():
    """Read the joystick and convert its axes to commands while its button is pressed."""
    return LaunchDescription([
        DeclareLaunchArgument("speed", default_value="0.5", description="At full deflection [m/s]."),
        DeclareLaunchArgument("turn", default_value="1.0", description="At full deflection [rad/s]."),
        DeclareLaunchArgument("button", default_value="0", description="Number of the button to hold."),
        Node(package="joy", executable="joy_node"),
        Node(
            package="teleop_twist_joy",
            executable="teleop_node",
            parameters=[
                {
                    "axis_linear.x": 1,
                    "axis_angular.yaw": 0,
                    "scale_linear.x": ParameterValue(LaunchConfiguration("speed"), value_type=float),
                    "scale_angular.yaw": ParameterValue(LaunchConfiguration("turn"), value_type=float),
                    "enable_button": ParameterValue(LaunchConfiguration("button"), value_type=int),
                }
            ],
        ),
    ])
