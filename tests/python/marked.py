"""Passages of the guide and the README that follow from something else: `cargo xtask bless guide` writes them anew.

A passage stands between lines `<!-- written: NAME -->` and `<!-- end -->`. A table keeps its head, a row the key of its first two cells.
"""

import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLESS = "HELIOTORQUE_BLESS" in os.environ
ANEW = "`cargo xtask bless guide` writes it anew"


def table_row(*cells):
    """A table's row in Markdown."""
    return "| " + " | ".join(cells) + " |"


def _passage(page, name):
    """The text of a page before a passage, the passage's lines, and the text from its end on."""
    text = (ROOT / page).read_text(encoding="utf-8")
    found = re.findall(rf"(?s)^(.*<!-- written: {re.escape(name)} -->\n\n)(.*?)(\n<!-- end -->.*)$", text)
    assert len(found) == 1, f"{page}: {len(found)} passages `<!-- written: {name} -->`"
    before, lines, after = found[0]
    return before, lines.splitlines(), after


def lines_of(page, name):
    """The lines of a passage."""
    return _passage(page, name)[1]


def _write(page, before, lines, after):
    (ROOT / page).write_text(before + "".join(f"{line}\n" for line in lines) + after, encoding="utf-8")


def hold(page, name, lines):
    """A passage has these lines."""
    before, old, after = _passage(page, name)
    if BLESS:
        _write(page, before, lines, after)
    else:
        assert old == lines, f"{page}, {name}: {ANEW}"


def hold_rows(page, name, rows):
    """A table has these rows below its head."""
    head = lines_of(page, name)[:2]
    assert head[1].startswith("|-"), f"{page}, {name}: no table"
    hold(page, name, head + list(rows))


def hold_row(page, name, *cells, key=2):
    """A table has this row; the first cells say which row of the table it is."""
    before, rows, after = _passage(page, name)
    beginning = table_row(*cells[:key]).removesuffix("|")
    [number] = [k for k, it in enumerate(rows) if it.startswith(beginning)]
    if BLESS:
        _write(page, before, [*rows[:number], table_row(*cells), *rows[number + 1:]], after)
    else:
        assert rows[number] == table_row(*cells), f"{page}, {name}: {ANEW}"
