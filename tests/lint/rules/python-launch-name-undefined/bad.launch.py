from launch.actions import DeclareLaunchArgument


def generate_launch_description():
    gui = DeclareLaunchArgument("gui", default_value="true")
    LaunchDescription([gui, gu])  # <!-- expect: L105, L105, L105 -->

    def inner():
        return gui
