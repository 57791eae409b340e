"""The elements of a document that a selector matches, and messages for selectors that match or paint nothing.

A text that begins with ``#`` is first taken for an id, whatever its characters: editors write ``layer 1`` and ``1st``,
which no CSS selector can spell without escapes. Numbers are those of shapes, as `shapeblend inspect` lists them.
Anything else, and an id that does not exist, is a CSS selector.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from shapeblend_cli.svg.xml.messages import Notes, Problem, printable
from shapeblend_cli.svg.xml.xmltree import GROUPS, LEFT_OUT, SHAPES, Node, Tree

_MAX_SELECTOR = 2_000
_MAX_SUGGESTED, _MAX_LISTED = 3, 5
_MAX_COMPARED = 2_000
_MAX_WORD = 100
_MAX_WORDS = 8
# Parts of a selector that are neither a type nor a class nor an id.
_OTHER_PARTS = r"""\[[^\]]*+\]|"[^"]*+"|'[^']*+'|::?[\w-]++"""
_WORD = r"[#.]?[\w-]++"


class SelectorError(ValueError):
    """A text that is no selector; the message says what would work."""


def check_selector(text: str) -> None:
    """Raise a SelectorError if `text` cannot be a selector, as far as that can be told without a file."""
    if not _is_id(text) and shape_numbers(text) is None:
        _compile(text)


def shape_numbers(text: str) -> list[int] | None:
    """Return the numbers of shapes in a selector such as ``0`` or ``0,2``; None for any other one."""
    is_numbers = re.fullmatch(r"[0-9]{1,9}( *, *[0-9]{1,9})*", text.strip())
    return [int(number) for number in text.split(",")] if is_numbers else None


def select(root: Node, text: str, note: Callable[[str], None] = lambda text: None) -> list[Node]:
    """Return the elements that a selector matches, in document order.

    A Problem is raised if there is none, or matching takes too long. A `note` says that the document itself is one of
    them, which few selectors mean.
    """
    nodes = []
    if _is_id(text):
        nodes = [node for node in root.walk() if node.get("id") == text[1:]]
    if not nodes:
        try:
            nodes = _match(root, text, _compile(text))
        except SelectorError as error:
            if not _is_id(text):
                raise Problem(str(error)) from None
    if not nodes:
        raise Problem(f"nothing in it matches '{printable(text, 60)}'; {_suggestion(root, text)}")
    if nodes[0] is root and text.strip() not in ("*", "svg", ":root"):
        note(f"all shapes are taken: '{printable(text, 60)}' matches the document itself")
    return nodes


def _is_id(text: str) -> bool:
    return text.startswith("#") and text != "#"


def _compile(text: str) -> list[Any]:
    """Return the tests of a CSS selector that an element can pass at all."""
    from shapeblend_cli.svg.styles import stylesheets

    if len(text) > _MAX_SELECTOR:
        raise SelectorError(f"a selector of more than {_MAX_SELECTOR} characters; a shorter one would work")
    try:
        compiled = stylesheets.compile_selectors(text)
    except stylesheets.UNREADABLE as error:
        raise SelectorError(
            f"'{printable(text)}' is no CSS selector ({_reason(error)}); '#id', '.class' or 'g > path' would work"
        ) from None
    return [one.test for one in compiled if one.pseudo_element is None and not one.never_matches]


def _reason(error: Exception) -> str:
    """Return where a selector breaks the grammar, or why it cannot be read."""
    if isinstance(error, (SyntaxError, MemoryError, RecursionError)):
        return "nested too deeply"
    if isinstance(error, NotImplementedError):
        return "a part of CSS that is not supported"
    # cssselect2 gives a token and what it expected there; no token is the end of the text.
    token = error.args[0] if error.args else ""
    if token is None:
        return "it ends too early"
    if hasattr(token, "source_column"):
        return f"at character {token.source_column}"
    return "an unknown pseudo-class" if "pseudo-class" in str(token) else "it cannot be read"


def _match(root: Node, text: str, tests: list[Any]) -> list[Node]:
    from shapeblend_cli.svg.styles import stylesheets

    if not tests:
        return []
    budget = stylesheets.Budget(
        f"the selector '{printable(text)}' takes too long to match; a simpler one would work"
    )
    nodes = []
    try:
        for element in stylesheets.elements(root, budget):
            budget.pay(len(tests))
            if any(test(element) for test in tests):
                nodes.append(element.etree_element)
    except RecursionError:
        raise Problem("its elements are nested too deeply for that selector; an id would work") from None
    return nodes


def paints_nothing(
    root: Node, text: str, nodes: Sequence[Node], reason: str | None, painted: Sequence[str]
) -> Problem:
    """Return the problem of a selector that matches `nodes` which paint nothing.

    The `reason` belongs to the first shape among them, if the walk reached it; the ids of `painted` shapes would work.
    """
    others = f" and {len(nodes) - 1} more" if len(nodes) > 1 else ""
    why = f"it is {reason}" if reason else _why(root, nodes[0])
    ids = _join(f"#{name}" for name in painted) if painted else ""
    advice = f"{ids} would work" if ids else "inspect lists what is painted"
    return Problem(
        f"'{printable(text, 60)}' is there ({nodes[0]}{others}) but paints nothing: {why}; {advice}"
    )


def no_shape(root: Node, skipped: Mapping[str, int], notes: Notes) -> Problem:
    """Return the error for a file that paints no shape, given the number of shapes skipped for each reason."""
    reasons = [f"{_shapes(count)} {reason}" for reason, count in skipped.items() if count]
    unseen = sum(node.tag in SHAPES for node in root.walk()) - sum(skipped.values())
    if unseen > 0:
        reasons.append(f"{_shapes(unseen)} in defs, symbols, clip paths or groups that are not displayed")
    reasons += notes.phrases()
    found = ", ".join(reasons) or "it has no shape elements"
    return Problem(f"no painted shape: {found}; a file with a filled or stroked path would work")


def _shapes(count: int) -> str:
    return "1 shape" if count == 1 else f"{count} shapes"


def _why(root: Node, node: Node) -> str:
    if node.tag in LEFT_OUT:
        return f"{node.tag} is not read"
    for outer in reversed(Tree(root).around(node)):
        if outer.tag not in GROUPS:
            return f"it stands in <{printable(outer.tag)}> and no use draws it"
    if node.tag == "use":
        return "what it refers to is not drawn"
    if node.tag in GROUPS:
        return "no shape stands in it"
    if node.tag in SHAPES:
        return "it is not drawn"
    return f"<{printable(node.tag)}> is no shape"


def _suggestion(root: Node, text: str) -> str:
    """Suggest names from the document that may have been meant; else list a few that are there."""
    names = _names(root)
    similar = _similar(text, names)
    if similar:
        return f"{_join(similar)} would"
    ids = [name for name in names if name.startswith("#")]
    if ids:
        more = f" and {len(ids) - _MAX_LISTED} more" if len(ids) > _MAX_LISTED else ""
        return f"its ids are {', '.join(printable(name) for name in ids[:_MAX_LISTED])}{more}"
    return f"it has no ids, but {_join(['0 (its first shape)', *names[: _MAX_SUGGESTED - 1]])} would"


def _names(root: Node) -> list[str]:
    """Return the ids, the classes and the types of elements that can be drawn, shapes before groups."""
    nodes = [node for node in root.walk() if node.tag in SHAPES or node.tag in GROUPS or node.tag == "symbol"]
    ids = [f"#{node.attrib['id']}" for node in nodes if node.get("id")]
    classes = [f".{word}" for node in nodes for word in (node.get("class") or "")[:_MAX_WORD].split()]
    types = sorted((node.tag for node in nodes), key=lambda tag: tag not in SHAPES)
    return list(dict.fromkeys([*ids, *classes, *types]))


def _similar(text: str, names: list[str]) -> list[str]:
    """Return the names most similar to those in a selector."""
    import difflib

    known = set(names)
    words = [text] if _is_id(text) else []
    words += [word for word in re.findall(_WORD, re.sub(_OTHER_PARTS, " ", text)) if word not in known]
    similar: dict[str, None] = {}
    for word in words[:_MAX_WORDS]:
        wanted = word[:_MAX_WORD].casefold()
        likely = [name for name in names if abs(len(name) - len(wanted)) <= 3 + len(wanted) // 4]
        # Comparing is slow and a file can have a hundred thousand ids: those that begin alike come first.
        likely.sort(key=lambda name: -_common_prefix(wanted, name.casefold()))
        folded = {
            name.casefold(): name for name in reversed(likely[:_MAX_COMPARED]) if len(name) <= _MAX_WORD
        }
        for name in difflib.get_close_matches(wanted, folded, n=_MAX_SUGGESTED, cutoff=0.65):
            similar[folded[name]] = None
        if similar and word is text:
            break
    return list(similar)[:_MAX_SUGGESTED]


def _common_prefix(a: str, b: str) -> int:
    """Return the number of characters in which two names begin alike."""
    return next((k for k, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), min(len(a), len(b)))


def _join(names: Iterable[str]) -> str:
    *others, last = (printable(name) for name in names)
    return f"{', '.join(others)} or {last}" if others else last
