"""Time of whole commands, beside what importing NumPy and click takes alone."""

import subprocess
import sys

import pytest

GROUP = "whole commands on two sample drawings"
BLEND = ["-m", "shapeblend_cli", "samples/bird-1.svg", "samples/bird-2.svg", "--force", "-o"]


@pytest.mark.parametrize(
    "arguments",
    [
        pytest.param(["-c", "import numpy, click"], id="import numpy, click"),
        pytest.param(["-m", "shapeblend_cli", "--help"], id="shapeblend --help"),
        pytest.param([*BLEND, "FOLDER"], id="shapeblend A.svg B.svg"),
        pytest.param([*BLEND, "FOLDER/moving.svg"], id="shapeblend A.svg B.svg -o moving.svg"),
    ],
)
def test_command(benchmark, tmp_path, request, arguments):
    benchmark.group = GROUP
    command = [sys.executable, *(a.replace("FOLDER", str(tmp_path / "out")) for a in arguments)]
    benchmark.pedantic(
        subprocess.run,
        (command,),
        {"check": True, "capture_output": True, "cwd": request.config.rootpath},
        rounds=15,
        warmup_rounds=2,
    )
