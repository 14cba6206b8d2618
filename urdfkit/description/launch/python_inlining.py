"""Calls of the functions that a Python launch file defines, replaced by what they return.

Launch files often shorten themselves with functions, such as ``include(package, name, **arguments)``, and with lists
over names. Readers of the syntax tree then see the actions as if each had been written out. Nodes of the arguments keep
their place at the call, the others theirs in the function.
"""

import ast
import copy
from collections import Counter
from collections.abc import Mapping, Set

_MOST_CALLS = 200
_DEEPEST = 6
_MOST_NODES = 40_000


def inlined(tree: ast.Module) -> ast.Module:
    """Return the syntax tree with calls of simple functions, and lists over constants, written out.

    A function is simple if it consists of assignments and one ``return`` of a value, and stands in the module or in a
    function of the module. Its definition is removed if nothing else names it.

    Args:
        tree: of a launch file; it is changed.
    """
    functions = _simple_functions(tree)
    inliner = _Inliner(functions)
    inliner.visit(tree)
    for name, function in functions.items():  # in order, so that each run gives the same tree
        if name not in inliner.replaced:  # such as a function that OpaqueFunction calls
            inliner.generic_visit(function)
    gone, named = inliner.replaced - {"generate_launch_description"}, {""}
    while named:
        named = gone & _names(tree, gone)
        gone -= named
    for block in _blocks(tree):
        block[:] = [node for node in block if not (isinstance(node, ast.FunctionDef) and node.name in gone)]
    return tree


def _blocks(tree: ast.Module) -> list[list[ast.stmt]]:
    return [tree.body, *(node.body for node in tree.body if isinstance(node, ast.FunctionDef))]


def _names(node: ast.AST, without: Set[str]) -> set[str]:
    """Return the names that are read, but not in the functions `without`."""
    if isinstance(node, ast.FunctionDef) and node.name in without:
        return set()
    own = {node.id} if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) else set()
    return own.union(*(_names(child, without) for child in ast.iter_child_nodes(node)))


def _simple_functions(tree: ast.Module) -> dict[str, ast.FunctionDef]:
    defined = Counter(node.name for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef, ast.ClassDef)))
    defined.update(node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store))
    return {
        node.name: node
        for block in _blocks(tree)
        for node in block
        if isinstance(node, ast.FunctionDef) and defined[node.name] == 1 and _is_simple(node)
    }


def _is_simple(function: ast.FunctionDef) -> bool:
    *before, last = function.body
    if before and isinstance(before[0], ast.Expr) and isinstance(before[0].value, ast.Constant):
        before = before[1:]
    assigned = [_assigned_name(each) for each in before]
    return (
        isinstance(last, ast.Return)
        and last.value is not None
        and None not in assigned
        and len(assigned) == len(set(assigned))
        and not (function.decorator_list or function.args.posonlyargs)
        and not any(isinstance(node, (ast.Lambda, ast.NamedExpr, ast.Await, ast.Yield)) for node in ast.walk(function))
    )


def _assigned_name(node: ast.stmt) -> str | None:
    """Return the name that a statement assigns; None for other statements."""
    if isinstance(node, ast.Assign) and len(node.targets) == 1 and isinstance(node.targets[0], ast.Name):
        return node.targets[0].id
    return None


class _Inliner(ast.NodeTransformer):
    def __init__(self, functions: Mapping[str, ast.FunctionDef]) -> None:
        self.functions, self.replaced = functions, set[str]()
        self._depth = self._calls = self._nodes = 0

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        if node.name not in self.functions or node.name == "generate_launch_description":
            self.generic_visit(node)
        return node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in ("list", "tuple") and len(node.args) == 1:
            return node if isinstance(node.args[0], ast.Constant) else node.args[0]
        function = self.functions.get(node.func.id) if isinstance(node.func, ast.Name) else None
        values = _values(function, node) if function is not None else None
        if function is None or values is None or self._depth >= _DEEPEST or not self._may_copy(function):
            return node
        self.replaced.add(function.name)
        self._depth += 1
        result: ast.expr = node
        for each in function.body:
            if isinstance(each, ast.Assign) and (name := _assigned_name(each)) is not None:
                values[name] = self._replaced(each.value, values)
            elif isinstance(each, ast.Return) and each.value is not None:
                result = self._replaced(each.value, values)
        self._depth -= 1
        if result is not node:
            result.called_at = node  # type: ignore[attr-defined]
        return result

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        """Return the first value of ``a or b`` that is constant and not false or empty, such as a default name."""
        self.generic_visit(node)
        values = node.values
        while isinstance(node.op, ast.Or) and len(values) > 1 and isinstance(values[0], (ast.Constant, ast.List)):
            is_true = values[0].value if isinstance(values[0], ast.Constant) else values[0].elts
            values = values[:1] if is_true else values[1:]
        return values[0] if len(values) == 1 else node

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        """Return the value that ``a if test else b`` has for a constant, list or dictionary as the test."""
        self.generic_visit(node)
        test = node.test
        if isinstance(test, ast.Constant):
            return node.body if test.value else node.orelse
        if isinstance(test, (ast.List, ast.Tuple)):
            return node.body if test.elts else node.orelse
        return (node.body if test.keys else node.orelse) if isinstance(test, ast.Dict) else node

    def visit_ListComp(self, node: ast.ListComp) -> ast.AST:
        self.generic_visit(node)
        each = node.generators[0]
        items = each.iter.elts if isinstance(each.iter, (ast.List, ast.Tuple)) else None
        if len(node.generators) > 1 or each.ifs or not items or not isinstance(each.target, ast.Name):
            return node
        if any(isinstance(item, ast.Starred) for item in items) or not self._may_copy(node.elt, len(items)):
            return node
        copies = [self._replaced(node.elt, {each.target.id: item}) for item in items]
        return ast.copy_location(ast.List(copies, ast.Load()), node)

    def _replaced(self, node: ast.expr, values: Mapping[str, ast.expr]) -> ast.expr:
        """Return a copy of an expression with values for names, and with the calls in it written out."""
        replaced: ast.expr = self.visit(_Substitution(values).visit(copy.deepcopy(node)))
        return replaced

    def _may_copy(self, node: ast.AST, times: int = 1) -> bool:
        """Whether the limits, which keep a file from growing without bound, allow copies of a node."""
        self._calls += 1
        self._nodes += times * sum(1 for _ in ast.walk(node))
        return self._calls <= _MOST_CALLS and self._nodes <= _MOST_NODES


class _Substitution(ast.NodeTransformer):
    def __init__(self, values: Mapping[str, ast.expr]) -> None:
        self._values = values

    def visit(self, node: ast.AST) -> ast.AST:
        """Replace names in a node, except the variables of a list comprehension."""
        if not isinstance(node, (ast.ListComp, ast.SetComp, ast.GeneratorExp, ast.DictComp)):
            replaced: ast.AST = super().visit(node)
            return replaced
        parts = (part for each in node.generators for part in ast.walk(each.target))
        bound = {part.id for part in parts if isinstance(part, ast.Name)}
        node.generators[0].iter = self.visit(node.generators[0].iter)  # type: ignore[assignment]
        own = {name: value for name, value in self._values.items() if name not in bound}
        return _Substitution(own).generic_visit(node)

    def visit_Name(self, node: ast.Name) -> ast.AST:
        value = self._values.get(node.id) if isinstance(node.ctx, ast.Load) else None
        if value is None:
            return node
        copied = copy.deepcopy(value)
        copied.named_at = node  # type: ignore[attr-defined]
        return copied

    def visit_List(self, node: ast.List) -> ast.AST:
        self.generic_visit(node)
        node.elts = _without_stars(node.elts)
        return node

    def visit_Tuple(self, node: ast.Tuple) -> ast.AST:
        self.generic_visit(node)
        node.elts = _without_stars(node.elts)
        return node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        node.args = _without_stars(node.args)
        return node


def _without_stars(items: list[ast.expr]) -> list[ast.expr]:
    """Return items with those of lists and tuples after a star in their place."""
    found: list[ast.expr] = []
    for item in items:
        inner = item.value if isinstance(item, ast.Starred) else None
        found += inner.elts if isinstance(inner, (ast.List, ast.Tuple)) else [item]
    return found


def _values(function: ast.FunctionDef, call: ast.Call) -> dict[str, ast.expr] | None:
    """Return the values of the parameters in a call; None if the call is computed or does not fit."""
    if any(isinstance(each, ast.Starred) for each in call.args) or any(word.arg is None for word in call.keywords):
        return None
    arguments = function.args
    plain = [each.arg for each in arguments.args]
    named = plain + [each.arg for each in arguments.kwonlyargs]
    values: dict[str, ast.expr] = dict(zip(plain, call.args, strict=False))
    rest: list[ast.keyword] = []
    for word in call.keywords:
        if word.arg in values or (word.arg not in named and arguments.kwarg is None):
            return None
        if word.arg in named:
            values[str(word.arg)] = word.value
        else:
            rest.append(word)
    defaults = dict(zip(plain[len(plain) - len(arguments.defaults) :], arguments.defaults, strict=True))
    defaults |= {k.arg: d for k, d in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True) if d is not None}
    values = defaults | values
    if arguments.kwarg is not None:
        keys: list[ast.expr | None] = [ast.copy_location(ast.Constant(word.arg), word) for word in rest]
        items = ast.Dict(keys, [word.value for word in rest])
        values[arguments.kwarg.arg] = ast.copy_location(items, rest[0] if rest else call)
    if arguments.vararg is not None:
        others = call.args[len(plain) :]
        values[arguments.vararg.arg] = ast.copy_location(ast.Tuple(others, ast.Load()), others[0] if others else call)
    fits = arguments.vararg is not None or len(call.args) <= len(plain)
    return values if fits and all(name in values for name in named) else None
