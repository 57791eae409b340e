"""What a release is made of, as far as that can be seen without making one."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

import shapeblend_cli

ROOT = Path(__file__).parents[2]
RELEASE = yaml.safe_load((ROOT / ".github/workflows/release.yml").read_text("utf-8"))
JOBS = RELEASE["jobs"]
FORMS = sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml"))


def test_only_the_job_that_publishes_may_do_more_than_read_and_it_has_no_password():
    assert RELEASE["permissions"] == {"contents": "read"}
    assert [name for name, job in JOBS.items() if "permissions" in job] == ["publish"]
    rights = JOBS["publish"]["permissions"]
    assert rights == {"contents": "read", "id-token": "write", "attestations": "write"}
    assert "secrets." not in (ROOT / ".github/workflows/release.yml").read_text("utf-8")
    assert JOBS["publish"]["environment"] == "pypi"


def test_nothing_is_published_that_was_not_checked_nor_without_a_tag():
    assert JOBS["publish"]["needs"] == "check"
    assert set(JOBS["check"]["needs"]) == set(JOBS) - {"check", "publish"}
    assert JOBS["publish"]["if"] == "github.ref_type == 'tag'"


def test_files_are_attested_before_they_are_published():
    uses = [step.get("uses", "") for step in JOBS["publish"]["steps"]]
    names = [use.partition("@")[0] for use in uses]
    attest, publish = "actions/attest", "pypa/gh-action-pypi-publish"
    assert names.index(attest) < names.index(publish)


def test_actions_are_named_by_commit_but_for_that_of_pypi():
    uses = [step["uses"] for job in JOBS.values() for step in job["steps"] if "uses" in step]
    loose = {use for use in uses if not re.search(r"@[0-9a-f]{40}$", use)}
    assert loose == {"pypa/gh-action-pypi-publish@release/v1"}


def test_wheels_are_built_for_every_system_of_which_one_is_checked():
    built = " ".join(each["what"] for each in JOBS["wheels"]["strategy"]["matrix"]["include"])
    for system in ("linux-x86_64", "linux-aarch64", "macos-arm64", "macos-x86_64", "windows-amd64"):
        assert system in built
    table = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    wheel = table["tool"]["cibuildwheel"]
    assert wheel["environment"] == {"SHAPEBLEND_ABI3": "1"}
    lowest = re.search(r"3\.(\d+)", table["project"]["requires-python"])[1]
    assert wheel["build"].split()[0] == f"cp3{lowest}-*"


def test_the_changelog_has_this_version_first_and_its_day():
    (first, *_) = re.findall(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    assert re.fullmatch(rf"{re.escape(shapeblend_cli.__version__)} - \d{{4}}-\d\d-\d\d|Unreleased", first)


def test_what_is_cited_is_this_version():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert cited["version"] == shapeblend_cli.__version__
    assert (cited["title"], cited["license"]) == ("shapeblend", "MIT")
    (paper,) = cited["references"]
    assert paper["title"] == "A Physically Based Approach to 2-D Shape Blending"


@pytest.mark.parametrize("form", [form for form in FORMS if form.name != "config.yml"], ids=lambda f: f.stem)
def test_forms_of_issues_are_forms(form):
    found = yaml.safe_load(form.read_text("utf-8"))
    assert {"name", "description", "body"} <= set(found)
    fields = [each for each in found["body"] if each["type"] != "markdown"]
    assert {each["type"] for each in fields} <= {"textarea", "input", "dropdown", "checkboxes"}
    ids = [each["id"] for each in fields]
    assert len(set(ids)) == len(ids)
    assert all(each["attributes"]["label"] for each in fields)
