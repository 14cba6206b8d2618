"""Skid steer: gazebo_ros_skid_steer_drive (ROS 1). ROS 2 and gz sim use the differential drive with more pairs.

Source: gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_skid_steer_drive.cpp.
"""

from urdfkit.sim.plugins.drives.diff_drive import DiffDrive
from urdfkit.sim.plugins.drives.odometry_parameters import odometry_topics
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics


class SkidSteer(DiffDrive):
    """Drives two wheels on each side at v ± w·separation/2; the motion of the robot results from wheel friction.

    The odometry is the true pose in the world with a height of zero. Left and right are never swapped.
    """

    kind = "skid_steer"

    def _topic_names(self, setup: Setup) -> Topics:
        # Unlike the differential drive, its default namespace is empty.
        return self.topic_names()

    def _read_wheels(self, setup: Setup, read: Parameters) -> None:
        def joint(meaning: str) -> str:
            return setup.joint(read.text(meaning), read.place(meaning))

        self._pairs = tuple((joint(f"left_{end}_joint"), joint(f"right_{end}_joint")) for end in ("front", "rear"))
        self._separations = (read.number("wheel_separation"),) * 2
        self._radii = (read.number("wheel_diameter") / 2,) * 2
        self._swapped = False

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self.topics = odometry_topics(
            setup,
            read,
            topics,
            published=True,
            with_tf=read.flag("publish_odometry_tf"),
            twist_covariance=True,
            flat=True,
        )
