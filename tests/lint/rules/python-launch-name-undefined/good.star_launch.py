from launch.actions import *
from launch_testing import LaunchDescription


def generate_test_description():
    return LaunchDescription([GroupAction([])])
