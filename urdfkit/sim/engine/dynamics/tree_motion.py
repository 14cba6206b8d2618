"""Motion of a tree during a step: terms at the start, predicted poses for the contacts, integration."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import compiled, field
from urdfkit.sim.engine.dynamics.integration import move
from urdfkit.sim.engine.dynamics.mass_matrix import place, terms


@compiled
def evaluate(floats: Any, integers: Any, tree: int) -> None:
    """Place a tree's bodies where they are, and compute M and bias."""
    place(floats, integers, tree, field(floats, integers, At.s), False)
    terms(floats, integers, tree)


@compiled
def begin_step(floats: Any, integers: Any, tree: int) -> None:
    """Start a step of a tree from its coordinates and velocities."""
    base = field(floats, integers, At.base)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    P = field(floats, integers, At.P)
    v_start = field(floats, integers, At.v_start)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_s = field(integers, integers, At.tree_s)
    tree_floats = field(integers, integers, At.tree_floats)
    saturated = field(integers, integers, At.saturated)
    pressed = field(integers, integers, At.pressed)
    for d in range(tree_dof[tree], tree_dof[tree + 1]):
        v_start[d] = v[d]
        saturated[d] = pressed[d] = 0
    # All of a tree is reckoned from one point, its floating base: far from the origin nothing is lost.
    for k in range(3):
        P[3 * tree + k] = s[tree_s[tree] + k] if tree_floats[tree] != 0 else base[3 * tree + k]
    evaluate(floats, integers, tree)


@compiled
def integrate_tree(floats: Any, integers: Any, tree: int, dt: float) -> None:
    """Integrate a tree's coordinates for `dt` with its velocities."""
    tree_body = field(integers, integers, At.tree_body)
    s, v = field(floats, integers, At.s), field(floats, integers, At.v)
    move(floats, integers, tree_body[tree], tree_body[tree + 1], s, v, dt)


@compiled
def predict_poses(floats: Any, integers: Any, tree: int, dt: float) -> None:
    """Compute the poses of a tree's bodies after `dt` at the present velocities."""
    tree_body = field(integers, integers, At.tree_body)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_s = field(integers, integers, At.tree_s)
    s, v = field(floats, integers, At.s), field(floats, integers, At.v)
    s_ahead, v_ahead = field(floats, integers, At.s_ahead), field(floats, integers, At.v_ahead)
    for k in range(tree_s[tree], tree_s[tree + 1]):
        s_ahead[k] = s[k]
    for d in range(tree_dof[tree], tree_dof[tree + 1]):
        v_ahead[d] = v[d]
    move(floats, integers, tree_body[tree], tree_body[tree + 1], s_ahead, v_ahead, dt)
    place(floats, integers, tree, s_ahead, True)
