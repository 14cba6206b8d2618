"""K977 topic-misspelt."""

from urdfkit.lint.finding import suggestion_of
from urdfkit.lint.rule import Findings, Model, RobotRule


class TopicMisspelt(RobotRule):
    """A launch file, parameter file or bridge misspells a topic of the robot by one letter.

    ## What it does
    Checks the topics in remappings, in parameters such as ``scan_topic``, ``odom_topic`` and ``odom0``, in arguments
    and on the ROS side of bridges. These topics are compared with the topics of the robot's Gazebo plugins, sensors,
    bridges and controllers, and with ``cmd_vel``, ``odom`` and ``scan``. A name is reported if it differs from exactly
    one of these topics by one letter or by the order of two letters, and if it occurs nowhere else in the packages,
    including their code and RViz files. A node that reads ``scan_raw`` or ``laser_scan`` is reported if the robot
    publishes ``scan`` and no other file or node names the topic of the node.

    If the publishers of all nodes are known, also reports topics without a publisher although the robot publishes
    messages of the same type: remapped inputs of nodes in the packages, and ``gps/fix`` of ``navsat_transform_node``.

    ## Why is this bad?
    The node waits for messages that never arrive, and reports no error.

    ## Example
    ```diff
     amcl:
       ros__parameters:
    -    scan_topic: sacn
    +    scan_topic: scan
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K977"
    name = "topic-misspelt"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt topic."""
        from urdfkit.lint.facts.topics.misspelt import misspelt_topics

        for span, topic, hint in misspelt_topics(model):
            message = f"no other file names the topic `{topic}`" + hint
            suggestion = suggestion_of(message)
            named = (topic, suggestion.meant) if suggestion is not None else (topic,)
            yield self.at_span(span, message, names=tuple(name.strip("/") for name in named))
