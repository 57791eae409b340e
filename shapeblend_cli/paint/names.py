"""Names of shapes, groups and pages in a blend: those on which both drawings agree, or which only one has."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.model import Group, Length, Name, Page, Pair, ShapeBlend

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.model import Box, Drawing

SAME_SCALE = 1e-3
"""Maximum difference of sizes that are the same, as a share."""


def common_page(pages: Sequence[Page]) -> Page:
    """Return the page for a blend, with a size only if all agree on it for the same part of the plane."""
    name = Name.common([page.name for page in pages])
    heading = " to ".join(page.heading for page in pages)
    sized = [page for page in pages if page.box is not None]
    if not sized:
        return Page(name=name, heading=heading)
    box = sized[0].box
    assert box is not None, "it is sized"
    alike = [page_for(page, box) for page in sized]
    width, height = (
        _common_length([page.width for page in alike]),
        _common_length([page.height for page in alike]),
    )
    # Where a page has no size, what fills it has its shape.
    fits = {page.fit for page in sized if page.width is not None and page.height is not None}
    fit = fits.pop() if len(fits) == 1 and width is not None and height is not None else ""
    return Page(width, height, box, name, fit, heading)


def page_for(page: Page, view: Box) -> Page:
    """Return a page that shows another part of the plane at the same scale."""
    if page.box is None:
        return page._replace(box=view)
    width, height = page.width, page.height
    if width is not None and width.unit != "%":
        width = width._replace(number=width.number * view.width / page.box.width)
    if height is not None and height.unit != "%":
        height = height._replace(number=height.number * view.height / page.box.height)
    return page._replace(width=width, height=height, box=view)


def _common_length(lengths: Sequence[Length | None]) -> Length | None:
    found = [length for length in lengths if length is not None]
    if not found or len({length.unit for length in found}) > 1:
        return None
    first = found[0]
    is_same = all(abs(first.number - other.number) <= SAME_SCALE * first.number for other in found)
    return first if is_same else None


def with_names(pairs: Sequence[Pair], drawings: Sequence[Drawing]) -> list[Pair]:
    """Return pairs whose shapes have names and groups; the numbers of groups are common to all pairs of a sequence."""
    named = []
    numbers = {group.number: group.number for shape in drawings[0].shapes for group in shape.groups}
    numbers_of = {0: numbers}
    following = max(numbers, default=0) + 1
    for pair in pairs:
        a, b = drawings[pair.a], drawings[pair.b]
        numbers = numbers_of[pair.a]
        partners = _partners(pair.shapes, a, b)
        partner_of_b = {other: one for one, other in partners.items()}
        numbers_b: dict[int, int] = {}
        for number in sorted({group.number for shape in b.shapes for group in shape.groups}):
            if number in partner_of_b:
                numbers_b[number] = numbers[partner_of_b[number]]
            else:
                numbers_b[number] = following
                following += 1
        merged = _Merged(partners, numbers, numbers_b)
        named.append(pair._replace(shapes=tuple(_named(shape, a, b, merged) for shape in pair.shapes)))
        numbers_of[pair.b] = numbers_b
    return named


def _named(shape: ShapeBlend, a: Drawing, b: Drawing, merged: _Merged) -> ShapeBlend:
    """Return a shape with the names and the groups of its shapes in both drawings."""
    i, j = shape.sources
    one, other = (None if k is None else drawing.shapes[k] for drawing, k in ((a, i), (b, j)))
    return shape._replace(
        names=tuple(side.name for side in (one, other) if side is not None),
        groups=merged.groups(one.groups if one else None, other.groups if other else None),
    )


def common_groups(a: Sequence[Group], b: Sequence[Group]) -> tuple[Group, ...]:
    """Return the groups around a shape that continues in the next pair: common groups, or the groups of one pair."""
    if not (a and b):
        return (*a, *b)
    others = {group.number: group for group in b}
    return tuple(
        group._replace(name=Name.common([group.name, others[group.number].name]))
        for group in a
        if group.number in others
    )


class _Merged(NamedTuple):
    """Groups of two drawings that are one in a blend."""

    partners: Mapping[int, int]  # numbers of B's groups by numbers of A's
    numbers_a: Mapping[int, int]  # in the blend, by numbers in A
    numbers_b: Mapping[int, int]  # in the blend, by numbers in B

    def groups(self, a: Sequence[Group] | None, b: Sequence[Group] | None) -> tuple[Group, ...]:
        """Return the groups around a shape, given its groups in A and in B; None if it is not in that drawing.

        Groups that each drawing alone has at the same place contradict each other, and none stays.
        """
        alone_a = [group._replace(number=self.numbers_a[group.number]) for group in a or ()]
        alone_b = [group._replace(number=self.numbers_b[group.number]) for group in b or ()]
        if a is None or b is None:
            return tuple(alone_b if a is None else alone_a)
        merged: list[Group] = []
        waiting: list[Group] = []  # groups of A that have no partner
        next_b = 0
        others = {group.number: k for k, group in enumerate(b)}
        for group, renumbered in zip(a, alone_a, strict=True):
            partner = self.partners.get(group.number)
            if partner is None:
                waiting.append(renumbered)
                continue
            at = others.get(partner, -1)
            if at < next_b:
                continue
            merged += self._between(waiting, alone_b[next_b:at], b[next_b:at])
            name = Name.common([group.name, b[at].name])
            merged.append(Group(renumbered.number, name, group.is_layer or b[at].is_layer))
            waiting, next_b = [], at + 1
        return (*merged, *self._between(waiting, alone_b[next_b:], b[next_b:]))

    def _between(self, a: list[Group], b: list[Group], drawn_b: Sequence[Group]) -> list[Group]:
        """Return the groups at one place that stay, given groups that only A has, and groups of B."""
        own_b = [
            group
            for group, drawn in zip(b, drawn_b, strict=True)
            if drawn.number not in self.partners.values()
        ]
        return [] if a and own_b else a or own_b


def _partners(shapes: Sequence[ShapeBlend], a: Drawing, b: Drawing) -> dict[int, int]:
    """Return the groups of B by groups of A: groups with the same id or label, or with the same shapes in them."""
    groups_a, groups_b = (
        {group.number: group for shape in drawing.shapes for group in shape.groups} for drawing in (a, b)
    )
    partners: dict[int, int] = {}
    for key in ("id", "label"):
        known_a, known_b = (_by_name(groups, key) for groups in (groups_a, groups_b))
        for name, number in known_a.items():
            other = known_b.get(name)
            if other is not None and number not in partners and other not in partners.values():
                partners[number] = other
    members_a: dict[int, set[int]] = {}
    members_b: dict[int, set[int]] = {}
    both = [shape for shape in shapes if None not in shape.sources]
    for k, shape in enumerate(both):
        i, j = shape.sources
        for members, drawing, index in ((members_a, a, i), (members_b, b, j)):
            for group in drawing.shapes[index].groups if index is not None else ():
                members.setdefault(group.number, set()).add(k)
    taken = set(partners.values())
    for number, inside in members_a.items():
        if number in partners:
            continue
        for other, inside_b in members_b.items():
            if other not in taken and inside == inside_b:
                partners[number] = other
                taken.add(other)
                break
    return partners


def _by_name(groups: Mapping[int, Group], key: str) -> dict[str, int]:
    """Return the numbers of groups by their ids or labels, as far as these are unique."""
    names = {number: getattr(group.name, key) for number, group in groups.items()}
    counts = Counter(names.values())
    return {name: number for number, name in names.items() if name is not None and counts[name] == 1}
