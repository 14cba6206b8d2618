from launch.actions import DeclareLaunchArgument


def generate_launch_description():  # <!-- expect: L105 -->
    gui = DeclareLaunchArgument("gui", default_value="true")
    LaunchDescription([gui, gui])  # <!-- expect: L105, L105 -->

    def inner():
        return gui
