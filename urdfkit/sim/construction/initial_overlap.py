"""Warnings about bodies that start inside others, because no separating push restores the intended pose."""

from collections.abc import Callable, Collection
from typing import Any

from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.sim.engine import Contact, Engine

DEEP = 0.005
"""Overlap without a warning [m]; models that are placed manually overlap slightly."""
PART = 1 << 15
"""Number of entries of a block that are saved together."""


def note_overlaps(
    engine: Engine,
    links: Collection[str],
    note: Callable[[str], None],
    *,
    newcomer: str = "",
    models: Collection[str] = (),
) -> None:
    """Warn of the bodies that a robot overlaps at the start, with its most deeply overlapping link.

    One warning names the two models of the world that overlap most deeply, and the number of other pairs.

    Args:
        engine: the engine at the start; its state is preserved.
        links: links of the robot, or names of bodies.
        note: reports a warning to the user.
        newcomer: name of the entity if it was spawned into a running world; empty for the first robot.
        models: models of the world that are compared with each other.
    """
    deepest: dict[str, tuple[float, str]] = {}
    pairs: dict[tuple[str, str], float] = {}
    for contact in touching(engine):
        if contact.depth <= DEEP:
            continue
        first, second = (name.partition("::")[0] for name in (contact.a, contact.b))
        if first != second and first in models and second in models:
            pairs[first, second] = max(pairs.get((first, second), 0.0), contact.depth)
        if (contact.a in links) is not (contact.b in links):
            link, body = (contact.a, contact.b) if contact.a in links else (contact.b, contact.a)
            deepest[body] = max(deepest.get(body, (0.0, "")), (contact.depth, link))
    for body, (depth, link) in deepest.items():
        subject, advice = f"link `{link}`", "start the robot elsewhere (--spawn, Spawn)"
        if newcomer:
            subject, advice = f"`{link}`", f"place `{newcomer}` elsewhere"
        note(f"{subject} starts {1000 * depth:.0f} mm inside `{body}`; {advice}")
    if pairs:
        (subject, body), depth = max(pairs.items(), key=lambda pair: pair[1])
        others = f" (other overlapping pairs: {len(pairs) - 1})" if len(pairs) > 1 else ""
        note(f"model `{subject}` starts {1000 * depth:.0f} mm inside `{body}`; change its <pose>{others}")


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
