"""How constants are described: one docstring each, which names a quantity first."""

import ast
import re

from tests.test_architecture import assert_none, trees

BEGINNINGS = re.compile(r"(What|So|By|Of|How|From)\b")
POSITIONS = re.compile(r"\bthe (first|second)\b")


def described(tree):
    """Yield the assignments of a module that a docstring follows, each with that and the statement before it."""
    body = [None, *tree.body]
    for before, node, after in zip(body, body[1:], body[2:], strict=False):
        text = after.value if isinstance(after, ast.Expr) else None
        if isinstance(node, ast.Assign | ast.AnnAssign) and isinstance(text, ast.Constant):
            yield before, node, text.value


def is_tuple(node):
    """Return whether several constants get their values, and no name for all of them: `STEPS = EAST, SOUTH = 0, 1`."""
    return isinstance(node, ast.Assign) and not any(isinstance(target, ast.Name) for target in node.targets)


def faults():
    for module, tree in trees().items():
        for before, node, text in described(tree):
            where = f"{module}:{node.lineno}"
            if BEGINNINGS.match(text):
                yield f"{where} begins with {text.split()[0]}"
            if found := POSITIONS.search(text):
                yield f"{where} says {found[0]}"
            is_shared = (
                isinstance(before, ast.Assign | ast.AnnAssign) and before.end_lineno == node.lineno - 1
            )
            if is_tuple(node) or is_shared:
                yield f"{where} describes several constants"


def test_every_constant_is_described_by_itself():
    assert_none(set(faults()), "one constant, one docstring: Maximum NOUN, in UNIT. Then why")
