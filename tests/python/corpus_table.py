"""Prints modelDescription/tests/corpus/README.md: each fault with our verdict and FMPy's beside it.

    python tests/python/corpus_table.py > modelDescription/tests/corpus/README.md
"""

import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import fmpy
from fmpy.model_description import ValidationError, read_model_description

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / "modelDescription" / "tests" / "corpus"


def ours(files):
    """What the `findings` example prints, by file: a list of (severity, code)."""
    command = ["cargo", "run", "--quiet", "--release", "--package", "model-description",
               "--features", "reader", "--example", "findings", "--", *map(str, files)]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, encoding="utf-8")
    if run.returncode not in (0, 1) or run.stderr:
        sys.exit(f"the findings example failed: {run.stderr}")
    found = {file: [] for file in files}
    for line in run.stdout.splitlines():
        match = re.match(r"(.+\.xml): (?:line \d+: )?(error|warning) \[([a-z-]+)\]", line)
        if match:
            found[Path(match[1])].append((match[2], match[3]))
    return found


def fmpys(file):
    """FMPy's first problem with the file packed as an FMU, or None."""
    with tempfile.TemporaryDirectory() as folder:
        fmu = Path(folder) / "corpus.fmu"
        with zipfile.ZipFile(fmu, "w") as archive:
            archive.write(file, "modelDescription.xml")
        try:
            read_model_description(str(fmu), validate=True, validate_variable_names=True,
                                   validate_model_structure=True)
        except ValidationError as error:
            return error.problems[0]
        except Exception as error:  # FMPy answers some faults with a bare exception
            return f"{type(error).__name__}: {error}"
    return None


def cell(text):
    """Text that stays in its table cell."""
    text = " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;")
    text = re.sub(r"[^\x20-\x7e]", "?", text)
    return text if len(text) <= 110 else text[:107] + "..."


def main():
    files = sorted(CORPUS.glob("*.xml"))
    verdicts = ours(files)
    rows = []
    named = seen = 0
    for file in files:
        problem = fmpys(file)
        if file.stem == "valid":
            if verdicts[file] or problem:
                sys.exit(f"the base is not valid: {verdicts[file]} {problem}")
            continue
        own = sorted(set(verdicts[file]))
        named += bool(own)
        seen += problem is not None
        shown = ", ".join(f"{code} ({severity})" for severity, code in own) or "nothing"
        theirs = cell(problem) if problem is not None else "nothing"
        rows.append(f"| [{file.stem}]({file.name}) | {shown} | {theirs} |")
    total = len(rows)
    print("# Model descriptions with one fault each")
    print()
    print("Every file is [valid.xml](valid.xml) with the one fault that its name says. `ours` is what this crate's")
    print("reader or validator finds; `FMPy` is the first problem that `read_model_description` of FMPy")
    print(f"{fmpy.__version__} reports with all its checks on (XML schema, variable names, model structure).")
    print()
    print(f"Of {total} faults we name {named}, FMPy {seen}. In `valid.xml` both find nothing.")
    print()
    print("This file is printed by `tests/python/corpus_table.py`; the faults are listed in")
    print("`modelDescription/tests/main/faults.txt`.")
    print()
    print("| fault | ours | FMPy |")
    print("|---|---|---|")
    print("\n".join(rows))


if __name__ == "__main__":
    main()
