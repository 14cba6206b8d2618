"""Pictures per CPU second next to MuJoCo's and PyBullet's software renderers, 640 × 480, of a room of the house.

Run it: ``python tests/bench/bench_pictures.py [--seconds 1] [--rounds 3] [--json]``. Everybody gets the same visuals,
the same camera and one sun; before every picture a table in it is moved a little, as a robot would be. All take turns,
and the best round of each counts. CPU seconds are those of all threads of the process. MuJoCo draws by the same OpenGL
as our ``gl``; without a graphics card that is a driver that draws on the CPU. MuJoCo takes four samples by default.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Callable
from typing import Any

os.environ.setdefault("MUJOCO_GL", "egl")

import numpy as np

from urdfkit.description.sdf import load_world
from urdfkit.description.urdf.robot import Box, Cylinder, Pose, Sphere
from urdfkit.scene import Scene
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.gl.driver_probe import probe
from urdfkit.scene.lights import lighting_of
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays import RayTable, warmup
from urdfkit.sim.scene_view import world_scene

EYE = Pose((-4.5, -3.5, 1.7), (0.0, 0.35, 0.7))
LENS = Lens(640, 480, 1.2)
SUN = np.array([-0.5, 0.1, -0.9])
MOVES = "world/cafe_table"
Take = Callable[[], np.ndarray]


def ours(scene: Scene, poses: np.ndarray, renderer: str, *, shadows: bool, samples: int, deep: bool) -> Take:
    """Return what takes our pictures."""
    table = RayTable(scene, scene.with_role("visual"))
    table.place(poses)
    lighting = lighting_of(load_world("house"))
    lighting.lights[:, 11] = float(shadows)
    lighting.lights[:, 1:4] = -SUN / np.linalg.norm(SUN)
    if renderer == "gl":
        from urdfkit.scene.gl.gl_renderer import GlRenderer

        renderer: Any = GlRenderer(table, lighting, probe().backend)
    else:
        renderer = RayRenderer(table, lighting)
    frame, row, here = pose_matrix(EYE), scene.bodies.index(MOVES), poses.copy()

    def take() -> np.ndarray:
        here[row, 0] += 1e-4
        table.place(here)
        return renderer.take(LENS, frame, near=0.05, far=100.0, samples=samples, deep=deep).rgb

    return take


def mujocos(scene: Scene, poses: np.ndarray, *, shadows: bool, samples: int, deep: bool) -> Take:
    """Return what takes MuJoCo's."""
    import mujoco

    spec = mujoco.MjSpec()
    spec.visual.quality.offsamples = 0 if samples == 1 else samples
    spec.visual.headlight.active = 0
    bodies = {
        name: spec.worldbody.add_body(name=name, pos=pose[:3], quat=pose[[6, 3, 4, 5]], mocap=name == MOVES)
        for name, pose in zip(scene.bodies, poses, strict=True)
    }
    kinds = mujoco.mjtGeom
    for shape in scene.with_role("visual"):
        match shape.geometry:
            case Box(size=size):
                kind, numbers = kinds.mjGEOM_BOX, np.array(size) / 2
            case Cylinder(radius=radius, length=length):
                kind, numbers = kinds.mjGEOM_CYLINDER, np.array([radius, length / 2, 0])
            case Sphere(radius=radius):
                kind, numbers = kinds.mjGEOM_SPHERE, np.array([radius, 0, 0])
            case plane:
                kind, numbers = kinds.mjGEOM_PLANE, np.array([*plane.size, 2.0]) / 2
        quaternion = np.empty(4)
        mujoco.mju_mat2Quat(quaternion, shape.placement[:3, :3].ravel())
        into = spec.worldbody if kind == kinds.mjGEOM_PLANE else bodies[shape.body]
        into.add_geom(type=kind, size=numbers, pos=shape.placement[:3, 3], quat=quaternion, rgba=shape.rgba)
    sun = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
    spec.worldbody.add_light(type=sun, dir=SUN, pos=[0, 0, 10], castshadow=shadows)
    turn = pose_matrix(EYE)[:3, :3]
    fovy = np.degrees(2 * np.arctan(np.tan(LENS.field_of_view / 2) * LENS.height / LENS.width))
    spec.worldbody.add_camera(name="eye", pos=EYE.xyz, xyaxes=[*-turn[:, 1], *turn[:, 2]], fovy=fovy)
    model = spec.compile()
    state = mujoco.MjData(model)
    renderer = mujoco.Renderer(model, LENS.height, LENS.width)

    def take() -> np.ndarray:
        state.mocap_pos[0, 0] += 1e-4
        mujoco.mj_kinematics(model, state)
        mujoco.mj_camlight(model, state)
        renderer.update_scene(state, "eye")
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        picture = renderer.render()
        if deep:
            renderer.enable_depth_rendering()
            renderer.render()
            renderer.disable_depth_rendering()
        return picture

    return take


def bullets(scene: Scene, poses: np.ndarray, *, shadows: bool) -> Take:
    """Return what takes PyBullet's; its pictures always come with depths and shapes."""
    import mujoco
    import pybullet as p

    client = p.connect(p.DIRECT)
    placed = pose_matrices(poses)
    chair = []
    for shape in scene.with_role("visual"):
        color: dict[str, Any] = {"rgbaColor": shape.rgba}
        match shape.geometry:
            case Box(size=size):
                visual = p.createVisualShape(
                    p.GEOM_BOX, physicsClientId=client, halfExtents=[edge / 2 for edge in size], **color
                )
            case Cylinder(radius=radius, length=length):
                visual = p.createVisualShape(
                    p.GEOM_CYLINDER, physicsClientId=client, radius=radius, length=length, **color
                )
            case Sphere(radius=radius):
                visual = p.createVisualShape(p.GEOM_SPHERE, physicsClientId=client, radius=radius, **color)
            case plane:
                visual = p.createVisualShape(
                    p.GEOM_BOX, halfExtents=[*(each / 2 for each in plane.size), 1e-3], **color
                )
        frame, quaternion = placed[scene.body_index[shape.body]] @ shape.placement, np.empty(4)
        mujoco.mju_mat2Quat(quaternion, frame[:3, :3].ravel())
        number = p.createMultiBody(0, -1, visual, frame[:3, 3], quaternion[[1, 2, 3, 0]], physicsClientId=client)
        if shape.body == MOVES:
            chair.append((number, frame[:3, 3].copy(), quaternion[[1, 2, 3, 0]]))
    turn = pose_matrix(EYE)[:3, :3]
    view = p.computeViewMatrix(EYE.xyz, (np.array(EYE.xyz) + turn[:, 0]).tolist(), turn[:, 2].tolist())
    fovy = np.degrees(2 * np.arctan(np.tan(LENS.field_of_view / 2) * LENS.height / LENS.width))
    lens = p.computeProjectionMatrixFOV(fovy, LENS.width / LENS.height, 0.05, 100.0)

    def take() -> np.ndarray:
        for number, at, quaternion in chair:
            at[0] += 1e-4
            p.resetBasePositionAndOrientation(number, at, quaternion, physicsClientId=client)
        found = p.getCameraImage(
            LENS.width, LENS.height, view, lens, shadow=int(shadows), lightDirection=(-SUN).tolist(),
            renderer=p.ER_TINY_RENDERER, physicsClientId=client,
        )  # fmt: skip
        return np.asarray(found[2], dtype=np.uint8).reshape(LENS.height, LENS.width, 4)[:, :, :3]

    return take


def rate(take: Take, seconds: float) -> float:
    """Return pictures per CPU second."""
    count, start = 0, time.process_time()
    while (spent := time.process_time() - start) < seconds:
        take()
        count += 1
    return count / spent


def takers(scene: Scene, poses: np.ndarray, *, shadows: bool, samples: int, deep: bool) -> dict[str, Take]:
    """Return whoever can take such pictures here."""
    options: dict[str, Any] = {"shadows": shadows, "samples": samples, "deep": deep}
    found = {"rays": ours(scene, poses, "ray", **options)}
    if probe().works:
        found["gl"] = ours(scene, poses, "gl", **options)
    try:
        found["mujoco"] = mujocos(scene, poses, **options)
        if samples == 1:
            found["pybullet"] = bullets(scene, poses, shadows=shadows)
    except ImportError as error:
        print(error, file=sys.stderr)
    return found


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=1.0, help="CPU seconds per renderer and round")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--save", metavar="FOLDER", help="write a picture of each")
    options = parser.parse_args()
    warmup()
    print(f"OpenGL: {probe().name}", file=sys.stderr)
    scene, poses = world_scene(load_world("house"))
    table: dict[str, dict[str, float]] = {}
    for deep in (False, True):
        for shadows in (True, False):
            for samples in (1, 4):
                parts = ("colour and depth" if deep else "colour", "shadows" if shadows else "no shadows")
                what = ", ".join((*parts, f"{samples} sample{'s' * (samples > 1)}"))
                everybody = takers(scene, poses, shadows=shadows, samples=samples, deep=deep)
                best = dict.fromkeys(everybody, 0.0)
                for name, take in everybody.items():
                    picture = take()
                    if options.save:
                        from PIL import Image

                        Image.fromarray(picture).save(f"{options.save}/{name}-{what}.png")
                for _ in range(options.rounds):
                    for name, take in everybody.items():
                        best[name] = max(best[name], rate(take, options.seconds))
                table[what] = best
                if not options.json:
                    of = best.get("mujoco", float("nan"))
                    row = "   ".join(f"{name} {value:6.1f} ({value / of:4.1f} ×)" for name, value in best.items())
                    print(f"{what:45s} {row}", flush=True)
    if options.json:
        print(json.dumps(table, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
