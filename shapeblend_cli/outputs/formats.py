"""A format, and an output in a format.

A format is chosen, and its options are checked, before anything heavy is imported: the functions of a format are known
by their names, and the modules of formats import numpy, svgwrite, Pillow and resvg_py only in the functions that need
them.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from os.path import join
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeVar, overload

from shapeblend_cli.options.easing import Ease

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from shapeblend_cli.model import Box, Frame, Page, PaintedShape, Pair
    from shapeblend_cli.options.easing import Knots, Timing
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.options.triggers import Trigger
    from shapeblend_cli.outputs.composed import Composed

STANDARD_OUTPUT = "-"

T = TypeVar("T")

TRANSPARENT, WHITE = "transparent", "#ffffff"

FASTEST = 50
"""Maximum rate of an animation, in pictures a second. Browsers slow faster animations down."""


class Rendered(NamedTuple):
    """The contents of an output, in the order of `OutputSpec.files`, and notes on properties that it cannot show."""

    contents: Sequence[str | bytes]
    notes: Sequence[str] = ()


class Format(NamedTuple):
    """A format that a blend can be written in.

    Functions are named as "module.function", in this package.
    """

    name: str
    help: str
    renderer: str
    emit: str = "frames"  # the value of --emit for it; frames leaves the choice to --output and --format
    suffix: str = ""  # of its file; empty if it is a folder
    files: Sequence[str] = ()  # names in its folder; empty if that has a file for each frame
    to_standard_output: bool = False  # whether it can be written there
    takes_sequences: bool = True  # whether it shows more than two drawings
    takes_times: bool = False  # whether it shows frames at any times
    takes_stagger: bool = False  # whether its shapes may start one after the other
    plays: bool = False  # whether it is an animation
    takes_triggers: bool = False  # whether it may wait for an event
    mixtures: Literal["none", "one", "several"] = "none"  # how many of --mix it shows
    takes_page_colour: bool = False  # whether what it shows may have the colour of a page around
    takes_text: bool = False  # whether text may stay text in it, if it waits for no event
    defaults: Mapping[str, str | int | None] = {}  # of the shared options that it takes
    motion: str = "auto"  # what the motion auto stands for
    checker: str = ""
    libraries: str = ""

    def render(self, spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
        """Return the contents of an output."""
        notes: Sequence[str] = ()
        has_pictures = any(shape.style_a.picture for pair in pairs for shape in pair.shapes)
        if has_pictures and not (self.takes_text and spec.trigger.is_load):
            from shapeblend_cli.frames.outlined import with_outlined_text

            pairs = [with_outlined_text(pair) for pair in pairs]
        if self.takes_page_colour:
            from shapeblend_cli.paint.page_colour import with_page_colour

            pairs, notes = with_page_colour(pairs, spec.settings.style)
        rendered: Rendered = named(self.renderer)(spec, pairs)
        return rendered._replace(notes=[*rendered.notes, *notes])

    def check(self, spec: OutputSpec) -> None:
        """Raise OptionError for options that it cannot be written with."""
        if self.checker:
            named(self.checker)(spec)

    def check_libraries(self) -> None:
        """Raise PictureError for missing libraries."""
        if self.libraries:
            named(self.libraries)()

    @property
    def has_frame_files(self) -> bool:
        """Whether it is a folder with a file for each frame."""
        return not (self.suffix or self.files)


def named(name: str) -> Callable[..., Any]:
    """Return a function of a format."""
    module, _, function = name.rpartition(".")
    found: Callable[..., Any] = getattr(import_module(f"{__package__}.{module}"), function)
    return found


class OutputSpec(NamedTuple):
    """An output with nothing left to choose; see `options.specify`.

    `options.OutputOptions` describes the fields after `timing`. A field is None if the format has no use for it.
    """

    format: Format
    path: str  # a folder, the name of a file, or "-"
    settings: Settings  # reads frames, ends, curves and style
    drawings: int
    timing: Timing
    animate: str
    trigger: Trigger
    precision: int | None
    width: int | None
    columns: int | None
    fps: int | None
    background: str | None
    lossless: bool = False
    watch: Callable[[str, float], None] = lambda stage, share: (
        None
    )  # takes the share of a stage that is done, 0 to 1

    def counted(self, items: Sequence[T], stage: str = "drawing") -> Iterator[T]:
        """Yield items, and say how many of them are drawn, or what else is done to them."""
        for k, item in enumerate(items):
            self.watch(stage, k / len(items))
            yield item

    @property
    def ground(self) -> str | None:
        """The colour behind pictures; None is transparent."""
        return None if self.background == TRANSPARENT else self.background

    def decided(self) -> dict[str, str | int | None]:
        """Return the options that the format has decided on, by name."""
        frame_format = self.format.name if self.format.has_frame_files else None
        shared = {name: getattr(self, name) for name in ("width", "columns", "background", "fps")}
        return {"output": self.path, "format": frame_format} | shared

    @property
    def frame_count(self) -> int:
        """How many frames the settings ask for."""
        if self.settings.mix:
            return len(self.settings.mix)
        if self.settings.times:
            return (self.drawings - 1) * len(self.settings.times)
        return (self.drawings - 1) * self.settings.frames + (self.drawings if self.settings.ends else 0)

    def frame_files(self) -> list[str | None]:
        """Return for each frame the name of the file that shows it alone, if there is one."""
        if not self.format.has_frame_files:
            return [None] * self.frame_count
        digits, suffix = len(str(self.frame_count)), self.format.name
        return [f"frame-{k:0{digits}d}.{suffix}" for k in range(1, self.frame_count + 1)]

    def files(self) -> list[str]:
        """Return the paths of the files that are written, in order; none for standard output."""
        if self.path == STANDARD_OUTPUT:
            return []
        if self.format.suffix:
            return [self.path]
        return [join(self.path, name) for name in self.format.files or self.frame_files() if name]

    def by_target(self, rendered: Rendered) -> dict[Path, str | bytes | dict[str, str | bytes]]:
        """Return the contents by target: a file, or a folder with the names of its files."""
        if self.format.suffix:
            return {Path(self.path): rendered.contents[0]}
        names = [name for name in self.format.files or self.frame_files() if name]
        return {Path(self.path): dict(zip(names, rendered.contents, strict=True))}

    @property
    def knots(self) -> Knots:
        """Progress at times, if the easing is one that the pairs have to be given for keyframes."""
        ease = self.settings.common_ease
        return () if isinstance(ease, Ease) else ease.knots

    def eased(self, pairs: Sequence[Pair]) -> Sequence[Pair]:
        """Return pairs for keyframes: with an easing that goes beyond the drawings, its pace is theirs."""
        from shapeblend_cli.frames.stagger import eased

        return [eased(pair, self.knots, each=False) for pair in pairs] if self.knots else pairs

    def decimals(self, pairs: Sequence[Pair]) -> int:
        """Return the number of decimals of coordinates."""
        from shapeblend_cli.svg.writing.rounding import decimals_for

        return decimals_for(views(pairs)) if self.precision is None else self.precision


def views(pairs: Sequence[Pair]) -> list[Box]:
    """Return the part of the plane to show of each drawing."""
    return [pairs[0].views[0], *(pair.views[1] for pair in pairs)]


def page_of(pairs: Sequence[Pair]) -> Page:
    """Return the page of a document that shows all drawings."""
    from shapeblend_cli.paint.names import common_page

    return common_page([pairs[0].pages[0], *(pair.pages[1] for pair in pairs)])


class Documents(Sequence["str | Composed"]):
    """Frames as SVG documents without a size, each written when it is asked for: with pictures they are large.

    Frames with bent pictures are in parts, where they can be.
    """

    def __init__(self, frames: Sequence[Frame], decimals: int, side: int) -> None:
        self._frames = frames
        self._decimals = decimals
        self._side = side

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, k: int) -> str | Composed: ...

    @overload
    def __getitem__(self, k: slice) -> Documents: ...

    def __getitem__(self, k: int | slice) -> str | Composed | Documents:
        from shapeblend_cli.svg.writing.document import frame_svg

        if isinstance(k, slice):
            return Documents(self._frames[k], self._decimals, self._side)
        frame = self._frames[k].picture
        if any(shape.bent is not None for shape in frame.shapes):
            from shapeblend_cli.outputs.composed import in_parts

            parts = in_parts(frame, self._decimals, self._side)
            if parts is not None:
                return parts
        if any(map(_has_pictures, frame.shapes)):
            from shapeblend_cli.images.own_files import with_own_pictures  # few drawings have any

            frame = with_own_pictures(frame, self._side)
        return frame_svg(frame, self._decimals)


def _has_pictures(shape: PaintedShape) -> bool:
    """Return whether a shape is painted with pictures, or masked with some."""
    below = shape.below is not None and shape.below.has_pictures
    return below or shape.style.has_pictures or any(effect.has_pictures for effect in shape.effects)


def frame_svgs(spec: OutputSpec, pairs: Sequence[Pair], settings: Settings | None = None) -> Documents:
    """Return every frame as an SVG document to be drawn, by the settings of the output or by others."""
    from shapeblend_cli.frames.frames import make_frames

    frames = make_frames(pairs, settings or spec.settings)
    view = pairs[0].views[0]
    side = (spec.width or 1) * max(1.0, view.height / view.width)
    return Documents(frames, spec.decimals(pairs), round(side))
