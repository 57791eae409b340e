"""The costs of pairs."""

from itertools import pairwise

from shapeblend_cli.blending.pairings import STRICTER
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pairing.costs import FoundWorks, Rates, Works
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.wires.rough import work_of_few
from tests.support.drawings import contours_of
from tests.support.shapes import star_polygon


def islands(rng, count):
    """Contours of all sizes, smooth and ragged."""
    sizes = 2.0 + 12.0 * rng.random(count) ** 3
    places = (complex(*rng.uniform(0.0, 90.0, 2)) for _ in sizes)
    outlines = (
        place + size * star_polygon(rng, 9, rng.random()) for place, size in zip(places, sizes, strict=True)
    )
    return contours_of(
        *("M" + "L".join(f"{z.real:.2f} {z.imag:.2f}" for z in outline) + "Z" for outline in outlines)
    )


def test_pairs_are_those_of_works_that_are_all_known(rng, monkeypatch):
    solved = []
    monkeypatch.setattr(
        "shapeblend_cli.pairing.costs.work_of_few", lambda *given: solved.append(1) or work_of_few(*given)
    )
    drawings = [islands(rng, count) for count in (1, 2, 9, 12, 12, 20)]
    found, counts = [], []
    costs = Works.costs
    for known in (False, True):
        if known:
            monkeypatch.setattr(Works, "costs", lambda self, *given: costs(self, *given[:3]))
        solved.clear()
        found.append([pair_contours(a, b, Settings()) for a, b in pairwise(drawings)])
        counts.append(len(solved))
    numbers = [[[(p.number, q.number) for p, q in pairs] for pairs in each] for each in found]
    assert numbers[0] == numbers[1]
    assert counts[0] < counts[1]


def test_pairings_of_the_same_drawings_share_what_they_found(rng, monkeypatch):
    solved = []
    monkeypatch.setattr(
        "shapeblend_cli.pairing.costs.work_of_few", lambda *given: solved.append(given) or work_of_few(*given)
    )
    a, b = (islands(rng, count) for count in (12, 20))
    alone = pair_contours(a, b, Settings())
    rates = Rates(works=FoundWorks({}, {}))
    counts, found = [], []
    for _ in range(2):
        solved.clear()
        found.append(pair_contours(a, b, Settings(), rates=rates))
        counts.append(len(solved))
    assert counts[0] > 0 == counts[1]
    assert rates.works.beyond, "some were not solved in full"
    assert found == [alone, alone]
    for other in STRICTER:
        assert pair_contours(a, b, Settings(), rates=other._replace(works=rates.works)) == pair_contours(
            a, b, Settings(), rates=other
        )
