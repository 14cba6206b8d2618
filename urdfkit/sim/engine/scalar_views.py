"""Views of the engine's memory for single numbers, which come and go through them much faster than through arrays."""

from typing import Any

from numpy.typing import NDArray


def numbers(array: NDArray[Any]) -> Any:
    """Return a view whose entries are plain numbers; of the same memory, and written to where the array may be."""
    view: Any = memoryview
    return view(array)
