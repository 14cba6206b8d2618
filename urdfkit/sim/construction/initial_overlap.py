"""Whether something starts inside something else: no push out would be what the user had in mind, so they are told."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from urdfkit.errors import SimulationError

if TYPE_CHECKING:
    from urdfkit.sim.engine import Contact, Engine

DEEP = 0.005
"""How deep a link may be in something without a word [m]; models that are put down by hand are a little."""
PART = 1 << 15
"""Entries of a block that are looked at together."""


def note_overlaps(engine: Engine, links: Collection[str], note: Callable[[str], None], *, newcomer: str = "") -> None:
    """Note what a robot starts inside of, the deepest of its links for each thing.

    Args:
        engine: at the start; left as it was.
        links: the robot's; or names of bodies.
        note: tells the user something.
        newcomer: what they are of, where that has come into a running world; the robot it is about otherwise.
    """
    deepest: dict[str, tuple[float, str]] = {}
    for contact in touching(engine):
        if contact.depth > DEEP and (contact.a in links) is not (contact.b in links):
            link, thing = (contact.a, contact.b) if contact.a in links else (contact.b, contact.a)
            deepest[thing] = max(deepest.get(thing, (0.0, "")), (contact.depth, link))
    for thing, (depth, link) in deepest.items():
        what, where = f"link `{link}`", "start the robot elsewhere (--spawn, Spawn)"
        if newcomer:
            what, where = f"`{link}`", f"put `{newcomer}` elsewhere"
        note(f"{what} starts {1000 * depth:.0f} mm deep in `{thing}`; {where}")


def touching(engine: Engine) -> tuple[Contact, ...]:
    """Return what touches at present, which a step finds out; what the step did is undone."""
    blocks = engine.arrays.floats, engine.arrays.integers
    kept = [_in_use(block) for block in blocks]
    try:
        engine.step()
        return engine.contacts()
    except SimulationError:
        return ()  # whoever steps on is told
    finally:
        for block, before in zip(blocks, kept, strict=True):
            _restore(block, before)


def _in_use(block: NDArray[Any]) -> dict[int, NDArray[Any]]:
    """Return copies of the parts of a block that are not zero: most of it never is, and takes no memory until then."""
    parts = {start: block[start : start + PART] for start in range(0, len(block), PART)}
    return {start: part.copy() for start, part in parts.items() if part.any()}


def _restore(block: NDArray[Any], before: dict[int, NDArray[Any]]) -> None:
    for start in range(0, len(block), PART):
        part = block[start : start + PART]
        if start in before:
            part[:] = before[start]
        elif part.any():
            part[:] = 0
