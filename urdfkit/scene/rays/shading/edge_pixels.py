"""Edge pixels of an image: pixels that differ from a neighbour."""

from typing import Any

from urdfkit.scene.rays.compilation import inlined


def outline(colors: Any, alike: int, found: Any) -> int:
    """Find the pixels that differ from a neighbour; return their number.

    Args:
        colors: 0..255; shape (height, width, 3).
        alike: largest difference of a channel between equal neighbours.
        found: output, the indices of the pixels in row-major order; shape (≥ height · width,).
    """
    height, width = colors.shape[0], colors.shape[1]
    count = 0
    for row in range(height):
        for column in range(width):
            ends = row > 0 and differ(colors, row, column, row - 1, column, alike)
            ends = ends or (row + 1 < height and differ(colors, row, column, row + 1, column, alike))
            ends = ends or (column > 0 and differ(colors, row, column, row, column - 1, alike))
            ends = ends or (column + 1 < width and differ(colors, row, column, row, column + 1, alike))
            if ends:
                found[count] = row * width + column
                count += 1
    return count


@inlined
def differ(colors: Any, row: int, column: int, other_row: int, other_column: int, alike: int) -> bool:
    """Return whether two pixels differ."""
    most = 0
    for c in range(3):
        one, other = colors[row, column, c], colors[other_row, other_column, c]
        most = max(
            most, one - other if one > other else other - one
        )  # unsigned: a negative difference would wrap around
    return most > alike
