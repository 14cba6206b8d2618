"""`urdfkit ik`: what it prints and writes, its exit codes, and how it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from tests.kinematics.arms import Reference, errors, random_configurations
from tests.kinematics.conftest import ARM
from urdfkit import load
from urdfkit.cli import main
from urdfkit.kinematics import Chain


@pytest.fixture
def arm_file(tmp_path: Path) -> str:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM, encoding="utf-8")
    return str(path)


def ran(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Return exit code, standard output and standard error of ``urdfkit ik -q WORDS``."""
    code = main(["ik", "-q", *words])
    out, err = capsys.readouterr()
    return code, out, err


def pose_words(matrix: np.ndarray) -> list[str]:
    """Return the options for a pose."""
    import pinocchio as pin

    x, y, z, *quaternion = pin.SE3ToXYZQUAT(pin.SE3(matrix)).tolist()
    return ["--xyz", f"{x!r},{y!r},{z!r}", "--quat", ",".join(map(repr, quaternion))]


def test_one_pose_as_json(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    chain = Chain(load(arm_file), None, "finger_a")
    target = chain.forward(np.array([0.3, 0.1, 1.2, 0.02]))
    code, out, err = ran(capsys, arm_file, "finger_a", *pose_words(target), "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert list(found) == ["base", "tip", "joints", "targets", "reached", "solutions", "repairs"]
    assert (found["base"], found["tip"], found["joints"]) == ("world", "finger_a", ["turn", "slide", "bend", "grip"])
    assert (found["targets"], found["reached"]) == (1, 1)
    (solution,) = found["solutions"]
    assert list(solution["positions"]) == found["joints"]
    assert solution["reached"] is True
    assert solution["reason"] is None
    assert solution["at_limits"] == []
    q = np.array(list(solution["positions"].values()))
    distance, angle = errors(Reference(chain).pose(q)[None], target[None])
    assert distance[0] == pytest.approx(solution["position_error"], abs=1e-12)
    assert distance[0] < 1e-3
    assert angle[0] < 1.745e-3


def test_roll_pitch_yaw_is_the_orientation(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    import pinocchio as pin

    chain = Chain(load(arm_file), None, "finger_a")
    target = chain.forward(np.array([0.3, 0.1, 1.2, 0.02]))
    rpy = ",".join(map(repr, pin.rpy.matrixToRpy(target[:3, :3]).tolist()))
    xyz = ",".join(map(repr, target[:3, 3].tolist()))
    code, out, _ = ran(capsys, arm_file, "finger_a", f"--xyz={xyz}", "--rpy", rpy, "--json")
    assert code == 0
    assert json.loads(out)["solutions"][0]["rotation_error"] < 1e-6


def test_a_pose_beyond_reach(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    code, out, _ = ran(capsys, arm_file, "finger_a", "--xyz", "-3,0,0.5", "--json")
    found = json.loads(out)
    (solution,) = found["solutions"]
    assert (code, found["reached"], solution["reached"]) == (1, 0, False)
    assert solution["reason"] == f"beyond reach by {solution['position_error']:.3g} m"
    chain = Chain(load(arm_file), None, "finger_a")
    pose = Reference(chain).pose(np.array(list(solution["positions"].values())))
    assert np.linalg.norm(pose[:3, 3] - [-3, 0, 0.5]) == pytest.approx(solution["position_error"], abs=1e-9)
    code, out, _ = ran(capsys, arm_file, "finger_a", "--xyz", "-3,0,0.5")
    assert code == 1
    assert out.startswith(f"finger_a in world: not reached: {solution['reason']}; the nearest configuration is ")


def test_the_limit_that_prevents_a_pose_is_named(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    beyond = Chain(load(arm_file), None, "elbow", hold={"slide": 0.1, "turn": 0.0}).forward(np.array([2.4]))
    hold = ["--hold", "slide=0.1,turn=0"]
    code, out, _ = ran(capsys, arm_file, "finger_a", *pose_words(beyond), *hold, "--json")
    assert code == 1
    code, out, _ = ran(capsys, arm_file, "elbow", *pose_words(beyond), *hold, "--json")
    (solution,) = json.loads(out)["solutions"]
    assert (code, solution["reason"], solution["at_limits"]) == (1, "limit of joint `bend`", ["bend"])
    assert solution["positions"] == {"bend": 2.0}


def test_a_slide_that_ends_before_the_pose_is_named(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "slide.urdf"
    joint = '<joint name="z" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>{limit}</joint>'
    limit = '<limit lower="0" upper="1" effort="1" velocity="1"/>'
    path.write_text(f'<robot name="s"><link name="a"/><link name="b"/>{joint.format(limit=limit)}</robot>')
    for z, reason in (("1.5", "limit of joint `z`"), ("9", "beyond reach by 8 m")):
        code, out, _ = ran(capsys, str(path), "b", f"--xyz=0,0,{z}", "--json")
        assert (code, json.loads(out)["solutions"][0]["reason"]) == (1, reason)


def test_an_orientation_that_cannot_be_reached(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    target = Chain(load(arm_file), None, "finger_a").forward(np.array([0.3, 0.1, 0.4, 0.02]))
    target[:3, :3] = target[:3, :3] @ np.diag([-1.0, -1.0, 1.0])
    code, out, _ = ran(capsys, arm_file, "finger_a", *pose_words(target), "--json")
    (solution,) = json.loads(out)["solutions"]
    assert code == 1
    assert solution["position_error"] < 1e-3
    assert solution["reason"] == f"orientation: {solution['rotation_error']:.3g} rad off"
    assert ran(capsys, arm_file, "finger_a", *pose_words(target), "--position-only")[0] == 0


@pytest.mark.parametrize("suffix", [".npy", ".npz", ".csv"])
def test_poses_of_files(capsys: pytest.CaptureFixture[str], tmp_path: Path, arm_file: str, suffix: str) -> None:
    import pinocchio as pin

    chain = Chain(load(arm_file), "world", "finger_a")
    matrices = chain.forward(random_configurations(chain, 20, 3))
    matrices[4, 0, 3] += 5.0
    poses = np.array([pin.SE3ToXYZQUAT(pin.SE3(matrix)) for matrix in matrices])
    path, output = tmp_path / f"poses{suffix}", tmp_path / "solutions.npz"
    if suffix == ".npy":
        np.save(path, matrices)
    elif suffix == ".npz":
        np.savez(path, other=np.zeros(3), targets=poses)
    else:
        path.write_text("x,y,z,qx,qy,qz,qw\n" + "".join(",".join(map(repr, row.tolist())) + "\n" for row in poses))
    code, out, _ = ran(capsys, arm_file, "finger_a", "--targets", str(path), "-o", str(output))
    assert (code, out) == (1, "finger_a in world: 19 of 20 poses reached\n     1 not reached: beyond reach\n")
    with np.load(output) as arrays:
        assert set(arrays) == {"joints", "q", "reached", "position_error", "rotation_error", "restarts"}
        assert arrays["joints"].tolist() == list(chain.joint_names)
        assert arrays["reached"].tolist() == [k != 4 for k in range(20)]
        distance, _ = errors(Reference(chain).poses(arrays["q"]), matrices)
        np.testing.assert_allclose(arrays["position_error"], distance, rtol=0, atol=1e-9)
    code, out, _ = ran(capsys, arm_file, "finger_a", "--targets", str(path), "--json")
    found = json.loads(out)
    assert (code, found["targets"], found["reached"], len(found["solutions"])) == (1, 20, 19, 20)


@pytest.mark.parametrize("suffix", [".csv", ".npy"])
def test_positions_of_files(capsys: pytest.CaptureFixture[str], tmp_path: Path, arm_file: str, suffix: str) -> None:
    file, output = tmp_path / f"positions{suffix}", tmp_path / "solutions.npz"
    positions = [[0.28, 0.16, 0.59], [0.3, 0.1, 0.5]]
    if suffix == ".npy":
        np.save(file, positions)
    else:
        file.write_text("x,y,z\n" + "".join(f"{x},{y},{z}\n" for x, y, z in positions))
    words = [arm_file, "finger_a", "--targets", str(file), "--position-only", "-o", str(output)]
    assert ran(capsys, *words)[0] == 0
    chain = Chain(load(arm_file), None, "finger_a")
    with np.load(output) as arrays:
        np.testing.assert_allclose(chain.forward(arrays["q"])[:, :3, 3], positions, rtol=0, atol=1e-3)


def test_warnings_of_limits_and_degrees(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    words = ["ik", arm_file, "finger_a", "--xyz", "0.28,0.16,0.59", "--position-only"]
    main([*words, "--hold", "bend=3", "--from", "slide=9", "--rpy", "0,90,0"])
    assert capsys.readouterr().err.splitlines() == [
        "urdfkit: warning: --rpy 0,90,0: 90 rad is more than one full turn; if it is in degrees, use 0,1.5708,0",
        "urdfkit: warning: joint `slide` at 9 m is outside its limits [-0.1, 0.4] m",
        "urdfkit: warning: joint `bend` at 3 rad is outside its limits [-1.5, 2] rad",
        "urdfkit: warning: joint `dial_joint` at 4.3 rad is outside its limits [-3, 3] rad",  # mimics `bend`
    ]


def test_one_pose_is_written_as_arrays(capsys: pytest.CaptureFixture[str], tmp_path: Path, arm_file: str) -> None:
    output = tmp_path / "one.npz"
    words = [arm_file, "finger_a", "--xyz", "0.28,0.16,0.59", "--position-only"]
    assert ran(capsys, *words, "-o", str(output))[0] == 0
    with np.load(output) as arrays:
        assert arrays["q"].shape == (1, 4)
        assert arrays["restarts"].dtype == np.int64


def test_all_solutions(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    joints = "".join(
        f'<joint name="j{k}" type="revolute"><parent link="l{k}"/><child link="l{k + 1}"/><origin xyz="{x} 0 0"/>'
        '<axis xyz="0 0 1"/><limit lower="-6.2" upper="6.2" effort="1" velocity="1"/></joint>'
        for k, x in enumerate((0.0, 0.5))
    )
    path = tmp_path / "two.urdf"
    links = "".join(f'<link name="l{k}"/>' for k in range(4))
    fixed = '<joint name="end" type="fixed"><parent link="l2"/><child link="l3"/><origin xyz="0.5 0 0"/></joint>'
    path.write_text(f'<robot name="two">{links}{joints}{fixed}</robot>')
    words = [str(path), "l3", "--xyz", "0.5,0.5,0", "--position-only", "--all"]
    code, out, _ = ran(capsys, *words, "--json")
    solutions = json.loads(out)["solutions"]
    found = {tuple(round(value, 6) for value in solution["positions"].values()) for solution in solutions}
    right = round(np.pi / 2, 6)
    branches = [(0.0, right), (right, -right)]
    expected = {
        (round(a + i * 2 * np.pi, 6), round(b + j * 2 * np.pi, 6))
        for a, b in ((0.0, np.pi / 2), (np.pi / 2, -np.pi / 2))
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    }
    expected = {pair for pair in expected if max(map(abs, pair)) <= 6.2}
    assert code == 0
    assert found == expected
    assert set(branches) < found
    assert len(solutions) == len(expected) == 6
    code, out, _ = ran(capsys, *words)
    assert out.splitlines()[0].startswith("l3 in l0: reached, 6 solutions, nearest first; ")


def test_the_solution_nearest_to_the_start(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    words = [arm_file, "finger_a", "--xyz", "0.28,0.16,0.59", "--position-only", "--json"]
    for turn in (0.0, 12.5):
        _, out, _ = ran(capsys, *words, "--from", f"turn={turn},bend=0.3", "--from", "slide=0.1")
        assert abs(json.loads(out)["solutions"][0]["positions"]["turn"] - turn) <= np.pi


@pytest.mark.slow
def test_the_solution_is_the_nearest_of_all(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    chain = Chain("seven_dof_arm", None, "grasping_frame")
    for matrix in chain.forward(random_configurations(chain, 3, 5)):
        words = ["seven_dof_arm", "grasping_frame", *pose_words(matrix), "--from", "elbow_pitch_joint=1", "--json"]
        listed = json.loads(ran(capsys, *words, "--all")[1])["solutions"]
        (one,) = json.loads(ran(capsys, *words)[1])["solutions"]
        start = chain.configuration({"elbow_pitch_joint": 1.0})
        distances = [np.linalg.norm(list(each["positions"].values()) - start) for each in [one, *listed]]
        assert distances[0] <= min(distances[1:]) + 1e-9
    np.save(tmp_path / "pose.npy", [[float(number) for k in (3, 5) for number in words[k].split(",")]])
    words = [*words[:2], "--targets", str(tmp_path / "pose.npy"), *words[-3:], "--prefer", "nearest"]
    assert json.loads(ran(capsys, *words)[1])["solutions"][0]["positions"] == pytest.approx(one["positions"], abs=1e-6)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["finger_a"], "ik: pass one of --xyz X,Y,Z and --targets FILE"),
        (["finger_a", "--xyz", "1,2"], "ik: --xyz expects 3 finite numbers separated by commas, got `1,2`"),
        (["finger_a", "--xyz", "1,2,nan"], "ik: --xyz expects 3 finite numbers separated by commas, got `1,2,nan`"),
        (["finger_a", "--xyz", "1,2,3", "--quat", "0,0,0,0"], "the quaternion has the length 0; use one of length 1"),
        (
            ["finger_a", "--xyz", "1,2,3", "--quat", "0,0,3,4"],
            "has the length 5; use one of length 1, such as 0,0,0.6,0.8",
        ),
        (["finger_a", "--xyz", "1e300,2,3"], "target is not a pose: its numbers must be finite and below 1e6"),
        (["finger_a", "--xyz", "1,2,3", "--quat", "0,0,0,1", "--rpy", "0,0,0"], "ik: pass one of --quat and --rpy"),
        (
            ["finger_a", "--xyz", "1,2,3", "--tolerance", "0,1"],
            "the tolerance is 0 m and 1 rad; both must be above zero",
        ),
        (["finger_a", "--xyz", "1,2,3", "--restarts", "-1"], "ik: --restarts -1: the number must not be negative"),
        (["finger_a", "--xyz", "1,2,3", "--threads", "0"], "ik: --threads 0: at least one thread is needed"),
        (
            ["finger_a", "--xyz", "1,2,3", "--from", "bent=1"],
            "no movable joint `bent` in robot `arm`; did you mean `bend`?",
        ),
        (["finger_a", "--xyz", "1,2,3", "--from", "bend"], "ik: --from expects name=value, got `bend`"),
        (["finger", "--xyz", "1,2,3"], "no frame `finger` in robot `arm`; did you mean `finger_b`?"),
        (["finger_a", "--xyz", "1,2,3", "--base", "wrld"], "no frame `wrld` in robot `arm`; did you mean `world`?"),
        (["--xyz", "1,2,3"], "such as finger_a, finger_b, camera_optical"),
        (["finger_a", "--targets", "poses.npy", "--all"], "ik: --all needs one pose: use --xyz instead of --targets"),
        (["finger_a", "--targets", "none.npy"], "ik: --targets: no such file: none.npy"),
        (
            ["finger_a", "--targets", "none.txt"],
            "ik: --targets none.txt: unsupported file type; use .npy, .npz or .csv",
        ),
        (["finger_a", "--xyz", "1,2,3", "-o", "a.txt"], "ik: -o a.txt: unsupported file type; use .npz"),
        (["finger_a", "--targets", "wide.npy"], "expected an array of shape (N, 7) or (N, 4, 4), got (2, 6)"),
        (["finger_a", "--targets", "no_array.npz"], "no array `targets`; its arrays: a, b"),
        (
            ["finger_a", "--targets", "broken.npy"],
            "not an array written by numpy.save; it starts with `nothing`; rename",
        ),
        (["finger_a", "--targets", "empty.npy"], "ik: --targets empty.npy: the file is empty"),
        (["finger_a", "--targets", "archive.npy"], "archive.npy: the file is a .npz file; rename it to .npz"),
        (["finger_a", "--targets", "objects.npy"], "objects.npy: the array has Python objects, not numbers"),
        (["finger_a", "--targets", "words.csv"], "words.csv:2: `1,2,3,0,0,0,one` are not numbers"),
        (
            ["finger_a", "--targets", "short.csv"],
            "short.csv:1: expected 7 numbers x,y,z,qx,qy,qz,qw, got 3; use --position-only",
        ),
        (["finger_a", "--targets", "mixed.csv", "--position-only"], "mixed.csv:2: expected 3 numbers as before, got 7"),
        (
            ["finger_a", "--xyz", "1,2,3", "--hold", "arm=1"],
            "no movable joint `arm` in robot `arm`; its movable joints",
        ),
        (["finger_a", "--targets", "zero.npy"], "the quaternion of pose 1 has the length 0; use one of length 1"),
        (["finger_a", "--targets", "nan.npy"], "target 1 is not a pose"),
        (["finger_a", "--targets", "first.csv"], "first.csv:1: `1,2,3,0,0,0,one` are not numbers"),
        (["finger_a", "--targets", "header.csv"], "ik: --targets header.csv: the file has no poses"),
    ],
)
def test_refusals(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    arm_file: str,
    words: list[str],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    np.save("wide.npy", np.zeros((2, 6)))
    np.save("zero.npy", [[0, 0, 0, 0, 0, 0, 1], [0] * 7])
    np.save("nan.npy", [[0, 0, 0, 0, 0, 0, 1], [0, 0, np.nan, 0, 0, 0, 1]])
    Path("first.csv").write_text("1,2,3,0,0,0,one\n")
    Path("header.csv").write_text("x,y,z,qx,qy,qz,qw\n")
    np.savez("no_array.npz", a=np.zeros(3), b=np.zeros(3))
    np.savez("archive.npz", a=np.zeros(3))
    Path("archive.npz").rename("archive.npy")
    np.save("objects.npy", np.array([{}, 1], dtype=object), allow_pickle=True)
    Path("broken.npy").write_bytes(b"nothing")
    Path("empty.npy").touch()
    Path("mixed.csv").write_text("1,2,3\n0,0,0,0,0,0,1\n")
    Path("words.csv").write_text("0,0,0,0,0,0,1\n1,2,3,0,0,0,one\n")
    Path("short.csv").write_text("1,2,3\n")
    code, out, err = ran(capsys, arm_file, *words)
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.splitlines()) == 1


def test_one_pose_is_solved_without_numpy_and_numba(arm_file: str) -> None:
    import subprocess
    import sys

    words = ["ik", arm_file, "finger_a", "--xyz", "0.28,0.16,0.59", "--position-only"]
    assert main(words) == 0  # the kernel is compiled
    code = (
        f"import sys\nfrom urdfkit.cli import main\nassert main({words!r}) == 0\n"
        "print([name for name in ('numpy', 'numba', 'pinocchio') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
