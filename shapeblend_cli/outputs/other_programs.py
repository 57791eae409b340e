"""Any form but frames: from moves to the texts of its files."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.easing import Ease
    from shapeblend_cli.outputs.move import Move


def emitted(
    emit: str, moves: Sequence[Move], seconds: float, ease: Ease, decimals: int
) -> tuple[list[str], list[str]]:
    """Write moves in the form that is asked for.

    Parameters
    ----------
    emit : str
        ``pair``, ``lottie`` or ``avd``.
    moves : sequence of Move
        More than one for ``lottie`` alone.
    seconds : float
        How long each move takes.
    ease : Ease
        How fast when within a move.
    decimals : int
        Of coordinates.

    Returns
    -------
    texts : list of str
        In the order of `formats.file_names`.
    notes : list of str
        What the form cannot say, a phrase each.
    """
    if emit == "pair":
        from shapeblend_cli.outputs.svg_pair import svg_pair

        return list(svg_pair(moves[0], decimals)), moves[0].straightened()
    if emit == "lottie":
        from shapeblend_cli.outputs.lottie import lottie

        return [lottie(moves, seconds, ease, decimals)], [
            note for move in moves for note in move.kept("Lottie")
        ]
    from shapeblend_cli.outputs.avd import animated_vector, too_long

    (move,) = moves
    return [animated_vector(move, seconds, ease, decimals)], [
        *move.kept("Android"),
        *too_long(move, decimals),
    ]
