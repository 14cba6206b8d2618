"""Kernels interpreted by Python while they are compiled."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.engine.worlds import cube, rover
from urdfkit.sim.engine import compiling_process, kernel_cache
from urdfkit.sim.engine.compiling_process import CompilingProcess
from urdfkit.sim.engine.interpreted_kernel import InterpretedKernel, interpreted, views
from urdfkit.sim.engine.simulation_memory import ADVANCE, At


def advance_both(engine, world, steps):
    """Return the coordinates and velocities after steps of the compiled and of the interpreted kernel."""
    a = engine.arrays
    floats, integers = a.floats.copy(), a.integers.copy()
    assert interpreted(kernel_cache._advance(world=world))(views(floats, integers), None, steps, ADVANCE) == steps
    engine.step(steps)
    found = [floats[integers[At[name]] :][: a[name].size] for name in ("s", "v")]
    return np.concatenate([a["s"], a["v"]]), np.concatenate(found)


@pytest.mark.parametrize("bodies", [[], [cube("cube", (0.6, 0.0, 0.11))]], ids=["robot", "world"])
def test_the_interpreted_kernel_computes_what_the_compiled_one_does(engine_of, bodies):
    engine = rover(engine_of, bodies=bodies)
    engine.motor_velocity[6:] = 4.0
    engine.motor_effort[6:] = 5.0
    engine.step(100)
    compiled, interpreted_ = advance_both(engine, bool(bodies), 10 if bodies else 100)
    assert abs(compiled[-1]) > 1.0 or bodies
    np.testing.assert_allclose(interpreted_, compiled, rtol=0.0, atol=1e-10)


class Process:
    """A process that compiles for as long as the test wants."""

    def __init__(self, kernel):
        self.kernel, self.ended, self.closed, self.fault = kernel, False, False, None
        Process.last = self

    def wait(self):
        self.ended = True

    def close(self):
        self.closed = True


def compiled_code(*, world):
    """Return a kernel of the cache, which live kernels do not find."""
    return None if kernel_cache._live.get() is not None else kernel_cache._code(world=world).load()


compiled_code.cache_clear = lambda: None


@pytest.fixture
def live(monkeypatch):
    """Kernels without a cache, whose messages are in ``reports`` and ``warnings``."""
    kernel_cache.kernel()  # compiled, for the end
    monkeypatch.setattr(kernel_cache, "CompilingProcess", Process)
    reports, warnings = [], []
    kernels = kernel_cache.LiveKernels(reports.append, warnings.append)
    kernels.reports, kernels.warnings = reports, warnings
    monkeypatch.setattr(kernel_cache, "_native", compiled_code)
    return kernels


def driven(engine, steps):
    engine.motor_velocity[6:] = 4.0
    engine.motor_effort[6:] = 5.0
    engine.step(steps)


@pytest.mark.parametrize(("kernel", "bodies"), [("robot", []), ("world", [cube("cube", (0.6, 0.0, 0.11))])])
def test_the_compiled_kernel_takes_over_without_a_jump(engine_of, live, kernel, bodies):
    unbroken = rover(engine_of, bodies=bodies)
    with live.used():
        engine = rover(engine_of, bodies=bodies)
    assert Process.last.kernel == kernel
    assert len(live.reports) == 1
    driven(engine, 10)
    driven(unbroken, 10)
    assert len(live.reports) == 1
    Process.last.ended = True
    for each in (engine, unbroken):
        each.step(100)
    assert live.reports[1:] == [None]
    assert live.warnings == []
    assert Process.last.closed
    assert engine.steps == 110
    np.testing.assert_allclose(engine.q, unbroken.q, rtol=0.0, atol=1e-10)


def test_other_simulations_of_the_process_are_not_interpreted(engine_of, live):
    with live.used():
        pass
    assert not isinstance(rover(engine_of).kernel, InterpretedKernel)
    assert live.reports == []


def test_what_python_cannot_compute_waits_for_the_compiled_kernel(engine_of, live, monkeypatch):
    monkeypatch.setattr("urdfkit.sim.engine.interpreted_kernel.interpreted", lambda _: lambda *_: 1 / 0)
    with live.used():
        engine = rover(engine_of)
    engine.step(3)
    assert Process.last.ended
    assert engine.steps == 3


def test_a_process_that_fails_is_reported_once_and_the_simulation_goes_on(engine_of, live):
    with live.used():
        engine = rover(engine_of)
    Process.last.ended, Process.last.fault = True, "MemoryError"
    driven(engine, 2)
    driven(engine, 2)
    assert engine.steps == 4
    assert live.reports[1:] == [None]
    assert live.warnings == ["the physics kernel cannot be compiled, so the simulation remains slow: MemoryError"]


@pytest.mark.parametrize(
    ("program", "fault"),
    [
        ("raise MemoryError('no {}')", "MemoryError: no robot"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "its process was ended by SIGKILL"),
        ("pass", None),
    ],
)
def test_the_reason_why_a_process_failed_is_one_line(monkeypatch, program, fault):
    monkeypatch.setattr(compiling_process, "PROGRAM", program)
    process = CompilingProcess("robot")
    process.wait()
    assert process.fault == fault
    process.close()


def test_a_process_ends_when_it_is_closed():
    process = CompilingProcess("robot")
    assert not process.ended
    process.close()
    assert process.ended
