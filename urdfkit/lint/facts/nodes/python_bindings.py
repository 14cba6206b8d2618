"""Values that functions and loops of a Python launch file pass to the calls inside them.

Functions that consist of assignments and a ``return`` are written out in the tree already (`python_inlining`).
"""

import ast
from functools import lru_cache

from urdfkit.description.launch.python_constants import assignments, launch_reader

Binding = dict[str, ast.expr]
"""Name of a parameter or loop variable → the expression that it stands for."""

_LOOPS = (ast.ListComp, ast.SetComp, ast.GeneratorExp, ast.For)
_MAX_BINDINGS = 100
"""Maximum number of bindings of one call."""


@lru_cache(maxsize=200)
def _scopes(tree: ast.Module) -> tuple[dict[ast.AST, tuple[ast.AST, ...]], dict[str, list[ast.Call]]]:
    """Return the functions and loops around each call and f-string, and the calls of each name."""
    around: dict[ast.AST, tuple[ast.AST, ...]] = {}
    calls: dict[str, list[ast.Call]] = {}
    waiting: list[tuple[ast.AST, tuple[ast.AST, ...]]] = [(tree, ())]
    while waiting:
        node, scopes = waiting.pop()
        if isinstance(node, (ast.Call, ast.JoinedStr)):
            around[node] = scopes
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            calls.setdefault(node.func.id, []).append(node)
        inner = (*scopes, node) if isinstance(node, (*_LOOPS, ast.FunctionDef)) and len(scopes) < 8 else scopes
        waiting += [(child, inner) for child in ast.iter_child_nodes(node)]
    return around, calls


def bindings(tree: ast.Module, call: ast.expr) -> list[Binding]:
    """Return the expressions that the names in a call stand for, one binding for each run of the call.

    Args:
        tree: syntax tree of the launch file.
        call: a call or an f-string in it.

    Returns:
        One binding, which may be empty, if no function with constant arguments and no loop over a literal list is
        around the call.
    """
    around, calls = _scopes(tree)
    found: list[Binding] = [{}]
    for scope in around.get(call, ()):
        each = _of_function(scope, calls) if isinstance(scope, ast.FunctionDef) else _of_loop(scope, tree)
        if each and len(each) * len(found) <= _MAX_BINDINGS:
            found = [{**outer, **inner} for outer in found for inner in each]
    return found


def resolved(node: ast.expr | None, binding: Binding) -> ast.expr | None:
    """Return the expression that a name stands for; other expressions as they are."""
    for _ in range(4):
        if not isinstance(node, ast.Name) or node.id not in binding or binding[node.id] is node:
            break
        node = binding[node.id]
    return node


def arguments_of(function: ast.FunctionDef, call: ast.Call) -> Binding | None:
    """Return the arguments that a call passes, by parameter; None if some of them are computed."""
    names = [each.arg for each in (*function.args.posonlyargs, *function.args.args)]
    if any(isinstance(each, ast.Starred) for each in call.args) or any(word.arg is None for word in call.keywords):
        return None
    passed = dict(zip(names, call.args, strict=False))
    passed.update({word.arg: word.value for word in call.keywords if word.arg is not None})
    return passed


def miscalled(tree: ast.Module) -> list[tuple[ast.Call, str]]:
    """Return the calls of the file's own functions that lack an argument or pass an unknown one, with messages."""
    functions: dict[str, list[ast.FunctionDef]] = {}
    methods = {inner for node in ast.walk(tree) if isinstance(node, ast.ClassDef) for inner in ast.walk(node)}
    stored = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and node not in methods:
            functions.setdefault(node.name, []).append(node)
    found = []
    for name, calls in _scopes(tree)[1].items():
        own = functions.get(name, [])
        if len(own) != 1 or name in stored or own[0].decorator_list:
            continue
        parts = own[0].args
        names = [each.arg for each in (*parts.posonlyargs, *parts.args)]
        required = names[: len(names) - len(parts.defaults)]
        required += [each.arg for each, value in zip(parts.kwonlyargs, parts.kw_defaults, strict=True) if value is None]
        accepted = {*names, *(each.arg for each in parts.kwonlyargs)}
        for call in calls:
            passed = arguments_of(own[0], call)
            if passed is None:
                continue
            lacking = [each for each in required if each not in passed]
            unknown = [each for each in passed if each not in accepted and parts.kwarg is None]
            if unknown:
                found.append((call, f"`{name}` has no argument `{unknown[0]}`"))
            elif lacking:
                found.append((call, f"`{name}` needs the argument `{lacking[0]}`"))
            elif parts.vararg is None and len(call.args) > len(names):
                found.append((call, f"`{name}` is called with {len(call.args)} arguments, but accepts {len(names)}"))
    return found


def _of_function(function: ast.FunctionDef, calls: dict[str, list[ast.Call]]) -> list[Binding]:
    parts = function.args
    names = [each.arg for each in (*parts.posonlyargs, *parts.args)]
    defaults = dict(zip(reversed(names), reversed(parts.defaults), strict=False))
    pairs = zip(parts.kwonlyargs, parts.kw_defaults, strict=True)
    defaults.update({each.arg: value for each, value in pairs if value is not None})
    passed = [arguments_of(function, call) for call in calls.get(function.name, ())] if names else []
    return [{**defaults, **each} for each in passed if each is not None] if None not in passed else []


def _of_loop(loop: ast.AST, tree: ast.Module) -> list[Binding]:
    assert isinstance(loop, _LOOPS)
    if isinstance(loop, ast.For):
        target, source = loop.target, loop.iter
    elif len(loop.generators) == 1 and not loop.generators[0].ifs:
        target, source = loop.generators[0].target, loop.generators[0].iter
    else:
        return []
    values = launch_reader(tree).assigned.get(source.id) if isinstance(source, ast.Name) else source
    if isinstance(values, ast.Call) and isinstance(values.func, ast.Attribute) and values.func.attr == "items":
        values = values.func.value
        values = launch_reader(tree).assigned.get(values.id) if isinstance(values, ast.Name) else values
        pairs = zip(values.keys, values.values, strict=True) if isinstance(values, ast.Dict) else ()
        items: list[ast.expr] = [ast.Tuple([key, value], ast.Load()) for key, value in pairs if key is not None]
    else:
        items = values.elts if isinstance(values, (ast.List, ast.Tuple)) else []
    if isinstance(target, ast.Name):
        return [{target.id: item} for item in items]
    names = [each.id for each in ast.walk(target) if isinstance(each, ast.Name)]
    found = [{name.id: value for name, value in assignments(target, item)} for item in items]
    return [each for each in found if len(each) == len(names)]
