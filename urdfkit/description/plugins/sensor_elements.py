"""Elements allowed in a ``<sensor>``, so that a misspelt one is reported.

Source: sdformat, sdf/1.9 to 1.12: sensor.sdf, camera.sdf, lidar.sdf, noise.sdf and related files; also elements of
older versions, which are converted, and elements that only gz-sensors reads.
"""

from __future__ import annotations

from urdfkit.description.xml.element import Element
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    Allowed = dict[str, "Allowed"]


@record
class UnknownSensorElement:
    """Element that sdformat does not read in its parent.

    Attributes:
        element: the element.
        inside: tag of the parent.
        meant: the most similar element allowed in the parent; None if none is similar.
    """

    element: Element
    inside: str
    meant: str | None


def _of(words: str = "", **deeper: Allowed) -> Allowed:
    return {**{word: {} for word in words.split()}, **deeper}


_NOISE = _of(
    "type mean stddev bias_mean bias_stddev precision dynamic_bias_stddev dynamic_bias_correlation_time",
    rate=_of("mean stddev bias_mean bias_stddev"),
    accel=_of("mean stddev bias_mean bias_stddev"),
)
_NOISY = _of(noise=_NOISE)
_AXES = _of(x=_NOISY, y=_NOISY, z=_NOISY)
_PLANES = _of(horizontal=_NOISY, vertical=_NOISY)
_CLIP = _of("near far")
_FAN = _of("samples resolution min_angle max_angle")
_LIDAR = _of("visibility_mask", scan=_of(horizontal=_FAN, vertical=_FAN), range=_of("min max resolution"), noise=_NOISE)
_GPS = _of(position_sensing=_PLANES, velocity_sensing=_PLANES)
_RADIO = _of("essid frequency min_frequency max_frequency gain power sensitivity")
_LENS = _of(
    "type scale_to_hfov cutoff_angle env_texture_size",
    custom_function=_of("c1 c2 c3 f fun"),
    intrinsics=_of("fx fy cx cy s"),
    projection=_of("p_fx p_fy p_cx p_cy tx ty"),
)
_CAMERA = _of(
    "camera_info_topic triggered trigger_topic horizontal_fov segmentation_type box_type visibility_mask"
    " optical_frame_id pose frame",
    image=_of("width height format anti_aliasing"),
    clip=_CLIP,
    save=_of("path"),
    depth_camera=_of("output", clip=_CLIP),
    noise=_NOISE,
    distortion=_of("k1 k2 k3 p1 p2 center"),
    lens=_LENS,
)

_SENSOR = _of(
    "always_on update_rate visualize topic enable_metrics pose frame origin plugin"
    " gz_frame_id ignition_frame_id frame_id rfid rfidtag",
    camera=_CAMERA,
    ray=_LIDAR,
    lidar=_LIDAR,
    contact=_of("collision topic"),
    imu=_of(
        "topic enable_orientation",
        orientation_reference_frame=_of("localization custom_rpy grav_dir_x"),
        angular_velocity=_AXES,
        linear_acceleration=_AXES,
        noise=_NOISE,
    ),
    force_torque=_of("frame measure_direction", force=_AXES, torque=_AXES),
    gps=_GPS,
    navsat=_GPS,
    magnetometer=_AXES,
    altimeter=_of(vertical_position=_NOISY, vertical_velocity=_NOISY),
    air_pressure=_of("reference_altitude", pressure=_NOISY),
    air_speed=_of(pressure=_NOISY),
    logical_camera=_of("near far aspect_ratio horizontal_fov"),
    sonar=_of("geometry min max radius"),
    transceiver=_RADIO,
)
_FREE = frozenset(("plugin", "origin", "pose", "frame", "rfid", "rfidtag"))
"""Elements whose content SDF does not define."""


def unknown_elements(sensor: Element) -> Iterator[UnknownSensorElement]:
    """Yield the elements in a ``<sensor>`` that are unknown to SDF; elements with a prefix are ignored."""
    return _unknown_elements(sensor, _SENSOR)


def _unknown_elements(element: Element, allowed: Allowed) -> Iterator[UnknownSensorElement]:
    for child in element.children:
        if child.tag in allowed:
            if child.tag not in _FREE:
                yield from _unknown_elements(child, allowed[child.tag])
        elif ":" not in child.tag and allowed:
            yield UnknownSensorElement(child, element.tag, nearest(child.tag, allowed))


def nearest(name: str, candidates: Iterator[str] | Allowed | tuple[str, ...], cutoff: float = 0.6) -> str | None:
    """Return the candidate most similar to a name, ignoring case; None if none is similar."""
    from urdfkit.errors import similar

    pool = {candidate.lower(): candidate for candidate in candidates}
    return next((pool[near] for near in similar(name.lower(), pool, cutoff=cutoff)), None)
