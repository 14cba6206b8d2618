"""M108 moveit-name-undefined."""

import re

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, span_of, yamls
from urdfkit.lint.finding import Finding
from urdfkit.lint.fix_builders import meant, nearest
from urdfkit.lint.model.masked_names import is_typo, unless_masked
from urdfkit.lint.rule import Findings, Model, RobotRule


class MoveitNameUndefined(RobotRule):
    """MoveIt's settings in YAML, or code that plans, name a group, state, joint or controller that does not exist.

    ## What it does
    Checks YAML files in packages with an SRDF of the robot for:

    - groups with a kinematics solver that the SRDF does not define
    - joints of ``joint_limits`` and of controllers, if the robot does not have them
    - poses in the ``initial`` list of the fake controllers that are not states of their group
    - names in ``controller_names`` without a section
    - controllers that no YAML file of these packages defines: misspelt names, and in ROS 1 names without their
      namespace

    Also checks the groups, named states, joints and end effectors that Python and C++ code passes to MoveIt, if the
    packages have one SRDF.

    ## Why is this bad?
    MoveIt ignores settings of unknown groups and joints, and logs "No kinematics plugins defined". It does not execute
    a trajectory for joints without a controller.

    ## Example
    ```diff
    -amr:
    +arm:
       kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "M108"
    name = "moveit-name-undefined"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined name."""
        from urdfkit.lint.facts.control.controller_joints import controllers
        from urdfkit.lint.facts.moveit.code_names import undefined_in_code
        from urdfkit.lint.facts.moveit.initial_poses import undefined_poses
        from urdfkit.lint.facts.moveit.settings import controller_names, entries, moveit_yamls
        from urdfkit.lint.facts.moveit.srdf import groups, virtual_joints

        for code, named, message in undefined_in_code(model):
            yield self.at_span(code.span(named.start, named.end), message)
        started: list[str] | None = None
        for source, root in moveit_yamls(model):
            for pose, message, states in undefined_poses(source, root):
                yield self._at(source, pose, message, states)
            for entry in entries(source):
                if entry.kind == "group" and (name := entry.name.text) not in (defined := groups(root)):
                    yield self._at(source, entry.name, f"group `{name}` does not exist in the SRDF", defined)
                elif entry.kind == "joint":
                    yield from self._joint(source, entry.name, model, virtual_joints(root))
                elif entry.kind == "controller":
                    joints = entry.settings.find("joints")
                    # In a file with controllers of ros_control, controller-joint-undefined reports joints.
                    for joint in joints.items if joints is not None and not controllers(source) else ():
                        yield from self._joint(source, joint, model, {})
                    if started is None:
                        started = [name for other in yamls(model) for name in controllers(other)]
                    name = entry.name.last_name
                    if name not in started:
                        yield from self._near(source, entry.name, f"unknown controller `{name}`", name, started)
                    elif "controller_list" in source.text:
                        yield from self._namespace(source, entry.name, model)
            for names, sections in controller_names(source):
                defined_names = [node.text for node in sections]
                for node in names:
                    if node.text not in defined_names:
                        yield self._at(source, node, f"controller `{node.text}` has no section", defined_names)
                unlisted = [node for node in sections if node.text not in [name.text for name in names]]
                if len(names) == len(sections) and len(unlisted) == 1:
                    continue
                for node in unlisted:
                    message = f"controller `{node.text}` is not in `controller_names`; MoveIt does not use it"
                    yield self._at(source, names[-1] if names and len(unlisted) == 1 else node, message, ())

    def _joint(self, source: Source, node: Node, model: Model, others: object) -> Findings:
        name, robot = node.text, model.robot
        if not name or name in robot.joint_by_name or name in others:  # type: ignore[operator]
            return
        if model.neighbouring_descriptions.define("joint", name):
            return
        finding = self._at(source, node, f"joint `{name}` does not exist in robot `{robot.name}`", robot.joint_by_name)
        suggestion, _ = meant(name, robot.joint_by_name)
        yield from unless_masked(
            model, name, suggestion, Finding(**{**finding.__dict__, "joint": name, "kind": "joint"})
        )

    def _near(self, source: Source, node: Node, message: str, name: str, defined: list[str]) -> Findings:
        """Yield a finding if the name is a misspelling of a defined name."""
        near = nearest(name, defined, cutoff=0.8)
        if near is not None and is_typo(name, near):
            yield self._at(source, node, message, [near])

    def _namespace(self, source: Source, node: Node, model: Model) -> Findings:
        """Yield a finding if the parameters of a ROS 1 controller are in a namespace that its name lacks."""
        from urdfkit.lint.facts.control.launched_nodes import launches
        from urdfkit.lint.facts.control.spawned_namespaces import paths_of_controllers

        name = node.text.strip("/")
        paths = ["/".join(key.text for key in path) for other in yamls(model) for path in paths_of_controllers(other)]
        longer = [path for path in paths if path.endswith(f"/{name}")]
        if name not in paths and "/" in name:
            yield from self._near(source, node, f"unknown controller `{name}`", name, paths)
        if name in paths or not longer or "ros__parameters" in longer[0]:  # ROS 2 has names of nodes there.
            return
        package, namespace = source.file.rpartition("/config/")[0], re.escape(longer[0].partition("/")[0])
        in_group = rf"<(?:group|include|node)\b[^<>]*\bns\s*=\s*[\"']/?(?:{namespace}\b|\$\(arg (?!robot_description))"
        if not any(re.search(in_group, launch.text) for launch in launches(model) if package in launch.file):
            yield self._at(source, node, f"controller `{name}` is in a namespace: its name is `{longer[0]}`", ())

    def _at(self, source: Source, node: Node, message: str, names: object) -> Finding:
        hint = meant(node.text.rpartition("/")[2], names)[1]  # type: ignore[arg-type]
        return self.at_span(span_of(source, node), message + hint, names=(node.text,))
