"""S912 camera-frame-not-optical."""

from collections.abc import Iterator

from urdfkit.description.urdf.geometry import rotation_of
from urdfkit.description.urdf.robot import GazeboBlock
from urdfkit.description.xml.element import Element
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_TO_THE_RIGHT = 0.9
"""Cosine of the largest angle to the negative y axis of the parent link."""


class CameraFrameNotOptical(RobotRule):
    """The images of a camera are in the frame of its body, or the camera itself is in the optical frame.

    ## What it does
    Checks ``optical_frame_id`` (or ``gz_frame_id`` if ``optical_frame_id`` is missing) and the frames of camera plugins
    of Gazebo Classic. The ``gz_frame_id`` of depth and logical cameras is not checked, because Gazebo also publishes
    points along x in this frame. Reports a link that has a child with ``optical`` in its name on a fixed joint. Also
    reports a camera of Gazebo in an optical frame, recognised by an x axis that points to the right of the parent link:
    Gazebo cameras look along x.

    ## Why is this bad?
    Images and depth are measured along the z axis of their frame. In the frame of the body, point clouds and markers
    appear above the camera instead of in front of it.

    ## Example
    ```diff
     <robot name="cart">
       <link name="camera_link"/>
       <link name="camera_optical_frame"/>
       <joint name="camera_optical_joint" type="fixed">
         <parent link="camera_link"/><child link="camera_optical_frame"/>
         <origin rpy="-1.5707963267948966 0 -1.5707963267948966"/>
       </joint>
       <gazebo reference="camera_link">
         <sensor name="camera" type="camera">
           <plugin name="camera" filename="libgazebo_ros_camera.so">
    -        <frame_name>camera_link</frame_name>
    +        <frame_name>camera_optical_frame</frame_name>
           </plugin>
         </sensor>
       </gazebo>
     </robot>
    ```
    """

    code = "S912"
    name = "camera-frame-not-optical"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each camera whose frame has an optical frame below it."""
        children: dict[str, list[str]] = {}
        for joint in model.robot.joints:
            if joint.type == "fixed" and joint.parent and joint.child and "optical" in joint.child.lower():
                children.setdefault(joint.parent, []).append(joint.child)
        for element in _frames(model) if children else ():
            name = (element.text or "").strip().lstrip("/")
            optical = children.get(name, [])
            if optical and "optical" not in name.lower():
                message = f"<{element.tag}> is `{name}`, which is not an optical frame"
                yield self.at(model, element, message, link=name, help=f"write `{optical[0]}`")
        for block, carrier in _sideways(model):
            name = block.reference or ""
            message = f"the camera in `{name}` looks along x, which points to the right of `{carrier}`"
            help = f"put the camera in `{carrier}`, and write `{name}` as the frame of the images"
            yield self.at(model, block.element, message, attribute="reference", link=name, help=help)


def _sideways(model: Model) -> Iterator[tuple[GazeboBlock, str]]:
    """Yield the blocks with a camera in an optical frame, and the link that carries the frame."""
    parents = {joint.child: joint for joint in model.robot.joints if joint.type == "fixed" and joint.parent}
    for block in model.robot.gazebo:
        joint = parents.get(block.reference)
        if joint is None or "optical" not in (block.reference or "").lower():
            continue
        x_axis = [row[0] for row in rotation_of(joint.origin.rpy)]
        cameras = [sensor for sensor in block.sensors if _is_camera(sensor.type or "")]
        if x_axis[1] < -_TO_THE_RIGHT and any(sensor.element.find("pose") is None for sensor in cameras):
            yield block, joint.parent or ""


_TAGS = ("optical_frame_id", "gz_frame_id", "ignition_frame_id")
"""Elements of a sensor that name the frame of its images."""

_WITH_POINTS = ("depth", "depth_camera", "logical_camera", "rgbd", "rgbd_camera")
"""Types of sensors whose ``<gz_frame_id>`` is also the frame of points or objects, which Gazebo measures along x."""


def _is_camera(kind: str) -> bool:
    return "camera" in kind or kind.strip() in ("depth", "multicamera")


def _frames(model: Model) -> Iterator[Element]:
    """Yield the elements that name the frame of the images of a camera."""
    for block in model.robot.gazebo:
        for sensor in block.sensors:
            if not _is_camera(sensor.type or ""):
                continue
            tags = _TAGS[:1] if (sensor.type or "").strip() in _WITH_POINTS else _TAGS
            named = [each for each in sensor.element.walk() if each.tag in tags]
            optical = [each for each in named if each.tag == "optical_frame_id"]
            yield from optical or named  # next to an optical frame, the other frame is that of the body
            for plugin in sensor.plugins:
                if "camera" in (plugin.filename or "") or "kinect" in (plugin.filename or ""):
                    yield from (each for each in plugin.element.children if each.tag in ("frame_name", "frameName"))
