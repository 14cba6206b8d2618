"""Which ROS a model was written for: some plugins changed their behaviour from one distribution to the next."""

from __future__ import annotations

from urdfkit.errors import UsageError, did_you_mean

ROS_1 = ("hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic")
"""Distributions of ROS 1, oldest first."""

ROS_2 = (
    "ardent",
    "bouncy",
    "crystal",
    "dashing",
    "eloquent",
    "foxy",
    "galactic",
    "humble",
    "iron",
    "jazzy",
    "kilted",
    "lyrical",
    "rolling",
)
"""Distributions of ROS 2, oldest first."""


class Distro:
    """A ROS distribution, or none in particular: then everything behaves as in the newest.

    Args:
        name: such as ``kinetic``; None for none in particular.

    Raises:
        UsageError: no such distribution, with the nearest one.

    Attributes:
        name: in lower case; empty for none in particular.
    """

    def __init__(self, name: str | None = None) -> None:
        self.name = (name or "").strip().lower()
        if name is not None and self.name not in (*ROS_1, *ROS_2):
            known = (*ROS_1, *ROS_2)
            raise UsageError(f"no ROS distribution `{name}`{did_you_mean(self.name, known)} (it is {', '.join(known)})")

    def before(self, other: str) -> bool:
        """Whether it is older than another distribution of ROS 1."""
        return self.name in ROS_1 and ROS_1.index(self.name) < ROS_1.index(other)
