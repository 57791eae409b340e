"""Write docs/api.md, the reference of the Python API, from its docstrings: python -m tools.api_reference."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import shapeblend_cli as sb

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "api.md"

HEAD = """# The Python API

Written by `make api`, from the docstrings, whose examples are run as tests. All names are those of `shapeblend_cli`:

```python
import shapeblend_cli as sb
```

Errors that a user can put right are `sb.ShapeblendError`s of one line. Most of them, and all that say a value is wrong,
are `ValueError`s too.
"""

ORDER = (
    "read",
    "blend",
    "Blend",
    "Picture",
    "match",
    "Correspondence",
    "Settings",
    "OutputOptions",
    "Drawing",
)


def page() -> str:
    """The reference as Markdown."""
    parts = [HEAD]
    for name in ORDER:
        value = getattr(sb, name)
        parts.append(f"## {name}\n\n{described(value, name)}")
        parts += [f"### {name}.{member}\n\n{described(method, member)}" for member, method in methods(value)]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def methods(value: object) -> Iterator[tuple[str, object]]:
    """The public methods that a class of the API itself defines."""
    if inspect.isclass(value) and value.__module__ == "shapeblend_cli.api":
        for name, member in vars(value).items():
            if inspect.isfunction(member) and not name.startswith("_"):
                yield name, member


def described(value: object, name: str) -> str:
    """The signature of a function, and a docstring with its sections as Markdown."""
    text = "" if inspect.isclass(value) else f"```python\n{name}{signature(value)}\n```\n\n"
    summary, *sections = re.split(r"\n\n(\w+)\n-+\n", inspect.getdoc(value) or "")
    text += summary
    for title, body in zip(sections[::2], sections[1::2], strict=True):
        text += f"\n\n**{title}**\n\n{example(body) if title == 'Examples' else entries(body)}"
    return text


def signature(value: object) -> str:
    """A signature as it is written, without `self`."""
    found = inspect.signature(value)
    parameters = [p for p in found.parameters.values() if p.name != "self"]
    return str(found.replace(parameters=parameters)).replace("'", "")


def entries(body: str) -> str:
    """Named values with their types and meanings as a list; other text as it is."""
    found = re.split(r"^(?=\S)", body, flags=re.MULTILINE)[1:]
    lines = []
    for entry in found:
        head, _, meaning = entry.strip().partition("\n")
        name, colon, kind = head.partition(" : ")
        meaning = " ".join(meaning.split())
        lines.append(f"- `{name}`" + f": {kind}" * bool(colon) + f". {meaning}" * bool(meaning))
    return "\n".join(lines)


def example(body: str) -> str:
    """Sessions as code, and what is said between them as text."""
    blocks = re.split(r"\n\n+", body.strip())
    return "\n\n".join(f"```pycon\n{b}\n```" if b.startswith(">>>") else b for b in blocks)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    sys.stdout.write(f"{PAGE.relative_to(ROOT)}\n")
