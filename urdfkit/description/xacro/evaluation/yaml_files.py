"""Read YAML files into values, with the units of xacro, within limits."""

import math
from collections.abc import Callable
from typing import Any

from urdfkit.description.xacro.evaluation.expressions.limits import MAX_ELEMENTS, MAX_NESTING, TooLarge
from urdfkit.description.xacro.evaluation.expressions.values import wrapped

_MOST_KEPT = 16
"""Number of documents whose nodes are kept: variants of a robot load the same files."""

_kept: dict[str, tuple[Any, int]] = {}
"""Text → its root node and the number of its nodes. Composing nodes takes ten times as long as reading their values."""

_UNITS = {
    "!radians": 1.0,
    "!degrees": math.pi / 180.0,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}


def yaml_values(text: str, name: str, evaluate: Callable[[str], Any], spend: Callable[[int], None]) -> Any:
    """Return the value of a YAML document.

    Args:
        text: of the file.
        name: of the file, for errors.
        evaluate: evaluates the expression of a value with a unit.
        spend: counts steps; a value takes as long to read as four operations of an expression.

    Raises:
        ValueError: it is not YAML.
        TooLarge: its merge keys or its nesting make too much.
    """
    import yaml

    class Loader(yaml.SafeLoader):
        """Loads plain values; counts what merge keys copy."""

        merged = depth = count = 0

        def fetch_more_tokens(self) -> None:
            _check_depth(self.flow_level)  # here, because the scanner reads 1,024 brackets ahead
            super().fetch_more_tokens()

        def compose_node(self, parent: Any, index: Any) -> Any:
            spend(4)
            self.count += 1
            self.depth += 1
            _check_depth(self.depth)
            node = super().compose_node(parent, index)
            self.depth -= 1
            return node

        def flatten_mapping(self, node: Any) -> None:
            for key, value in node.value:
                if key.tag == "tag:yaml.org,2002:merge":
                    for source in value.value if isinstance(value, yaml.SequenceNode) else [value]:
                        if isinstance(source, yaml.MappingNode) and source is not node:
                            self.flatten_mapping(source)
                            self.merged += len(source.value)
            if self.merged > MAX_ELEMENTS:
                raise TooLarge(f"its merge keys produce more than {MAX_ELEMENTS:,} elements")
            super().flatten_mapping(node)

    def with_unit(factor: float) -> Callable[[Any, Any], float]:
        return lambda loader, node: float(evaluate(loader.construct_scalar(node))) * factor

    spend(len(text) >> 3)
    for tag, factor in _UNITS.items():
        Loader.add_constructor(tag, with_unit(factor))
    try:
        if (kept := _kept.get(text)) is not None:  # one access, because threads share it
            spend(4 * kept[1])
            return wrapped(Loader("").construct_document(kept[0]))
        loader = Loader(text)
        root = loader.get_single_node()
        if root is None:
            return None
        if "<<" not in text and "merge" not in text:  # merge keys change the nodes
            if len(_kept) >= _MOST_KEPT:
                _kept.clear()
            _kept[text] = root, loader.count
        return wrapped(loader.construct_document(root))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"{name}:{mark.line + 1}:{mark.column + 1}" if mark is not None else name
        raise ValueError(f"{place}: {error.problem or error.context}") from None
    except RecursionError:
        raise TooLarge("the YAML file is nested too deeply") from None


def _check_depth(depth: int) -> None:
    if depth > MAX_NESTING:
        raise TooLarge("the YAML file is nested too deeply")
