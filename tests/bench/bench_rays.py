"""Rays per CPU second next to MuJoCo's mj_multiRay, embree and PyBullet, on one core and the same house.

Run it: ``python tests/bench/bench_rays.py [--seconds 0.3] [--rounds 3] [--json]``. Everybody gets the same collision
shapes and the same rays from the same place; all take turns, and the best round of each counts, because other programs
only ever take time away. Embree knows triangles only and gets solids as meshes, flat, with its poses frozen. Then,
ours alone: a hundred and a thousand objects in one room, and pictures with and without shadows.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from urdfkit.description.sdf import Plane, load_world
from urdfkit.description.urdf.robot import Box, Cylinder, Pose, Sphere
from urdfkit.scene import Scene, Shape
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.lights import lighting_of
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays import RayTable, warmup
from urdfkit.sim.scene_view import world_scene

ORIGIN = np.array([0.3, 0.2, 0.4])
FAR = 30.0
Cast = Callable[[np.ndarray], np.ndarray]


def scans() -> dict[str, np.ndarray]:
    """Return the directions of a lidar of one ring and of sixteen (Velodyne VLP-16 at 0.2°)."""

    def rings(samples: int, elevations: np.ndarray) -> np.ndarray:
        azimuth, elevation = np.meshgrid(np.linspace(-np.pi, np.pi, samples, endpoint=False), elevations)
        a, e = azimuth.ravel(), elevation.ravel()
        return np.column_stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])

    return {"2-D, 720 rays": rings(720, np.zeros(1)), "VLP-16, 28800": rings(1800, np.radians(np.arange(-15, 16, 2)))}


def ours(scene: Scene, poses: np.ndarray) -> Cast:
    """Return our caster; bodies are placed anew before every scan."""
    table = RayTable(scene, scene.with_role("collision"))

    def cast(directions: np.ndarray) -> np.ndarray:
        table.place(poses)
        return table.cast(ORIGIN, directions, far=FAR).distances

    return cast


def solids(scene: Scene, poses: np.ndarray) -> list[tuple[Any, np.ndarray]]:
    """Return every collision with where it is."""
    bodies = pose_matrices(poses)
    return [
        (shape.geometry, bodies[scene.body_index[shape.body]] @ shape.placement)
        for shape in scene.with_role("collision")
    ]


def mujocos(scene: Scene, poses: np.ndarray) -> Cast:
    """Return MuJoCo's caster; kinematics is brought up to date before every scan, as ours is."""
    import mujoco

    spec = mujoco.MjSpec()
    bodies = {}
    for name, pose in zip(scene.bodies, poses, strict=True):
        bodies[name] = spec.worldbody.add_body(name=name, pos=pose[:3], quat=pose[[6, 3, 4, 5]])
    for shape in scene.with_role("collision"):
        match shape.geometry:
            case Box(size=size):
                kind, numbers = mujoco.mjtGeom.mjGEOM_BOX, np.array(size) / 2
            case Cylinder(radius=radius, length=length):
                kind, numbers = mujoco.mjtGeom.mjGEOM_CYLINDER, np.array([radius, length / 2, 0])
            case Sphere(radius=radius):
                kind, numbers = mujoco.mjtGeom.mjGEOM_SPHERE, np.array([radius, 0, 0])
            case Plane():
                kind, numbers = mujoco.mjtGeom.mjGEOM_PLANE, np.array([0, 0, 1.0])
        place = shape.placement
        quat = np.empty(4)
        mujoco.mju_mat2Quat(quat, place[:3, :3].ravel())
        into = spec.worldbody if kind == mujoco.mjtGeom.mjGEOM_PLANE else bodies[shape.body]
        into.add_geom(type=kind, size=numbers, pos=place[:3, 3], quat=quat)
    model = spec.compile()
    state = mujoco.MjData(model)
    mujoco.mj_forward(model, state)

    def cast(directions: np.ndarray) -> np.ndarray:
        count = len(directions)
        ids, distances = np.zeros(count, np.int32), np.zeros(count)
        mujoco.mj_kinematics(model, state)
        mujoco.mj_multiRay(model, state, ORIGIN, directions.ravel(), None, 1, -1, ids, distances, None, count, FAR)
        return np.where(ids >= 0, distances, np.inf)

    return cast


def embrees(scene: Scene, poses: np.ndarray) -> Cast:
    """Return embree's caster."""
    import trimesh
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    meshes = []
    for geometry, place in solids(scene, poses):
        match geometry:
            case Box(size=size):
                mesh = trimesh.creation.box(size)
            case Cylinder(radius=radius, length=length):
                mesh = trimesh.creation.cylinder(radius, length, sections=32)
            case Sphere(radius=radius):
                mesh = trimesh.creation.icosphere(subdivisions=3, radius=radius)
            case Plane():
                mesh = trimesh.creation.box((200, 200, 1e-4))
        mesh.apply_transform(place)
        meshes.append(mesh)
    triangles = trimesh.util.concatenate(meshes).triangles.astype(np.float32)
    embree = EmbreeScene()
    TriangleMesh(embree, triangles)

    def cast(directions: np.ndarray) -> np.ndarray:
        origins = np.tile(ORIGIN.astype(np.float32), (len(directions), 1))
        found = embree.run(origins, directions.astype(np.float32), query="DISTANCE")
        return np.where(found < 1e20, found, np.inf)

    return cast


def bullets(scene: Scene, poses: np.ndarray) -> Cast:
    """Return PyBullet's caster, in batches of the most rays it takes, on one thread."""
    import pybullet as p

    client = p.connect(p.DIRECT)
    for geometry, place in solids(scene, poses):
        match geometry:
            case Box(size=size):
                shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=[edge / 2 for edge in size])
            case Cylinder(radius=radius, length=length):
                shape = p.createCollisionShape(p.GEOM_CYLINDER, radius=radius, height=length)
            case Sphere(radius=radius):
                shape = p.createCollisionShape(p.GEOM_SPHERE, radius=radius)
            case Plane():
                shape = p.createCollisionShape(p.GEOM_PLANE)
        quaternion = np.empty(4)
        import mujoco

        mujoco.mju_mat2Quat(quaternion, place[:3, :3].ravel())
        p.createMultiBody(0, shape, basePosition=place[:3, 3], baseOrientation=quaternion[[1, 2, 3, 0]])

    def cast(directions: np.ndarray) -> np.ndarray:
        found: list[float] = []
        for part in np.array_split(directions, len(directions) // (p.MAX_RAY_INTERSECTION_BATCH_SIZE - 1) + 1):
            starts = np.tile(ORIGIN, (len(part), 1))
            ends = starts + FAR * part
            hits = p.rayTestBatch(starts.tolist(), ends.tolist(), numThreads=1, physicsClientId=client)
            found.extend(hit[2] * FAR if hit[0] >= 0 else np.inf for hit in hits)
        return np.array(found)

    return cast


def rate(cast: Cast, directions: np.ndarray, seconds: float) -> float:
    """Return rays per CPU second."""
    count, start = 0, time.process_time()
    while (spent := time.process_time() - start) < seconds:
        cast(directions)
        count += len(directions)
    return count / spent


def crowd(count: int) -> tuple[Scene, np.ndarray]:
    """Return boxes, cylinders and spheres at random places in a room of 40 m."""
    random = np.random.default_rng(0)
    names = [f"s{k}" for k in range(count)]
    kinds = (Box((0.4, 0.3, 0.8)), Cylinder(0.2, 0.8), Sphere(0.25))
    shapes = [Shape(name, name, "collision", kinds[k % 3], np.eye(4)) for k, name in enumerate(names)]
    poses = np.zeros((count, 7))
    poses[:, :2], poses[:, 2], poses[:, 6] = random.uniform(-20, 20, (count, 2)), 0.4, 1.0
    return Scene(tuple(names), tuple(shapes)), poses


def pictures(scene: Scene, poses: np.ndarray, seconds: float, *, shadows: bool) -> float:
    """Return pictures per CPU second of a room of the house."""
    table = RayTable(scene, scene.with_role("visual"))
    lighting = lighting_of(load_world("house"))
    if not shadows:
        lighting.lights[:, 11] = 0.0
    renderer, lens = RayRenderer(table, lighting), Lens(640, 480, 1.2)
    frame = pose_matrix(Pose((-4.5, -3.5, 1.7), (0.0, 0.35, 0.7)))
    lens.order, lens.directions  # noqa: B018 - made once
    count, start = 0, time.process_time()
    while (spent := time.process_time() - start) < seconds:
        table.place(poses)
        renderer.take(lens, frame, near=0.05, far=100.0)
        count += 1
    return count / spent


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=0.3, help="CPU seconds per caster and round")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    warmup()
    scene, poses = world_scene(load_world("house"))
    casters = {"urdfkit": ours(scene, poses)}
    for name, make in (("mujoco", mujocos), ("embree", embrees), ("pybullet", bullets)):
        try:
            casters[name] = make(scene, poses)
        except ImportError:
            print(f"{name} is not installed", file=sys.stderr)
    table: dict[str, dict[str, float]] = {}
    for scan, directions in scans().items():
        truth = casters["urdfkit"](directions)
        best = dict.fromkeys(casters, 0.0)
        for _ in range(options.rounds):
            for name, cast in casters.items():
                best[name] = max(best[name], rate(cast, directions, options.seconds))
        table[scan] = best
        for name, value in best.items():
            same = np.isclose(casters[name](directions), truth, rtol=0, atol=0.01).mean()
            ratio = best["urdfkit"] / value
            if not options.json:
                print(
                    f"{scan:15s} {name:9s} {value / 1e6:7.2f} Mrays/s   ours is {ratio:6.1f} ×"
                    f"   (within 1 cm of ours: {100 * same:.2f} %)"
                )
    crowds = {}
    for count in (100, 1000):
        cast = ours(*crowd(count))
        crowds[count] = {
            scan: max(rate(cast, rays, options.seconds) for _ in range(options.rounds))
            for scan, rays in scans().items()
        }
    for scan in scans():
        ratio = crowds[100][scan] / crowds[1000][scan]
        table[f"{scan}, 100 → 1000 objects"] = {"cost per ray": ratio}
        if not options.json:
            print(f"{scan:15s} 100 → 1000 objects: a ray costs {ratio:.2f} ×")
    for shadows in (True, False):
        frames = max(pictures(scene, poses, options.seconds, shadows=shadows) for _ in range(options.rounds))
        what = f"640 × 480 colour, depth and shapes, {'with' if shadows else 'without'} shadows"
        table[what] = {"urdfkit": frames}
        if not options.json:
            print(f"{what}: {frames:.1f} frames/s")
    if options.json:
        print(json.dumps(table, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
