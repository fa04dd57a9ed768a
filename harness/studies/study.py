"""Parts that all studies share: chosen cases, tables with verdicts, CSV files, figures, and calls of the program.

A study is a program of its own, `<subject>/<name>.py`. The first line of its docstring names the paper and says what the
study shows, the last paragraph is for `remark`. It ends with `study.main(function)`; `main` reads the command line and hands
the function a `Run`.
"""

import argparse
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
import tomlkit

from fmu import Failure, Fmu

DAY_S = 86_400.0
AU_M = 149_597_870_700.0
# Labels that an error lists one by one.
MOST_LISTED = 12
# Text stays text, and the bytes of a figure depend on nothing but what it shows.
FIGURE_STYLE = {
    "svg.fonttype": "none",
    "svg.hashsalt": "heliotorque",
    "axes.grid": True,
    "axes.titlelocation": "left",
    "axes.titlesize": "small",
    "axes.xmargin": 0.0,
    "font.size": 9.0,
    "grid.alpha": 0.3,
    "legend.fontsize": "small",
    "lines.linewidth": 1.2,
    "lines.markersize": 4.0,
}


# --- Cells of tables ----------------------------------------------------------------------------------------------------


def verdict(holds, text="agrees"):
    """The text of a comparison that holds, or `off`."""
    return text if holds else "off"


def agrees(holds):
    """The verdict on what a paper says in words."""
    return "agrees" if holds else "differs"


def rounds(ours, paper, digit):
    """Whether `ours` is the paper's number to half a unit of its last digit."""
    return bool(abs(ours - paper) <= 0.5 * digit * (1.0 + 1e-9))


def scientific(numbers):
    """Cells of numbers with seven digits: 1.234567e-8."""
    return [unpadded(f"{number:.6e}") for number in numbers]


def brief(number, digits=1, sign=""):
    """A cell of few digits: 1.3e-9."""
    return unpadded(f"{number:{sign}.{digits}e}")


def flag(is_set):
    """The cell of a flag."""
    return "true" if is_set else "false"


def exact(number):
    """The shortest cell that reads as the same number: 0.1, 1e-7."""
    return unpadded(repr(float(number)))


def plain(number):
    """The same without exponent, and without point where it is whole: 12, 0.00001."""
    return np.format_float_positional(number, trim="-")


def unpadded(text):
    """A text whose exponents have neither plus nor leading zeros."""
    return re.sub(r"e([-+])0*(?=\d)", lambda sign: "e" + sign[1].strip("+"), text)


def unsigned_zeros(text):
    """A text whose zeros have no sign: 0.00 for -0.00."""
    return re.sub(r"(?<![\w.+)\]-])-(?=0\.?0*(e0)?\b(?!\.?\w))", "", text)


def columns(header):
    """The names of columns with bars between them."""
    return [name.strip() for name in header.split("|")]


def mark(axes, values, label):
    """Draws dashed lines at values."""
    for k, value in enumerate(values):
        axes.axhline(value, color="black", linestyle="--", linewidth=0.8, label="_" if k else label)


# --- A study under way --------------------------------------------------------------------------------------------------


class Run:
    """A study under way: its options, its FMUs, and what it leaves."""

    def __init__(self, name, options, description=""):
        self.name, self.options, self._description, self._fmus, self._folders = name, options, description, {}, []

    def folder(self):
        """A folder of its own that lasts as long as the study runs."""
        self._folders.append(tempfile.TemporaryDirectory(prefix="study-"))
        return pathlib.Path(self._folders[-1].name)

    def fmu(self, file):
        """An FMU of the folder --dist, loaded once."""
        if file not in self._fmus:
            self._fmus[file] = Fmu(self.dist(file))
        return self._fmus[file]

    def dist(self, file):
        """The path of a file in the folder --dist."""
        return pathlib.Path(self.options.dist, file)

    def chosen(self, cases, label=str):
        """Those of the cases whose label contains --only."""
        cases = list(cases)
        found = [case for case in cases if self.options.only in label(case)]
        if not found:
            labels = [label(case) for case in cases]
            known = "\n  ".join(labels)
            if len(labels) > MOST_LISTED:
                known = f"{labels[0]}, {labels[1]}, ..., {labels[-1]} ({len(labels)} of them)"
            raise Failure(f"no case of {self.name} contains `{self.options.only}`; the cases are\n  {known}")
        return found

    def all(self, cases, simulate):
        """The results of all cases, in their order, from one process a core where the system can fork."""
        cases = list(cases)
        cores = min(len(cases), len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1)
        if cores < 2:
            return [simulate(case) for case in self._shown(cases)]
        import multiprocessing

        global _forked
        _forked = simulate, cases
        with multiprocessing.get_context("fork").Pool(cores) as pool:
            results = pool.imap(_forked_case, range(len(cases)))
            return [next(results) for _ in self._shown(cases)]

    def _shown(self, cases):
        is_shown = not self.options.quiet and sys.stderr.isatty()
        for number, case in enumerate(cases, 1):
            yield case
            if is_shown:
                print(f"\r{number} of {len(cases)} cases", end="\n" if number == len(cases) else "", file=sys.stderr)

    def heliotorque(self, *arguments, accepted=(0,)):
        """Output of the program `heliotorque`, called with these arguments; another status than those accepted is a failure."""
        program = self.options.heliotorque or os.environ.get("HELIOTORQUE") or shutil.which("heliotorque")
        if program is None:
            raise Failure("found no program heliotorque: see --heliotorque")
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, encoding="utf-8")
        if done.returncode not in accepted:
            raise Failure(f"heliotorque {arguments[0]}: {done.stderr.strip()}")
        return done.stdout

    def plan(self, mission, plan):
        """The folder of what `heliotorque plan` finds for a mission of MomentumPlant. Status 1 is a plan that exceeds a limit, if by
        a trifle: studies judge it themselves."""
        folder = self.folder()
        for name, content in (("mission", mission), ("plan", {"mission": "mission.toml", "freeze": 0} | plan)):
            (folder / f"{name}.toml").write_text(tomlkit.dumps(content), encoding="utf-8")
        arguments = ["plan", folder / "plan.toml", "--quiet", "--budget", 1e-9, "--output", folder / "out"]
        self.heliotorque(*arguments, "--template", self.dist("MomentumPlant.fmu"), accepted=(0, 1))
        return folder / "out"

    def variant(self, file, sets=(), **files):
        """An FMU of the folder --dist packed anew: with start values, `name=value`, and with other files, `spacecraft` and
        `timeline`, by their texts or paths."""
        with tempfile.TemporaryDirectory(prefix="study-") as folder:
            options = [option for assignment in sets for option in ("--set", assignment)]
            for name, content in files.items():
                path = content
                if isinstance(content, str):
                    path = pathlib.Path(folder, f"{name}.toml")
                    path.write_text(content, encoding="utf-8")
                options += [f"--{name}", path]
            self.heliotorque("pack", "--template", self.dist(file), *options, "--output", f"{folder}/variant.fmu")
            return Fmu(pathlib.Path(folder, "variant.fmu"))

    def line(self, text):
        """Prints a paragraph."""
        print(unsigned_zeros(text))

    def remark(self):
        """Prints the last paragraph of the study's docstring."""
        self.line(self._description.rpartition("\n\n")[2].rstrip())

    def table(self, header, rows):
        """Prints a table."""
        rows = [columns(header), *([unsigned_zeros(cell) for cell in row] for row in rows)]
        widths = [max(map(len, column)) + 1 for column in zip(*rows)]
        lines = ["".join(f" {cell:<{width}} " for cell, width in zip(row, widths)) for row in rows]
        rule = len(lines[0])
        print("\n".join(["─" * rule, lines[0], "═" * rule, *lines[1:], "─" * rule]))

    def csv(self, file, header, rows):
        """Writes rows of cells into the folder --output."""
        with open(self._output(file), "w", encoding="utf-8", newline="") as target:
            writer = csv.writer(target, lineterminator="\n")
            writer.writerow(columns(header))
            writer.writerows([unsigned_zeros(str(cell)) for cell in row] for row in rows)

    def table_and_csv(self, file, header, rows):
        """Prints a table and writes it as CSV."""
        rows = list(rows)
        self.table(header, rows)
        self.csv(file, header, rows)

    def axes(self, title, x_label, y_labels, height_in=2.2, is_row=False):
        """A figure with one panel below the other, or beside it, and its axes."""
        import matplotlib
        from matplotlib.figure import Figure

        matplotlib.rcParams.update(FIGURE_STYLE)
        shape = (1, len(y_labels)) if is_row else (len(y_labels), 1)
        figure = Figure(figsize=(9.0, height_in * shape[0] + 0.8), layout="constrained")
        figure.suptitle(title, x=0.01, ha="left", weight="bold")
        axes = figure.subplots(*shape, sharex=not is_row, squeeze=False).ravel()
        for panel, y_label in zip(axes, y_labels):
            panel.set(ylabel=y_label, xlabel=x_label if is_row or panel is axes[-1] else "")
        return figure, axes

    def figure(self, file, figure):
        """Writes a figure as SVG with its text as text, the same bytes at every call."""
        for panel in figure.axes:
            labels = panel.get_legend_handles_labels()[1]
            if labels and not figure.legends:
                ncols = min(len(labels), max(1, 120 // (8 + max(map(len, labels)))))
                panel.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=ncols, frameon=False)
        figure.savefig(self._output(file), format="svg", metadata={"Date": None})

    def _output(self, file):
        folder = pathlib.Path(self.options.output or pathlib.Path(self.options.dist, self.name))
        folder.mkdir(parents=True, exist_ok=True)
        return folder / file


def _forked_case(number):
    simulate, cases = _forked
    return simulate(cases[number])


def main(study, **extra):
    """Runs a study with the options of the command line; `extra` has further ones, with what argparse takes for each."""
    program = sys.modules[study.__module__]
    path = pathlib.Path(program.__file__)
    parser = argparse.ArgumentParser(description=program.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dist", default="dist", metavar="FOLDER", help="folder with the FMUs (default: dist)")
    parser.add_argument("--output", metavar="FOLDER", help="folder for CSV files and figures (default: DIST/SUBJECT/NAME)")
    parser.add_argument("--only", default="", metavar="TEXT", help="only the cases whose label contains this text")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    parser.add_argument("--heliotorque", metavar="FILE", help="the program (default: $HELIOTORQUE, or that of PATH)")
    for name, keywords in extra.items():
        parser.add_argument(f"--{name}", **keywords)
    # A negative value with a unit is no option: --angle -20deg.
    arguments = re.sub(r"\0(-\d)", r"=\1", "\0".join(sys.argv[1:])).split("\0") if len(sys.argv) > 1 else []
    options, others = parser.parse_known_args(arguments)
    name = f"{path.parent.name}/{path.stem}"
    try:
        if others:
            raise Failure(f"{name} does not take {others[0]}")
        study(Run(name, options, program.__doc__))
    except Failure as failure:
        print(f"{path.stem}: {failure}", file=sys.stderr)
        sys.exit(2)
