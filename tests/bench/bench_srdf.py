"""Disabled pairs of `urdfkit srdf`: CPU time, and whether pairs called Never collide by Pinocchio.

Run it: ``python -m tests.bench.bench_srdf [--robots NAME ...] [--samples 100000] [--check 1000000] [--json]``. The
check shares no code with the command: Pinocchio reads the URDF itself, draws other configurations, and coal's broad
phase reports collisions. Then the distance of each pair is minimised at random from the nearest configurations.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin

from tests.kinematics.arms import CORPUS
from urdfkit.kinematics.self_collision import CollisionMatrix, collision_matrix

BLOCK = 10_000
NEAREST = 3
"""Configurations of a pair from which its distance is minimised."""
TRIALS = 150


def two_armed(folder: Path) -> Path:
    """Write a robot with 49 links: a torso, a head, and two arms with five fingers each; return its file."""
    links, joints = [], []

    def add(name: str, parent: str, size: str, middle: str, origin: str, axis: str, low: float, high: float) -> None:
        box = f'<collision><origin xyz="{middle}"/><geometry><box size="{size}"/></geometry></collision>'
        links.append(f'<link name="{name}">{box}</link>')
        if parent:
            joints.append(
                f'<joint name="{name}_joint" type="revolute"><parent link="{parent}"/><child link="{name}"/>'
                f'<origin xyz="{origin}"/><axis xyz="{axis}"/>'
                f'<limit lower="{low}" upper="{high}" effort="1" velocity="1"/></joint>'
            )

    add("torso", "", "0.2 0.3 0.5", "0 0 0.25", "", "", 0, 0)
    add("neck", "torso", "0.08 0.08 0.08", "0 0 0.05", "0 0 0.51", "0 0 1", -1.5, 1.5)
    add("head", "neck", "0.15 0.15 0.2", "0 0 0.11", "0 0 0.1", "0 1 0", -0.7, 0.7)
    for side, y in (("left", 1), ("right", -1)):
        parent, origin = "torso", f"0 {0.21 * y} 0.45"
        for k, length in enumerate((0.06, 0.06, 0.14, 0.14, 0.11, 0.11, 0.05)):
            axis = ("0 1 0", "1 0 0", "0 0 1", "0 1 0", "0 0 1", "0 1 0", "1 0 0")[k]
            name = f"{side}_arm_{k + 1}"
            high = 2.2 if k % 2 == 0 else 1.8
            size = f"0.07 0.07 {0.8 * length:.4g}"
            add(name, parent, size, f"0 0 {-length / 2}", origin, axis, -high, high)
            parent, origin = name, f"0 0 {-length}"
        add(f"{side}_palm", parent, "0.03 0.1 0.08", "0 0 -0.05", origin, "0 0 1", -1, 1)
        for finger in range(5):
            parent, origin = f"{side}_palm", f"0 {0.022 * (finger - 2):.4g} -0.095"
            for part in range(3):
                name = f"{side}_finger_{finger}_{part}"
                add(name, parent, "0.014 0.016 0.03", "0 0 -0.018", origin, "0 1 0" if part else "1 0.3 0", -0.3, 1.4)
                parent, origin = name, "0 0 -0.036"
    file = folder / "two_armed.urdf"
    file.write_text(f'<robot name="two_armed">{"".join(links)}{"".join(joints)}</robot>')
    return file


def robots(folder: Path) -> dict[str, Path]:
    """Return robots whose collision shapes need no missing meshes."""
    unitree = CORPUS / "unitree_ros/robots"
    return {
        "two-armed": two_armed(folder),
        "Go1": unitree / "go1_description/urdf/go1.urdf",
        "H1": unitree / "h1_description/urdf/h1.urdf",
        "B2": unitree / "b2_description/urdf/b2_description.urdf",
    }


class Check:
    """Collisions of pairs of links by Pinocchio and coal, from the URDF."""

    def __init__(self, file: Path, pairs: list[tuple[str, str]], seed: int) -> None:
        self.model = pin.buildModelFromUrdf(str(file))
        self.data = self.model.createData()
        self.geometry = pin.buildGeomFromUrdf(self.model, str(file), pin.GeometryType.COLLISION, package_dirs=[])
        self.objects = list(self.geometry.geometryObjects)
        of_link: dict[str, list[int]] = {}
        for index, each in enumerate(self.objects):
            of_link.setdefault(self.model.frames[each.parentFrame].name, []).append(index)
        self.links = []
        for first, second in pairs:
            for a in of_link[first]:
                for b in of_link[second]:
                    self.geometry.addCollisionPair(pin.CollisionPair(a, b))
                    self.links.append((first, second))
        self.found = pin.GeometryData(self.geometry)
        self.broad = pin.BroadPhaseManager_DynamicAABBTreeCollisionManager(self.model, self.geometry, self.found)
        self.random = np.random.default_rng(seed)
        self.lower, self.upper = self.model.lowerPositionLimit, self.model.upperPositionLimit

    def draw(self, count: int) -> np.ndarray:
        """Return configurations; a joint with a cosine and a sine gets any angle."""
        q = np.zeros((count, self.model.nq))
        for joint in self.model.joints[1:]:
            at = joint.idx_q
            if joint.nq == 2:
                angle = self.random.uniform(-math.pi, math.pi, count)
                q[:, at], q[:, at + 1] = np.cos(angle), np.sin(angle)
            else:
                q[:, at] = self.random.uniform(self.lower[at], self.upper[at], count)
        return q

    def sampled(self, count: int) -> Iterator[tuple[int, set[tuple[str, str]]]]:
        """Yield after each block the number of configurations, and the pairs that collide in any of them."""
        hits: set[tuple[str, str]] = set()
        pairs = np.array([(pair.first, pair.second) for pair in self.geometry.collisionPairs])
        radii = np.array([each.geometry.aabb_radius for each in self.objects])
        apart = radii[pairs].sum(axis=1)
        self.nearest: list[list[tuple[float, np.ndarray]]] = [[] for _ in pairs]
        for first in range(0, count, BLOCK):
            q = self.draw(min(BLOCK, count - first))
            for k, row in enumerate(q):
                if pin.computeCollisions(self.model, self.data, self.broad, row, False):
                    results = self.found.collisionResults
                    hits |= {self.links[i] for i in range(len(pairs)) if results[i].isCollision()}
                if k % 20 == 0:
                    centres = np.array(
                        [self.found.oMg[i].act(each.geometry.aabb_center) for i, each in enumerate(self.objects)]
                    )
                    gaps = np.linalg.norm(centres[pairs[:, 0]] - centres[pairs[:, 1]], axis=1) - apart
                    for i in np.flatnonzero(
                        gaps < np.array([near[-1][0] if len(near) == NEAREST else np.inf for near in self.nearest])
                    ):
                        self.nearest[i] = sorted([*self.nearest[i], (gaps[i], row)], key=lambda one: one[0])[:NEAREST]
            yield first + len(q), hits

    def searched(self) -> set[tuple[str, str]]:
        """Return the pairs that a random descent of their distance makes collide."""
        return {self.links[i] for i in range(len(self.links)) for _, q in self.nearest[i] if self._descend(i, q) <= 0.0}

    def _descend(self, pair: int, q: np.ndarray) -> float:
        size, best = 0.2, self._distance(pair, q)
        for _ in range(TRIALS):
            step = np.where(self.random.random(self.model.nv) < 0.3, self.random.normal(size=self.model.nv), 0.0)
            tried = pin.integrate(self.model, q, size * step)
            bounded = np.array([joint.nq != 2 for joint in self.model.joints[1:] for _ in range(joint.nq)])
            tried = np.where(bounded, np.clip(tried, self.lower, self.upper), tried)
            distance = self._distance(pair, tried)
            if distance < best:
                best, q = distance, tried
            else:
                size = max(0.97 * size, 1e-3)
            if best <= 0.0:
                break
        return best

    def _distance(self, pair: int, q: np.ndarray) -> float:
        pin.updateGeometryPlacements(self.model, self.data, self.geometry, self.found, q)
        return float(pin.computeDistance(self.geometry, self.found, pair).min_distance)


def measured(file: Path, samples: int) -> tuple[dict[str, Any], CollisionMatrix]:
    """Return the CPU time of the matrix [s] and its counts, and the matrix."""
    start = time.process_time()
    matrix = collision_matrix(file, samples=samples)
    seconds = time.process_time() - start
    counts = Counter(pair.reason or "to check" for pair in matrix.pairs)
    return {"links": len(matrix.links), "pairs": len(matrix.pairs), "cpu [s]": seconds, **counts}, matrix


def main() -> None:
    """Measure robots and print a line each, or JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", nargs="*")
    parser.add_argument("--samples", type=int, default=100_000)
    parser.add_argument("--check", type=int, default=1_000_000, help="0 for no check")
    parser.add_argument("--seed", type=int, default=31)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        files = robots(Path(folder))
        for name in arguments.robots or files:
            row, matrix = measured(files[name], arguments.samples)
            print(f"{name}: {row}", file=sys.stderr, flush=True)
            if arguments.check:
                never = [(pair.first, pair.second) for pair in matrix.pairs if pair.reason == "Never"]
                check, start = Check(files[name], never, arguments.seed), time.process_time()
                hits: set[tuple[str, str]] = set()
                for done, hits in check.sampled(arguments.check):
                    if done % 100_000 == 0:
                        print(f"{name}: {done:,} configurations, {sorted(hits)}", file=sys.stderr, flush=True)
                row |= {"Never that collide in samples": len(hits)}
                searched = check.searched()
                row |= {"or in a search": len(hits | searched), "check cpu [s]": time.process_time() - start}
                if hits | searched:
                    row["colliding"] = sorted(hits | searched)
            rows.append({"robot": name} | row)
            if not arguments.json:
                print(
                    ", ".join(
                        f"{key} {value:.4g}" if isinstance(value, float) else f"{key} {value}"
                        for key, value in rows[-1].items()
                    ),
                    flush=True,
                )
    if arguments.json:
        print(json.dumps(rows))


if __name__ == "__main__":
    main()
