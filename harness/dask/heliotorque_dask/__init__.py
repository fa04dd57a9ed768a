"""Runs a heliotorque campaign on the workers of a Dask cluster, in pieces whose rows are joined in order."""

import csv
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import warnings

import cloudpickle

# Workers get the functions themselves, so that nothing of this package has to be installed there.
cloudpickle.register_pickle_by_value(sys.modules[__name__])

PROGRAM = "heliotorque"
# Pieces for each thread of the cluster, so that one slow piece does not keep the others waiting.
PIECES_PER_THREAD = 4
# Lines of a failed program's words that are shown.
LINES_SHOWN = 20
# Status of `heliotorque sweep` whose table is complete and has failed runs; a refused campaign has 2.
SOME_FAILED = 1


class SweepError(RuntimeError):
    """A campaign that could not be run, with what was found and what is allowed."""


def table(arguments, program=PROGRAM, output="-"):
    """Table that `heliotorque sweep` prints for these arguments, failed runs among its rows; nothing with a file as output."""
    command = [program, "sweep", *arguments, "--output", str(output)]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True)
    except OSError as error:
        raise SweepError(f"{program}: {error.strerror}; allowed: the heliotorque program, see --heliotorque") from None
    if done.returncode not in (0, SOME_FAILED):
        said = "\n".join(done.stderr.decode(errors="replace").splitlines()[-LINES_SHOWN:])
        raise SweepError(f"{' '.join(command)}: ended with {done.returncode}: {said}")
    return done.stdout


def rows_of(text, of):
    """The header of a table of runs with its line end, the rest, and the rows."""
    header, end, rest = text.partition(b"\n")
    if not end or header.split(b",")[0].strip() != b"run":
        raise SweepError(f"{of}: found {header[:80]!r}, allowed: a table that begins with run")
    lines = csv.reader(io.StringIO(rest.decode(), newline=""))
    return header + end, rest, [line for line in lines if line]


def planned(campaign, program=PROGRAM):
    """How many runs a campaign has, and the text beside their table: units, seed, versions, digests."""
    with tempfile.TemporaryDirectory() as folder:
        values = pathlib.Path(folder, "values.csv")
        table([str(campaign), "--dry-run"], program, values)
        _, _, rows = rows_of(values.read_bytes(), f"{campaign}, --dry-run")
        return len(rows), pathlib.Path(f"{values}.toml").read_bytes()


def not_made(campaign):
    """What a campaign keeps that is no part of the table made here, in sentences."""
    try:
        keep = tomllib.loads(pathlib.Path(campaign).read_text(encoding="utf-8")).get("keep", {})
    except (OSError, ValueError):
        return []
    said = {
        "percentiles": "no percentiles are made here, allowed: `heliotorque sweep` on one machine, or `histories`",
        "histories": "each worker writes the histories of its runs into its own file system",
    }
    return [f"{campaign}: keep.{key}: {what}" for key, what in said.items() if key in keep]


def cut(runs, pieces):
    """Runs from 0 as pieces of nearly the same length: begin and end, the end excluded; none is empty."""
    pieces = max(1, min(pieces, runs))
    edges = [runs * k // pieces for k in range(pieces + 1)]
    return list(zip(edges, edges[1:]))


def piece(campaign, begin, end, program=PROGRAM):
    """The table of some runs, on a worker, or what went wrong; each piece has its own process, so one worker of `sweep` is enough."""
    try:
        return table([campaign, "--runs", f"{begin}..{end}", "--workers", "1"], program)
    except SweepError as error:
        # The class is the worker's own.
        return str(error)


def joined(tables, pieces, of, failed):
    """The bytes of one table: the header, then each piece's rows, which must be those that were requested; failed runs are added to a list."""
    first = None
    for text, (begin, end) in zip(tables, pieces):
        name = f"{of}, runs {begin}..{end}"
        header, rest, rows = rows_of(text, name)
        runs = [row[0] for row in rows]
        if first is None:
            first = header
            yield header
        if header != first:
            raise SweepError(f"{name}: found another header than the first piece's, allowed: one program on all workers")
        if runs != [str(run) for run in range(begin, end)]:
            raise SweepError(f"{name}: found {len(runs)} rows, from run {runs[:1]} on, allowed: {end - begin}, one for each run")
        status = next(csv.reader([first.decode()])).index("status")
        failed += [row[0] for row in rows if row[status] in ("failed", "killed")]
        yield rest


def sweep(client, campaign, output, pieces=None, program=PROGRAM, fresh=False, failed=None):
    """Runs a campaign on a client's cluster and writes its table; gives the number of runs.

    A run that fails is a row with its reason, and is added to the list `failed` if there is one. What is kept beside the table is
    warned of where it is not made here. Rows of this campaign that an earlier sweep left in `OUTPUT.part` are refused unless `fresh`.

    Until the table is complete it is `OUTPUT.part`, with which `heliotorque sweep --resume` goes on; beside it stands the `.toml` of
    `heliotorque sweep`. `-` is the standard output. Raises SweepError.
    """
    campaign = str(pathlib.Path(campaign).resolve())
    runs, origin = planned(campaign, program)
    if pieces is None:
        pieces = PIECES_PER_THREAD * max(1, sum(client.nthreads().values()))
    if runs == 0:
        raise SweepError(f"{campaign}: found no run, allowed: one at least")
    if str(output) != "-" and not fresh and is_left(output, origin):
        allowed = "`heliotorque sweep --resume`, which goes on with them, or fresh, which begins anew"
        raise SweepError(f"{output}.part: found runs of this campaign, allowed: {allowed}")
    for what in not_made(campaign):
        warnings.warn(what, stacklevel=2)
    pieces = cut(runs, pieces)
    failed = [] if failed is None else failed
    futures = [client.submit(piece, campaign, begin, end, program, pure=False) for begin, end in pieces]
    try:
        rows = joined(results(futures), pieces, campaign, failed)
        if str(output) == "-":
            for part in rows:
                sys.stdout.buffer.write(part)
            sys.stdout.buffer.flush()
            return runs
        unfinished = pathlib.Path(f"{output}.part")
        pathlib.Path(f"{unfinished}.toml").write_bytes(origin)
        with open(unfinished, "wb") as file:
            for part in rows:
                file.write(part)
        os.replace(unfinished, output)
        os.replace(f"{unfinished}.toml", f"{output}.toml")
        return runs
    finally:
        client.cancel([future for future in futures if future is not None])


def is_left(output, origin):
    """Whether an unfinished table of the campaign with this text beside it has a row."""
    try:
        same = pathlib.Path(f"{output}.part.toml").read_bytes() == origin
        return same and pathlib.Path(f"{output}.part").read_bytes().count(b"\n") > 1
    except OSError:
        return False


def results(futures):
    """The tables that the futures come to, in order; what was read is let go."""
    for index, future in enumerate(futures):
        result = future.result()
        if isinstance(result, str):
            raise SweepError(result)
        futures[index] = None
        yield result
