"""Parameters of ROS 1 nodes in XML launch files: types, values, former names and order.

Sources (Noetic): ros-planning/navigation (amcl_node.cpp, costmap_2d_ros.cpp), ros-perception/slam_gmapping
(slam_gmapping.cpp), ros-teleop/teleop_twist_joy (teleop_twist_joy.cpp), cra-ros-pkg/robot_localization
(ros_filter.cpp).
"""

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.facts.navigation.tables import DIFFERENT_FRAMES, ORDERED
from urdfkit.lint.facts.parameters.schemas import OF_ROS1

Defects = Iterator[tuple[Named, str]]

_CHOICES = {
    ("amcl", "odom_model_type"): ("diff", "omni", "diff-corrected", "omni-corrected"),
    ("amcl", "laser_model_type"): ("beam", "likelihood_field", "likelihood_field_prob"),
}

_NUMBERS = {
    "amcl": """min_particles max_particles kld_err kld_z update_min_d update_min_a resample_interval transform_tolerance
    recovery_alpha_slow recovery_alpha_fast initial_pose_x initial_pose_y initial_pose_a gui_publish_rate save_pose_rate
    laser_min_range laser_max_range laser_max_beams laser_z_hit laser_z_short laser_z_max laser_z_rand laser_sigma_hit
    laser_lambda_short laser_likelihood_max_dist odom_alpha1 odom_alpha2 odom_alpha3 odom_alpha4 odom_alpha5""",
    "gmapping": """map_update_interval maxUrange maxRange sigma kernelSize lstep astep iterations lsigma ogain lskip
    minimumScore srr srt str stt linearUpdate angularUpdate temporalUpdate resampleThreshold particles xmin ymin xmax
    ymax delta llsamplerange llsamplestep lasamplerange lasamplestep transform_publish_period occ_thresh""",
    "teleop_twist_joy": "enable_button enable_turbo_button scale_linear scale_linear_turbo scale_angular",
    "robot_localization": "frequency sensor_timeout",
}
"""Package → parameters that are numbers."""

_FRAMES = ({"odom_frame", "odom_frame_id"}, {"map_frame", "global_frame_id"})


def parameters_in_launch(source: Source) -> Iterator[tuple[str, dict[str, tuple[Named, Named]]]]:
    """Yield the package of each node of a launch file and its parameters: name → name and value with their places."""
    for element in all_elements(source):
        package = element.attributes.get("pkg")
        if element.tag != "node" or package is None:
            continue
        found = {}
        for child in element.children:
            name, value = (child.attributes.get(each) for each in ("name", "value"))
            if child.tag == "param" and name is not None and value is not None:
                found[name.name] = (name, value)
        if found:
            yield package.name, found


def launch_parameter_defects(source: Source) -> Defects:
    """Yield the defects of the parameters of nodes in a ROS 1 launch file, at the value or name."""
    if not reads_ros1(source):
        return
    for package, written in parameters_in_launch(source):
        renamed, numbers = OF_ROS1.get(package, {}), _NUMBERS.get(package, "").split()
        for name, (key, value) in written.items():
            right, text = renamed.get(name), value.name.strip()
            if right is not None and right not in written:
                yield key, f"`{package}` has no parameter `{name}`" + Suggestion(right, name)
            choices = _CHOICES.get((package, name), ())
            if choices and text not in choices and "$" not in text:
                hint = Suggestion(nearest(text, choices), text) or f"; write one of {', '.join(choices)}"
                yield value, f"unknown `{name}` `{text}` of {package}" + hint
            if name in numbers and "$" not in text and _number(text) is None:
                yield value, f"`{name}` is `{text}`, which is not a number"
        for low, high in (*ORDERED, ("min_particles", "max_particles")):
            if low in written and high in written:
                least, most = (_number(written[each][1].name) for each in (low, high))
                if least is not None and most is not None and least > most:
                    yield written[low][1], f"`{low}` is {least:g}, more than `{high}`, {most:g}"
        for first, second in DIFFERENT_FRAMES:
            frames = [written[name][1] for name in (first, second) if name in written]
            if len(frames) == 2 and frames[0].name == frames[1].name and "$" not in frames[0].name:
                is_first = frames[1].name == "odom" and not first.startswith("odom")
                wrong = frames[0] if is_first else frames[1]
                yield wrong, f"`{first}` and `{second}` are both `{wrong.name}`"
        odom, world = ([written[name][1] for name in names if name in written] for names in _FRAMES)
        if odom and world and (odom[0].name, world[0].name) == ("map", "odom"):
            yield odom[0], "the odometry frame is `map` and the map frame is `odom`; swap them"


def _number(text: str) -> float | None:
    return float(text) if re.fullmatch(r"\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?\s*", text) else None
