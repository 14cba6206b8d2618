"""I506 inertia-decimal-slip."""

from urdfkit.description.urdf.robot import Link
from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS, tensor_of
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

AGREEMENT = 1.7
"""Factor within which a moment agrees with that at uniform density."""

SCALED_AGREEMENT = 1.5
"""Factor within which a moment agrees after scaling by a power of ten."""

EXACT = 1.02
"""Factor within which all three moments agree with those of a shape after scaling by ten."""

_MIRRORED = 0.02
"""Largest difference of the tensors of mirrored parts, relative to the largest entry."""


class InertiaDecimalSlip(RobotRule):
    """One moment of inertia is off by a power of ten.

    ## What it does
    Compares ixx, iyy and izz with the moments of inertia of the link's shapes at uniform density. If two moments agree
    and the third is off by a factor of 10, 100 or 1000, the decimal point of the third is wrong. If all three are off
    by a factor of exactly 10, the decimal point of the mass may be wrong. A tensor with products of inertia is accepted
    if another link has the same tensor except for signs, because such pairs come from CAD programs that computed them
    for mirrored parts.

    ## Why is this bad?
    The link rotates about one axis as if it were much lighter or heavier than it is.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <inertial>
           <mass value="3"/>
    -      <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.0052"/>
    +      <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.052"/>
         </inertial>
         <visual><geometry><box size="0.32 0.31 0.3"/></geometry></visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix scales the moment, but the other moments may be the wrong ones.
    """

    code = "I506"
    name = "inertia-decimal-slip"
    severity = "warning"
    fix = "unsafe"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each moment that is off by a power of ten."""
        extents = model.extents
        for link in model.robot.links:
            inertial = link.inertial
            if inertial is None or not inertial.mass or inertial.mass < 0.0 or inertial.inertia is None:
                continue
            inertia = inertial.inertia
            written = (inertia.ixx, inertia.iyy, inertia.izz)
            extent = extents.get(link.name)
            if extent is None or min(written) <= 0.0:
                continue
            values = tensor_of(link, extent, inertial.mass)
            if values is None or min(values[0], values[3], values[5]) <= 0.0:
                continue
            ratios = (written[0] / values[0], written[1] / values[3], written[2] / values[5])
            outliers = [axis for axis, ratio in enumerate(ratios) if not 1.0 / AGREEMENT < ratio < AGREEMENT]
            if len(outliers) == 3:
                yield from self._mass(model, link, ratios)
            if len(outliers) != 1:
                continue
            if _has_mirrored_part(model, link):
                model.document(link.element.origin.position.file)  # not clean alone: the result depends on the other
                continue
            axis = outliers[0]
            name, moment, ratio = ("ixx", "iyy", "izz")[axis], written[axis], ratios[axis]
            powers = (-3, -2, -1, 1, 2, 3)
            power = next((k for k in powers if 1.0 / SCALED_AGREEMENT < ratio * 10.0**k < SCALED_AGREEMENT), None)
            if power is not None:
                corrected = f"{moment * 10.0**power:.6g}"
                is_impossible = 2.0 * max(written) > sum(written)  # principal moments, which I503 reports otherwise
                yield self.at(
                    model,
                    inertia.element,
                    f"link `{link.name}`: {name}={moment:g} kg·m² is off by a factor of {10 ** abs(power)}",
                    attribute=name,
                    link=link.name,
                    severity="error" if is_impossible else None,
                    help=f"shape and mass give {moment / ratio:.3g} kg·m²; did you mean {corrected}?",
                    fix=new_value(model, inertia.element, name, corrected, "unsafe", f"Replace with {corrected}"),
                )

    def _mass(self, model: Model, link: Link, ratios: tuple[float, ...]) -> Findings:
        """Yield a finding for a mass with which all moments are off by ten, but would be exactly those of the shape."""
        inertial = link.inertial
        low, high = min(ratios), max(ratios)
        power = next((k for k in (-1, 1) if low * 10.0**k > 1.0 / EXACT and high * 10.0**k < EXACT), None)
        if inertial is None or power is None:
            return
        place = inertial.element.find("mass") or inertial.element
        message = f"link `{link.name}`: mass {inertial.mass:g} kg or all moments of inertia are off by a factor of 10"
        help = f"the moments match the shape with a mass of {(inertial.mass or 0.0) / 10.0**power:g} kg"
        yield self.at(model, place, message, attribute="value", link=link.name, help=help)


def _has_mirrored_part(model: Model, link: Link) -> bool:
    """Return whether another link has the same tensor except for signs: a program computed both from the geometry."""
    own = _entries(link)
    if own is None or not any((own[1], own[2], own[4])):
        return False
    others = (other for other in model.robot.links if other is not link)
    return any((entries := _entries(other)) is not None and _is_close(entries, own) for other in others)


def _entries(link: Link) -> tuple[float, ...] | None:
    inertia = link.inertial.inertia if link.inertial is not None else None
    return tuple(abs(getattr(inertia, name)) for name in COMPONENTS) if inertia is not None else None


def _is_close(entries: tuple[float, ...], others: tuple[float, ...]) -> bool:
    largest = max(others)
    return all(abs(entry - other) <= _MIRRORED * largest for entry, other in zip(entries, others, strict=True))
