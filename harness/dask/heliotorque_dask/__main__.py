"""python -m heliotorque_dask campaign.toml --scheduler ADDRESS --output runs.csv"""

import argparse
import sys
import warnings

from distributed import Client, LocalCluster

from heliotorque_dask import PROGRAM, SweepError, sweep


def whole(text):
    """A number of pieces."""
    number = int(text)
    if number < 1:
        raise ValueError
    return number


def main():
    parser = argparse.ArgumentParser("python -m heliotorque_dask", description="Runs a heliotorque campaign on a Dask cluster.")
    parser.add_argument("campaign", help="the campaign, a TOML file that every worker finds at this path")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of the cluster: tcp://head:8786; otherwise processes of this machine")
    parser.add_argument("--output", metavar="CSV", required=True, help="the table to write; - is the standard output")
    parser.add_argument("--pieces", metavar="N", type=whole, help="pieces the runs are cut into; otherwise four a thread")
    parser.add_argument("--heliotorque", metavar="PATH", default=PROGRAM, help="the program, here and on every worker")
    parser.add_argument("--fresh", action="store_true", help="begin anew although OUTPUT.part holds runs of this campaign")
    arguments = parser.parse_args()
    warnings.showwarning = lambda message, *_: print(f"heliotorque_dask: {message}", file=sys.stderr)
    failed = []
    try:
        cluster = arguments.scheduler or LocalCluster(processes=True, threads_per_worker=1, dashboard_address=None)
        try:
            with Client(cluster) as client:
                runs = sweep(client, arguments.campaign, arguments.output, arguments.pieces, arguments.heliotorque, arguments.fresh, failed)
        finally:
            if not arguments.scheduler:
                cluster.close()
    except (SweepError, OSError) as error:
        print(f"heliotorque_dask: {error}", file=sys.stderr)
        sys.exit(2)
    print(f"{arguments.output}: {runs} runs" + (f", {len(failed)} failed" if failed else ""), file=sys.stderr)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
