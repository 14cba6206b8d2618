"""CPU time of the commands for generated files of n and 4 n elements: a pass that compares all pairs takes 16 times.

Run it as ``python tests/bench/growth.py [--size N] [--command COMMAND]… [FAMILY]…``. It prints one row for each family
of files and command: seconds of CPU at n and at 4 n, the ratio without the time of an empty robot, and the memory.
A ratio above 6, or more than the budget of the command, is marked.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

Files = dict[str, str]
"""Path in the package → content; the entry is the first one."""

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
BUDGET = 20.0
"""Seconds of CPU after which a run is stopped."""
LOADING_BUDGET = 80.0
"""Seconds of CPU after which a run that loads meshes, builds a model or simulates is stopped."""
LOADING = ("info", "tf", "view", "sim")
MAX_RATIO = 6.0
ROOT = Path(__file__).parents[2]


def link(name: str, inside: str = "") -> str:
    """Return a link with mass and a box."""
    return (
        f'<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" '
        f'iyz="0"/></inertial><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>{inside}</link>\n'
    )


def joint(name: str, parent: str, child: str, kind: str = "fixed", inside: str = "") -> str:
    """Return a joint."""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>'
        f'<limit lower="-1" upper="1" effort="1" velocity="1"/>{inside}</joint>\n'
    )


def urdf(*parts: str) -> Files:
    """Return a package with one URDF."""
    return {"urdf/robot.urdf": f'<robot name="r">\n<link name="base"/>\n{"".join(parts)}</robot>\n'}


def xacro(*parts: str) -> Files:
    """Return a package with one xacro file."""
    return {"urdf/robot.urdf.xacro": f'<robot name="r" {XACRO}>\n<link name="base"/>\n{"".join(parts)}</robot>\n'}


def similar(n: int) -> list[str]:
    """Return n names that differ in a few letters."""
    return [f"front_left_wheel_link_{number:05}" for number in range(n)]


def misspelt(n: int) -> list[str]:
    """Return n names that resemble those of `similar`."""
    return [f"front_left_whel_lnk_{number:05}x" for number in range(n)]


def star(names: Sequence[str], kind: str = "fixed") -> str:
    """Return a link for each name and the joint that attaches it to the base."""
    return "".join(link(name) + joint(f"{name}_joint", "base", name, kind) for name in names)


def chain(names: Sequence[str], kind: str = "fixed") -> str:
    """Return links that hang from one another."""
    parents = ["base", *names]
    return "".join(
        link(name) + joint(f"{name}_joint", parent, name, kind) for name, parent in zip(names, parents, strict=False)
    )


def controllers(n: int, joints: Sequence[str]) -> str:
    """Return controller settings with n controllers."""
    rows = ["controller_manager:", "  ros__parameters:", "    update_rate: 100"]
    for number in range(n):
        rows += [f"    arm_{number}:", "      type: joint_trajectory_controller/JointTrajectoryController"]
    for number in range(n):
        rows += [f"arm_{number}:", "  ros__parameters:", f"    joints: [{joints[number]}]"]
        rows += ["    command_interfaces: [position]", "    state_interfaces: [position]"]
    return "\n".join(rows) + "\n"


CONTROL = (
    '<ros2_control name="c" type="system"><hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>{}'
    '</ros2_control><gazebo><plugin filename="gz_ros2_control-system" '
    'name="gz_ros2_control::GazeboSimROS2ControlPlugin"><parameters>$(find r_description)/config/c.yaml</parameters>'
    "</plugin></gazebo>"
)


def control_joint(name: str) -> str:
    """Return a joint of ``<ros2_control>``."""
    return f'<joint name="{name}"><command_interface name="position"/><state_interface name="position"/></joint>\n'


def with_controllers(yaml: str, joints: Sequence[str] = (), ros2: Sequence[str] = ()) -> Files:
    """Return a package with a robot and the settings of its controllers."""
    robot = xacro(star(joints, "revolute"), CONTROL.format("".join(map(control_joint, ros2))))
    return {**robot, "config/c.yaml": yaml}


def undefined_parents(n: int) -> Files:
    """Joints with misspelt parents."""
    names, wrong = similar(n), misspelt(n)
    return urdf(*map(link, names), *(joint(f"j{i}", wrong[i], names[i]) for i in range(n)))


def undefined_children(n: int) -> Files:
    """Joints with misspelt children."""
    return urdf(star(similar(n)), *(joint(f"j{i}", "base", name) for i, name in enumerate(misspelt(n))))


def misspelt_children(n: int) -> Files:
    """Return n roots, and joints whose children are these roots, misspelt."""
    children = (joint(f"j{i}", "base", name) for i, name in enumerate(misspelt(n)))
    return urdf(*(link(name) for name in similar(n)), *children)


def undefined_references(n: int) -> Files:
    """Tags <gazebo> with misspelt references."""
    tags = (f'<gazebo reference="{name}"><mu1>1</mu1></gazebo>\n' for name in misspelt(n))
    return urdf(star(similar(n)), *tags)


def undefined_mimics(n: int) -> Files:
    """Joints that mimic misspelt joints."""
    names, wrong = similar(n), misspelt(n)
    return urdf(
        *(
            link(name) + joint(name, "base", name, "revolute", f'<mimic joint="{other}"/>')
            for name, other in zip(names, wrong, strict=True)
        )
    )


def undefined_materials(n: int) -> Files:
    """Visuals with misspelt materials."""
    defined = "".join(f'<material name="{name}"><color rgba="1 0 0 1"/></material>\n' for name in similar(n))
    shape = '<visual><geometry><box size="1 1 1"/></geometry><material name="{}"/></visual>'
    return urdf(
        defined, '<link name="a">', *(shape.format(name) for name in misspelt(n)), "</link>", joint("j", "base", "a")
    )


def undefined_transmissions(n: int) -> Files:
    """Transmissions of misspelt joints."""
    text = (
        '<transmission name="t{}"><type>transmission_interface/SimpleTransmission</type><joint name="{}">'
        "<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>"
        '<actuator name="m{}"/></transmission>\n'
    )
    return urdf(star(similar(n), "revolute"), *(text.format(i, name, i) for i, name in enumerate(misspelt(n))))


def undefined_ros2_control(n: int) -> Files:
    """Joints of <ros2_control> that the robot lacks."""
    return with_controllers(controllers(1, ["x"]), similar(n), misspelt(n))


def undefined_controllers(n: int) -> Files:
    """Controllers of misspelt joints."""
    return with_controllers(controllers(n, misspelt(n)), similar(n), similar(n))


def valid_controllers(n: int) -> Files:
    """Controllers of joints that exist."""
    return with_controllers(controllers(n, similar(n)), similar(n), similar(n))


def one_joint_controllers(n: int) -> Files:
    """Controllers that all command the same joint."""
    return with_controllers(controllers(n, ["a"] * n), ["a"], ["a"])


def unknown_parameters(n: int) -> Files:
    """One controller with misspelt parameters."""
    rows = "".join(f"    command_interfces_{i}: [position]\n" for i in range(n))
    return with_controllers(controllers(1, ["a"]) + rows, ["a"], ["a"])


def deep_yaml(n: int) -> Files:
    """Controller settings nested n deep."""
    return with_controllers(f"a: {'[' * n}{']' * n}\n", ["a"], ["a"])


def indented_yaml(n: int) -> Files:
    """Controller settings with n levels of mappings."""
    return with_controllers("".join(f"{' ' * i}a:\n" for i in range(min(n, 900))) + " " * 1000 + "b: 1\n", ["a"], ["a"])


def merging_yaml(n: int) -> Files:
    """Controller settings whose merge keys double each level."""
    rows = ["a0: &a0 {x: 1}"]
    rows += [f"a{i}: &a{i} {{<<: [*a{i - 1}, *a{i - 1}], k{i}: 1}}" for i in range(1, n)]
    return with_controllers("\n".join(rows) + "\n", ["a"], ["a"])


def alias_yaml(n: int) -> Files:
    """Controller settings whose aliases multiply at each level."""
    rows = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    rows += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, min(n, 9))]
    rows += [f"b{i}: *a0" for i in range(n)]
    joints = f"arm:\n  ros__parameters:\n    joints: *a{min(n, 9) - 1}\n"
    return with_controllers(controllers(1, ["a"]) + "\n".join(rows) + "\n" + joints, ["a"], ["a"])


def duplicate_links(n: int) -> Files:
    """Links with the same name."""
    return urdf(link("a") * n, joint("j", "base", "a"))


def duplicate_joints(n: int) -> Files:
    """Joints with the same name."""
    names = similar(n)
    return urdf(*map(link, names), *(joint("j", "base", name) for name in names))


def same_child(n: int) -> Files:
    """Joints with the same child."""
    names = similar(n)
    return urdf(star(names), link("a"), *(joint(f"j{i}", name, "a") for i, name in enumerate(names)))


def several_roots(n: int) -> Files:
    """Links without joints."""
    return urdf(*map(link, similar(n)))


def one_cycle(n: int) -> Files:
    """Links in one cycle."""
    names = similar(n)
    return urdf(*map(link, names), *(joint(f"j{i}", names[i - 1], names[i]) for i in range(n)))


def small_cycles(n: int) -> Files:
    """Pairs of links that hang from each other."""
    names = similar(n)
    pairs = zip(names[::2], names[1::2], strict=False)
    return urdf(*map(link, names), *(joint(f"{a}1", a, b) + joint(f"{a}2", b, a) for a, b in pairs))


def long_chain(n: int) -> Files:
    """Links in one chain."""
    return urdf(chain(similar(n)))


def moving_star(n: int) -> Files:
    """Moving links on one base."""
    return urdf(star(similar(n), "revolute"))


def mimic_chain(n: int) -> Files:
    """Joints each of which mimics the next one."""
    parts = [
        link(f"l{i}") + joint(f"j{i}", "base", f"l{i}", "revolute", f'<mimic joint="j{i + 1}"/>' if i < n - 1 else "")
        for i in range(n)
    ]
    return urdf(*parts)


def suppressions(n: int) -> Files:
    """Suppressions, most of them unused."""
    return urdf(*(link(name) + "<!-- urdfkit: ignore I503 -->\n<!-- urdfkit: ignore T101 -->\n" for name in similar(n)))


def file_suppressions(n: int) -> Files:
    """Suppressions of the whole file and findings for them."""
    return urdf("<!-- urdfkit: ignore-file T101 -->\n" * n, *map(link, similar(n)))


def unknown_suppressions(n: int) -> Files:
    """Suppressions of unknown codes."""
    return urdf(*(f"<!-- urdfkit: ignore Q{i} -->\n" for i in range(n)))


def overlapping_shapes(n: int) -> Files:
    """Shapes at the same place of one link."""
    shape = '<collision name="{0}"><geometry><box size="1 1 1"/></geometry></collision>'
    return urdf(f'<link name="a">{"".join(shape.format(i) for i in range(n))}</link>', joint("j", "base", "a"))


def unnamed_shapes(n: int) -> Files:
    """Shapes without names or with the same name."""
    shape = '<visual name="v"><geometry><box size="1 1 1"/></geometry></visual>\n'
    return urdf(f'<link name="a">{shape * n}</link>', joint("j", "base", "a"))


def missing_meshes(n: int) -> Files:
    """Meshes that do not exist."""
    shape = '<visual><geometry><mesh filename="package://r_description/meshes/{}.stl"/></geometry></visual>\n'
    links = (f'<link name="a">{"".join(shape.format(name) for name in misspelt(n))}</link>', joint("j", "base", "a"))
    return {**urdf(*links), **{f"meshes/{name}.dae": "" for name in similar(min(n, 2000))}}


def missing_packages(n: int) -> Files:
    """Meshes in packages that do not exist."""
    shape = '<visual><geometry><mesh filename="package://{}/a.stl"/></geometry></visual>\n'
    return urdf(f'<link name="a">{"".join(map(shape.format, misspelt(n)))}</link>', joint("j", "base", "a"))


def unknown_plugins(n: int) -> Files:
    """Gazebo plugins with misspelt files."""
    plugin = '<gazebo><plugin name="p{0}" filename="libgazebo_ros_dif_drive{0}.so"/></gazebo>\n'
    return urdf(*(plugin.format(i) for i in range(n)))


def same_topics(n: int) -> Files:
    """Sensors that publish on the same topic, with the same name."""
    sensor = (
        '<gazebo reference="base"><sensor name="s" type="gpu_lidar"><topic>scan</topic><update_rate>10</update_rate>'
        "</sensor></gazebo>\n"
    )
    return urdf(sensor * n)


def diff_drives(n: int) -> Files:
    """Drives that use the same wheels."""
    drive = (
        '<gazebo><plugin name="d{0}" filename="gz-sim-diff-drive-system"><left_joint>{1}</left_joint><right_joint>{2}'
        "</right_joint><wheel_separation>1</wheel_separation><wheel_radius>0.1</wheel_radius></plugin></gazebo>\n"
    )
    names, wrong = similar(n), misspelt(n)
    return urdf(star(names, "continuous"), *(drive.format(i, f"{names[i]}_joint", wrong[i]) for i in range(n)))


def unknown_tags(n: int) -> Files:
    """Misspelt tags and attributes."""
    return urdf(*(f'<lnk{i} name="{name}"/>\n<link nam{i}="x"/>\n' for i, name in enumerate(similar(n))))


def undefined_properties(n: int) -> Files:
    """Uses of misspelt properties."""
    defined = "".join(f'<xacro:property name="{name}" value="1"/>\n' for name in similar(n))
    return xacro(defined, *(f'<link name="${{{name}}}"/>\n' for name in misspelt(n)))


def undefined_macros(n: int) -> Files:
    """Calls of misspelt macros."""
    defined = "".join(f'<xacro:macro name="{name}" params="a"><link name="x"/></xacro:macro>\n' for name in similar(n))
    return xacro(defined, *(f'<xacro:{name} a="1"/>\n' for name in misspelt(n)))


def undefined_parameters(n: int) -> Files:
    """Calls with misspelt parameters."""
    defined = f'<xacro:macro name="m" params="{" ".join(f"{name}:=1" for name in similar(n // 8))}"/>\n'
    return xacro(defined, *(f'<xacro:m {name}="1"/>\n' for name in misspelt(n)))


def undefined_arguments(n: int) -> Files:
    """Uses of misspelt arguments."""
    defined = "".join(f'<xacro:arg name="{name}" default="1"/>\n' for name in similar(n))
    return xacro(defined, *(f'<link name="$(arg {name})"/>\n' for name in misspelt(n)))


def unprefixed_directives(n: int) -> Files:
    """Directives and calls without the prefix."""
    defined = "".join(f'<xacro:macro name="{name}" params=""><link name="x"/></xacro:macro>\n' for name in similar(n))
    return xacro(defined, *(f"<{name}/>\n<propert{i} name='a' value='1'/>\n" for i, name in enumerate(similar(n))))


def redefined_properties(n: int) -> Files:
    """Properties defined again, unused."""
    return xacro(
        '<xacro:property name="a" value="1"/>\n' * n,
        *(f'<xacro:property name="{name}" value="1"/>\n' for name in similar(n)),
    )


def missing_includes(n: int) -> Files:
    """Includes of missing files."""
    return xacro(*(f'<xacro:include filename="{name}.xacro"/>\n' for name in misspelt(min(n, 1900))))


def included_files(n: int) -> Files:
    """Includes of many files."""
    names = similar(min(n, 1900))
    inside = f'<robot {XACRO}><xacro:property name="a" value="1"/></robot>'
    includes = xacro(*(f'<xacro:include filename="{name}.xacro"/>\n' for name in names))
    return {**includes, **{f"urdf/{name}.xacro": inside for name in names}}


def macro_expansions(n: int) -> Files:
    """Calls of one macro with a defect inside."""
    macro = (
        '<xacro:macro name="m" params="n"><link name="l"/><joint name="j${n}" type="fixd"><parent link="bse"/></joint>'
        "</xacro:macro>\n"
    )
    return xacro(macro, *(f'<xacro:m n="{i}"/>\n' for i in range(n)))


def launch_files(n: int) -> Files:
    """Launch files and nodes with remappings of similar topics."""
    node = (
        '<node pkg="r_description" exec="{0}" name="{0}"><remap from="{0}" to="{0}s"/><param name="{0}" value="1"/>'
        "</node>\n"
    )
    text = f"<launch>{''.join(map(node.format, misspelt(n)))}</launch>"
    return {**urdf(star(similar(n))), "launch/a.launch.xml": text, "launch/b.launch": text}


def dependencies(n: int) -> Files:
    """Dependencies of the package."""
    names = "".join(f"<exec_depend>{name}</exec_depend>" for name in similar(n))
    return {**missing_packages(n), "package.xml": MANIFEST.format(names)}


MANIFEST = (
    '<package format="3"><name>r_description</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.c">m</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>'
    "{}<export><build_type>ament_cmake</build_type></export></package>"
)

FAMILIES: dict[str, Callable[[int], Files]] = {
    family.__name__: family
    for family in (
        undefined_parents, undefined_children, misspelt_children, undefined_references, undefined_mimics,
        undefined_materials, undefined_transmissions, undefined_ros2_control, undefined_controllers, valid_controllers,
        one_joint_controllers, unknown_parameters, deep_yaml, indented_yaml, merging_yaml, alias_yaml,
        duplicate_links, duplicate_joints, same_child, several_roots, one_cycle, small_cycles, long_chain, moving_star,
        mimic_chain, suppressions, file_suppressions, unknown_suppressions, overlapping_shapes, unnamed_shapes,
        missing_meshes, missing_packages, unknown_plugins, same_topics, diff_drives, unknown_tags,
        undefined_properties, undefined_macros, undefined_parameters, undefined_arguments, unprefixed_directives,
        redefined_properties, missing_includes, included_files, macro_expansions, launch_files, dependencies,
    )
}  # fmt: skip

LSP = """
import sys
from pathlib import Path
from urdfkit.lint.editor.open_files import Project
from urdfkit.lint.project.options import Options
path = Path(sys.argv[1]).resolve()
project = Project(Options())
text = path.read_text()
for version in range(3):
    project.set_text(path, text.replace("<robot ", "<robot " + " " * version, 1))
    project.findings(path)
"""

COMMANDS: dict[str, Sequence[str]] = {
    "lint": ("-m", "urdfkit", "lint", "--no-cache", "{}"),
    "expand": ("-m", "urdfkit", "expand", "{}"),
    "lsp": ("-c", LSP, "{}"),
    "info": ("-m", "urdfkit", "info", "{}"),
    "tf": ("-m", "urdfkit", "tf", "{}"),
    "view": ("-m", "urdfkit", "view", "{}", "--html", "r.html"),
    "sim": ("-m", "urdfkit", "sim", "run", "{}", "--for", "0.01"),
}
"""Command → its arguments; ``{}`` is the file."""


def write(folder: Path, files: Files) -> Path:
    """Write a package; return the path of its entry."""
    for name, content in {"package.xml": MANIFEST.format(""), **files}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
    return folder / next(iter(files))


def budget_of(command: str) -> float:
    """Return the seconds of CPU after which a run of a command is stopped."""
    return LOADING_BUDGET if command in LOADING else BUDGET


def measured(command: str, files: Files) -> tuple[float, float, int, str]:
    """Return CPU [s], memory [MB], exit status and the last line of the errors."""
    budget = int(budget_of(command))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "r_description"
        entry = write(folder, files)
        words = [word.format(entry) if word == "{}" else word for word in COMMANDS[command]]
        with (folder / "out").open("wb") as out, (folder / "err").open("wb") as err:
            process = subprocess.Popen(
                [sys.executable, *words],
                cwd=folder,
                env={**os.environ, "PYTHONPATH": str(ROOT), "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME", "")},
                stdout=out,
                stderr=err,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (budget, budget)),
            )
            _, status, used = os.wait4(process.pid, 0)
        lines = (folder / "err").read_text(errors="replace").splitlines() or [""]
        return used.ru_utime + used.ru_stime, used.ru_maxrss / 1000, os.waitstatus_to_exitcode(status), lines[-1]


def main(words: Sequence[str] | None = None) -> int:
    """Measure and print; return 1 if a command exceeds its limits."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("families", nargs="*", choices=[[], *FAMILIES])
    parser.add_argument("--size", type=int, default=500)
    parser.add_argument("--command", action="append", choices=COMMANDS)
    arguments = parser.parse_args(words)
    failed = False
    for command in arguments.command or COMMANDS:
        base = measured(command, urdf())[0]
        for name in arguments.families or FAMILIES:
            small = measured(command, FAMILIES[name](arguments.size))
            large = measured(command, FAMILIES[name](4 * arguments.size))
            ratio = (large[0] - base) / max(small[0] - base, 0.05)
            slow = ratio > MAX_RATIO or large[0] > budget_of(command) or large[2] not in (0, 1, 2)
            failed |= slow
            print(
                f"{command:7}{name:24}{small[0]:7.2f} s{large[0]:7.2f} s  ×{ratio:5.1f} {large[1]:6.0f} MB  "
                f"{large[2]:4} {'SLOW ' if slow else ''}{large[3][:70]}",
                flush=True,
            )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
