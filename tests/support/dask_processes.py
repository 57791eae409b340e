"""How a scheduler of dask and its workers are started, each as a process of this machine."""

import sys

ADDRESS = "address.json"
"""The file in its working folder into which a scheduler writes its address."""

DASK = (sys.executable, "-m")

SCHEDULER = (
    *(*DASK, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"),
    *("--no-dashboard", "--scheduler-file", ADDRESS),
)


def worker(address: str, folder: object) -> tuple[str, ...]:
    """Return the command of a worker with one thread, which keeps its files in a folder."""
    options = ("--nthreads", "1", "--local-directory", str(folder), "--no-dashboard")
    return (*DASK, "distributed.cli.dask_worker", address, *options)
