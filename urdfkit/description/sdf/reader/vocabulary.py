"""Elements that SDF allows in each element, so that a misspelt one is reported."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.sdf.reader.reading_state import Context
from urdfkit.description.xml.element import Element
from urdfkit.errors import nearest

_INCLUDE = "allow_auto_disable enable_wind name placement_frame plugin pose static uri merge"
_LIGHT = "attenuation cast_shadows diffuse direction frame intensity light_on plugin pose specular spot visualize"
_SHAPE = "frame geometry laser_retro pose"

_ALLOWED = {
    "sdf": "actor light model world",
    "world": "actor atmosphere audio frame gravity gui include joint light magnetic_field model physics plugin"
    " population road scene spherical_coordinates state wind",
    "model": "allow_auto_disable enable_wind frame gripper include joint link model plugin pose self_collide static"
    " battery",
    "include": _INCLUDE,
    "link": "audio_sink audio_source battery collision enable_wind frame gravity inertial kinematic light"
    " must_be_base_link particle_emitter plugin pose projector self_collide sensor velocity_decay visual",
    "collision": f"{_SHAPE} auto_inertia_params density max_contacts surface material",
    "visual": f"{_SHAPE} cast_shadows material meta plugin transparency visibility_flags",
    "joint": "axis axis2 child frame gearbox_ratio gearbox_reference_body parent physics plugin pose"
    " screw_thread_pitch sensor thread_pitch",
    "light": _LIGHT,
    "geometry": "box capsule cone cylinder ellipsoid empty heightmap image mesh plane polyline sphere",
    "surface": "bounce contact friction soft_contact",
    "inertial": "auto_inertia_params density fluid_added_mass frame inertia mass pose",
    "axis": "dynamics initial_position limit mimic use_parent_model_frame xyz",
}
_SETS = {tag: frozenset(allowed.split()) for tag, allowed in _ALLOWED.items()}


def note_unknown_elements(context: Context, element: Element) -> None:
    """Add a note for each child unknown to SDF, which sdformat ignores too; elements with a prefix get no note."""
    allowed = _SETS["axis" if element.tag == "axis2" else element.tag]
    for child in element.children:
        if child.tag not in allowed and ":" not in child.tag:
            near = nearest(child.tag, allowed)
            hint = Suggestion(near and f"<{near}>", f"<{child.tag}>")
            context.note(child, f"unknown element <{child.tag}> in <{element.tag}> is ignored" + hint, "element")
