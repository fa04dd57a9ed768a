"""Runs a heliotorque campaign on the workers of a Dask cluster, in pieces whose rows are joined in order."""

import csv
import io
import os
import pathlib
import subprocess
import sys
import tempfile

import cloudpickle

# Workers get the functions themselves, so that nothing of this package has to be installed there.
cloudpickle.register_pickle_by_value(sys.modules[__name__])

PROGRAM = "heliotorque"
# Pieces for each thread of the cluster, so that one slow piece does not keep the others waiting.
PIECES_PER_THREAD = 4
# Lines of a failed program's words that are shown.
LINES_SHOWN = 20


class SweepError(RuntimeError):
    """A campaign that could not be run, with what was found and what is allowed."""


def table(arguments, program=PROGRAM, output="-"):
    """What `heliotorque sweep` prints for these arguments, as bytes; nothing with a file as output."""
    command = [program, "sweep", *arguments, "--output", str(output)]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True)
    except OSError as error:
        raise SweepError(f"{program}: {error.strerror}; allowed: the heliotorque program, see --heliotorque") from None
    if done.returncode != 0:
        said = "\n".join(done.stderr.decode(errors="replace").splitlines()[-LINES_SHOWN:])
        raise SweepError(f"{' '.join(command)}: ended with {done.returncode}: {said}")
    return done.stdout


def rows_of(text, of):
    """The header of a table of runs with its line end, the rest, and the numbers of the runs."""
    header, end, rest = text.partition(b"\n")
    if not end or header.split(b",")[0].strip() != b"run":
        raise SweepError(f"{of}: found {header[:80]!r}, allowed: a table that begins with run")
    lines = csv.reader(io.StringIO(rest.decode(), newline=""))
    return header + end, rest, [line[0] for line in lines if line]


def planned(campaign, program=PROGRAM):
    """How many runs a campaign has, and the text beside their table: units, seed, versions, digests."""
    with tempfile.TemporaryDirectory() as folder:
        values = pathlib.Path(folder, "values.csv")
        table([str(campaign), "--dry-run"], program, values)
        _, _, runs = rows_of(values.read_bytes(), f"{campaign}, --dry-run")
        return len(runs), pathlib.Path(f"{values}.toml").read_bytes()


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


def joined(tables, pieces, of):
    """The bytes of one table: the header, then each piece's rows, which must be those that were requested."""
    first = None
    for text, (begin, end) in zip(tables, pieces):
        name = f"{of}, runs {begin}..{end}"
        header, rest, runs = rows_of(text, name)
        if first is None:
            first = header
            yield header
        if header != first:
            raise SweepError(f"{name}: found another header than the first piece's, allowed: one program on all workers")
        if runs != [str(run) for run in range(begin, end)]:
            raise SweepError(f"{name}: found {len(runs)} rows, from run {runs[:1]} on, allowed: {end - begin}, one for each run")
        yield rest


def sweep(client, campaign, output, pieces=None, program=PROGRAM):
    """Runs a campaign on a client's cluster and writes its table; gives the number of runs.

    Until the table is complete it is `OUTPUT.part`, with which `heliotorque sweep --resume` goes on; beside it stands the `.toml` of
    `heliotorque sweep`. `-` is the standard output. Raises SweepError.
    """
    campaign = str(pathlib.Path(campaign).resolve())
    runs, origin = planned(campaign, program)
    if pieces is None:
        pieces = PIECES_PER_THREAD * max(1, sum(client.nthreads().values()))
    if runs == 0:
        raise SweepError(f"{campaign}: found no run, allowed: one at least")
    pieces = cut(runs, pieces)
    futures = [client.submit(piece, campaign, begin, end, program, pure=False) for begin, end in pieces]
    try:
        rows = joined(results(futures), pieces, campaign)
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


def results(futures):
    """The tables that the futures come to, in order; what was read is let go."""
    for index, future in enumerate(futures):
        result = future.result()
        if isinstance(result, str):
            raise SweepError(result)
        futures[index] = None
        yield result
