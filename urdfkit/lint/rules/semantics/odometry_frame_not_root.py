"""S913 odometry-frame-not-root."""

from urdfkit.lint.facts.gazebo.plugins import OUTSIDE_FRAMES, is_foreign, plugins, spec_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_FRAMES = (
    ("frame_id", "child_frame_id"),
    ("odom_frame", "robot_base_frame"),
    ("odometry_frame", "robot_base_frame"),
    ("odometryFrame", "robotBaseFrame"),
)
"""Parameters of drives and odometry publishers: frame of the odometry, frame of the robot."""


class OdometryFrameNotRoot(RobotRule):
    """A drive publishes the pose of a link that has a parent in the robot.

    ## What it does
    Reports Gazebo drives that publish the odometry transform of a link other than the root link.

    ## Why is this bad?
    In TF, a frame has only one parent, and each message replaces this parent. Because ``robot_state_publisher``
    publishes another parent of the same frame, the parent alternates. The links above the frame are not connected to
    the odometry frame.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <link name="base_link"/>
       <joint name="base_joint" type="fixed">
         <parent link="base_footprint"/><child link="base_link"/>
       </joint>
       <gazebo>
         <plugin name="move" filename="libgazebo_ros_planar_move.so">
    -      <robotBaseFrame>base_link</robotBaseFrame>
    +      <robotBaseFrame>base_footprint</robotBaseFrame>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "S913"
    name = "odometry-frame-not-root"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each drive with another base frame."""
        from urdfkit.description.plugins import values

        yield from self._same_frames(model)
        roots = model.robot.roots()
        root = roots[0].name if len(roots) == 1 and not model.is_incomplete else None
        if root is None or root in OUTSIDE_FRAMES:
            return
        for plugin, _, _ in plugins(model.robot):
            spec = spec_of(plugin, model.target)
            frame = spec.by_meaning("base_frame") if spec is not None else None
            if spec is None or frame is None or spec.generation == "gz" or is_foreign(plugin, model):
                continue
            publishes = [spec.by_meaning(each) for each in ("publish_odometry", "publish_odometry_tf")]
            written = [
                next((text for text, _ in values(plugin, each)), each.default) for each in publishes if each is not None
            ]
            if not publishes[-1] and spec.kind != "planar_move":
                continue
            for text, element in values(plugin, frame):
                name = text.lstrip("/")
                is_link = name in model.robot.link_by_name and name != root
                if is_link and not any((each or "").lower() in ("false", "0") for each in written):
                    message = (
                        f"<{element.tag}> is `{name}`, but the root link is `{root}`: `{name}` has two parents in TF"
                    )
                    yield self.at(model, element, message, link=name, help=f"write `{root}`")

    def _same_frames(self, model: Model) -> Findings:
        """Yield a finding for each plugin whose odometry frame is its base frame."""
        for plugin, _, _ in plugins(model.robot):
            for odometry, base in _FRAMES:
                first, second = plugin.element.find(odometry), plugin.element.find(base)
                if first is None or second is None or any(model.is_unresolved(each) for each in (first, second)):
                    continue
                name = (first.text or "").strip().strip("/")
                if name and name == (second.text or "").strip().strip("/") and "$" not in name:
                    message = f"<{odometry}> and <{base}> are both `{name}`: "
                    message += "the odometry frame must not be a link of the robot"
                    yield self.at(model, first, message, link=name, help="write `odom`")
