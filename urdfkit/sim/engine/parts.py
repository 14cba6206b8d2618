"""The parts of the step that the reference provider shares: contact geometry and the solver."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import CONTACTS, DT, FLOOR, SHAPES, At, field
from urdfkit.sim.engine.collide import collide_with_plane
from urdfkit.sim.engine.solve import solve


def find_contacts(floats: Any, integers: Any) -> int:
    """Find the contacts of bodies placed by other means; return how many."""
    numbers = field(floats, integers, At.numbers)
    return collide_with_plane(
        integers[SHAPES],
        integers[CONTACTS],
        field(integers, integers, At.shape_kind),
        field(integers, integers, At.shape_body),
        field(integers, integers, At.shape_feature),
        field(integers, integers, At.shape_vertex),
        field(floats, integers, At.shape_R),
        field(floats, integers, At.shape_p),
        field(floats, integers, At.shape_size),
        field(floats, integers, At.shape_radius),
        field(floats, integers, At.shape_mu),
        field(floats, integers, At.vertices),
        field(floats, integers, At.extreme),
        field(integers, integers, At.extreme_vertex),
        numbers[FLOOR] - floats[integers[At.P] + 2],
        numbers[DT],
        field(floats, integers, At.R),
        field(floats, integers, At.r),
        field(floats, integers, At.twist),
        field(integers, integers, At.contact_body),
        field(integers, integers, At.contact_feature),
        field(floats, integers, At.contact_point),
        field(floats, integers, At.contact_frame),
        field(floats, integers, At.contact_gap),
        field(floats, integers, At.contact_mu),
    )


def find_impulses(floats: Any, integers: Any, rows: int) -> int:
    """Solve rows written by other means; return what `solve` does."""
    return solve(
        rows,
        field(floats, integers, At.A),
        field(floats, integers, At.g),
        field(floats, integers, At.low),
        field(floats, integers, At.high),
        field(floats, integers, At.mu),
        field(floats, integers, At.before),
        field(integers, integers, At.state),
        field(floats, integers, At.slip),
        field(floats, integers, At.B),
        field(floats, integers, At.y),
        field(integers, integers, At.index),
        field(floats, integers, At.x),
    )
