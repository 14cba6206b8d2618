"""One page with two modes: a simulation starts from the viewer, has its panels, and returns to it."""

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")
pytest.importorskip("numba")

from tests.cli.conftest import READY
from tests.cli.lab import panel


@pytest.mark.slow
@pytest.mark.browser
def test_a_simulation_starts_from_the_viewer_has_its_panels_and_returns(lab_served, visits, until, keep) -> None:
    page = visits.open(lab_served.url)
    page.get_by_label("World of the simulation").select_option("empty")
    page.get_by_role("button", name="Simulate").click()
    page.wait_for_selector(f"{READY}[data-mode=sim]")
    panel(page, "tree")
    page.locator(".tree [data-link=upper]").click()
    page.get_by_role("button", name="Inspect", exact=True).last.click()
    assert "0.5 kg" in page.locator("#panel-inspect").inner_text()
    panel(page, "tf")
    page.locator("#tf-in").select_option(label="world")
    until(lambda: "0.1" in page.locator("[data-frame=upper]").inner_text())
    panel(page, "findings")
    assert page.locator("#panel-findings .finding").count() > 0

    panel(page, "joints")
    bend = page.locator("#panel-joints [data-joint=bend] input[type=range]")
    assert bend.is_disabled()
    page.get_by_role("button", name="Pause").click()
    until(lambda: bend.is_enabled())
    number = page.locator("#panel-joints [data-joint=bend] input:not([type=range])")
    number.select_text()
    number.press_sequentially("-1.5", delay=200)  # slower than the positions that the simulation sends
    number.press("Enter")
    until(lambda: page.evaluate("urdfkit.page.values.bend") == pytest.approx(-1.5))
    keep(page, "posed")

    page.get_by_role("button", name="Viewer").click()
    page.wait_for_selector(f"{READY}[data-mode=view]")
    until(lambda: bend.is_enabled())
    assert visits.problems == []
