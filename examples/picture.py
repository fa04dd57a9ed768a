"""What every example shares outside its subject: where FMUs are and pictures go, and how a picture looks."""

import argparse
import pathlib

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # after the choice of backend


def folders(text):
    """The folder with the FMUs and the one for pictures, from the command line."""
    parser = argparse.ArgumentParser(description=text)
    parser.add_argument("dist", nargs="?", default="dist", type=pathlib.Path, help="folder with the FMUs")
    parser.add_argument("--output", default="pictures", type=pathlib.Path, help="folder for the picture")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    return arguments.dist, arguments.output


def panels(rows, across):
    """Axes one above the other over a common abscissa."""
    figure, axes = plt.subplots(rows, 1, sharex=True, squeeze=False, figsize=(7.5, 1.2 + 2.3 * rows), layout="constrained")
    for axis in axes[:, 0]:
        axis.grid(color="0.9")
    axes[-1, 0].set_xlabel(across)
    return figure, list(axes[:, 0])


def finish(figure, path):
    """Writes the picture; a legend on every panel that has labels."""
    for axis in figure.axes:
        if axis.get_legend_handles_labels()[0]:
            axis.legend(frameon=False, fontsize="small")
    figure.savefig(path)
