from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def command(path, options):
    return Command(["xacro", options, path, options, "size:=2"])


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("cart_description"), LaunchConfiguration("model")])
    prefix = LaunchConfiguration("prefix")
    descriptions = [
        Command(["xacro", " ", path, " ", "prefix:=", prefix, " size:=", "2"]),
        Command([PathJoinSubstitution([FindExecutable(name="xacro")]), " ", path]),
        Command([FindExecutable(name="xacro"), "", " ", path, " prefix:=", "'", prefix, "'"]),
        command(path, " "),
    ]
    text = "a long description of the -d " "option in two lines"
    return LaunchDescription([
        DeclareLaunchArgument("model"),
        DeclareLaunchArgument("prefix", default_value="", description=text),
        Node(
            package="rviz2",
            executable="rviz2",
            arguments=["-d", "/scan@sensor_msgs/msg/LaserScan" "@gz.msgs.LaserScan", *descriptions],
        ),
    ])
