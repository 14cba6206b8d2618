"""Models of SDF: links, joints, frames, nested models and included files."""

from dataclasses import replace

from urdfkit.description.sdf.frame_graph import Scope
from urdfkit.description.sdf.model import WorldModel
from urdfkit.description.sdf.reader.joints import read_joint
from urdfkit.description.sdf.reader.links import read_light, read_link
from urdfkit.description.sdf.reader.reading_state import Context
from urdfkit.description.sdf.reader.vocabulary import note_unknown_elements
from urdfkit.description.sdf.shapes import Light, keep
from urdfkit.description.sdf.values import RawPose, boolean, name_of, raw_pose, text, wrong
from urdfkit.description.sdf.world import WorldRobot
from urdfkit.description.urdf.robot import Pose
from urdfkit.description.xml.element import Element

_READ = {"frame", "include", "joint", "link", "model", "pose", "self_collide", "static"}


class ReadEntity:
    """Model, robot or light read from a ``<model>`` or ``<include>``, its pose not yet resolved.

    Attributes:
        entity: the model, robot or light.
        raw: unresolved pose.
        placement: the frame inside the model that the pose places.
        scope: the frames of a model.
    """

    def __init__(
        self, entity: WorldModel | WorldRobot | Light, raw: RawPose, placement: str = "", scope: Scope | None = None
    ) -> None:
        self.entity, self.raw, self.placement, self.scope = entity, raw, placement, scope

    def add_to(self, scope: Scope, *, strict: bool) -> None:
        """Add the frame of a model to the frames of its parent; lights have none.

        Raises:
            DescriptionError: the name already exists.
        """
        if not isinstance(self.entity, Light):
            name = self.entity.name
            scope.add(name, "model", self.raw, placement=self.placement, nested=self.scope, strict=strict)

    def placed(self, scope: Scope) -> WorldModel | WorldRobot | Light:
        """Return the entity with its resolved pose.

        Raises:
            DescriptionError: the pose is relative to an unknown frame.
        """
        if isinstance(self.entity, Light):
            return replace(self.entity, pose=scope.place(self.raw, scope.root, scope.root))
        return replace(self.entity, pose=scope.pose(self.entity.name, self.raw.position))


def read_model(context: Context, element: Element) -> ReadEntity:
    """Read a ``<model>``.

    Raises:
        ResourceError: an included model or a mesh does not exist.
        DescriptionError: the model cannot be read.
    """
    note_unknown_elements(context, element)
    name = name_of(element)
    scope = Scope("__model__", f"model `{name}`")
    strict = context.version >= (1, 7)
    inside: list[ReadEntity] = []
    merged: list[WorldModel] = []
    for child in element.children:
        if child.tag in ("model", "include"):
            found = read_model(context, child) if child.tag == "model" else read_include(context, child)
            if found is None:
                continue
            if not isinstance(found.entity, WorldModel):
                raise wrong(child, "a model may include only models, neither lights nor URDF files")
            if child.get("merge", "false") in ("true", "1") and found.scope is not None:
                scope.merge(found.entity.name, found.scope, found.raw, found.placement)
                merged.append(found.entity)
                continue
            found.add_to(scope, strict=strict)
            inside.append(found)
        else:
            add_frame(scope, child, strict=strict)
    scope.canonical = _canonical(element, scope)
    links = [read_link(context, link, scope) for link in element.find_all("link")]
    joints = [read_joint(context, joint, scope) for joint in element.find_all("joint")]
    models = [each for found in inside if isinstance(each := found.placed(scope), WorldModel)]
    kept = [keep(child) for child in element.children if child.tag not in _READ]
    for part in merged:
        links += [replace(each, pose=scope.pose(each.name)) for each in part.links]
        models += [replace(each, pose=scope.pose(each.name)) for each in part.models]
        joints += part.joints
        kept += part.kept
    model = WorldModel(
        name,
        static=boolean(element, "static", False),
        links=tuple(links),
        joints=tuple(joints),
        models=tuple(models),
        self_collide=boolean(element, "self_collide", False),
        canonical_link=scope.canonical,
        kept=tuple(kept),
        position=element.origin.position,
    )
    return ReadEntity(model, raw_pose(element), element.get("placement_frame") or "", scope)


def add_frame(scope: Scope, element: Element, *, strict: bool) -> None:
    """Add the frame of a link, joint or ``<frame>``; other elements have none.

    Raises:
        DescriptionError: the name is missing or already exists.
    """
    if element.tag == "link":
        scope.add(name_of(element), "link", raw_pose(element), strict=strict)
    elif element.tag == "joint":
        scope.add(name_of(element), "joint", raw_pose(element), default=text(element, "child"), strict=strict)
    elif element.tag == "frame":
        scope.add(name_of(element), "frame", raw_pose(element), default=element.get("attached_to") or "", strict=strict)


def _canonical(element: Element, scope: Scope) -> str:
    written = element.get("canonical_link") or ""
    if written:
        link = scope.link_of(written, element.origin.position)
        if link != written:
            raise wrong(element, f"canonical_link `{written}` does not exist")
    return written


def read_include(context: Context, element: Element) -> ReadEntity | None:
    """Read an ``<include>``: a model, a light, or a URDF.

    Returns:
        The included entity; None for an actor, with a note.

    Raises:
        ResourceError: unknown model.
        DescriptionError: the included file cannot be read.
    """
    from urdfkit.description.sdf.reader.uris import find_model

    note_unknown_elements(context, element)
    uri = element.find("uri")
    if uri is None:
        raise wrong(element, "<include> has no <uri>")
    path = find_model(context, uri)
    called = text(element, "name")
    if path.suffix in (".urdf", ".xacro"):
        if text(element, "placement_frame"):
            raise wrong(element, "<placement_frame> of a URDF is not read; place its root link")
        robot = WorldRobot(
            called or path.name.partition(".")[0],
            uri.text if "://" in uri.text else f"file://{path}",
            str(path),
            static=boolean(element, "static", False),
            kept=tuple([keep(child) for child in element.find_all("plugin")]),
            position=element.origin.position,
        )
        return ReadEntity(robot, raw_pose(element))
    inner = context.enter(path, uri)
    root = inner.open()
    found = _first(inner, root)
    if found is None:
        context.note(element, f"{uri.text} is an actor, which is not simulated", "actor")
        return None
    found.entity = replace(found.entity, position=element.origin.position)
    if called:
        found.entity = replace(found.entity, name=called)
    if element.find("pose") is not None:
        found.raw, found.placement = raw_pose(element), text(element, "placement_frame")
    elif text(element, "placement_frame"):
        raise wrong(element, "<placement_frame> requires a <pose>")
    if isinstance(found.entity, WorldModel):
        plugins = tuple([keep(child) for child in element.find_all("plugin")])
        static = boolean(element, "static", found.entity.static)
        found.entity = replace(found.entity, static=static, kept=found.entity.kept + plugins)
    return found


def _first(context: Context, root: Element) -> ReadEntity | None:
    if root.tag != "sdf":
        raise wrong(root, f"<{root.tag}> is not a model: an SDF model starts with <sdf> and contains a <model>")
    for child in root.children:
        if child.tag == "model":
            return read_model(context, child)
        if child.tag == "light":
            return ReadEntity(read_light(context, child, Pose()), raw_pose(child))
        if child.tag == "actor":
            return None
    raise wrong(root, "this file has neither a <model> nor a <light>")
