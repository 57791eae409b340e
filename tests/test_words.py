"""How constants are described: one docstring each, which names a quantity first."""

import ast
import re

from tests.test_architecture import TREES, assert_none, room

NOT_YET = frozenset(("matching", "wires"))
"""Rooms whose constants are still described in other ways."""

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
    return isinstance(node, ast.Assign) and (len(node.targets) > 1 or isinstance(node.targets[0], ast.Tuple))


def faults():
    for module, tree in TREES.items():
        for before, node, text in described(tree):
            where = f"{room(module)}: {module}:{node.lineno}"
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
    by_room = {}
    for fault in faults():
        by_room.setdefault(fault.partition(":")[0], []).append(fault)
    assert_none(NOT_YET - by_room.keys(), "take these rooms off the list")
    wrong = {fault for name in by_room.keys() - NOT_YET for fault in by_room[name]}
    assert_none(wrong, "one constant, one docstring: Maximum NOUN, in UNIT. Then why")
