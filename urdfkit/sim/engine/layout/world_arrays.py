"""Robots, bodies and shapes → the engine's arrays."""

from collections.abc import Sequence

import numpy as np

from urdfkit.sim.engine.bodies import Body, Member
from urdfkit.sim.engine.collision.collide_pair import MOST
from urdfkit.sim.engine.collision.convex_hull import convex_hull
from urdfkit.sim.engine.collision.geometry_arrays import Geometry
from urdfkit.sim.engine.collision.support_points import HULL, MESH
from urdfkit.sim.engine.contact_surface import Ground, Touching
from urdfkit.sim.engine.contacts import ground_contacts
from urdfkit.sim.engine.island_solver.nesterov_acceleration import KEPT
from urdfkit.sim.engine.layout.collision_shapes import box_of, still_box
from urdfkit.sim.engine.layout.tree_arrays import branch_entries, fill_branches, fill_free, fill_member
from urdfkit.sim.engine.simulation_memory import Arrays, allocate

PAIRS, PAIRS_EACH = 32768, 64
"""Most pairs of shapes whose boxes may overlap at once, or so many for each shape that moves if that is more."""
MOST_DENSE = 1500
"""Most rows of an island that there is room for the matrix of; those with more are swept."""


def fill(
    members: Sequence[Member],
    bodies: Sequence[Body],
    touches: Sequence[Touching],
    *,
    dt: float,
    gravity: Sequence[float],
    ground: Ground | None,
    sleep: bool = False,
) -> Arrays:
    """Return the arrays of a world of robots and bodies with these shapes, which may `sleep` or never do."""
    free = [body for body in bodies if not body.static]
    models = [member.kinematics.model for member in members]
    joints = [[model.joints[i].nv for i in range(1, model.njoints)] for model in models] + [[6]] * len(free)
    dofs = [sum(each) for each in joints]
    widths = [sum(nv if nv < 6 else 7 for nv in each) for each in joints]
    features = [_features(touch) for touch in touches]
    geometry = Geometry()
    moving = [touch for touch in touches if touch.body >= 0]
    mimics = [len(member.kinematics.mimic_names) for member in members] + [0] * len(free)
    links = [len(member.kinematics.link_names) for member in members] + [0] * len(free)
    owners = {touch.owner for touch in touches}
    meets = len(owners) > 1 or any(touch.meets for touch in touches)
    contacts = sum(
        min(ground_contacts.MOST[touch.kind], n) for touch, n in zip(touches, features, strict=True) if touch.body >= 0
    )
    # What may need sweeps goes to the kernel that has them, even if nothing meets.
    meets = meets or sum(mimics) + 2 * sum(dofs) + 3 * contacts > MOST_DENSE
    places = [_add(geometry, touch) if meets else 0 for touch in touches]
    pairs = min(max(PAIRS, PAIRS_EACH * len(moving)), len(moving) * len(touches)) if meets else 0
    contacts += min(pairs * MOST, 64 + 24 * len(moving)) if meets else 0
    rows = sum(mimics) + 2 * sum(dofs) + 3 * contacts
    slots = 2 * sum(dofs) + sum(mimics) + 3 * (sum(features) + contacts)
    vertices = sum(len(touch.vertices) for touch in touches)
    width = max(dofs, default=0) * (2 if meets else 1)
    entries = sum(n * n for n in dofs)
    sizes = (
        sum(len(each) for each in joints),
        sum(dofs),
        sum(widths),
        len(touches),
        vertices,
        sum(mimics),
        contacts,
        rows,
        slots,
        len(joints),
        entries,
        rows * width,
        max(KEPT // 3 * rows, min(rows, MOST_DENSE) ** 2),
        pairs,
        len(geometry.numbers),
        len(geometry.indices),
        sum(links),
        sum(branch_entries(n) for n in dofs),
    )
    arrays = allocate(sizes, width=width)
    arrays["numbers"][:] = dt, ground.height if ground else 0.0, ground is not None, meets
    arrays["gravity"][:] = gravity
    arrays["tree_body"][1:] = np.cumsum([len(each) for each in joints])
    arrays["tree_dof"][1:] = np.cumsum(dofs)
    arrays["tree_s"][1:] = np.cumsum(widths)
    arrays["tree_mimic"][1:] = np.cumsum(mimics)
    arrays["tree_link"][1:] = np.cumsum(links)
    for name in ("servo_effort", "fastest", "acceleration", "deceleration"):
        arrays[name][:] = np.inf
    arrays["sleeps"][:] = sleep
    arrays["gravity_last_step"][:] = gravity
    arrays["tree_order"][:] = np.arange(len(joints))
    arrays["lower"][:], arrays["upper"][:] = -np.inf, np.inf
    entry = 0
    for tree, n in enumerate(dofs):
        first = int(arrays["tree_dof"][tree])
        arrays["dof_row"][first : first + n] = entry + np.arange(n) * n - first
        arrays["body_tree"][arrays["tree_body"][tree] : arrays["tree_body"][tree + 1]] = tree
        entry += n * n
    for tree, member in enumerate(members):
        fill_member(arrays, tree, member)
    for tree, body in enumerate(free, len(members)):
        fill_free(arrays, tree, body)
    fill_branches(arrays)
    arrays["shape_data"][:] = places
    arrays["pair_numbers"][:], arrays["pair_indices"][:] = geometry.numbers, geometry.indices
    _fill_shapes(arrays, touches, features, 100.0 if ground is None else ground.mu)
    return arrays


def _add(geometry: Geometry, touch: Touching) -> int:
    """Add a hull or mesh to the geometry for pairs; return its `data`."""
    if touch.kind == HULL:
        return geometry.add_hull(convex_hull(touch.vertices))
    return geometry.add_mesh(touch.triangles) if touch.kind == MESH else 0


def _features(touch: Touching) -> int:
    if touch.body < 0:  # only what moves touches the ground
        return 0
    return len(touch.vertices) if touch.kind == HULL else ground_contacts.FEATURES[touch.kind]


def _fill_shapes(arrays: Arrays, touches: Sequence[Touching], features: Sequence[int], floor_mu: float) -> None:
    feature = vertex = 0
    for k, touch in enumerate(touches):
        arrays["shape_kind"][k] = touch.kind
        arrays["shape_body"][k] = touch.body
        arrays["shape_owner"][k] = touch.owner
        arrays["shape_meets"][k] = touch.meets
        arrays["shape_feature"][k] = feature
        arrays["shape_vertex"][k] = vertex
        arrays["shape_R"][k] = touch.R.ravel()
        arrays["shape_p"][k] = touch.p
        arrays["shape_size"][k] = touch.size
        arrays["shape_middle"][k], arrays["shape_half"][k] = box_of(touch)
        arrays["shape_radius"][k] = touch.radius
        arrays["shape_mu"][k] = touch.mu
        arrays["floor_mu"][k], arrays["floor_mu2"][k] = min(touch.mu, floor_mu), min(touch.mu2, floor_mu)
        arrays["shape_mu2"][k], arrays["shape_along"][k] = touch.mu2, touch.along
        arrays["along_body"][k] = touch.along_body
        arrays["vertices"][vertex : vertex + len(touch.vertices)] = touch.vertices
        feature += features[k]
        vertex += len(touch.vertices)
    arrays["shape_vertex"][len(touches)] = vertex
    for touch in touches:
        if touch.meets and touch.owner < len(arrays["tree_meets"]):
            arrays["tree_meets"][touch.owner] = 1
    trees = [int(arrays["body_tree"][touch.body]) for touch in touches if touch.body >= 0]
    arrays["tree_shape"][:] = np.searchsorted(trees, np.arange(len(arrays["tree_shape"])))
    for k in range(len(trees), len(touches)):
        arrays["shape_at"][k], arrays["shape_reach"][k] = still_box(touches[k])
