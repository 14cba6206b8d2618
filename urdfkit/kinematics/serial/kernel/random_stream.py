"""Random numbers of a target: they depend on its own numbers and the seed, not on other targets or threads.

The generator is SplitMix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, 2014).
"""

from typing import Any

from numba import uint64

from urdfkit.kinematics.serial.kernel.compilation import Integers, inlined


@inlined
def mixed(z: Any) -> Any:
    """Return 64 bits that each depend on all bits of `z`."""
    z = (z ^ (z >> uint64(30))) * uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> uint64(27))) * uint64(0x94D049BB133111EB)
    return z ^ (z >> uint64(31))


@inlined
def next_state(state: Any) -> Any:
    """Return the state after `state`."""
    return uint64(state) + uint64(0x9E3779B97F4A7C15)


@inlined
def uniform(state: Any) -> float:
    """Return a number of [0, 1) for a state."""
    return float(mixed(state) >> uint64(11)) * (1.0 / 9007199254740992.0)


@inlined
def first_state(seed: float, bits: Integers, first: int, count: int) -> Any:
    """Return the state for a target.

    Args:
        seed: number of the stream.
        bits: the numbers of the targets, as integers.
        first: index of the target's first number.
        count: number of its numbers.
    """
    state = mixed(next_state(uint64(seed)))
    for k in range(count):
        state = mixed(next_state(state ^ uint64(bits[first + k])))
    return state
