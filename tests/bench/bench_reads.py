"""CPU time of reading the state between calls of ten steps, compared with MuJoCo in the same run.

    python tests/bench/bench_reads.py

An arm of 12 joints and 20 links without contacts, with the same URDF in both. MuJoCo calls `mj_step` for ten steps and
copies `qpos`, `qvel`, `xpos` and `xquat`; its settings are those of the URDF importer and Euler integration.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parents[2]))

from urdfkit.sim import Simulator

JOINTS, FIXED, STEPS, CALLS, TURNS = 12, 7, 10, 300, 15
INERTIA = '<inertial><mass value="0.3"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>'


def arm() -> str:
    """Return the URDF of the arm."""
    text = f'<link name="link_0">{INERTIA}</link>'
    for k in range(JOINTS):
        text += (
            f'<link name="link_{k + 1}">{INERTIA}</link><joint name="joint_{k}" type="revolute">'
            f'<parent link="link_{k}"/><child link="link_{k + 1}"/><origin xyz="0 0 0.1"/>'
            f'<axis xyz="{k % 2} {1 - k % 2} 0"/><limit lower="-2" upper="2" effort="50" velocity="5"/>'
            f'<dynamics damping="0.5"/></joint>'
        )
    for k in range(FIXED):
        text += (
            f'<link name="tool_{k}"/><joint name="fixed_{k}" type="fixed"><parent link="link_{k + 3}"/>'
            f'<child link="tool_{k}"/><origin xyz="0 0.1 0"/></joint>'
        )
    compiler = '<mujoco><compiler fusestatic="false"/></mujoco>'
    return f'<robot name="arm">{compiler}{text}</robot>'


def ours(path: Path) -> dict[str, Callable[[], None]]:
    """Return the two measured calls of urdfkit."""
    simulator = Simulator(path, world="void", fixed_base=True, sleep=False)
    state = simulator.state

    def poses() -> None:
        state.advance(0)  # without the poses of the call before
        state.link_poses()

    def step_and_read() -> None:
        simulator.step(STEPS)
        simulator.link_poses(), state.q, state.v.copy()

    return {"all link poses": poses, "10 steps, q, v and poses": step_and_read}


def mujocos(path: Path) -> dict[str, Callable[[], None]]:
    """Return the same calls of MuJoCo."""
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(path))
    model.opt.timestep = 0.001
    data = mujoco.MjData(model)

    def poses() -> None:
        mujoco.mj_kinematics(model, data)  # positions of the present step, as ours
        data.xpos.copy(), data.xquat.copy()

    def step_and_read() -> None:
        mujoco.mj_step(model, data, nstep=STEPS)
        data.xpos.copy(), data.xquat.copy(), data.qpos.copy(), data.qvel.copy()

    return {"all link poses": poses, "10 steps, q, v and poses": step_and_read}


def seconds(call: Callable[[], None]) -> float:
    """Return the CPU time of one call [s]."""
    start = time.process_time()
    for _ in range(CALLS):
        call()
    return (time.process_time() - start) / CALLS


def main() -> int:
    """Measure both in turns; print medians and their ratio."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "arm.urdf"
        path.write_text(arm())
        own, peer = ours(path), mujocos(path)
        print(f"{'CPU time per call [µs]':28}{'urdfkit':>9}{'MuJoCo':>9}{'MuJoCo / urdfkit':>18}")
        for name in own:
            turns = [(seconds(own[name]), seconds(peer[name])) for _ in range(TURNS)]
            mine, other = (1e6 * median(column) for column in zip(*turns, strict=True))
            print(f"{name:28}{mine:9.1f}{other:9.1f}{other / mine:18.2f}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
