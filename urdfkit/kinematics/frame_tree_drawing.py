"""The frame tree as text, as Graphviz DOT, and as an SVG drawing."""

from collections.abc import Iterator
from dataclasses import dataclass
from unicodedata import east_asian_width
from xml.sax.saxutils import escape

from urdfkit.errors import shortened
from urdfkit.kinematics.tf import Edge, TransformTree

_CHAR, _FONT = 7.3, 12  # [px] a monospaced character at that font size; rather too wide than too narrow
_BOX, _ROW, _MARGIN, _ELBOW = 26, 46, 16, 14  # [px] heights of a box and a row, outer margin, width of a bend

# Lines and their labels are of middle brightness, boxes have their own background: readable on light and dark pages.
_STYLE = """
  text { font: 12px ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace; }
  .frame { fill: #1f2933; }
  .joint { fill: #6f7b88; }
  .type { fill: #6f7b88; font-size: 10px; }
  .box { fill: #eef2f6; stroke: #7b8794; }
  .root { fill: #cfe3f6; stroke: #2f6fb0; }
  path { fill: none; stroke: #7b8794; stroke-width: 1.4; }
  .moves { stroke: #3b82c4; stroke-width: 2; }
  .mimics { stroke: #3b82c4; stroke-width: 2; stroke-dasharray: 5 3; }
"""


def as_text(tree: TransformTree, *, ascii_only: bool = False) -> str:
    """Return the tree as indented lines, a frame each, with the joint that leads to it."""
    tee, last, bar = ("|-- ", "`-- ", "|   ") if ascii_only else ("├── ", "└── ", "│   ")
    below = _below(tree)
    lines = [shortened(tree.root)]
    stack = [(edge, "") for edge in reversed(below.get(tree.root, []))]
    while stack:
        edge, indent = stack.pop()
        is_last = edge is below[edge.parent][-1]
        own = shortened(f"{edge.child}  [{edge.joint}, {_kind(edge)}]")
        lines.append(f"{indent}{last if is_last else tee}{own}")
        deeper = indent + ("    " if is_last else bar)
        stack += [(child, deeper) for child in reversed(below.get(edge.child, []))]
    return "\n".join(lines) + "\n"


def as_dot(tree: TransformTree) -> str:
    """Return the tree in Graphviz' language; joints that move are drawn in blue."""
    lines = [f"digraph {_quote(tree.kinematics.robot.name or 'frames')} {{", "  rankdir=LR;"]
    lines.append('  node [shape=box, style=rounded, fontname="monospace"];')
    lines.append('  edge [fontname="monospace", fontsize=10];')
    lines += [f"  {_quote(frame)};" for frame in tree.frames]
    for edge in tree.edges:
        look = "" if edge.is_static else ', color="#2f6fb0", penwidth=2'
        # The line break is DOT's own escape, it stays outside the quoting.
        label = f"{_quote(edge.joint)[:-1]}\\n{_quote(_kind(edge))[1:]}"
        lines.append(f"  {_quote(edge.parent)} -> {_quote(edge.child)} [label={label}{look}];")
    return "\n".join([*lines, "}"]) + "\n"


@dataclass(slots=True)
class _Box:
    """A frame in the drawing: left edge, centre line, width, and where the line from its parent bends [px]."""

    x: float
    y: float
    width: float
    bend: float


def as_svg(tree: TransformTree) -> str:
    """Return the tree as an SVG drawing, root at the left, that suits light and dark pages.

    Each leaf has its own row, and a frame is centred on the frames below it; the columns are as wide as their widest
    frame and the widest joint name before it. Joints that move are blue, mimic joints dashed.
    """
    boxes = _layout(tree)
    width = max(box.x + box.width for box in boxes.values()) + _MARGIN
    height = max(box.y for box in boxes.values()) + _ROW / 2 + _MARGIN
    size = f'width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img">',
        f"<title>Frames of {escape(tree.kinematics.robot.name or 'robot')}</title>",
        f"<style>{_STYLE}</style>",
    ]
    for edge in tree.edges:
        parts += _draw_edge(edge, boxes[edge.parent], boxes[edge.child])
    for frame, box in boxes.items():
        look = "root" if frame == tree.root else "box"
        parts.append(
            f'<rect class="{look}" x="{box.x:.1f}" y="{box.y - _BOX / 2:.1f}" '
            f'width="{box.width:.1f}" height="{_BOX}" rx="5"/>'
        )
        parts.append(_label("frame", box.x + box.width / 2, box.y + 4, frame))
    return "\n".join([*parts, "</svg>"]) + "\n"


def _layout(tree: TransformTree) -> dict[str, _Box]:
    below = _below(tree)
    depth = {tree.root: 0}
    for edge in tree.edges:
        depth[edge.child] = depth[edge.parent] + 1
    columns = max(depth.values()) + 1
    widths, gaps = [0.0] * columns, [0.0] * columns
    for frame, column in depth.items():
        widths[column] = max(widths[column], _length(frame) + 20)
    for edge in tree.edges:
        label = max(_length(edge.joint), _length(_kind(edge)) * 0.85)
        gaps[depth[edge.child]] = max(gaps[depth[edge.child]], label + 3 * _ELBOW)
    left = [float(_MARGIN)]
    for column in range(1, columns):
        left.append(left[-1] + widths[column - 1] + gaps[column])
    boxes = {
        frame: _Box(left[column], 0.0, _length(frame) + 20, left[column] - gaps[column] + _ELBOW)
        for frame, column in depth.items()
    }
    row = 0
    for frame in _bottom_up(tree, below):
        if children := below.get(frame):
            boxes[frame].y = (boxes[children[0].child].y + boxes[children[-1].child].y) / 2
        else:
            boxes[frame].y = _MARGIN + _ROW * (row + 0.5)
            row += 1
    return boxes


def _draw_edge(edge: Edge, parent: _Box, child: _Box) -> Iterator[str]:
    start = parent.x + parent.width
    look = ' class="mimics"' if edge.mimics else "" if edge.is_static else ' class="moves"'
    yield f'<path{look} d="M{start:.1f} {parent.y:.1f}H{child.bend:.1f}V{child.y:.1f}H{child.x:.1f}"/>'
    middle = (child.bend + child.x) / 2
    yield _label("joint", middle, child.y - 5, edge.joint)
    yield _label("type", middle, child.y + 13, _kind(edge))


def _label(look: str, x: float, y: float, text: str) -> str:
    return f'<text class="{look}" x="{x:.1f}" y="{y:.1f}" text-anchor="middle">{escape(text)}</text>'


def _below(tree: TransformTree) -> dict[str, list[Edge]]:
    found: dict[str, list[Edge]] = {}
    for edge in tree.edges:
        found.setdefault(edge.parent, []).append(edge)
    return found


def _bottom_up(tree: TransformTree, below: dict[str, list[Edge]]) -> list[str]:
    """Return the frames, those below a frame before it, and siblings in their order."""
    order, stack = [], [tree.root]
    while stack:
        frame = stack.pop()
        order.append(frame)
        stack += [edge.child for edge in below.get(frame, [])]
    return order[::-1]


def _kind(edge: Edge) -> str:
    return f"{edge.type}, mimics {edge.mimics}" if edge.mimics else edge.type


def _length(text: str) -> float:
    """Return the width of a text [px]; wide characters (CJK) count twice."""
    return sum(2 if east_asian_width(character) in "WF" else 1 for character in text) * _CHAR


def _quote(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
    return f'"{escaped}"'
