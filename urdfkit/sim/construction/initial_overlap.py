"""Warnings about robots that start inside other bodies, because no separating push restores the intended pose."""

from collections.abc import Callable, Collection
from typing import Any

from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.sim.engine import Contact, Engine

DEEP = 0.005
"""Overlap without a warning [m]; models that are placed manually overlap slightly."""
PART = 1 << 15
"""Number of entries of a block that are saved together."""


def note_overlaps(engine: Engine, links: Collection[str], note: Callable[[str], None], *, newcomer: str = "") -> None:
    """Warn of the bodies that a robot overlaps at the start, with its most deeply overlapping link.

    Args:
        engine: the engine at the start; its state is preserved.
        links: links of the robot, or names of bodies.
        note: reports a warning to the user.
        newcomer: name of the entity if it was spawned into a running world; empty for the first robot.
    """
    deepest: dict[str, tuple[float, str]] = {}
    for contact in touching(engine):
        if contact.depth > DEEP and (contact.a in links) is not (contact.b in links):
            link, body = (contact.a, contact.b) if contact.a in links else (contact.b, contact.a)
            deepest[body] = max(deepest.get(body, (0.0, "")), (contact.depth, link))
    for body, (depth, link) in deepest.items():
        subject, advice = f"link `{link}`", "start the robot elsewhere (--spawn, Spawn)"
        if newcomer:
            subject, advice = f"`{link}`", f"place `{newcomer}` elsewhere"
        note(f"{subject} starts {1000 * depth:.0f} mm inside `{body}`; {advice}")


def touching(engine: Engine) -> tuple[Contact, ...]:
    """Return the present contacts, which are computed by a step; the effects of the step are reverted."""
    blocks = engine.arrays.floats, engine.arrays.integers
    kept = [_in_use(block) for block in blocks]
    try:
        engine.step()
        return engine.contacts()
    except SimulationError:
        return ()  # the next step of the user reports the error
    finally:
        for block, before in zip(blocks, kept, strict=True):
            _restore(block, before)


def _in_use(block: NDArray[Any]) -> dict[int, NDArray[Any]]:
    """Return copies of the parts of a block that are not zero; most parts are, and occupy no memory."""
    parts = {start: block[start : start + PART] for start in range(0, len(block), PART)}
    return {start: part.copy() for start, part in parts.items() if part.any()}


def _restore(block: NDArray[Any], before: dict[int, NDArray[Any]]) -> None:
    for start in range(0, len(block), PART):
        part = block[start : start + PART]
        if start in before:
            part[:] = before[start]
        elif part.any():
            part[:] = 0
