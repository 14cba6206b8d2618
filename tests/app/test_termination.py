import io
import signal
import sys

import pytest

from tests.processes import running, signals
from tests.time_limit import PATIENCE
from urdfkit.app.termination import ended_by_signals
from urdfkit.cli import main


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_block_and_what_it_did_before_is_back(how):
    undone = []

    def write():
        with ended_by_signals():
            try:
                signal.raise_signal(how)
            finally:
                signal.raise_signal(how)
                undone.append("undone")

    with signals():
        with pytest.raises(SystemExit) as ended:
            write()
        assert signal.getsignal(how) == signal.SIG_DFL
    assert ended.value.code == 128 + how
    assert undone == ["undone"]


def test_ctrl_c_that_is_caught_leaves_the_exit_code_alone():
    code = """
import signal
from urdfkit.app.termination import ended_by_signals
try:
    with ended_by_signals():
        exec("signal.raise_signal(signal.SIGINT)")
except KeyboardInterrupt:
    raise SystemExit(7)
"""
    with running([sys.executable, "-c", code]) as process:
        assert process.wait(PATIENCE) == 7


@pytest.mark.parametrize("statement", ["import optional", "Finalized()"])
@pytest.mark.parametrize("times", [1, 2])
@pytest.mark.parametrize(("how", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_is_not_lost_where_exceptions_are_ignored(statement, how, status, times, tmp_path):
    raised = f"signal.raise_signal({int(how)})"
    (tmp_path / "optional.py").write_text(f"import signal\ntry: {raised}\nexcept BaseException: pass\n")
    code = f"""
import signal, sys, time
from urdfkit.app.termination import ended_by_signals
class Finalized:
    def __del__(self):
        try: {raised}
        finally: {raised if times == 2 else "pass"}
try:
    with ended_by_signals():
        {statement}
        time.sleep({PATIENCE})
except KeyboardInterrupt:
    sys.exit(130)
"""
    with running([sys.executable, "-c", code], cwd=tmp_path) as process:
        assert process.wait(PATIENCE / 2) == status


def test_ctrl_c_at_a_question_leaves_the_line(tmp_path, monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

        def readline(self):
            raise KeyboardInterrupt

    shown = Terminal()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.stdin", Terminal())
    monkeypatch.setattr("sys.stderr", shown)
    assert main(["new", "robot", "scout", "--no-preview"]) == 130
    assert shown.getvalue().endswith(": \n")
    assert list(tmp_path.iterdir()) == []
