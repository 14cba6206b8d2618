"""L120 parameters-loaded-twice."""

from urdfkit.lint.rule import Findings, Model, RobotRule

_FIXED = ("command", "file", "ns", "param")
"""Attributes of two <rosparam> that load the same parameters into the same namespace."""


class ParametersLoadedTwice(RobotRule):
    """A ROS 1 launch file loads a file twice into one namespace.

    ## What it does
    Compares the ``<rosparam>`` elements without a condition in a node, a group or the whole file.

    ## Why is this bad?
    The second load has no effect. Usually the second load was intended for another namespace, such as that of the other
    costmap. That namespace then has no parameters.

    ## Example
    ```diff
     <launch>
       <node name="move_base" pkg="move_base" type="move_base">
         <rosparam command="load" file="$(find cart_description)/config/costmap.yaml" ns="global_costmap"/>
    -    <rosparam command="load" file="$(find cart_description)/config/costmap.yaml" ns="global_costmap"/>
    +    <rosparam command="load" file="$(find cart_description)/config/costmap.yaml" ns="local_costmap"/>
       </node>
     </launch>
    ```
    """

    code = "L120"
    name = "parameters-loaded-twice"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each repeated load."""
        from urdfkit.lint.facts.launch.spawned_controllers import ros1_files, tags

        seen: dict[tuple[object, ...], int] = {}
        for source, tag in tags(ros1_files(model), "rosparam"):
            at = {name: each.value for name, each in tag.attributes.items()}
            if "file" not in at or {"if", "unless"} & at.keys() or at.get("command", "load") != "load":
                continue
            parent = next(iter(tag.ancestors()), None)
            key = (source.file, None if parent is None else parent.start, *(at.get(name, "") for name in _FIXED[1:]))
            first = seen.setdefault(key, tag.start)
            if first != tag.start:
                space = f"namespace `{at['ns']}`" if "ns" in at else "this namespace"
                line = source.span(first, first).line
                message = f"{at['file'].rpartition('/')[2]} is already loaded into {space} on line {line}"
                yield self.at_span(source.span(tag.start, tag.end), message, help="write another namespace")
