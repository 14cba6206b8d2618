from launch import LaunchDescription


def generate_launch_descriptions():  # <!-- expect: L105 -->
    return LaunchDescription([])
