"""L111 node-name-duplicate."""

from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.rule import Findings, Model, RobotRule


class NodeNameDuplicate(RobotRule):
    """An XML or Python launch file starts two nodes with the same name in the same namespace.

    ## What it does
    Compares the names of all nodes in a launch file. Names with substitutions are not checked. Two nodes with
    different conditions are not compared. In Python, files that push namespaces or react to events are not checked, and
    nodes in branches, loops, groups or different functions are not compared. Also reports two includes that start
    Gazebo under the same condition.

    ## Why is this bad?
    roslaunch stops with "multiple nodes named". In ROS 2, both nodes run, and a parameter or a service request may
    reach either one.

    ## Example
    ```diff
     <launch>
       <node name="view" pkg="rviz" type="rviz"/>
    -  <node name="view" pkg="rviz" type="rviz"/>
    +  <node name="rear_view" pkg="rviz" type="rviz"/>
     </launch>
    ```
    """

    code = "L111"
    name = "node-name-duplicate"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each node whose name another node has."""
        from urdfkit.lint.facts.launch.python.names import python_files
        from urdfkit.lint.facts.launch.repetitions import repeated_nodes, repeated_simulators
        from urdfkit.lint.facts.launch.ros_version import reads_ros1

        for file, source in model.related_files.items():
            if not file.endswith((".launch", ".launch.xml", "_launch.xml")):
                continue
            earlier: dict[str, list[Tag]] = {}
            for tag in (tag for root in Document(source).roots for tag in root.walk()):
                name = _full_name(tag) if tag.name == "node" else None
                others = earlier.setdefault(name, []) if name is not None else []
                other = next((each for each in others if _both_start(each, tag)), None)
                others.append(tag)
                if other is not None:
                    written = tag.attributes["name"]
                    line = source.position(other.start).line
                    message = f"the node on line {line} also has the name `{written.value}`"
                    severity = self.severity if reads_ros1(source) else "warning"
                    span = source.span(written.value_start, written.value_end)
                    yield self.at_span(span, message, severity=severity)
        for source, tree in python_files(model):
            for name, span, line in repeated_nodes(source, tree):
                message = f"the node on line {line} also has the name `{name}`"
                yield self.at_span(span, message, severity="warning")
            for span, message in repeated_simulators(source, tree):
                yield self.at_span(span, message)


def _full_name(tag: Tag) -> str | None:
    """Return name and namespace of a node; None if they depend on substitutions or other elements."""
    parts: list[str] = []
    for each in (tag, *tag.ancestors()):
        attributes = each.attributes
        is_moved = any("namespace" in child.name for child in each.children)  # push-ros-namespace
        if is_moved or each.name not in ("node", "group", "launch"):
            return None
        parts += [attributes[name].value for name in ("ns", "namespace") if name in attributes]
    own = tag.attributes.get("name")
    return "/".join([*reversed(parts), own.value]) if own is not None and "$" not in f"{own.value}{parts}" else None


def _both_start(one: Tag, other: Tag) -> bool:
    """Return whether two nodes can start together: one has no conditions except those of the other."""
    conditions = [
        {
            (key, each.attributes[key].value)
            for each in (tag, *tag.ancestors())
            for key in _CONDITIONS & {*each.attributes}
        }
        for tag in (one, other)
    ]
    return conditions[0] <= conditions[1] or conditions[1] <= conditions[0]


_CONDITIONS = {"if", "unless"}
