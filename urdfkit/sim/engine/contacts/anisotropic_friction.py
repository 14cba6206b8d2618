"""Anisotropic friction, and the warm start of friction impulses.

With coefficients mu1 along one tangent and mu2 along the other, the tangents of a contact's frame have the lengths mu1
and mu2: the friction ellipse becomes a circle of radius 1, and impulses along these tangents have the right magnitude.
Friction obeys the principle of maximum dissipation: it is the point of the ellipse that dissipates most power.
"""

from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import (
    cross,
    dot,
    load_rotation,
    load_spatial,
    load_vector,
    rotate,
    scale,
    store_vector,
    sub,
)


@inlined
def orient_friction(
    w: KernelWorld, contacts: int, first_slot: int, first_pair_slot: int, memory: Any, dt: float
) -> None:
    """Set the frames of contacts with two coefficients; rotate the stored friction of other contacts with their bodies.

    When a robot drives a curve, slip rotates with it, so the rotated impulse is the better warm start. Frames along a
    direction of a body rotate with the body.
    """
    for k in range(contacts):
        shape, against = w.contact_shape[k], w.contact_against[k]
        mu2 = w.floor_mu2[shape] if against < 0 else min(w.shape_mu2[shape], w.shape_mu2[against])
        if mu2 != w.contact_mu[k]:
            set_frame(w, k, mu2)
            continue
        at = first_slot + 3 * w.contact_feature[k] if against < 0 else first_pair_slot + 3 * k
        first, second = memory[at + 1], memory[at + 2]
        if first == 0.0 and second == 0.0:
            continue
        spin = load_spatial(w.twist, w.contact_body[k])[1]
        half = 0.5 * dt * dot(spin, load_vector(w.contact_frame, 3 * k + 2))
        # Cayley's rotation: it keeps the length, and its angle is right to third order.
        share = 2.0 / (1.0 + half * half)
        cosine, sine = share - 1.0, half * share
        memory[at + 1], memory[at + 2] = cosine * first - sine * second, sine * first + cosine * second


@inlined
def set_frame(w: KernelWorld, k: int, mu2: float) -> None:
    """Write the tangents of a contact with two coefficients: along its shapes' direction and across, mu1 and mu2 long.

    Of two directions that of the shape with the smaller mu1 counts, as in Gazebo Classic (ODEPhysics::Collide). Without
    one, or where it is normal to the contact, the tangents stay along the world's axes.
    """
    shape, other = w.contact_shape[k], w.contact_against[k]
    along = load_vector(w.shape_along, shape)
    if other >= 0:
        second = load_vector(w.shape_along, other)
        none = dot(along, along) == 0.0
        if dot(second, second) > 0.0 and (none or w.shape_mu[other] < w.shape_mu[shape]):
            shape, along = other, second
    if w.along_body[shape] >= 0:
        along = rotate(load_rotation(w.R, w.along_body[shape]), along)
    normal = load_vector(w.contact_frame, 3 * k + 2)
    first = load_vector(w.contact_frame, 3 * k)
    flat = sub(along, scale(dot(along, normal), normal))
    size = dot(flat, flat) ** 0.5
    if size > 1e-6:
        first = scale(1.0 / size, flat)
    store_vector(w.contact_frame, 3 * k, scale(w.contact_mu[k], first))
    store_vector(w.contact_frame, 3 * k + 1, scale(mu2, cross(normal, first)))
    w.contact_mu[k] = 1.0
