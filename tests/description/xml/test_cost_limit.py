"""A description that takes more CPU time or memory than permitted is refused, with the element and the phase."""

from __future__ import annotations

import json
import signal
import sys
import threading
import time
from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.description.xml.cost_limit import CostError, CostLimit, excluded
from urdfkit.lint.editor.open_files import Project
from urdfkit.lint.project.options import Options
from urdfkit.lint.rules.joints.joint_type_unknown import JointTypeUnknown

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no POSIX timers")

ROBOT = """<robot name="r"><link name="a"/><link name="b"/>
  <joint name="j" type="fixd"><parent link="a"/><child link="b"/></joint>
</robot>"""


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A robot, for which one rule does not end."""

    def check(self, model):
        for joint in model.robot.joints:
            element = joint.element
            while element is not None:
                pass
            yield

    monkeypatch.setattr(JointTypeUnknown, "check", check)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "r.urdf").write_text(ROBOT)
    return tmp_path / "r.urdf"


def test_lint_reports_one_finding_with_the_rule_and_the_element(file, capsys) -> None:
    assert main(["lint", "r.urdf", "--no-cache", "--time-limit", "0.3", "--format", "json"]) == 1
    (finding,) = json.loads(capsys.readouterr().out)
    assert (finding["code"], finding["file"], finding["line"], finding["column"]) == ("X126", "r.urdf", 2, 3)
    assert finding["message"] == (
        "linting takes more than 0.3 s of CPU while checking the rule joint-type-unknown; --time-limit raises the limit"
    )


def test_the_language_server_reports_the_time_limit(file) -> None:
    project = Project(Options(time_limit=0.3))
    project.set_text(file, ROBOT)
    (finding,) = project.findings(file)[file]
    assert (finding.code, finding.line) == ("X126", 2)


def test_expand_is_one_line(tmp_path, monkeypatch, capsys) -> None:
    from urdfkit.description.xacro.evaluation.evaluator import Evaluator

    def expand(self):
        while True:
            pass

    monkeypatch.setattr(Evaluator, "expand", expand)
    (tmp_path / "r.xacro").write_text(ROBOT)
    assert main(["expand", str(tmp_path / "r.xacro"), "--time-limit", "0.3"]) == 2
    error = capsys.readouterr().err
    assert "more than 0.3 s of CPU while expanding xacro; --time-limit raises the limit" in error
    assert error.count("\n") == 1


def test_a_signal_while_the_block_ends_is_ignored(monkeypatch) -> None:
    original = signal.setitimer

    def setitimer(timer: int, *arguments: float) -> object:
        if timer == signal.ITIMER_PROF:
            signal.raise_signal(signal.SIGPROF)
        return original(timer, *arguments)

    with CostLimit(1e-6, memory=0):
        monkeypatch.setattr(signal, "setitimer", setitimer)


def test_memory_that_the_process_used_before_does_not_count() -> None:
    with CostLimit(60.0, memory=50_000_000):  # the interpreter with pytest alone takes more
        begin = time.process_time()
        while time.process_time() - begin < 0.3:
            pass


@pytest.mark.parametrize("command", [["tf"], ["info"], ["view", "--html", "r.html"]])
def test_loading_a_robot_is_limited(command, file, monkeypatch, capsys) -> None:
    from urdfkit.description.xml import cost_limit
    from urdfkit.kinematics import mimic

    def follow(joints, joint, resolved):
        while True:
            pass

    monkeypatch.setattr(cost_limit, "LOADING", 0.5)
    monkeypatch.setattr(mimic, "_follow", follow)
    file.write_text(ROBOT.replace("fixd", "continuous").replace("</joint>", '<mimic joint="j"/></joint>'))
    name, *options = command
    assert main([name, "r.urdf", *options]) == 2
    error = capsys.readouterr().err
    assert error == ("urdfkit: r.urdf:2:3: more than 0.5 s of CPU while building the kinematic model\n")


def test_memory_is_limited() -> None:
    kept: list[bytes] = []

    def fill() -> None:
        with CostLimit(60.0, memory=1):
            while len(kept) < 30:
                kept.append(b"x" * 10**8)  # so large that no memory freed earlier is used

    with pytest.raises(CostError, match=r"more than 1e-09 GB of memory"):
        fill()


def test_nothing_is_left_behind() -> None:
    before = signal.getsignal(signal.SIGPROF)
    with CostLimit(60.0):
        assert signal.getsignal(signal.SIGPROF) != before
    assert signal.getsignal(signal.SIGPROF) == before
    assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)
    with CostLimit(0.0):
        assert signal.getsignal(signal.SIGPROF) == before


def test_other_threads_run_without_a_limit() -> None:
    done = []

    def run() -> None:
        with CostLimit(0.1):
            done.append(True)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    assert done == [True]


@pytest.mark.parametrize("text", ["x", "-1", "nan", "inf"])
def test_a_limit_that_is_no_time_is_refused(text, capsys) -> None:
    assert main(["lint", "r.urdf", f"--time-limit={text}"]) == 2
    assert f"`{text}` is not a number of seconds" in capsys.readouterr().err


def busy(seconds: float) -> None:
    end = time.process_time() + seconds
    while time.process_time() < end:
        pass


def busy_but_for(left_out: float, seconds: float) -> None:
    with excluded():
        busy(left_out)
    busy(seconds)


@pytest.mark.slow
def test_an_excluded_block_does_not_count() -> None:
    with CostLimit(0.5):
        with excluded():
            busy(1.0)
        busy(0.2)
    limit = CostLimit(0.5)
    with pytest.raises(CostError, match=r"more than 0\.5 s of CPU"), limit:
        busy_but_for(0.2, 1.0)
