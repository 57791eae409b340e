"""Draw the pictures of docs/paper.md by the commands in it: python -m tools.paper_pictures, no arguments.

The page says it all: below each picture stands the command that draws it. They are run here as they stand there.
"""

from __future__ import annotations

import re
import shlex
from contextlib import chdir, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.cli import run
from tools.readme_pictures import DOCS, ROOT

if TYPE_CHECKING:
    from collections.abc import Iterator

PAGE = DOCS / "paper.md"

SHOWN = re.compile(r"^!\[[^\]]+\]\(([^)]+)\)\n\n```sh\nshapeblend ([^`]+)\n```$", re.MULTILINE)
"""A picture, and the command below it."""


class Shown(NamedTuple):
    """A picture of the page."""

    file: Path
    words: tuple[str, ...]

    @property
    def is_plot(self) -> bool:
        """Whether it is a plot, and no row of in-betweens."""
        return self.words[0] == "plot"


def shown() -> dict[str, Shown]:
    """Return the pictures of the page by the names that their commands give them."""
    found = {}
    for link, line in SHOWN.findall(PAGE.read_text(encoding="utf-8")):
        words = tuple(shlex.split(line.replace("\\\n", "")))
        name = words[words.index("-o") + 1]
        if Path(link).name != name:
            raise SystemExit(f"{PAGE.name}: {link} is not what the command below it writes, {name}")
        found[name] = Shown(DOCS / link, words)
    return found


@contextmanager
def beside_samples() -> Iterator[Path]:
    """Work in an empty folder in which samples are where the page has them."""
    with TemporaryDirectory() as folder, chdir(folder):
        Path("samples").symlink_to(ROOT / "samples")
        yield Path(folder)


def draw(name: str, *more: str) -> bytes:
    """Run the command of a picture, with more options if any, and return what it draws."""
    with beside_samples() as folder:
        if run([*shown()[name].words, "--force", *more]) != 0:
            raise SystemExit(f"{name} was not drawn")
        return (folder / name).read_bytes()


def main() -> None:
    for name, picture in shown().items():
        picture.file.parent.mkdir(exist_ok=True)
        picture.file.write_bytes(draw(name))
        print(picture.file.relative_to(ROOT))


if __name__ == "__main__":
    main()
