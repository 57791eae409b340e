"""Which ends of blends `tools/ends.py` takes for their files."""

import pytest

from tests.support.commands import write
from tests.support.drawings import svg
from tools.ends import measured, page_in, table

RECT = '<path d="M3.3 4.2H20V19H3.3Z" fill="#c02020"/>'
FILES = {
    "rect": (svg(RECT), True),
    "unsized": (svg(RECT).replace('viewBox="0 0 24 24"', 'width="24" height="20"'), True),
    # A group that its own filter shows is not drawn in it.
    "flooded": (
        svg(f'<filter id="f"><feImage href="#r"/></filter><g filter="url(#f)" id="r">{RECT}</g>'),
        False,
    ),
    "boundless": (svg(RECT).replace('viewBox="0 0 24 24"', ""), False),
    "empty": (svg(""), False),
}


@pytest.mark.parametrize("is_moving", [False, True])
def test_files_that_differ_from_their_ends_are_found_and_drawn(browser, here, is_moving):
    write(**{name: text for name, (text, _) in FILES.items()})
    page = page_in(browser)
    found = [measured(page, here / f"{name}.svg", here, is_moving=is_moving) for name in FILES]
    page.close()
    assert {one.name: one.is_within for one in found} == {name: good for name, (_, good) in FILES.items()}
    assert [one.name for one in found if one.share is None] == ["boundless", "empty"]
    assert [path.stem for path in here.glob("*.png")] == ["flooded"]
    *bad, last = table(found)
    assert [line.split()[0] for line in bad][:2] == ["-", "-"]
    assert last == "2 of 5 files differ in at most 0.5 % of the pixels"
