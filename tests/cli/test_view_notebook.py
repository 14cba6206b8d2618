"""The page of a handle in a notebook: a frame in a page of another site."""

from __future__ import annotations

import http.server
import threading

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")
pytest.importorskip("playwright")

import urdfkit
from tests.cli.conftest import READY

FLAG = """<robot name="flag">
  <link name="base"><visual><geometry><mesh filename="flag.stl"/></geometry></visual></link>
</robot>
"""
TRIANGLE = """solid flag
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid flag
"""

pytestmark = pytest.mark.browser


def test_a_notebook_on_another_host_name_shows_the_page(visits, keep, until, tmp_path) -> None:
    """Cookies are not sent from a frame of another site; the page uses its token."""
    (tmp_path / "flag.urdf").write_text(FLAG)
    (tmp_path / "flag.stl").write_text(TRIANGLE)

    class Notebook(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            body = f"<!doctype html><title>notebook</title>{shown._repr_html_()}".encode()
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None:
            pass

    notebook = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Notebook)
    threading.Thread(target=notebook.serve_forever, daemon=True).start()
    try:
        with urdfkit.view(tmp_path / "flag.urdf") as shown:
            page = visits.open(f"http://localhost:{notebook.server_port}/", ready=False)
            frame = page.frame_locator("iframe")
            frame.locator(READY).wait_for()
            assert frame.locator("#state").inner_text() == "connected"
            keep(page, "frame")
            geometry = f"{shown.url.partition('?')[0]}geometry/"  # the mesh
            until(lambda: any(url.startswith(geometry) and "?token=" in url for url in visits.requests))
        assert [text for text in visits.problems if "favicon" not in text] == []
    finally:
        notebook.shutdown()
        notebook.server_close()
