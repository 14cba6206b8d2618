"""Invalid numbers of a ``<sensor>``, for linter and simulator."""

from __future__ import annotations

from math import isfinite, isnan, pi

from urdfkit.description.plugins.lookup import values
from urdfkit.description.plugins.spec import PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.element import Element
from urdfkit.errors import did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    Senseless = Iterator[tuple[Element, str]]
    """Element and one-line message of each defect."""

ORDERED = (("min_depth", "max_depth"), ("min_range", "max_range"))
"""Pairs of parameters of which the first must be the smaller."""


NOISES = ("none", "gaussian", "gaussian_quantized")
"""Types of noise (sdformat, noise.sdf)."""

PIXEL_FORMATS = frozenset(
    (
        *("L8", "L16", "R8G8B8", "R8G8B8A8", "B8G8R8", "B8G8R8A8", "R16G16B16", "R32G32B32", "B16G16R16", "B32G32R32"),
        *("L_INT8", "L_INT16", "RGB_INT8", "RGBA_INT8", "BGRA_INT8", "RGB_INT16", "RGB_INT32", "BGR_INT8", "BGR_INT16"),
        *("BGR_INT32", "R_FLOAT16", "RGB_FLOAT16", "R_FLOAT32", "RGB_FLOAT32", "UNKNOWN_PIXEL_FORMAT", "UNKNOWN"),
        *("BAYER_RGGB8", "BAYER_BGGR8", "BAYER_GBRG8", "BAYER_GRBG8", "BAYER_RGGR8", "R16", "R32"),
    )
)
"""Pixel formats of a camera (sdformat, camera.sdf and Camera.cc; Gazebo Classic, rendering/Conversions and Image)."""

NUMBERS = frozenset(
    (
        *("update_rate", "samples", "resolution", "min_angle", "max_angle"),
        *("horizontal_fov", "width", "height", "near", "far", "mean", "stddev"),
    )
)
"""Elements of a ``<sensor>`` outside plugins that contain a number (sdformat: sensor.sdf, noise.sdf …)."""

_MAX_ANGLE = 6.3
"""Slightly more than a full turn [rad], because descriptions often contain the rounded value 6.2832."""

_FAR = 1.0
"""Distance that is too large for the minimum of the range of a lidar, and too small for its maximum [m]."""

WIDE = ("wideanglecamera", "wide_angle_camera")
"""Types of cameras with a field of view of up to a full turn (sdformat, camera.sdf: ``horizontal_fov`` to 6.283186)."""


def senseless_numbers(sensor: Element) -> Senseless:
    """Yield values that are not numbers, negative rates, angles above a full turn, and unknown types of noise."""
    wide = [child for child in sensor.children if child.tag in ("min_angle", "max_angle") and _is_wide(child)]
    if wide:
        numbers = " and ".join(f"{_value(child.text):g}" for child in wide)
        names = " and ".join(f"<{child.tag}>" for child in wide)
        verb = "is" if len(wide) == 1 else "are"
        yield wide[0], f"{names} {verb} {numbers} rad, more than a full turn: angles are in radians"
    for child in sensor.children:
        if child.tag == "plugin":
            continue
        if child.tag == "noise" and (unknown := _unknown_noise(child)) is not None:
            yield unknown
        if child.tag not in NUMBERS or child.children:
            yield from senseless_numbers(child)
            continue
        value = _value(child.text)
        if child.text and isnan(value) and child.text.lower() != "nan":
            yield child, f"<{child.tag}> is `{child.text}`, not a number"
        elif child.tag == "update_rate" and value < 0.0:
            yield (
                child,
                f"<update_rate> is {value:g} Hz; it must not be negative; with zero, the sensor updates at every step",
            )


def _is_wide(angle: Element) -> bool:
    return abs(_value(angle.text)) > _MAX_ANGLE


def _unknown_noise(noise: Element) -> tuple[Element, str] | None:
    written = noise.find("type")
    kind = (written.text if written is not None else noise.get("type")) or "none"
    if kind in NOISES:
        return None
    return written or noise, f"unknown noise type `{kind}`; use one of {', '.join(NOISES)}" + did_you_mean(kind, NOISES)


def senseless_scan(lidar: Element) -> Senseless:
    """Yield invalid values in a ``<ray>`` or ``<lidar>``; the defaults are sdformat's (lidar.sdf)."""
    pattern, reach = lidar.find("scan"), lidar.find("range")
    for fan in (None if pattern is None else pattern.find(tag) for tag in ("horizontal", "vertical")):
        if fan is not None:
            yield from _senseless_fan(fan)
    near, far = _number(reach, "min", 0.0), _number(reach, "max", 0.0)
    if near < 0.0:
        yield (reach and reach.find("min")) or lidar, f"<min> is {near:g} m; it must be zero or greater"
    elif not isnan(near + far) and not near < far:
        place = reach and (reach.find("min" if near >= _FAR else "max") or reach.find("min") or reach.find("max"))
        yield place or reach or lidar, f"the range of the lidar, {near:g} m to {far:g} m, is empty"


def _senseless_fan(fan: Element) -> Senseless:
    samples, resolution = _number(fan, "samples", 640.0), _number(fan, "resolution", 1.0)
    if samples < 1:
        yield fan.find("samples") or fan, f"<{fan.tag}> has {samples:g} samples; it must have at least one"
    elif isfinite(samples) and samples != int(samples):
        yield fan.find("samples") or fan, f"<samples> is {samples:g}; it must be a whole number"
    elif resolution <= 0:
        message = f"<resolution> is {resolution:g}; it must be greater than zero: it is multiplied by <samples>"
        yield fan.find("resolution") or fan, message
    elif isfinite(samples * resolution) and round(samples * resolution) < 1:
        yield fan, f"<{fan.tag}> has {samples:g} samples at a resolution of {resolution:g}, which is less than one"
    low, high = _number(fan, "min_angle", 0.0), _number(fan, "max_angle", 0.0)
    place = fan.find("max_angle" if high < 0.0 else "min_angle") or fan
    if low > high:
        yield place, f"<{fan.tag}> goes from {low:g} to {high:g} rad: <min_angle> must be the smaller angle"
    elif low == high != 0.0 and samples > 1:
        yield place, f"<{fan.tag}> has {samples:g} samples, but <min_angle> and <max_angle> are both {low:g} rad"


def senseless_camera(camera: Element, *, is_wide: bool = False) -> Senseless:
    """Yield invalid values in a ``<camera>``; the defaults are sdformat's (camera.sdf).

    Args:
        camera: the element.
        is_wide: whether its sensor is of one of the `WIDE` types, with a field of view of up to a full turn.
    """
    angle = _number(camera, "horizontal_fov", 1.047)
    if not (0.0 < angle < pi or isnan(angle) or (is_wide and 0.0 < angle < _MAX_ANGLE)):
        message = f"<horizontal_fov> is {angle:g} rad; it must be between 0 and {'2π' if is_wide else 'π'}"
        yield camera.find("horizontal_fov") or camera, message
    image, clip = camera.find("image"), camera.find("clip")
    for tag in ("width", "height"):
        pixels = _number(image, tag, 1.0)
        if isfinite(pixels) and (pixels < 1 or pixels != int(pixels)) and image is not None:
            yield image.find(tag) or image, f"<{tag}> is {pixels:g}; it must be a whole number, one or greater"
    written = image.find("format") if image is not None else None
    if written is not None and written.text and written.text.strip().upper() not in PIXEL_FORMATS:
        hint = did_you_mean(written.text, sorted(PIXEL_FORMATS)) or "; use `R8G8B8` for colours or `L8` for grey"
        yield written, f"unknown pixel format `{written.text}`" + hint
    near, far = _number(clip, "near", 0.1), _number(clip, "far", 100.0)
    if not isnan(near + far) and not near < far:
        place = clip and (clip.find("near") or clip.find("far"))
        yield place or clip or camera, f"the range of the camera, {near:g} m to {far:g} m, is empty"


def senseless_parameters(plugin: Plugin, spec: PluginSpec) -> Senseless:
    """Yield pairs of a plugin's parameters in the wrong order."""
    for pair in ORDERED:
        tags, numbers, places = [], [], []
        for meaning in pair:
            parameter = spec.by_meaning(meaning)
            if parameter is None:
                break
            text, place = next(((t, e) for t, e in values(plugin, parameter) if t), (parameter.default, None))
            tags.append(parameter.tag)
            numbers.append(_value(text))
            places.append(place)
        else:
            place = places[0] or places[1]
            if place is not None and numbers[0] >= numbers[1]:
                low, high = (f"<{tag}> {value:g} m" for tag, value in zip(tags, numbers, strict=True))
                yield place, f"the range from {low} to {high} is empty: <{tags[0]}> must be less than <{tags[1]}>"


def _number(parent: Element | None, tag: str, default: float) -> float:
    """Return the number in a child, the default if it is missing, NaN if it is not a number."""
    child = None if parent is None else parent.find(tag)
    return default if child is None or not child.text else _value(child.text)


def _value(text: str | None) -> float:
    try:
        return float(text or "nan")
    except ValueError:
        return float("nan")
