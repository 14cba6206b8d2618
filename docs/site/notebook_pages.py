"""Pages of the example notebooks: text, code and stored outputs, whose values a test compares with the cells."""

from __future__ import annotations

import json
from base64 import b64decode
from collections.abc import Iterator
from pathlib import Path
from typing import Any

_NOT_SERVED = "The page of the robot is shown here while the notebook runs."


def notebook_pages(folder: Path) -> dict[str, str | bytes]:
    """Return path → content of a page for each notebook of a folder, and of its pictures."""
    found: dict[str, str | bytes] = {}
    for file in sorted(folder.glob("*.ipynb")):
        pictures: list[bytes] = []
        text = "\n\n".join(
            part for cell in json.loads(file.read_text("utf-8"))["cells"] for part in _cell(cell, pictures)
        )
        heading, _, rest = text.partition("\n")
        for number, picture in enumerate(pictures, 1):
            found[f"notebooks/{file.stem}-{number}.png"] = picture
            rest = rest.replace(f"PICTURE-{number}.png", f"{file.stem}-{number}.png")
        found[f"notebooks/{file.stem}.md"] = (
            f"{heading}\n\n[Download the notebook]({file.name}){{ download }}\n{rest}\n"
        )
    return found


def _cell(cell: dict[str, Any], pictures: list[bytes]) -> Iterator[str]:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        yield source
        return
    yield f"```python\n{source}\n```"
    for output in cell["outputs"]:
        data = {kind: "".join(lines) for kind, lines in output.get("data", {}).items()}
        if "image/png" in data:
            pictures.append(b64decode(data["image/png"]))
            yield f"![Plot of the cell above](PICTURE-{len(pictures)}.png)"
        elif "<iframe" in data.get("text/html", ""):
            yield f"*{_NOT_SERVED}*"
        elif "text/html" in data:
            yield data["text/html"]
        else:
            yield f"```text\n{(''.join(output.get('text', '')) or data['text/plain']).rstrip()}\n```"
