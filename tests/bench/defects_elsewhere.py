"""What other simulators do with a defective link of a URDF: the table in docs/physics.md.

Run it as ``python tests/bench/defects_elsewhere.py [mujoco] [pybullet] [drake] [urdfkit]`` in an environment that has
them (``pip install mujoco pybullet drake``). An arm hangs from the world on a joint; its link has one defect. Each
engine loads it and simulates one second in a process of its own; the output is the mass and the moments of inertia that
it uses, the angle after a second, and the messages, or the error.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path

BOX = '<collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>'
EMPTY = '<collision><geometry><box size="0.1 0 0.3"/></geometry></collision>'
MESH = '<collision><geometry><mesh filename="missing.obj"/></geometry></collision>'
INERTIAL = (
    '<inertial><origin xyz="0.2 0 0"/><mass value="{}"/>'
    '<inertia ixx="{}" ixy="0" ixz="0" iyy="{}" iyz="0" izz="{}"/></inertial>'
)
GOOD = INERTIAL.format(1, 0.01, 0.01, 0.01)
PLUGIN = '<gazebo><plugin name="own" filename="libown_plugin.so"/></gazebo>'

DEFECTS = {
    "no defect": BOX + GOOD,
    "no <inertial>, with a shape": BOX,
    "no <inertial>, no shape": "",
    "mass 0": BOX + INERTIAL.format(0, 0.01, 0.01, 0.01),
    "mass 0, inertia 0": BOX + INERTIAL.format(0, 0, 0, 0),
    "inertia 0": BOX + INERTIAL.format(1, 0, 0, 0),
    "negative mass": BOX + INERTIAL.format(-1, 0.01, 0.01, 0.01),
    "impossible tensor": BOX + INERTIAL.format(1, 0.01, 0.01, 0.05),
    "tensor off by 1e-8": BOX + INERTIAL.format(1, 0.01, 0.01, 0.02 * (1 + 1e-8)),
    "negative moment": BOX + INERTIAL.format(1, 0.01, 0.01, -0.01),
    "size 0": EMPTY + GOOD,
    "missing mesh": MESH + GOOD,
    "unknown plugin": BOX + GOOD,
}

ROBOT = """<robot name="arm">
<link name="world"/>
<link name="arm">{}</link>
<joint name="hinge" type="continuous"><parent link="world"/><child link="arm"/><axis xyz="0 1 0"/></joint>
{}</robot>"""


def mujoco(path: str) -> str:
    """Load and simulate in MuJoCo."""
    mj = importlib.import_module("mujoco")
    model = mj.MjModel.from_xml_path(path)
    data = mj.MjData(model)
    while data.time < 1.0:
        mj.mj_step(model, data)
    shapes = model.ngeom
    body = model.nbody - 1
    return f"mass {model.body_mass[body]:.4g}, inertia {model.body_inertia[body]}, {shapes} shapes, q {data.qpos}"


def pybullet(path: str) -> str:
    """Load and simulate in PyBullet."""
    pb = importlib.import_module("pybullet")
    pb.connect(pb.DIRECT)
    pb.setGravity(0, 0, -9.81)
    body = pb.loadURDF(path, useFixedBase=True, flags=pb.URDF_USE_INERTIA_FROM_FILE)
    pb.setJointMotorControl2(body, 0, pb.VELOCITY_CONTROL, force=0)
    pb.changeDynamics(body, 0, linearDamping=0, angularDamping=0, jointDamping=0)
    for _ in range(240):
        pb.stepSimulation()
    dynamics = pb.getDynamicsInfo(body, 0)
    shapes = len(pb.getCollisionShapeData(body, 0))
    return f"mass {dynamics[0]:.4g}, inertia {dynamics[2]}, {shapes} shapes, q {pb.getJointState(body, 0)[0]:.4g}"


def drake(path: str) -> str:
    """Load and simulate in Drake."""
    plants = importlib.import_module("pydrake.multibody.plant")
    parsing = importlib.import_module("pydrake.multibody.parsing")
    framework = importlib.import_module("pydrake.systems.framework")
    analysis = importlib.import_module("pydrake.systems.analysis")
    builder = framework.DiagramBuilder()
    plant, _ = plants.AddMultibodyPlantSceneGraph(builder, 0.001)
    parsing.Parser(plant).AddModels(path)
    plant.Finalize()
    simulator = analysis.Simulator(builder.Build())
    simulator.AdvanceTo(1.0)
    context = plant.GetMyContextFromRoot(simulator.get_context())
    body = plant.GetBodyByName("arm")
    inertia = body.default_spatial_inertia()
    moments = inertia.CalcRotationalInertia().get_moments()
    shapes, q = plant.num_collision_geometries(), plant.GetPositions(context)
    return f"mass {inertia.get_mass():.4g}, inertia {moments}, {shapes} shapes, q {q}"


def urdfkit(path: str) -> str:
    """Load and simulate in urdfkit."""
    simulator = importlib.import_module("urdfkit").Simulator(path, note=lambda text: print(text, file=sys.stderr))
    simulator.run(1.0)
    inertial = simulator.kinematics.robot.link_by_name["arm"].inertial
    i = inertial.inertia
    shapes = len(list(simulator.scene.with_role("collision")))
    return (
        f"mass {inertial.mass:.4g}, inertia {i.ixx:.4g} {i.iyy:.4g} {i.izz:.4g}, {shapes} shapes, q {simulator.state.q}"
    )


ENGINES = {"mujoco": mujoco, "pybullet": pybullet, "drake": drake, "urdfkit": urdfkit}


def main() -> int:
    """Try every defect in every engine."""
    if sys.argv[1:2] == ["--one"]:
        print("RESULT", ENGINES[sys.argv[2]](sys.argv[3]))
        return 0
    for engine in sys.argv[1:] or [
        name for name in ENGINES if importlib.util.find_spec(name.replace("drake", "pydrake"))
    ]:
        for defect, inside in DEFECTS.items():
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "arm.urdf"
                path.write_text(ROBOT.format(inside, PLUGIN if defect == "unknown plugin" else ""))
                command = [sys.executable, __file__, "--one", engine, str(path)]
                done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
                output = (done.stdout + done.stderr).replace(folder, "")
            kept = [line for line in output.splitlines() if line.strip() and not line.startswith(("  File", "    "))]
            kept.sort(key=lambda line: "RESULT" not in line)
            print(f"{engine:9s} {defect:28s} status {done.returncode}: {' | '.join(kept)[:600]}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
