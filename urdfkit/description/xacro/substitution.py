"""``$(…)``: packages are found by us, and what is evaluated is kept from reaching the machine."""

from __future__ import annotations

from urdfkit.errors import ResourceError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.expressions.evaluation import Evaluator


class Substitution:
    """What a run of xacro does with ``$(find …)``, ``$(arg …)``, ``$(eval …)`` and the like."""

    packages: Packages
    evaluator: Evaluator
    xacro: Any
    stock: dict[str, Any]
    missing_package: str | None

    def eval_extension(self, s: str) -> Any:
        """Evaluate ``$(…)``: ``find`` through our packages, the rest as xacro does."""
        # The two frequent ones directly: xacro's module for them imports PyYAML, which takes longer than most files.
        words = s[2:-1].split(" ") if s.count("$") == 1 else []
        if len(words) == 2 and all(words) and not set("()") & set(words[1]):
            if words[0] == "find" and "$" not in (path := self._find(words[1])):
                return path
            if words[0] == "arg":
                value = self.xacro.substitution_args_context["arg"].get(words[1])
                if isinstance(value, str) and "$" not in value:
                    return value
        from xacro import substitution_args

        saved = substitution_args._eval_find, substitution_args._eval, substitution_args._eval_dict["find"]
        substitution_args._eval_find = substitution_args._eval_dict["find"] = self._find
        substitution_args._eval = self._eval_command
        try:
            return self.stock["eval_extension"](s)
        finally:
            substitution_args._eval_find, substitution_args._eval = saved[:2]
            substitution_args._eval_dict["find"] = saved[2]

    def _find(self, name: str) -> str:
        try:
            return str(self.packages.find(name))
        except ResourceError as error:
            self.missing_package = name
            raise self.xacro.XacroException(exc=error) from error

    def _eval_command(self, expression: str, context: dict[str, Any]) -> str:
        from xacro import substitution_args as stock

        arguments = context.setdefault("arg", {})
        functions = {
            **stock._eval_dict,
            "arg": lambda name: stock.convert_value(stock._eval_arg(name, args=arguments), "auto"),
            "dirname": lambda: stock._eval_dirname(context.get("filename")),
        }
        functions.pop("__builtins__", None)
        return self.evaluator.eval_command(expression, stock._DictWrapper(arguments, functions))
