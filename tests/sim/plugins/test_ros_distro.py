import pytest

from urdfkit.errors import UsageError
from urdfkit.sim.plugins.ros_distro import Distro


def test_distributions_are_ordered() -> None:
    assert Distro("indigo").before("kinetic")
    assert Distro("Kinetic ").before("melodic")
    assert not Distro("kinetic").before("kinetic")
    assert not Distro("noetic").before("melodic")
    assert not Distro("humble").before("hydro")
    assert not Distro().before("noetic")


def test_unknown_distributions_are_named_with_the_nearest() -> None:
    with pytest.raises(UsageError, match="unknown ROS distribution `humbel`; did you mean `humble`"):
        Distro("humbel")
    with pytest.raises(UsageError):
        Distro("")
