"""Estimated masses and inertias of moving links without them, from their shapes at uniform density."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from math import isfinite, pi

from urdfkit.defect_message import DefectMessage, with_effect
from urdfkit.description.repair_positions import at_attributes
from urdfkit.description.urdf.geometry import rotation_of, rpy_of
from urdfkit.description.urdf.massless_links import first_of, has_inertia, has_mass, moving_bodies
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Geometry, Inertia, Inertial, Joint, Link, Pose, Robot
from urdfkit.description.urdf.volume_moments import Moments, of_primitive, union
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number
from urdfkit.meshes.mesh_moments import moments
from urdfkit.scene import Scene, Shape
from urdfkit.sim.construction.repairs.inertia_tensors import repair_at


def with_estimates(robot: Robot, scene: Scene, *, floating: bool, density: float) -> tuple[Robot, list[Repair]]:
    """Return a robot whose moving bodies have masses and inertias where they can be estimated, and the repairs.

    A body without mass gets the mass of its shapes at a density: of the collision shapes of each link, else of its
    visual shapes. A body with mass and without inertia gets the inertia of these shapes with its mass, or of a solid
    sphere of the density if it has no shapes. A mass or tensor in the source is kept. Bodies with neither mass nor
    shapes stay unchanged.

    Args:
        robot: the robot.
        scene: its shapes.
        floating: whether its base moves.
        density: density of the shapes [kg/m³].
    """
    changed: dict[str, Link] = {}
    repairs: list[Repair] = []
    for joint, links in moving_bodies(robot, floating=floating).values():
        heavy = [link for link in links if has_mass(link)]
        if (heavy and any(map(has_inertia, links))) or any(map(_is_negative, links)):
            continue
        estimated: dict[str, Inertial] = {}
        is_sphere = False
        for link in heavy or links:
            volume = _volume(scene, link.name)
            if heavy or volume.volume > 0.0:
                estimated[link.name] = _estimated(link, volume, density)
                changed[link.name] = replace(link, inertial=estimated[link.name])
                is_sphere |= volume.volume <= 0.0
        if estimated and (first := first_of(links)) is not None:
            shapes = _shapes_of(list(estimated), first.name)
            basis = f"the inertia from {shapes}" if heavy else f"from {shapes} at {density:g} kg/m³"
            if is_sphere:
                basis = f"the inertia of a sphere of {density:g} kg/m³"
            repairs.append(mass_repair(first, list(estimated.values()), joint, basis))
    if not changed:
        return robot, repairs
    return replace(robot, links=tuple([changed.get(link.name, link) for link in robot.links])), repairs


def _shapes_of(names: list[str], reported: str) -> str:
    """Return the words for the shapes of links, in a message about one link of their body."""
    if len(names) > 1:
        return "their shapes"
    return "its shapes" if names == [reported] else f"the shapes of `{names[0]}`"


def _is_negative(link: Link) -> bool:
    return link.inertial is not None and (link.inertial.mass or 0.0) < 0.0


def _estimated(link: Link, volume: Moments, density: float) -> Inertial:
    """Return the inertial of a link, with an estimate of each missing quantity: mass, centre of mass or inertia."""
    written = link.inertial
    element = link.element if written is None else written.element
    mass = written.mass if written is not None and written.mass else density * volume.volume
    is_placed = written is not None and bool(written.mass or has_inertia(link))
    origin = written.origin if written is not None and is_placed else Pose(volume.middle)
    if written is not None and written.inertia is not None and has_inertia(link):
        inertia = written.inertia
    elif volume.volume > 0.0:
        ixx, ixy, ixz, iyy, iyz, izz = volume.tensor(mass, rotation_of(origin.rpy))
        inertia = Inertia(ixx, ixy, ixz, iyy, iyz, izz, element)
    else:
        inertia = _sphere(mass, density, link)
    return Inertial(origin, mass, inertia, element)


def _sphere(mass: float, density: float, link: Link) -> Inertia:
    """Return the inertia of a solid sphere with a mass [kg] and a density [kg/m³]."""
    moment = 0.4 * mass * (3.0 * mass / (4.0 * pi * density)) ** (2.0 / 3.0)
    return Inertia(moment, 0.0, 0.0, moment, 0.0, moment, link.element)


def mass_repair(link: Link, inertials: list[Inertial], joint: Joint | None, basis: str) -> Repair:
    """Return the repair of a body without mass or inertia.

    Args:
        link: the first link of the body that has a mass or a shape.
        inertials: masses and inertias of its links in the simulation.
        joint: the joint that moves it; None for the base.
        basis: where the values come from.
    """
    why = f"joint `{joint.name}` moves it" if joint is not None else "the robot is free to move"
    written, element, code, attribute = link.inertial, link.element, "I511", None
    if written is None:
        problem = "has no <inertial>"
        code = {"parent": "T201", "child": "T202"}.get(element.tag, code)  # The link was added for a joint.
    elif not has_mass(link):
        problem = "has no mass"
        element, code, attribute = _unread(written.element, "mass", ("value",))
        if written.mass is not None:
            element, code = written.element.find("mass") or element, "I501"
    else:
        problem = "has no moment of inertia"
        element, code, attribute = _unread(written.element, "inertia", ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
        if written.inertia is not None:
            element, code = written.inertia.element, "I504"
    amount = f"{sum(inertial.mass or 0.0 for inertial in inertials):.4g} kg"
    if len(inertials) > 1:
        amount += f" in {len(inertials)} links that are fixed to each other"
    elif (i := inertials[0].inertia) is not None:
        amount += f" and {i.ixx:.4g}, {i.iyy:.4g}, {i.izz:.4g} kg·m²"
    message = with_effect(f"link `{link.name}` {problem}, but {why}", f"simulated with {amount} ({basis})")
    repair = repair_at(element, "mass", code, message, link=link.name, joint=None if joint is None else joint.name)
    return replace(repair, attribute=attribute)


def with_causes(repairs: Iterable[Repair], masses: Iterable[Repair]) -> list[Repair]:
    """Return repairs of a description and of masses, in which the repair of an unreadable mass or inertia is one.

    Args:
        repairs: repairs of the description, such as an ignored mass.
        masses: the estimates, such as that of the same mass.
    """
    estimates = {(each.code, each.position): each for each in at_attributes(masses)}
    found = []
    for each in repairs:
        if (estimate := estimates.pop((each.code, each.position), None)) is not None:
            message, effect = DefectMessage.of(each.message), DefectMessage.of(estimate.message).effect
            each = replace(estimate, message=DefectMessage(message.defect, effect, message.suggestion, message.tail))
        found.append(each)
    return [*found, *estimates.values()]


def _unread(inertial: Element, tag: str, attributes: tuple[str, ...]) -> tuple[Element, str, str | None]:
    """Return the element without which an inertial has no mass or inertia, and code and attribute of its defect."""
    element = inertial.find(tag)
    if element is None:
        return inertial, "E014", None
    texts = {name: element.get(name) for name in attributes}
    if None in texts.values():
        return element, "E014", None
    numbers = {name: number(text or "") for name, text in texts.items()}
    unread = next((name for name, value in numbers.items() if value is None), None)
    if unread is not None:
        return element, "E010", unread
    return element, "E012", next((name for name, value in numbers.items() if not isfinite(value or 0.0)), None)


def _volume(scene: Scene, link: str) -> Moments:
    """Return the moments of the union of a link's collision shapes; of its visual shapes without collision shapes."""
    for role in ("collision", "visual"):
        shapes = [shape for shape in scene.shapes if shape.body == link and shape.role == role]
        whole = union(list(_moments(shapes)))[0]
        if whole.volume > 0.0:
            return whole
    return Moments(0.0, (0.0, 0.0, 0.0), (0.0,) * 6)


def _moments(shapes: list[Shape]) -> Iterator[tuple[Geometry, Pose, Moments]]:
    """Yield each shape of a robot with its pose in the link and its moments in its own frame."""
    for shape in shapes:
        geometry: Geometry = shape.geometry  # type: ignore[assignment]  # robots have no planes, ellipsoids and cones
        x, y, z = shape.placement[:3, 3].tolist()
        pose = Pose((x, y, z), rpy_of(shape.placement[:3, :3].tolist()))
        if shape.mesh is None:
            yield geometry, pose, of_primitive(geometry)
        else:
            yield geometry, pose, moments(shape.mesh, shape.name)[0]
