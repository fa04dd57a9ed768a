"""Lists of the guide and the README are those of the program and the FMUs."""

import re
import subprocess

import pytest
from fmpy import read_model_description

from marked import BLESS, ROOT, hold, hold_rows, lines_of, table_row

MODELS = ("MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance")
FILES = ROOT / "docs" / "src" / "files"
pytestmark = pytest.mark.written


@pytest.fixture(scope="module")
def program(heliotorque):
    def run(*arguments):
        ran = subprocess.run([heliotorque, *arguments], capture_output=True, text=True, encoding="utf-8", check=True)
        return ran.stdout

    return run


def commands(program):
    """What `--help` lists: name and sentence of every command."""
    found = re.findall(r"(?m)^  ([a-z]+) {2,}(\S.*)$", program("--help"))
    return [(name, sentence) for name, sentence in found if name != "help"]


def page_of(model):
    """The file of a model's chapter: MomentumPlant's is momentum-plant.md."""
    return re.sub(r"(?<!^)([A-Z])", r"-\1", model).lower() + ".md"


def test_the_commands_are_those_of_the_help(program):
    found = commands(program)
    assert len(found) >= 15
    anchored = [table_row(f"[`{name}`](#{name})", sentence.replace("|", "\\|")) for name, sentence in found]
    hold_rows("docs/src/commands.md", "commands", anchored)


def test_the_isolated_commands_are_those_with_a_timeout(program):
    def is_isolated(*command):
        text = program(*command, "--help")
        below = re.findall(r"(?m)^  ([a-z]+) {2,}\S", text.partition("Commands:")[2].partition("Options:")[0])
        return "--timeout <" in text or any(is_isolated(*command, name) for name in below if name != "help")

    isolated = [name for name, _ in commands(program) if is_isolated(name)]
    assert {"run", "check", "sweep"} <= set(isolated)
    hold("docs/src/commands.md", "isolated", [", ".join(f"`{name}`" for name in isolated)])


@pytest.mark.parametrize("page, folder", [("README.md", "docs/src/models/"), ("docs/src/models.md", "models/")])
def test_the_fmus_are_described_as_in_their_xml(page, folder, dist):
    rows = []
    for model in MODELS:
        # The spacecraft's name stands before the model's sentence.
        _, _, sentence = read_model_description(str(dist / f"{model}.fmu")).description.partition(": ")
        rows.append(table_row(f"[`{model}`]({folder}{page_of(model)})", sentence))
    hold_rows(page, "fmus", rows)


def test_the_torques_are_those_of_the_fmus(dist):
    sources = {}
    for model in MODELS:
        for variable in read_model_description(str(dist / f"{model}.fmu")).modelVariables:
            if re.fullmatch(r"torque\.\w+\[1\]", variable.name):
                sources.setdefault(variable.name.removesuffix("[1]"), (variable.description, []))[1].append(model)
    assert len(sources) >= 10
    rows = [table_row(f"`{name}`", sentence, ", ".join(models)) for name, (sentence, models) in sources.items()]
    hold_rows("docs/src/theory.md", "torques", rows)


def test_the_kinds_of_files_are_those_of_new(program):
    found = re.findall(r"(?m)^ +- ([a-z]+): +(\S.*)$", program("new", "--help").partition("Options:")[0])
    assert len(found) >= 8
    rows = []
    for kind, sentence in found:
        folder = next(name for name in ("files", "gallery") if (FILES.parent / name / f"{kind}.md").exists())
        rows.append(table_row(f"[{kind}]({folder}/{kind}.md)", sentence))
    hold_rows("docs/src/files.md", "kinds", rows)


def test_the_readme_repeats_rows_of_the_guide():
    """What the README shows of the long tables is theirs, word for word; its rows are chosen by what they are of."""
    for name, page, key in (
        ("performance", "performance.md", 1), ("papers", "validation.md", 2), ("tools", "validation.md", 2),
    ):
        guide = [line for line in (FILES.parent / page).read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
        rows = []
        for shown in lines_of("README.md", name)[2:]:
            beginning = " | ".join(shown.split(" | ")[:key])
            [repeated] = [it for it in guide if it.startswith(f"{beginning} | ")]
            rows.append(repeated)
        hold_rows("README.md", name, rows)
    validation = lines_of("README.md", "papers")[2:] + lines_of("README.md", "tools")[2:]
    assert len(validation) == 6 and len(lines_of("README.md", "performance")) == 2 + 3
    assert sum("**off**" in it for it in validation) == 1 and any("Basilisk" in it for it in validation)


def test_every_chapter_of_the_theory_is_in_its_table():
    text = (FILES.parent / "theory.md").read_text(encoding="utf-8")
    chapters = sorted((FILES.parent / "theory").glob("*.md"))
    assert chapters and [it.name for it in chapters if f"(theory/{it.name})" not in text] == []


@pytest.mark.skipif(BLESS, reason="passages are being written")
def test_every_passage_is_written_by_a_test():
    names = set()
    for page in [ROOT / "README.md", *(ROOT / "docs" / "src").rglob("*.md")]:
        text = page.read_text(encoding="utf-8")
        found = re.findall(r"(?m)^<!-- written: (.*) -->$", text)
        assert len(found) == len(re.findall(r"(?m)^<!-- end -->$", text)), page
        names |= set(found)
    tests = "".join(file.read_text(encoding="utf-8") for file in (ROOT / "tests" / "python").glob("test_*.py"))
    assert {name for name in names if f'"{name}"' not in tests} == set()
