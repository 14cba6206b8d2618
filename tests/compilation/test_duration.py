"""The announced duration of a compilation depends on the load of the machine."""

import os

import pytest

from urdfkit.compilation.duration import announced_duration


@pytest.mark.parametrize(
    ("load", "expected"),
    [
        (0.0, "about 50 s"),
        (1.5, "about 50 s"),
        (2.0, "about 75 s at the present load of this machine"),
        (11.0, "about 5 min at the present load of this machine"),
    ],
)
def test_the_duration_grows_with_the_load_of_the_machine(monkeypatch, load, expected):
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    monkeypatch.setattr(os, "getloadavg", lambda: (load, 0.0, 0.0), raising=False)
    assert announced_duration(50.0) == expected


def test_the_duration_of_an_idle_machine_is_announced_where_the_load_is_not_measured(monkeypatch):
    monkeypatch.delattr(os, "getloadavg", raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    assert announced_duration(22.0) == "about 22 s"
