"""Style sheets, by tinycss2 and cssselect2; imported only when a file needs them.

Matching a selector can take exponential time (``g g g g path`` in a deep tree), so every element looked at is paid for
from a budget.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any

import cssselect2
import tinycss2

from shapeblend_cli.svg.styles.declarations import Declarations, add, parse
from shapeblend_cli.svg.xml.messages import Problem
from shapeblend_cli.svg.xml.xmltree import Node

_MAX_TEXT = 500_000
_BUDGET = 4_000_000
_NEW = 3  # cost of an element that is made, not only looked at
_MAX_SELECTOR = 2_000
_MAX_CLASSES = 10_000

_LIGHT = "(prefers-color-scheme: light)"

MEDIA = frozenset(
    ("", "all", "screen", "only screen", _LIGHT, f"screen and {_LIGHT}", f"{_LIGHT} and screen")
)
"""Media of which rules count: a screen, and one that is light."""

UNREADABLE = (
    cssselect2.SelectorError,
    NotImplementedError,
    ValueError,
    SyntaxError,
    MemoryError,
    RecursionError,
    # cssselect2 stumbles over ':nth-child(2n+)'.
    AttributeError,
    TypeError,
)
"""Errors of cssselect2 on texts that are no selectors, or unknown selectors."""


def match(root: Node, texts: list[str]) -> dict[int, tuple[Declarations, Declarations]]:
    """Return the normal and the important declarations of each element that a rule selects, by the node's identity.

    A Problem is raised if the sheets, in document order, are too long or take too long to match.
    """
    budget = Budget("its style sheet takes too long to match; without it the file would work")
    matcher = cssselect2.Matcher()
    declared = {}
    try:
        rules = list(_rules(texts))
        for rule in rules:
            matcher.add_selector(*rule)
        # Each selector is tried on the elements of its class, id or type: those without one, on all.
        matcher.add_relevant_selectors = _paid(matcher.add_relevant_selectors, budget)
        for element in elements(root, budget) if rules else ():
            normal: Declarations = {}
            important: Declarations = {}
            matches = matcher.match(element)
            budget.pay(4 * len(matches))
            for _, _, pseudo_element, payload in matches:
                if pseudo_element is None:
                    add(normal, payload[0])
                    add(important, payload[1])
            if normal or important:
                declared[id(element.etree_element)] = (normal, important)
    except RecursionError:
        raise Problem("its style sheet is nested too deeply; without it the file would work") from None
    return declared


def _rules(texts: list[str]) -> Iterator[tuple[Any, tuple[Declarations, Declarations]]]:
    """Yield the selectors of all sheets, each with its declarations, in order."""
    sheet = _without_fonts("\n".join(texts))
    if len(sheet) > _MAX_TEXT:
        raise Problem(f"a style sheet longer than {_MAX_TEXT} characters, the limit")
    waiting = tinycss2.parse_stylesheet(sheet, skip_comments=True, skip_whitespace=True)[::-1]
    while waiting:
        rule = waiting.pop()
        if rule.type == "at-rule" and rule.lower_at_keyword == "media" and rule.content is not None:
            if medium(tinycss2.serialize(rule.prelude)) in MEDIA:
                inner = tinycss2.parse_rule_list(rule.content, skip_comments=True, skip_whitespace=True)
                waiting += inner[::-1]
        elif rule.type == "qualified-rule":
            declarations = parse(rule.content)
            yield from ((selector, declarations) for selector in _selectors(rule.prelude))


def medium(text: str) -> str:
    """Return a medium as `MEDIA` writes it."""
    return (
        " ".join(text.lower().replace(":", ": ").split())
        .replace("( ", "(")
        .replace(" :", ":")
        .replace(" )", ")")
    )


def _without_fonts(sheet: str) -> str:
    """Return `sheet` without ``@font-face`` rules: embedded fonts can be most of a file."""
    first, *rest = sheet.split("@font-face")
    # A rule ends at its closing brace; without one, all of the text remains.
    return first + "".join(text[text.find("}") + 1 :] for text in rest)


def _selectors(prelude: list[Any]) -> list[Any]:
    """Return a rule's selectors; none when one of them cannot be read, as in browsers."""
    if len(prelude) > _MAX_SELECTOR:
        return []
    try:
        return compile_selectors(prelude)
    except RecursionError:
        raise
    except UNREADABLE:
        return []


def compile_selectors(source: object) -> list[Any]:
    """Return the selectors in `source`, text or tokens; raise one of `UNREADABLE` if they cannot be read."""
    return list(cssselect2.compile_selector_list(source))


class Budget:
    """How many more elements may be looked at before a problem is raised."""

    def __init__(self, problem: str) -> None:
        self._left = _BUDGET
        self._problem = problem

    def pay(self, count: int) -> None:
        """Subtract `count`; raise the problem if that is more than is left."""
        self._left -= count
        if self._left < 0:
            raise Problem(self._problem)


def _paid(add: Callable[..., None], budget: Budget) -> Callable[..., None]:
    def paid(element: object, selectors: list[object], relevant: list[object]) -> None:
        budget.pay(len(selectors))
        add(element, selectors, relevant)

    return paid


class _Element(cssselect2.ElementWrapper):  # type: ignore[misc]
    """A node as cssselect2 sees it. Its own wrapper recurses over ancestors and siblings and keeps all siblings."""

    def __init__(self, node: Node, parent: _Element | None, index: int, budget: Budget) -> None:
        budget.pay(_NEW)
        self.etree_element = node
        self.parent = parent
        self.index = index
        self.in_html_document = False
        self.transport_content_language = None
        self.local_name = node.tag
        self.namespace_url = ""
        self.etree_children = node.children
        self._budget = budget

    @property
    def etree_siblings(self) -> list[Node]:
        siblings = [self.etree_element] if self.parent is None else self.parent.etree_children
        self._budget.pay(len(siblings))
        return siblings

    @cached_property
    def classes(self) -> set[str]:
        text = self.etree_element.get("class")
        return set(text[:_MAX_CLASSES].split()) if text else set()

    @property
    def previous(self) -> _Element | None:
        if self.parent is None or self.index == 0:
            return None
        before = self.index - 1
        return _Element(self.parent.etree_children[before], self.parent, before, self._budget)

    @property
    def ancestors(self) -> Iterator[_Element]:
        element = self.parent
        while element is not None:
            self._budget.pay(1)
            yield element
            element = element.parent

    @property
    def previous_siblings(self) -> Iterator[_Element]:
        element = self.previous
        while element is not None:
            yield element
            element = element.previous

    def iter_children(self) -> Iterator[_Element]:
        for index, node in enumerate(self.etree_element.children):
            yield _Element(node, self, index, self._budget)


def elements(root: Node, budget: Budget) -> Iterator[_Element]:
    """Yield the element of `root` and of each node below it, in document order."""
    first = _Element(root, None, 0, budget)
    yield first
    stack = [first.iter_children()]
    while stack:
        element = next(stack[-1], None)
        if element is None:
            stack.pop()
        else:
            yield element
            stack.append(element.iter_children())
