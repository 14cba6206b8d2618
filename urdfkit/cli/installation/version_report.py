"""``urdfkit --version --verbose``: versions of the platform and of the dependencies, for a bug report."""

import os
import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from urdfkit import __version__

PACKAGES = (
    "xacro pyyaml pin numpy numba trimesh meshcat tornado moderngl rosbags pygls mcp gymnasium toppra ruckig cyclonedds"
)
"""Packages that urdfkit uses, of all extras."""

_VARIABLES = "ROS_DISTRO ROS_PACKAGE_PATH AMENT_PREFIX_PATH GZ_SIM_RESOURCE_PATH GAZEBO_MODEL_PATH NUMBA_CACHE_DIR"


def report() -> str:
    """Return the report; it contains no names of users, because folders in the home folder begin with ``~``."""
    lines = [
        f"urdfkit {__version__}",
        f"Python {platform.python_version()} ({platform.python_implementation()}), {sys.executable}",
        f"{platform.platform()}, {platform.machine()}, {os.cpu_count()} processors",
        f"installed in {Path(__file__).parents[2]}",
    ]
    found = []
    for name in PACKAGES.split():
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            found.append(f"{name} not installed")
    lines += [f"  {each}" for each in found]
    lines += [f"  {name}={os.environ[name]}" for name in _VARIABLES.split() if name in os.environ]
    home = str(Path.home())
    return "\n".join(line.replace(home, "~") if len(home) > 1 else line for line in lines)
