"""A function and all it calls, compiled as one program: the same as numba makes of them, and no trace left."""

from __future__ import annotations

import gc
import math

import numba
import numpy as np
import pytest
from numba.core.registry import cpu_target

from urdfkit.compilation import compile_or_load
from urdfkit.compilation.whole_program import EntryLibrary, LinkedFunction, whole_program

OPTIONS = {"fastmath": False, "error_model": "numpy", "nogil": True, "_nrt": False}
FLOATS = (numba.float64[::1],)


@numba.njit(**OPTIONS)
def hypotenuse(a, b):
    return math.sqrt(a * a + b * b)


@numba.njit(forceinline=True, **OPTIONS)
def farthest(values):
    most = 0.0
    for k in range(len(values) - 1):
        most = max(most, hypotenuse(values[k], values[k + 1]))
    return most


@numba.njit(**OPTIONS)
def positive(value):
    if value < 0.0:
        raise ValueError("below zero")
    return value


def work(values):
    total = np.cos(values[0]) % 0.3
    for k in range(len(values)):
        total += hypotenuse(values[k], farthest(values)) * positive(abs(values[k]))
    return total


def refuses(values):
    return positive(values[0])


def other(values):
    return farthest(values) + hypotenuse(values[0], 1.0)


def whole(function):
    dispatcher = numba.njit(function, **OPTIONS)
    with whole_program(function.__qualname__):
        dispatcher.compile(FLOATS)
    return dispatcher


def plain(function):
    dispatcher = numba.njit(function, **OPTIONS)
    dispatcher.compile(FLOATS)
    return dispatcher


def test_a_program_computes_what_numba_makes_of_its_functions():
    one, other = whole(work), plain(work)
    assert isinstance(one.overloads[FLOATS].library, EntryLibrary)
    rng = np.random.default_rng(1)
    for _ in range(50):
        values = rng.normal(size=rng.integers(1, 9))
        assert one(values) == other(values)


def test_only_the_outermost_function_is_emitted():
    library = whole(work).overloads[FLOATS].library
    outside = {f.name for f in library.get_defined_functions() if f.linkage.name == "external"}
    assert len(outside) == 2  # itself, and what Python calls
    assert all("work" in name for name in outside)


def test_what_it_calls_can_be_called_and_compiled_alone_afterwards():
    whole(work)
    left = [*farthest.overloads.values(), *hypotenuse.overloads.values()]
    assert not [each for each in left if isinstance(each.library, LinkedFunction)]
    assert hypotenuse(3.0, 4.0) == 5.0
    assert plain(other)(np.array([3.0, 4.0])) == 5.0 + math.sqrt(10.0)


def test_parts_that_were_compiled_before_are_taken_as_they_are():
    assert hypotenuse(3.0, 4.0) == 5.0
    assert whole(other)(np.array([3.0, 4.0])) == 5.0 + math.sqrt(10.0)


def test_an_error_in_a_part_is_raised():
    with pytest.raises(ValueError, match="below zero"):
        whole(refuses)(np.array([-1.0]))


def test_nothing_of_numba_stays_changed():
    target = cpu_target.target_context
    subroutines = set(target.cached_internal_func)
    changed = target, target.codegen(), cpu_target.typing_context
    before = [set(vars(each)) for each in changed]
    whole(work)
    with pytest.raises(numba.TypingError), whole_program("wrong"):
        numba.njit(lambda x: x.nothing, **OPTIONS).compile(FLOATS)
    assert [set(vars(each)) for each in changed] == before
    assert gc.isenabled()
    assert set(target.cached_internal_func) == subroutines


@pytest.mark.parametrize("broken", ["finalize", "get_pointer_to_function"])
def test_where_numba_is_made_otherwise_it_compiles_as_it_does(monkeypatch, tmp_path, broken):
    def fail(*arguments):
        raise AttributeError("no such thing in this numba")

    monkeypatch.setattr(EntryLibrary, broken, fail)
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    compiled = compile_or_load(other, FLOATS, digest=f"broken {broken}", options=OPTIONS)
    assert compiled(np.array([3.0, 4.0])) == 5.0 + math.sqrt(10.0)
    assert not isinstance(compiled.overloads[FLOATS].library, EntryLibrary)
