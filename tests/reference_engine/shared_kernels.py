"""The parts of the step that the reference engine shares: contact geometry and the solver."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.contacts.contact_search import find_candidate_pairs
from urdfkit.sim.engine.contacts.contact_search import find_contacts as find_contacts_of_placed_trees
from urdfkit.sim.engine.kernel_world import world
from urdfkit.sim.engine.solver.active_set_newton import solve


def find_candidates(floats: Any, integers: Any) -> int:
    """List pairs and mark trees, as `contact_search.find_candidate_pairs` does, for bodies placed by other means."""
    return find_candidate_pairs(world(floats, integers))


def find_contacts(floats: Any, integers: Any, pairs: int) -> int:
    """Find the contacts, as `contact_search.find_contacts` does, of bodies placed by other means."""
    return find_contacts_of_placed_trees(world(floats, integers), pairs)


def find_impulses(floats: Any, integers: Any, rows: int) -> int:
    """Solve rows written by other means; return what `solve` does."""
    return solve(world(floats, integers), rows)
