"""Options of bridges that are refused, and origins as browsers send them."""

import argparse

import pytest

from urdfkit.cli.sim.bridge_options import add_bridges
from urdfkit.cli.sim.ros_options import ros_options


@pytest.mark.parametrize(
    ("text", "origin"),
    [
        ("https://example.org", "https://example.org"),
        ("https://Example.org/", "https://example.org"),
        ("http://10.0.0.5:8080", "http://10.0.0.5:8080"),
        ("null", "null"),
    ],
)
def test_origins(text: str, origin: str) -> None:
    parser = argparse.ArgumentParser()
    add_bridges(parser)
    assert parser.parse_args(["--allow-origin", text]).allow_origin == [origin]


@pytest.mark.parametrize("text", ["example.org", "foo", "https://example.org/page", "*", "", "https://"])
def test_texts_that_no_browser_sends_as_origin_are_refused(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    parser = argparse.ArgumentParser()
    add_bridges(parser)
    with pytest.raises(SystemExit):
        parser.parse_args(["--allow-origin", text])
    assert f"`{text}` is not an origin" in capsys.readouterr().err


def test_a_bridge_to_ros1_has_a_namespace_and_a_rate_of_the_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:11311")
    asked = argparse.Namespace(ros1=True, ros2=False, ros_domain=None, namespace="cart", clock_rate=50.0)
    options = ros_options(asked)
    assert options is not None
    assert (options.namespace, options.clock_rate, options.domain) == ("/cart", 50.0, None)
    assert (
        ros_options(argparse.Namespace(ros1=False, ros2=False, ros_domain=None, namespace=None, clock_rate=None))
        is None
    )
