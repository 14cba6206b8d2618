"""The notebooks of the documentation have the outputs that their cells print.

``python -m tests.docs.test_notebooks`` runs them and writes their outputs.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")
pytest.importorskip("numba")
pytest.importorskip("matplotlib")

NOTEBOOKS = sorted((Path(__file__).parents[2] / "docs/notebooks").glob("*.ipynb"))
VARIES = re.compile(r"127\.0\.0\.1:\d+|token=[\w-]+")
"""What is not stored: ports and tokens of pages."""


def executed(path: Path, folder: Path):
    """Run a notebook in a folder and return it with its outputs."""
    notebook = nbformat.read(path, as_version=4)
    resources = {"metadata": {"path": folder}}
    return nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3", resources=resources).execute()


def texts(notebook) -> list[list[str]]:
    """Return the texts that each cell prints; of pictures, pages and tables only that they are there."""

    def shown(output) -> str:
        if output.output_type == "stream":
            return output.text
        return next((kind for kind in ("image/png", "text/html") if kind in output.data), output.data["text/plain"])

    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    return [[shown(output) for output in cell.outputs] for cell in cells]


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_outputs_of_a_notebook_are_those_of_its_cells(path: Path, tmp_path: Path) -> None:
    stored = nbformat.read(path, as_version=4)
    assert any(texts(stored))
    assert texts(executed(path, tmp_path)) == texts(stored)


def renew(folder: Path) -> None:
    """Run all notebooks and write their outputs."""
    for path in NOTEBOOKS:
        notebook = executed(path, folder)
        for cell in notebook.cells:
            cell.metadata.clear()
            for output in cell.get("outputs", ()):
                data = output.get("data", {})
                for kind in data:
                    if kind.startswith("text/"):
                        data[kind] = VARIES.sub("…", data[kind])
        nbformat.write(notebook, path)


if __name__ == "__main__":
    import tempfile

    with tempfile.TemporaryDirectory() as temporary:
        renew(Path(temporary))
