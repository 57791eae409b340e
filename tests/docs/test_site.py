"""The site of the documents is built without a network, and has every page."""

import json
import tomllib

import pytest

from tools import site


def test_every_page_is_in_the_navigation_and_every_link_within_the_site_leads_somewhere(tmp_path):
    navigation = tomllib.loads(site.CONFIGURATION.read_text("utf-8"))["project"]["nav"]
    told = [name for section in navigation for names in section.values() for name in names]
    assert sorted(told) == sorted(
        [*(page.name for page in site.DOCS.glob("*.md")), *site.ROOT_PAGES.values()]
    )
    built = site.build(tmp_path)
    assert all((built / name).with_suffix(".html").is_file() for name in told)


SOUGHT = "pause loop easing icon hover gif after+effects figma react vue svelte spring duration delay white flubber"


@pytest.fixture(scope="module")
def index(tmp_path_factory):
    """What the search of the site looks through: the title and the text of each section."""
    return json.loads((site.build(tmp_path_factory.mktemp("site")) / "search.json").read_text("utf-8"))[
        "items"
    ]


@pytest.mark.parametrize("word", SOUGHT.split())
def test_what_people_look_for_is_found_and_on_the_first_page_of_the_guide(index, word):
    words = word.replace("+", " ")
    found = [one["location"] for one in index if words in f"{one['title']} {one['text']}".lower()]
    assert len(found) > 1
    assert any(location.startswith("guide.html") for location in found)


def test_a_link_that_leads_nowhere_ends_it(tmp_path, monkeypatch):
    monkeypatch.setattr(site, "DOCS", tmp_path / "docs")
    site.shutil.copytree(site.ROOT / "docs", site.DOCS)
    (site.DOCS / "glossary.md").write_text("[x](options.md#nothing)", "utf-8")
    with pytest.raises(SystemExit):
        site.build(tmp_path / "site")
