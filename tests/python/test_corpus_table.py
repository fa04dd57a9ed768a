"""FMPy's verdicts in modelDescription/tests/corpus/README.md are FMPy's; ours beside them are held by a Rust test."""

import re

import fmpy
import pytest

from corpus_table import CORPUS, cell, fmpys

README = (CORPUS / "README.md").read_text(encoding="utf-8")
VERDICTS = dict(re.findall(r"^\| \[(.+)\]\(\1\.xml\) \| [^|]+ \| (.+) \|$", README, re.MULTILINE))
# libxml2's wording changes from version to version.
SCHEMA = "ERROR (line "


def test_every_file_stands_in_the_table_once():
    files = {file.stem for file in CORPUS.glob("*.xml")} - {"valid"}
    assert set(VERDICTS) == files and README.count(".xml) |") == len(files)
    seen = sum(verdict != "nothing" for verdict in VERDICTS.values())
    assert f"Of {len(files)} faults we name {len(files)}, FMPy {seen}." in " ".join(README.split())
    assert f"FMPy {fmpy.__version__} reports" in " ".join(README.split())


def test_the_base_has_no_fault_for_fmpy():
    assert fmpys(CORPUS / "valid.xml") is None


@pytest.mark.parametrize("name", VERDICTS)
def test_the_verdict_is_fmpys(name):
    problem = fmpys(CORPUS / f"{name}.xml")
    found = "nothing" if problem is None else cell(problem)
    if VERDICTS[name].startswith(SCHEMA):
        assert found.startswith(SCHEMA)
    else:
        assert found == VERDICTS[name]
