"""Common odometry parameters of drives: topics, frames, covariances and the source of the pose."""

from urdfkit.sim.plugins.odometry import OdometryTopics
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics

HUGE = 1e12
"""Variance of quantities that odometry does not measure, as gazebo_ros_diff_drive writes it."""


def odometry_topics(
    setup: Setup,
    read: Parameters,
    topics: Topics,
    *,
    published: bool,
    with_tf: bool,
    twist_covariance: bool = False,
    flat: bool = False,
) -> OdometryTopics:
    """Return the odometry topics of a drive.

    Args:
        setup: setup of the drive.
        read: parameters of the drive; topics and covariance default to those of gazebo_ros_diff_drive.
        topics: topic names of the drive.
        published: publish the odometry message.
        with_tf: publish the transform.
        twist_covariance: the twist has the same variances as the pose.
        flat: set the height in the message to zero.
    """
    gz = read.generation == "gz"
    x, y, yaw = (
        read.number(f"covariance_{part}", default) for part, default in (("x", 1e-5), ("y", 1e-5), ("yaw", 1e-3))
    )
    covariance = None if gz else (x, y, HUGE, HUGE, HUGE, yaw)
    return OdometryTopics(
        setup.bus,
        topic=topics.resolve(read.text("odometry_topic", "odom")) if published else None,
        tf_topic=(topics.resolve(read.text("tf_topic")) if gz else "/tf") if with_tf else None,
        frame=read.text("odometry_frame"),
        child=read.text("base_frame"),
        covariance=covariance,
        twist_covariance=covariance if twist_covariance else None,
        flat=flat,
    )


def by_encoder(read: Parameters) -> bool:
    """Return whether odometry comes from the wheels, not from the world.

    Raises:
        SimulationError: unknown odometry source.
    """
    return read.choice("odometry_source", "encoder") in ("encoder", "0")
