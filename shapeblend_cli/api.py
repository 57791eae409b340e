"""The Python API: drawings are read and blended, blends are looked at, measured and saved, polygons are matched."""

from __future__ import annotations

import re
import warnings
from dataclasses import replace
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from shapeblend_cli.errors import InputError, OptionError, ShapeblendError
from shapeblend_cli.frames.frames import frame_at, make_frames
from shapeblend_cli.job.options import report_settings
from shapeblend_cli.job.report import measure, report
from shapeblend_cli.model import Correspondence, Drawing, Frame, PaintedShape, Pair, Polygon
from shapeblend_cli.options.easing import frame_times
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT, views
from shapeblend_cli.outputs.options import OutputOptions, specify
from shapeblend_cli.paint.page_colour import with_page_colour
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read as read_file
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.rounding import decimals_for
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.write import check_targets, write_files
from shapeblend_cli.version import __version__
from shapeblend_cli.wires.constraints import Constraints, check_stiff
from shapeblend_cli.wires.direction import choose_direction

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from os import PathLike

    from numpy.typing import ArrayLike

    from shapeblend_cli.outputs.formats import OutputSpec

    File = str | PathLike[str]


F = TypeVar("F", bound="Callable[..., Any]")

OPTION = re.compile(r"--([a-z][a-z-]*)")


def _in_python(function: F) -> F:
    """Let errors of a function name the fields of settings where the command would name options."""
    names = {
        flag: name
        for record in (Settings, OutputOptions)
        for name, option in record.options.items()
        for flag in option.flags
    }

    def field(found: re.Match[str]) -> str:
        return names.get(found[0], found[1].replace("-", "_"))

    @wraps(function)
    def called(*arguments: Any, **options: Any) -> Any:
        try:
            return function(*arguments, **options)
        except ShapeblendError as error:
            error.args = (OPTION.sub(field, str(error)),)
            raise

    return called  # type: ignore[return-value]


@_in_python
def read(
    file: File | None = None, *, text: str | None = None, select: str | None = None, lenient: bool = False
) -> Drawing:
    """Read an SVG file, or the text of one.

    Parameters
    ----------
    file : str or path
        ``-`` is standard input.
    text : str
        An SVG document, in place of a file.
    select : str, optional
        ``#id`` or a CSS selector: take only the shapes it matches, and those in groups it matches.
    lenient : bool
        Draw broken path data up to the error, as browsers do, instead of refusing the file.

    Raises
    ------
    ShapeblendError
        The file cannot be read, is not SVG, or paints nothing that can be blended.

    Examples
    --------
    >>> drawing = read("samples/bird-1.svg")
    >>> len(drawing.shapes), drawing.viewbox.width
    (1, 350.0)
    >>> len(read(text='<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V9Z"/></svg>').shapes)
    1
    """
    if (file is None) == (text is None):
        raise TypeError("read takes the name of a file, or text=...")
    if text is not None:
        if not isinstance(text, str):
            raise TypeError(f"text must be str, not {type(text).__name__}")
        return read_file("<text>", text.encode("utf-8", "replace"), select=select, lenient=lenient)
    if "\n" in str(file) or str(file).lstrip("\ufeff \t\r").startswith("<"):
        raise InputError("SVG text", "given in place of the name of a file; read(text=...) would work")
    return read_file(str(file), select=select, lenient=lenient)


@_in_python
def blend(
    a: Drawing | File | Sequence[Drawing | File],
    b: Drawing | File | Settings | None = None,
    settings: Settings | None = None,
    **options: Any,
) -> Blend:
    """Blend a drawing into another one, or several drawings in order.

    Parameters
    ----------
    a, b : Drawing, or the name of an SVG file
        Or `a` alone: a list of two or more of these. The second argument may then be the settings.
    settings : Settings, optional
    **options
        Fields of `Settings`, instead of those in `settings`.

    Raises
    ------
    ShapeblendError
        A file or a drawing that cannot be blended, or settings that do not fit the drawings.
    ValueError
        A field with a value that it cannot have; the message names it.

    Examples
    --------
    >>> blend("samples/e.svg", "samples/f.svg", motion="linear")
    <Blend of samples/e.svg and samples/f.svg>
    >>> blend(["samples/triangle.svg", "samples/square.svg", "samples/e.svg"], Settings(vertices=50))
    <Blend of samples/triangle.svg, samples/square.svg and samples/e.svg>
    """
    if isinstance(b, Settings):
        b, settings = None, b
    if settings is not None and not isinstance(settings, Settings):
        kind = type(settings).__name__
        raise TypeError(f"settings must be Settings, not {kind}; a list of drawings may have more than two")
    several = b is None and not isinstance(a, str | Path | Drawing)
    given = list(a) if several else [a] if b is None else [a, b]  # type: ignore[arg-type]
    if len(given) < 2:
        raise ValueError(f"a blend needs two drawings or more; {len(given)} given")
    drawings = [one if isinstance(one, Drawing) else read(one) for one in given]  # type: ignore[arg-type]
    return Blend(drawings, (settings or Settings()).replace(**options))


class Blend:
    """Drawings that are blended, each into the next one. In a notebook they show themselves as an animation.

    Attributes
    ----------
    drawings : list of Drawing
    settings : Settings
    pairs : list of Pair
        What was matched, and how it moves: shapes of contours with their correspondences.
    notes : list of str
        What was left out of the blend, one phrase each.
    """

    def __init__(self, drawings: Sequence[Drawing], settings: Settings) -> None:
        self.drawings = list(drawings)
        self.settings = settings
        settings.check_drawings(len(drawings))
        self._clock = Clock()
        self.pairs, self.notes = match_all(self.drawings, settings, self._clock)

    def __repr__(self) -> str:
        names = [drawing.file for drawing in self.drawings]
        return f"<Blend of {', '.join(names[:-1])} and {names[-1]}>"

    def _repr_svg_(self) -> str:
        options = OutputOptions(output="blend.svg", repeat="pingpong")
        spec = specify(options, self.settings.replace(times=None), len(self.drawings))
        (shown,) = spec.format.render(spec, self.pairs).contents
        assert isinstance(shown, str), "it is an SVG document"
        return shown

    def frame(self, t: float) -> Picture:
        """Return the in-between at a time.

        Parameters
        ----------
        t : float
            0 is the first drawing, 1 the second, 2 the third, and so on.

        Raises
        ------
        ValueError
            A time outside the blend.

        Examples
        --------
        >>> blend("samples/e.svg", "samples/f.svg").frame(0.5).svg[:4]
        '<svg'
        """
        if not 0.0 <= t <= len(self.pairs):
            raise ValueError(f"t must lie between 0 and {len(self.pairs)}, not {t}")
        number = min(int(t), len(self.pairs) - 1)

        def shown(pairs: Sequence[Pair]) -> Frame:
            return frame_at(pairs[number], t - number, as_drawn=self.settings.draws_ends)

        return self._picture(self.pairs, self.settings, shown)

    @_in_python
    def mix(self, *weights: float) -> Picture:
        """Return a mixture of all drawings, with a share of each.

        Each corresponds with the first. Of two drawings that have a share it is their blend.

        Parameters
        ----------
        *weights : float
            A share for each drawing, 0 or more and not all 0.

        Examples
        --------
        >>> drawings = blend(["samples/triangle.svg", "samples/square.svg", "samples/e.svg"])
        >>> drawings.mix(0.2, 0.5, 0.3).svg[:4]
        '<svg'
        """
        settings = self.settings.replace(mix=(weights,), frames=None, ends=None, ease=None)
        settings.check_drawings(len(self.drawings))
        pairs, _ = match_all(self.drawings, settings)
        return self._picture(pairs, settings, lambda pairs: make_frames(pairs, settings)[0])

    def _picture(
        self, pairs: Sequence[Pair], settings: Settings, shown: Callable[[Sequence[Pair]], Frame]
    ) -> Picture:
        """Return a picture whose document may have the colour of a page, and whose shapes have colours alone."""
        frame = shown(pairs)
        in_page, _ = with_page_colour(pairs, settings.style)
        drawn = frame if in_page is pairs else shown(in_page)
        return Picture(frame, frame_svg(drawn, decimals_for(views(pairs))))

    @_in_python
    def save(
        self,
        path: File,
        *,
        n: int | None = None,
        ends: bool | None = None,
        force: bool = False,
        **options: Any,
    ) -> list[Path]:
        """Write the blend to files, all of them or none, in any format that the command has.

        Parameters
        ----------
        path : str or path
            A folder gets one file for each frame. The suffix of a file chooses the format: ``.svg`` is one animated
            SVG, ``.gif``, ``.webp`` and ``.apng`` are raster animations, ``.png`` is a contact sheet. What a
            format cannot show is a warning.
        n : int, optional
            In-betweens of each pair of drawings; by default those of the settings.
        ends : bool, optional
            Include the drawings themselves.
        force : bool
            Replace existing files.
        **options
            Fields of `OutputOptions`: ``duration=3.0``, ``emit="lottie"``, ``width=300`` and so on.

        Returns
        -------
        list of Path
            The files.

        Raises
        ------
        ShapeblendError
            A file exists or cannot be written, there is nothing to write, or options do not go together.
        ValueError
            An option with a value that it cannot have; the message names it.

        Examples
        --------
        >>> import tempfile
        >>> letters = blend("samples/e.svg", "samples/f.svg")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     [file.name for file in letters.save(folder + "/frames", n=2, ends=True)]
        ['frame-1.svg', 'frame-2.svg', 'frame-3.svg', 'frame-4.svg']
        """
        if "output" in options:
            raise TypeError("save takes path in place of output")
        asked = {"frames": n, "ends": ends}
        settings = self.settings.replace(**{name: x for name, x in asked.items() if x is not None})
        spec = specify(OutputOptions(output=str(path), **options), settings, len(self.drawings))
        files = self._checked_targets(spec, force)
        is_same = spec.settings.motion == self.settings.motion
        pairs = self.pairs if is_same else match_all(self.drawings, spec.settings)[0]
        rendered = spec.format.render(spec, pairs)
        for note in rendered.notes:
            warnings.warn(note, stacklevel=2)
        write_files(spec.by_target(rendered), force)
        return files

    def _checked_targets(self, spec: OutputSpec, force: bool) -> list[Path]:
        """Return the files to write, if these can be written."""
        if spec.path == STANDARD_OUTPUT:
            raise OptionError(
                "- is standard output, which only the command writes to; the name of a file would work"
            )
        files = [Path(name) for name in spec.files()]
        if not files:
            raise OptionError(
                "nothing is written: no in-betweens are asked for; ends=True would write the drawings"
            )
        spec.format.check_libraries()
        names = *(drawing.file for drawing in self.drawings), spec.settings.timing.file
        check_targets(files, [Path(name) for name in names if name], force)
        return files

    def report(self) -> dict[str, Any]:
        """Return what the command's ``--report`` writes, with frames at the times of the settings.

        Examples
        --------
        >>> found = blend("samples/triangle.svg", "samples/square.svg", frames=1).report()
        >>> [contour["motion"] for contour in found["pairs"][0]["contours"]]
        ['linear']
        """
        from shapeblend_cli.job.make import Run

        run = Run(self.pairs, self.settings, self._clock)
        return report(
            __version__,
            [drawing.file for drawing in self.drawings],
            report_settings(self.settings),
            self.pairs,
            run.grades,
            run.measures,
            [None] * len(run.measures),
            self._clock.seconds,
        )

    def crossings(self, n: int = 20) -> int:
        """Count how often outlines cross themselves and others of their shape, in n in-betweens of each pair.

        Raises
        ------
        ValueError
            A number of in-betweens below 0.

        Examples
        --------
        >>> blend("samples/e.svg", "samples/f.svg").crossings()
        0
        """
        if n < 0:
            raise ValueError(f"n must be 0 or more, not {n}")
        times = frame_times(n, ends=False)
        return sum(measure(pair, t).self_crossings for pair in self.pairs for t in times)


class Picture:
    """A drawing at one time of a blend. In a notebook it shows itself.

    Attributes
    ----------
    t : float
        Time within its pair of drawings.
    shapes : tuple of PaintedShape
        Paths of cubic Bézier segments with their paint, the lowest first.
    svg : str
        An SVG document. Where both drawings have ``currentColor``, it has that too, and `shapes` are black.
    """

    def __init__(self, frame: Frame, svg: str) -> None:
        self.t: float = frame.t
        self.shapes: tuple[PaintedShape, ...] = frame.shapes
        self.svg: str = svg

    def __repr__(self) -> str:
        return f"<Picture at t = {self.t:g}>"

    def _repr_svg_(self) -> str:
        return self.svg


@_in_python
def match(
    p0: ArrayLike,
    p1: ArrayLike,
    closed: bool = True,
    settings: Settings | None = None,
    **options: Any,
) -> Correspondence:
    """Find the least-work correspondence of two polygons, without any SVG.

    Parameters
    ----------
    p0, p1 : (m, 2) and (n, 2) float, or (m,) and (n,) complex
        Vertices, in any unit; the first is not repeated at the end. Each polygon is scaled to the unit box
        (section 3.3).
    closed : bool
        Open polygons correspond end to end.
    settings : Settings, optional
        Its start, pins, reverse, stiff, solver, band, effort and constants count; points are those of `p0` and `p1`.
    **options
        Fields of `Settings`, instead of those in `settings`.

    Returns
    -------
    Correspondence
        Its `pairs` number the vertices as they were given, also where `p1` is traversed backwards.

    Raises
    ------
    ValueError
        Vertices that are not finite, neighbours that coincide, or too few; a field with a value it cannot have.
    ShapeblendError
        Starts, pins, bands and stiff regions that do not fit the polygons.

    Examples
    --------
    The triangle and the square of figures 23 and 24:

    >>> found = match([(0, 0), (0, 1), (1, 0)], [(0, 0), (0, 1), (1, 1), (1, 0)], k_s=1.0)
    >>> found.pairs.tolist()[0], round(found.stretching, 4), found.gap
    ([0, 0], 2.1421, 0.0)
    """
    a, b = _polygon(p0, closed), _polygon(p1, closed)
    settings = (settings or Settings()).replace(**options)
    check_stiff([a], settings)
    is_reversed, found = choose_direction(a, b, settings, Constraints(settings.start, settings.pins))
    if not is_reversed:
        return found
    # Reversed, a closed polygon keeps its first vertex, and an open one begins at its last.
    last = len(b.vertices) - (0 if closed else 1)
    i, j = found.dots.T
    return replace(found, dots=np.stack([i, (last - j) % len(b.vertices)], axis=1))


def _polygon(points: ArrayLike, closed: bool) -> Polygon:
    """Return a polygon on a contour of straight segments, one for each vertex."""
    least = 3 if closed else 2
    form = f"a polygon is a list of {least} or more points, (x, y) or complex numbers"
    try:
        # NumPy's product of objects that are no numbers ends the process.
        vertices = np.asarray(points, np.complex128)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(form) from None
    if vertices.ndim == 2 and vertices.shape[1] == 2:
        vertices = vertices @ (1, 1j)
    if vertices.ndim != 1 or len(vertices) < least:
        raise ValueError(form)
    if not np.isfinite(vertices).all():
        raise ValueError("a vertex is not finite")
    if (np.diff(vertices) == 0.0).any() or (closed and vertices[0] == vertices[-1]):
        raise ValueError(
            "neighbouring vertices coincide; leave out repetitions, also of the first vertex at the end"
        )
    return Polygon(vertices, np.arange(len(vertices)), np.zeros(len(vertices)), closed)
