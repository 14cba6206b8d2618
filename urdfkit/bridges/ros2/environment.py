"""Variables of ROS 2: the domain, how far discovery reaches, and the transports of Fast DDS."""

import os
from collections.abc import Mapping, MutableMapping
from importlib.util import find_spec
from pathlib import Path

from urdfkit.errors import UsageError

HIGHEST_DOMAIN = 232
RANGE, LOCALHOST_ONLY, DOMAIN = "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY", "ROS_DOMAIN_ID"
BEFORE_RANGE = ("dashing", "eloquent", "foxy", "galactic", "humble")
"""Distributions that read only ``ROS_LOCALHOST_ONLY``."""
WITH_FAST_DDS_2 = (*BEFORE_RANGE, "iron", "jazzy")
PROFILES, PROFILES_2 = "FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE"
"""Variable with the profiles of Fast DDS 3, and that of Fast DDS 2."""
TRANSPORTS = "FASTDDS_BUILTIN_TRANSPORTS"


def ros_domain(requested: int | None, environment: Mapping[str, str] = os.environ) -> int:
    """Return the ROS domain: the requested one, else that of ``ROS_DOMAIN_ID``, else 0.

    Raises:
        UsageError: it is not a number from 0 to 232.
    """
    text = str(requested) if requested is not None else environment.get(DOMAIN) or "0"
    name = "--ros-domain" if requested is not None else DOMAIN
    if not text.isdecimal() or int(text) > HIGHEST_DOMAIN:
        raise UsageError(f"{name} is `{text}`; a ROS domain is a number from 0 to {HIGHEST_DOMAIN}")
    return int(text)


def on_this_machine(environment: Mapping[str, str] = os.environ) -> bool:
    """Return whether discovery stays on this machine: unless a variable of ROS extends it, it does.

    Raises:
        UsageError: the variable switches discovery off, or has an unknown value.
    """
    value = environment.get(RANGE)
    if value is None:
        return environment.get(LOCALHOST_ONLY, "1") != "0"
    if value not in ("LOCALHOST", "SUBNET", "SYSTEM_DEFAULT"):
        reason = "switches discovery off" if value == "OFF" else "is unknown"
        raise UsageError(f"{RANGE}={value} {reason}; use LOCALHOST, SUBNET or SYSTEM_DEFAULT")
    return value == "LOCALHOST"


def keep_on_this_machine(environment: MutableMapping[str, str] = os.environ) -> None:
    """Set the variable that limits the discovery of rclpy to this machine, unless the user has set one."""
    if on_this_machine(environment) and not {RANGE, LOCALHOST_ONLY} & environment.keys():
        if environment.get("ROS_DISTRO") in BEFORE_RANGE:
            environment[LOCALHOST_ONLY] = "1"
        else:
            environment[RANGE] = "LOCALHOST"


def share_long_messages(environment: MutableMapping[str, str] = os.environ) -> None:
    """Set the variable by which Fast DDS shares memory for several images, unless the user has configured Fast DDS."""
    if not {PROFILES, PROFILES_2, TRANSPORTS} & environment.keys():
        distribution = environment.get("ROS_DISTRO")
        old = distribution in WITH_FAST_DDS_2 if distribution else find_spec("fastrtps") is not None  # of the wheels
        environment[PROFILES_2 if old else PROFILES] = str(Path(__file__).parent / "fastdds_profiles.xml")
