"""K984 frame-inconsistent."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class FrameInconsistent(RobotRule):
    """A node uses a map or odometry frame that no other node names, or the same frame for both.

    ## What it does
    Compares ``odom_frame``, ``odom_frame_id``, ``local_frame``, ``map_frame``, ``global_frame_id`` and ``global_frame``
    in YAML with each other and with the odometry frames of plugins. Reports a frame other than ``map`` and ``odom`` if
    another node uses a different frame and the name occurs nowhere else in the files and code of these packages. Also
    reports a node whose map frame and odometry frame are equal. Controllers of differential drives are reported if
    their base frame is not the root link, because this frame then has two parents.

    ## Why is this bad?
    The node waits for a transform that no node publishes, or publishes a transform that no other node uses.

    ## Example
    ```diff
     slam_toolbox:
       ros__parameters:
    -    odom_frame: odom_combined
    +    odom_frame: odom
     local_costmap:
       local_costmap:
         ros__parameters:
           global_frame: odom
    ```
    """

    code = "K984"
    name = "frame-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each frame that occurs once."""
        from urdfkit.lint.facts.control.yaml_tree import span_of, yamls
        from urdfkit.lint.facts.navigation.frames import equal_frames, lone_frames, second_parents

        equal = [(source, *found) for source in yamls(model) for found in equal_frames(source)]
        for source, node, message in (*lone_frames(model), *second_parents(model), *equal):
            yield self.at_span(span_of(source, node), message)
