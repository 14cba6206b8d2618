"""What rows do where guesses lead nowhere: robots that are stuck, knocked stacks, heaps that come to rest."""

from __future__ import annotations

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

from urdfkit.sim.engine.arrays import GUESSES
from urdfkit.sim.engine.world.rounds import BALANCE, HARDNESS, HEAP_ROUNDS

SPEC = spec_from_file_location("worlds", Path(__file__).with_name("worlds.py"))
worlds = module_from_spec(SPEC)
SPEC.loader.exec_module(worlds)
cube, slab, rover = worlds.cube, worlds.slab, worlds.rover

X = 3.0
"""Where things are, away from the robot [m]."""
IN_VAIN = -(len(HARDNESS) + 1)


def test_every_round_has_its_stiffness_and_balance():
    assert len(HARDNESS) == len(BALANCE) >= HEAP_ROUNDS


def test_a_knocked_stack_is_never_only_nearly_solved(engine_of):
    engine = rover(engine_of, bodies=[cube(f"box{k}", (X, 0.0, 0.1 + 0.2 * k)) for k in range(5)], sleep=False)
    engine.step(50)
    for sign in (1.0, -1.0, 1.0, -1.0):
        top = engine.bodies["box4"]
        top.place(top.pose, (0.02 * sign, 0.0, 0.0, 0.0, 0.0, 0.0))
        guesses = []
        for _ in range(30):
            engine.step()
            guesses.append(int(engine._arrays["counts"][GUESSES]))
        assert min(guesses) > IN_VAIN
        assert sum(each < 0 for each in guesses) <= 6
        assert set(guesses[15:]) == {1}
