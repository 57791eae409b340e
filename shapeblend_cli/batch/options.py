"""Options of a batch, beside those of its jobs, and of a ranking; nothing heavy is imported, for ``--help``."""

from __future__ import annotations

from shapeblend_cli.options import types as types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import BATCH, RANK


class BatchOptions(Record, section=BATCH):
    """Which jobs a batch has, and how they are done."""

    pairs: tuple[str, str] | None = option(
        types.FOLDERS,
        default=None,
        help="Blend each drawing in FROM, or in a folder inside it, into the one with the same name in TO.",
    )
    chain: str | None = option(
        types.file(),
        default=None,
        metavar="'*.svg'",
        help="Blend each of these drawings, or of those in a folder, into the next one, 9.svg before 10.svg.",
    )
    every_two: str | None = option(
        types.file(),
        default=None,
        key="all",
        metavar="FOLDER",
        help="Blend every two drawings of a folder, or of a pattern in quotes.",
    )
    jobs: int | None = option(
        types.whole(1, 1024),
        default=None,
        flags=("-j", "--jobs"),
        help="Number of jobs done at a time.",
        default_text="the number of processors",
    )
    results: str | None = option(
        types.file(),
        default=None,
        metavar="FILE.jsonl",
        help="Append a line of JSON for each job as it ends; - for standard output.",
    )
    summary: str | None = option(
        types.file(".xml", ".json"),
        default=None,
        metavar="FILE.xml|FILE.json",
        help="Write the outcome of all jobs at the end of the batch: as JUnit XML for CI servers, with a test case "
        "for each job, or as JSON.",
    )
    log_file: str | None = option(
        types.file(), default=None, help="Append all messages to a file, with the time, even with --quiet."
    )
    depfile: str | None = option(
        types.file(".d"),
        default=None,
        metavar="FILE.d",
        help="Write the drawings that each output depends on, for make and ninja.",
    )
    retries: int = option(
        types.whole(0, 100),
        default=0,
        help="Try a job that fails, takes too long or dies up to N more times.",
        default_text="0, and 1 for a job that dies",
    )
    keep_going: int = option(
        types.whole(0),
        default=0,
        flags=("-k", "--keep-going"),
        help="Start no further jobs after N have failed. 0: go on, however many fail.",
    )
    fail_fast: bool = option(types.FLAG, default=False, help="The same as --keep-going 1.")
    cache: str | None = option(
        types.file(),
        default=None,
        metavar="DIR",
        help="Keep outputs in a folder too, and copy outputs from there that were made from the same drawings and "
        "settings before, in any checkout and on any machine.",
    )
    clean: bool = option(
        types.FLAG,
        default=False,
        help="Remove outputs of jobs that the batch no longer has, and frames of longer runs, unless they were edited "
        "since.",
    )
    dry_run: bool = option(
        types.FLAG, default=False, help="Print what would be done, and why, and do nothing."
    )
    why: bool = option(types.FLAG, default=False, help="Say for each job why it is done.")
    outside: bool = option(
        types.FLAG,
        default=False,
        help="Let the manifest name outputs outside its own folder.",
    )
    watch: bool = option(
        types.FLAG,
        default=False,
        help="Keep running, and do jobs again when their drawings or the manifest change.",
    )
    wait: bool = option(
        types.FLAG,
        default=False,
        help="Wait while another batch writes the same outputs, instead of ending with an error.",
    )
    shard: tuple[int, int] | None = option(
        types.SHARD,
        default=None,
        help="Do the Kth of N parts of the batch, to share it between N machines.",
    )
    cluster: str | None = option(
        types.ADDRESS,
        default=None,
        help="Let the workers of a dask scheduler do the jobs. Drawings and outputs are sent; no shared folder is "
        "needed.",
    )


class RankOptions(Record, section=RANK):
    """How drawings are ranked, printed and written."""

    by: str = option(
        types.choice("looks", "work"),
        default="looks",
        help="Order of the list. looks: by the grades of blends, the best first; work: by their work, the least first.",
    )
    top: int | None = option(types.whole(1), default=None, help="List only the first N.", default_text="all")
    as_json: bool = option(
        types.FLAG, default=False, key="json", help="Print a line of JSON for each drawing, for programs."
    )
    sheet: str | None = option(
        types.file(".svg"),
        default=None,
        metavar="FILE.svg",
        help="Write a contact sheet: a row of in-betweens for each drawing that is listed.",
    )
    force: bool = option(
        types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing sheet."
    )
    jobs: int | None = option(
        types.whole(1, 1024),
        default=None,
        flags=("-j", "--jobs"),
        help="Number of blends made at a time.",
        default_text="the number of processors",
    )
