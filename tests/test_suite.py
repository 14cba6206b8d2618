"""How the tests themselves are run: what they start ends with them, and none of them waits for ever."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.leftover_processes import descendants
from tests.processes import running
from tests.slow_tests import wrong_marks
from tests.time_limit import PATIENCE, limit

ROOT = Path(__file__).parents[1]
PLUGINS = ("-p", "tests.leftover_processes", "-p", "tests.time_limit")
LEAVES_ONE = """
import subprocess, sys
import tests.leftover_processes
tests.leftover_processes.PATIENCE = 0.1
SLEEP = [sys.executable, "-c", "import time; time.sleep(3600)"]

def test_it():
    subprocess.run([sys.executable, "-c", f"import subprocess; subprocess.Popen({SLEEP!r}, start_new_session=True)"])
"""
WAITS = """
import sys
from tests.processes import running

def test_it():
    with running([sys.executable, "-c", "import time; print(flush=True); time.sleep(3600)"]) as process:
        process.wait()
"""


def run(file: Path, text: str) -> list[object]:
    file.write_text(text)
    return [sys.executable, "-m", "pytest", "-q", "-s", "--rootdir", file.parent, *PLUGINS, file]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux names the descendants of a process")
def test_a_run_that_leaves_a_process_behind_fails_and_names_the_test(tmp_path: Path) -> None:
    command = run(tmp_path / "test_leaves_one.py", LEAVES_ONE)
    with running(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as process:
        reported = process.communicate(timeout=PATIENCE)[0]
    assert process.returncode == 1, reported
    assert "ERROR test_leaves_one.py::test_it (call): process " in reported
    assert not [line for _, line in descendants() if "test_leaves_one" in line]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux names the descendants of a process")
def test_a_run_that_is_told_to_end_ends_what_its_tests_have_started(tmp_path: Path) -> None:
    command = run(tmp_path / "test_waits.py", WAITS)
    with running(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert "\n" in iter(process.stdout.readline, "")  # of the program that the test has started
        process.send_signal(signal.SIGTERM)
        reported = process.communicate(timeout=PATIENCE)[0]
    assert process.returncode == 143, reported
    assert not [line for _, line in descendants() if "test_waits" in line]


def test_what_takes_too_long_fails() -> None:
    with pytest.raises(pytest.fail.Exception, match=r"^waiting: not done after 0.05 s$"), limit(0.05, "waiting"):
        time.sleep(PATIENCE)


def test_signals_are_handled_as_in_a_terminal_unless_ignored() -> None:
    code = "import signal; print([signal.getsignal(n) == signal.SIG_IGN for n in (signal.SIGINT, signal.SIGHUP)])"
    for ignored in ((), (signal.SIGHUP,)):
        with running([sys.executable, "-c", code], ignored=ignored, stdout=subprocess.PIPE, text=True) as process:
            assert process.communicate()[0] == f"{[False, bool(ignored)]}\n"


@pytest.mark.slow
def test_the_times_of_several_processes_come_together(tmp_path: Path) -> None:
    file = tmp_path / "times.txt"
    command = run(tmp_path / "test_two.py", "def test_one(): pass\ndef test_two(): sum(range(3 * 10**8))\n")
    command += ["-p", "tests.slow_tests", f"--cpu-times={file}", "-n", "2", "-p", "no:cacheprovider"]
    done = subprocess.run([str(word) for word in command], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 0, done.stdout
    assert sorted(line.split()[1] for line in file.read_text().splitlines()) == [
        "test_two.py::test_one",
        "test_two.py::test_two",
    ]
    assert "\ntest_two.py::test_two: " in done.stdout
    assert "CPU time of 2 tests: " in done.stdout


def test_the_summary_names_wrong_marks_by_the_slowest_case_of_a_test() -> None:
    times = {"a.py::test_long[1]": 0.1, "a.py::test_long[2]": 9.0, "a.py::test_short": 0.2, "a.py::test_quick": 0.8}
    assert wrong_marks(times, {"a.py::test_short"}) == [
        "a.py::test_long: 9.0 s of CPU time, slow",
        "a.py::test_short: 0.2 s of CPU time, not slow",
    ]
    assert wrong_marks(times, {"a.py::test_long[1]", "a.py::test_long[2]"}) == []
