"""Options of bridges that are refused, and origins as browsers send them."""

import argparse

import pytest

from urdfkit.cli.sim.bridge_options import add_bridges


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
