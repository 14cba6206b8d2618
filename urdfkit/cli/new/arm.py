"""``urdfkit new arm``: add an arm to an existing description."""

import argparse
import sys

from urdfkit.cli.new.change_workflow import add_description, apply, description, vector

SUMMARY = "an arm for an existing description"
_SIZES = {"reach": "arm_reach", "mass": "arm_mass", "payload": "payload", "finger_travel": "finger_travel"}


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.description = "add an arm of three to seven joints: a macro in a separate file, one include, one call"
    parser.epilog = (
        "examples:\n"
        "  urdfkit new arm --into scout_description --dof 6 --gripper\n"
        "  urdfkit new arm --into base.urdf.xacro --name left --xyz 0.1 0.2 0.3 --diff"
    )
    add_description(parser)
    parser.add_argument("--dof", choices=("3", "4", "5", "6", "7"), default="6", metavar="N", help="joints, 3 to 7")
    parser.add_argument(
        "--name",
        help="name of the arm and, unless it is `arm`, prefix of its links and joints (default: arm, then arm_2 …)",
    )
    parser.add_argument(
        "--parent", metavar="LINK", help="link to mount the arm on (default: base_link, or the heaviest link)"
    )
    parser.add_argument("--xyz", nargs=3, metavar="M", help="position in LINK [m] (default: a free place on top)")
    parser.add_argument("--rpy", nargs=3, metavar="RAD", default=["0", "0", "0"], help="roll, pitch, yaw [rad]")
    parser.add_argument(
        "--reach", metavar="M", help="distance from shoulder to tool [m] (default: proportional to the size of LINK)"
    )
    parser.add_argument("--mass", metavar="KG", help="mass of the arm [kg]")
    parser.add_argument("--payload", metavar="KG", help="payload, including the gripper [kg]")
    parser.add_argument("--gripper", action="store_true", help="add a gripper with two parallel fingers")
    parser.add_argument("--finger-travel", metavar="M", help="travel of each finger [m]")


def run(arguments: argparse.Namespace) -> int:
    """Load the description, add the arm, lint, print or write the change.

    Raises:
        UrdfkitError: the arm could not be added; nothing was written.
    """
    from urdfkit.resources import templates_dir
    from urdfkit.scaffold import load_template
    from urdfkit.scaffold.additions.arm import OPTIONS, ArmRequest, add_arm

    template = load_template(templates_dir() / "robot", options=OPTIONS)
    answers = {"arm": arguments.dof, "gripper": "yes" if arguments.gripper else "no"}
    for option, question in _SIZES.items():
        if (value := getattr(arguments, option)) is not None:
            answers[question] = template.question(question).accept(value)
    model, robot, generation = description(arguments)
    xyz = None if arguments.xyz is None else vector(arguments.xyz, "--xyz")
    # Gazebo Classic ignores mimic joints: with ROS 1 both fingers have a motor, as in new robots.
    answers["ros"] = "noetic" if generation == "classic" else "none"
    request = ArmRequest(arguments.name, answers, arguments.parent, xyz, vector(arguments.rpy, "--rpy"))
    alterations, notes = add_arm(robot, model.path, request)
    for note in () if arguments.quiet else notes:
        print(f"urdfkit: {note}", file=sys.stderr)
    code = apply(alterations, model, arguments)
    if not arguments.quiet and not arguments.diff:
        print(f"  urdfkit new controllers --into {arguments.into or '.'}")
    return code
