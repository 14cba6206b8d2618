"""ROS distributions: some plugins behave differently from one distribution to the next."""

from urdfkit.errors import UsageError, did_you_mean

ROS_1 = ("hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic")
"""ROS 1 distributions, oldest first."""

ROS_2 = (
    *("ardent", "bouncy", "crystal", "dashing", "eloquent", "foxy", "galactic", "humble", "iron", "jazzy"),
    *("kilted", "lyrical", "rolling"),
)
"""ROS 2 distributions, oldest first."""


class Distro:
    """ROS distribution that a robot was written for; if unspecified, plugins behave as in the newest.

    Args:
        name: name of the distribution, e.g. ``kinetic``; None if unspecified.

    Raises:
        UsageError: the distribution is unknown, with the nearest name.

    Attributes:
        name: name in lower case; empty if unspecified.
    """

    def __init__(self, name: str | None = None) -> None:
        self.name = (name or "").strip().lower()
        if name is not None and self.name not in (*ROS_1, *ROS_2):
            names = (*ROS_1, *ROS_2)
            raise UsageError(
                f"unknown ROS distribution `{name}`{did_you_mean(self.name, names)} (available: {', '.join(names)})"
            )

    def before(self, other: str) -> bool:
        """Whether this is a ROS 1 distribution older than `other`."""
        return self.name in ROS_1 and ROS_1.index(self.name) < ROS_1.index(other)
