"""`urdfkit jacobian`: the Jacobian by Pinocchio, singular configurations in words, and how it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from tests.kinematics.conftest import ARM
from urdfkit import load
from urdfkit.cli import main
from urdfkit.kinematics import Chain, Kinematics


@pytest.fixture
def arm_file(tmp_path: Path) -> str:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM, encoding="utf-8")
    return str(path)


def planar_arm(path: Path, axes: tuple[str, ...]) -> str:
    """Write an arm of links of 1 m along x with joints about these axes."""
    links = "".join(f'<link name="l{k}"/>' for k in range(len(axes) + 2))
    joints = "".join(
        f'<joint name="j{k}" type="continuous"><parent link="l{k}"/><child link="l{k + 1}"/>'
        f'<origin xyz="{min(k, 1)} 0 0"/><axis xyz="{axis}"/></joint>'
        for k, axis in enumerate(axes)
    )
    last = len(axes)
    end = (
        f'<joint name="e" type="fixed"><parent link="l{last}"/><child link="l{last + 1}"/><origin xyz="1 0 0"/></joint>'
    )
    path.write_text(f'<robot name="planar">{links}{joints}{end}</robot>')
    return str(path)


def ran(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Return exit code, standard output and standard error of ``urdfkit jacobian WORDS``."""
    code = main(["jacobian", *words])
    out, err = capsys.readouterr()
    return code, out, err


def test_the_jacobian_is_pinocchios(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    positions = {"turn": 0.4, "slide": 0.2, "bend": -0.7}
    words = [f"{name}={value}" for name, value in positions.items()]
    code, out, err = ran(capsys, "-q", arm_file, "finger_a", "--joint", *words, "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert found["joints"] == ["turn", "slide", "bend", "grip"]
    kinematics = Kinematics(load(arm_file))
    q = kinematics.configuration(positions)
    frame = kinematics.frame("finger_a")
    expected = pin.computeFrameJacobian(kinematics.model, kinematics.data, q, frame, pin.LOCAL_WORLD_ALIGNED)
    columns = [kinematics.velocity_index(name) for name in found["joints"]]
    np.testing.assert_allclose(found["jacobian"], expected[:, columns], rtol=0, atol=1e-12)
    values = np.linalg.svd(expected[:, columns], compute_uv=False)
    np.testing.assert_allclose(found["singular_values"], values, rtol=0, atol=1e-12)
    assert (found["rank"], found["singular"], found["lost"]) == (4, False, [])
    assert found["manipulability"] == pytest.approx(np.prod(values), abs=1e-12)
    assert found["condition"] == pytest.approx(values[0] / values[-1], rel=1e-9)


def test_the_axes_are_those_of_the_base(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    _, out, _ = ran(capsys, "-q", arm_file, "finger_a", "--base", "mast", "--joint", "bend=0.3", "--json")
    found = json.loads(out)
    chain = Chain(arm_file, "mast", "finger_a")
    q = np.array([0.0, 0.3, 0.0])
    for j in range(3):
        ahead = q.copy()
        ahead[j] += 1e-7
        rate = (chain.forward(ahead) - chain.forward(q))[:3, 3] / 1e-7
        np.testing.assert_allclose(np.array(found["jacobian"])[:3, j], rate, rtol=0, atol=1e-6)


def test_the_direction_that_a_stretched_arm_loses(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = planar_arm(tmp_path / "planar.urdf", ("0 0 1", "0 0 1"))
    code, out, _ = ran(capsys, "-q", file, "l3", "--json")
    found = json.loads(out)
    assert (code, found["rank"], found["singular"]) == (0, 2, False)  # x is lost, and rotation gains: rank stays 2
    file = planar_arm(tmp_path / "three.urdf", ("0 0 1", "0 0 1", "0 0 1"))
    code, out, _ = ran(capsys, "-q", file, "l4", "--json")
    found = json.loads(out)
    assert (code, found["rank"], found["singular"]) == (0, 2, True)
    assert found["condition"] is None or found["condition"] > 1e12
    (lost,) = found["lost"]
    assert lost["words"] == "translation along x of `l0`"
    np.testing.assert_allclose(lost["direction"], [1, 0, 0, 0, 0, 0], rtol=0, atol=1e-9)
    _, out, _ = ran(capsys, "-q", file, "l4")
    assert out.splitlines()[-1] == "singular: no translation along x of `l0`"
    _, out, _ = ran(capsys, "-q", file, "l4", "--joint", "j1=0.5", "j2=0.4", "--json")
    assert json.loads(out)["singular"] is False


def test_warnings_and_refusals(capsys: pytest.CaptureFixture[str], arm_file: str) -> None:
    code, _, err = ran(capsys, arm_file, "finger_a", "--joint", "bend=3")
    assert code == 0
    assert "joint `bend` at 3 rad is outside its limits [-1.5, 2] rad" in err
    for words, message in (
        (["finger_a", "--joint", "bnd=1"], "no movable joint `bnd` in robot `arm`; did you mean `bend`?"),
        (["finger_a", "--joint", "dial_joint=1"], "joint `dial_joint` mimics another"),
        (["world"], "no joint moves `world` relative to `world` in robot `arm`"),
        (["finger_a", "x", "y"], "jacobian: expected ROBOT and TIP, got 4 words"),
    ):
        code, out, err = ran(capsys, arm_file, *words)
        assert (code, out) == (2, "")
        assert message in err


@pytest.mark.parametrize("words", [["jacobian"], ["reach"], ["ik", "--targets", "poses.csv"]], ids=" ".join)
def test_a_core_installation_names_the_extra(words, monkeypatch, capsys):
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    assert main([*words, "seven_dof_arm", "grasping_frame"]) == 2
    error = capsys.readouterr().err
    assert error.endswith(" needs numpy, numba and pinocchio: pip install 'urdfkit[sim]'\n")
    assert error.count("\n") == 1
