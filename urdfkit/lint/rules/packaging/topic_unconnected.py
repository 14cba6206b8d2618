"""K980 topic-unconnected."""

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule


class TopicUnconnected(RobotRule):
    """A remapping leaves a common node without a connection to any other node.

    ## What it does
    Checks the remappings of ``teleop_twist_joy``, ``teleop_twist_keyboard``, ``joy``, ``twist_mux``,
    ``robot_localization``, ``nav2_velocity_smoother``, ``nmea_navsat_driver``, ``robot_state_publisher`` and
    ``joint_state_publisher`` for topics that the node does not have. For a node of the workspace, the remappings are
    compared with the names in the code of its package, unless the code computes names. Also reports:

    - nodes such as ``nav2_velocity_smoother`` that subscribe to the topic on which they publish
    - two nodes of a launch file that run the same executable and publish on one topic
    - drivers with swapped names in a remapping

    The rule also follows the includes of launch files. It reports nodes that publish or subscribe to
    ``robot_description`` or ``joint_states`` in a different namespace from the other nodes of the launch.

    A ``twist_mux``, a drive controller, a plugin or a bridge of the packages may subscribe to velocity commands. In
    this case, the rule also reports nodes, including those of Nav2, that publish velocity commands on a topic that no
    other file of the packages names.

    In the code of workspace nodes, also reports a publisher without a subscriber, or a subscriber without a publisher,
    if exactly one other node has an unmatched subscriber or publisher with the same message type. Topic names from
    parameters, YAML files and remappings are included. Also reports:

    - topics and actions in the namespace of a controller that the controller does not have
    - subscribers with the private name of a topic such as ``joint_states``
    - action servers in Python that never report success to their clients

    ## Why is this bad?
    The robot does not move, and no node reports an error.

    ## Example
    ```diff
     <launch>
       <node pkg="teleop_twist_joy" exec="teleop_node">
    -    <remap from="cmd_velocity" to="joy_vel"/>
    +    <remap from="cmd_vel" to="joy_vel"/>
       </node>
     </launch>
    ```
    """

    code = "K980"
    name = "topic-unconnected"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each remapping without an effect, and for each topic that no node reads."""
        from urdfkit.lint.facts.connections.messages_in_code import unfinished_goals
        from urdfkit.lint.facts.connections.misnamed_remappings import misnamed_remappings
        from urdfkit.lint.facts.connections.namespaces import separated_nodes
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.topics.controller_topics import private_readers, wrong_inputs
        from urdfkit.lint.facts.topics.loops import published_together, self_readers
        from urdfkit.lint.facts.topics.monitored_commands import unconnected_monitors
        from urdfkit.lint.facts.topics.node_topics import published_commands
        from urdfkit.lint.facts.topics.other_sides import other_side
        from urdfkit.lint.facts.topics.own_pairs import unpaired
        from urdfkit.lint.facts.topics.own_remappings import misnamed_in_code
        from urdfkit.lint.facts.topics.velocity_commands import unfed_mux_topics, unread_commands

        loops = list(self_readers(model))
        # Otherwise the commands that the loop leaves without a reader are its consequence.
        unread = unread_commands(model) if not loops else ()
        of_code = list(misnamed_in_code(model))
        misnamed = (*misnamed_remappings(model), *of_code)
        for kind, defects in (("remapping", misnamed), ("loop", loops), ("unread", unread)):
            for source, name, message in defects:
                found = self.at_span(source.span(name.start, name.end), message, kind=kind)
                other = other_side(source, name, model) if kind == "unread" else None
                names = (name.name.strip("/"), published_commands().get(name.name, ""))
                cause = name.name if other is not None else ""
                details = {"names": names, "other": other, "is_other_wrong": other is not None, "cause": cause}
                yield Finding(**{**found.__dict__, **details})
        for node, message, _ in published_together(model):
            if node.place is not None:
                yield self.at_span(node.source.span(*node.place), message)
        for span, message, topic in separated_nodes(model):
            yield self.at_span(span, message, kind="namespace", names=(topic,))
        for source, value, message in unconnected_monitors(model):
            yield self.at_span(span_of(source, value), message)
        # A topic of the code can be without a counterpart because its remapping has another name.
        for end, message in unpaired(model) if not of_code else ():
            yield self.at_span(end.source.span(end.start, end.end), message, kind="own", names=(end.topic,))
        for end, message in private_readers(model):
            yield self.at_span(end.source.span(end.start, end.end), message, names=(end.topic,))
        for source, name, message in wrong_inputs(model):
            yield self.at_span(source.span(name.start, name.end), message, names=(name.name,))
        for source, place, message in unfinished_goals(model):
            yield self.at_span(source.span(*place), message)
        for source, value, near, message in unfed_mux_topics(model):
            yield self.at_span(span_of(source, value), message, names=(near,))
