"""K985 topic-type-mismatch."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class TopicTypeMismatch(RobotRule):
    """A parameter makes a node subscribe to a topic with the wrong message type.

    ## What it does
    Compares the inputs of robot_localization, the observation sources of costmaps, ``scan_topic``, ``odom_topic``,
    ``point_cloud_topic`` and ``image_topic`` with the types of topics that bridges, sensors, controllers and filters
    publish. For Nav2, twist_mux, teleop_twist_joy and drive controllers, also checks that the publisher and the
    subscriber of velocity commands set their flags for stamped messages to the same value. The subscribers in the code
    of the workspace are compared with the publishers of their topics.

    ## Why is this bad?
    ROS connects only publishers and subscribers of the same type, so the node receives no messages and reports no
    error.

    ## Example
    ```diff
     ekf_filter_node:
       ros__parameters:
    -    imu0: drive/odom
    +    odom0: drive/odom
     controller_manager:
       ros__parameters:
         drive:
           type: diff_drive_controller/DiffDriveController
     drive:
       ros__parameters:
         left_wheel_names: [left_wheel_joint]
         right_wheel_names: [right_wheel_joint]
    ```
    """

    code = "K985"
    name = "topic-type-mismatch"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter with a topic or a flag of another type."""
        from urdfkit.lint.facts.topics.message_types import mistyped, unequal_stamps
        from urdfkit.lint.facts.topics.own_pairs import mistyped_in_code

        for span, message, element, is_wrong in mistyped(model):
            place = model.span(element.origin.position) if element is not None else None
            cause = "type" if is_wrong else ""
            yield self.at_span(span, message, other=place, is_other_wrong=is_wrong, cause=cause)
        for end, message in mistyped_in_code(model):
            yield self.at_span(end.source.span(end.start, end.end), message)
        for span, message in unequal_stamps(model):
            yield self.at_span(span, message)
