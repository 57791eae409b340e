"""Time of whole commands, beside what importing NumPy and click takes alone."""

import subprocess
import sys

import numpy as np
import pytest

GROUP = "whole commands"
BLEND = ["-m", "shapeblend_cli", "samples/bird-1.svg", "samples/bird-2.svg", "--force", "-o"]
SMILE, FROWN = "M 12 22 q 6 8 12 0", "M 12 28 q 6 -9 12 0"


def face(head, eyes, mouth):
    """A face in several colours."""
    return f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 36 36">
    <circle cx="18" cy="18" r="17" fill="{head}"/><path d="{mouth}" fill="none" stroke="#664500" stroke-width="2"/>
    <ellipse cx="11" cy="14" rx="2.5" ry="{eyes}" fill="#664500"/>
    <ellipse cx="25" cy="14" rx="2.5" ry="{eyes}" fill="#664500"/></svg>"""


def islands(seed, count=100):
    """A map of islands of all sizes."""
    rng = np.random.default_rng(seed)
    outlines = []
    for size in 0.6 * np.minimum(1.0 + rng.pareto(1.5, count), 12.0):
        angle = np.linspace(0.0, 2.0 * np.pi, rng.integers(8, 40), endpoint=False)
        z = complex(*rng.uniform(5.0, 95.0, 2)) + size * rng.uniform(0.7, 1.3, len(angle)) * np.exp(
            1j * angle
        )
        outlines.append("M" + "L".join(f"{p.real:.2f} {p.imag:.2f}" for p in z) + "Z")
    path = f'<path d="{"".join(outlines)}"/>'
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{path}</svg>'


DRAWN = {
    "smile.svg": face("#ffcc4d", 3.5, SMILE),
    "frown.svg": face("#dd2e44", 1.5, FROWN),
    "map-1.svg": islands(1),
    "map-2.svg": islands(2),
}


def blend(a, b):
    return ["-m", "shapeblend_cli", a, b, "--force", "-o", "FOLDER/out"]


@pytest.mark.parametrize(
    ("arguments", "rounds"),
    [
        pytest.param(["-c", "import numpy, click"], 15, id="import numpy, click"),
        pytest.param(["-m", "shapeblend_cli", "--help"], 15, id="shapeblend --help"),
        pytest.param(blend("samples/e.svg", "samples/f.svg"), 15, id="two plain icons"),
        pytest.param(blend("FOLDER/smile.svg", "FOLDER/frown.svg"), 15, id="two faces in colour"),
        pytest.param([*BLEND, "FOLDER/out"], 15, id="two birds"),
        pytest.param([*BLEND, "FOLDER/moving.svg"], 15, id="two birds -o moving.svg"),
        pytest.param(blend("FOLDER/map-1.svg", "FOLDER/map-2.svg"), 3, id="two maps of 100 islands"),
    ],
)
def test_command(benchmark, tmp_path, request, arguments, rounds):
    benchmark.group = GROUP
    for name, text in DRAWN.items():
        (tmp_path / name).write_text(text)
    command = [sys.executable, *(a.replace("FOLDER", str(tmp_path)) for a in arguments)]
    benchmark.pedantic(
        subprocess.run,
        (command,),
        {"check": True, "capture_output": True, "cwd": request.config.rootpath},
        rounds=rounds,
        warmup_rounds=1,
    )
