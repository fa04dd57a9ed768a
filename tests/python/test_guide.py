"""The guide's commands run in an empty folder and print what the guide shows.

A block `console` holds commands after `$ ` and what they print; a line `...` stands for any lines. The blocks of a page run one
after the other in one folder that has the tutorial's files. `cargo xtask bless guide` writes anew what they print, but for blocks with
`...`, and the tables of keys, which follow the schemas.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest
from fmpy import read_model_description

ROOT = pathlib.Path(__file__).resolve().parents[2]
BOOK = ROOT / "docs" / "src"
BLOCK = re.compile(r"(?m)^```console\n(.*?)^```$", re.DOTALL)
PAGES = sorted(page for page in BOOK.rglob("*.md") if BLOCK.search(page.read_text(encoding="utf-8")))
BLESS = "HELIOTORQUE_BLESS" in os.environ
# Pictures that commands of a page write and the guide shows. A drawing is the same everywhere; a simulation's last digits are not.
PICTURES = {
    "venus.svg": "venus.svg", "ten-days.svg": "ten-days.svg", "year.svg": "year.svg", "turn/burn.svg": "turn.svg",
    "torques.svg": "torques.svg", "comsat.svg": "comsat.svg", "cubesat-12u.svg": "cubesat.svg", "asteroid-orbiter.svg": "asteroid.svg",
    "sunshield-telescope.svg": "telescope.svg", "spinner.svg": "spinner.svg",
}
DRAWINGS = ("venus.svg",)
# What differs from run to run, from build to build, and in the last digits from processor to processor.
VARYING = [
    (r"(\d\.\d{8})\d{4,}", r"\1..."), (r"\bin \d+\.\d+ s\b", "in ... s"),
    (r"\{[0-9a-f-]{36}\}", "{...}"), (r"\b\d+ kB\b", "... kB"),
]
# A table of a file's keys, behind the name of its schema and of what is described.
KEYS = re.compile(r"(?m)^<!-- keys: (\w+) ?(\w*) -->\n((?:\|.*\n)*)")
UNIT = re.compile(r", in ((?:kg|k?m[23]?|s|deg|rad|rpm|K|N|Pa|Hz|W|J|sqrt\(kg\))(?:[ /][\w/]+)*?)(?= or |[,;:.]|$)")
SUFFIXES = {"_m_s": "m/s", "_m": "m", "_s": "s", "_rad": "rad", "_deg": "deg"}
# What stands in backticks like a variable and is none: keys and calls of other things.
NO_VARIABLES = re.compile(r"\.(md|rs|py|toml|svg|csv|json|ssp|fmu|ssv|part|html|xml|bsp|spk)$|_|^numpy|^name\.|^io\.github\.|^x\.|/")


def plain(text):
    for pattern, replacement in VARYING:
        text = re.sub(pattern, replacement, text)
    return [line.rstrip() for line in text.rstrip("\n").split("\n")]


def steps(block):
    """Commands of a block, each with the lines shown below it."""
    found = []
    for line in block.splitlines():
        if line.startswith("$ "):
            found.append(([line[2:]], []))
        elif found and not found[-1][1] and found[-1][0][-1].endswith("\\"):
            found[-1][0].append(line)
        else:
            found[-1][1].append(line)
    return found


def shows(expected, printed):
    """Whether the lines are those printed, `...` standing for any."""
    pattern = "\n".join(r"(?:.*\n)*?.*" if line == "..." else re.escape(line.rstrip()) for line in expected)
    return re.fullmatch(pattern, "\n".join(printed)) is not None


@pytest.fixture(scope="module")
def installed(tmp_path_factory, heliotorque, dist):
    """The program with its library and FMUs, as `cargo xtask install` lays them out."""
    prefix = tmp_path_factory.mktemp("prefix")
    (prefix / "bin").mkdir()
    folder = prefix / "lib" / "heliotorque"
    folder.mkdir(parents=True)
    shutil.copy2(heliotorque, prefix / "bin" / "heliotorque")
    shutil.copy2(os.environ["HELIOTORQUE_LIBRARY"], folder / "libheliotorque.so")
    for fmu in [*pathlib.Path(dist).glob("*.fmu"), *pathlib.Path(dist).glob("*.ssp")]:
        shutil.copy2(fmu, folder)
    return prefix / "bin"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(BOOK)))
def test_a_page_prints_what_it_shows(page, installed, dist, tmp_path):
    is_gallery = page.parent.name == "gallery"
    for file in (BOOK / "tutorial").iterdir():
        if file.suffix in (".toml", ".py") and not is_gallery:
            shutil.copy2(file, tmp_path)
    (tmp_path / "dist").symlink_to(pathlib.Path(dist).resolve())
    (tmp_path / "fmu-src").symlink_to(ROOT / "fmu-src")
    path = os.pathsep.join([str(installed), str(pathlib.Path(sys.executable).parent), os.environ["PATH"]])
    environment = {**os.environ, "PATH": path, "COLUMNS": "120"}
    text, wrong = page.read_text(encoding="utf-8"), []

    def run(match):
        block = match.group(1)
        written = []
        for lines, expected in steps(block):
            ran = subprocess.run(
                ["bash", "-c", "\n".join(lines)], cwd=tmp_path, env=environment, stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
            )
            printed = plain(ran.stdout) if ran.stdout else []
            assert ran.returncode == 0 or not is_gallery, [lines, printed]
            if not shows(expected, printed):
                wrong.append("\n".join(["$ " + "\n".join(lines), *printed]))
            written += ["$ " + "\n".join(lines), *(expected if "..." in expected else printed)]
        return "```console\n" + "\n".join(written) + "\n```"

    blessed = BLOCK.sub(run, text)
    if BLESS:
        page.write_text(blessed, encoding="utf-8")
    else:
        assert not wrong, "\n".join(wrong)
    for written, shown in PICTURES.items():
        if (tmp_path / written).exists() and f"pictures/{shown})" in text:
            if BLESS:
                shutil.copy2(tmp_path / written, BOOK / "pictures" / shown)
            elif shown in DRAWINGS:
                assert (tmp_path / written).read_bytes() == (BOOK / "pictures" / shown).read_bytes(), shown


def resolved(schema, entry):
    """What describes a value; `null`, which is a key left out, aside."""
    for choice in entry.get("anyOf", []):
        if choice.get("type") != "null":
            entry = {**choice, **{k: v for k, v in entry.items() if k != "anyOf"}}
    name = entry.get("$ref", "").rpartition("/")[2]
    return {**schema["$defs"][name], **entry} if name else entry


def type_of(schema, entry):
    """The type of a value in words."""
    entry = resolved(schema, entry)
    if "enum" in entry or "const" in entry or "oneOf" in entry:
        if any("properties" in resolved(schema, it) for it in entry.get("oneOf", [])):
            return "table"
        return "item"
    if entry.get("format") == "unit vector":
        return "unit vector"
    types = entry.get("type", "any")
    kinds = [it for it in ([types] if isinstance(types, str) else types) if it != "null"]
    if kinds == ["array"]:
        element = type_of(schema, entry["items"])
        least, most = entry.get("minItems", 0), entry.get("maxItems")
        plural = element if " " in element or element == "text" else f"{element}s"
        if least != most:
            return f"list of {plural}"
        return f"{least} x {element}" if " " in element else f"{least} {plural}"
    return " or ".join({"string": "text", "object": "table", "array": "list"}.get(kind, kind) for kind in kinds)


def items(schema, entry):
    """The items that a value has, as text."""
    entry = resolved(schema, entry)
    entry = resolved(schema, entry["items"]) if "items" in entry else entry
    listed = entry.get("enum") or [it["const"] for it in entry.get("oneOf", []) if "const" in it]
    return f" One of {', '.join(f'`{item}`' for item in listed)}." if listed else ""


def rules(table, key):
    """The rules of a table that a key makes, as text."""
    def names(choices):
        return " or ".join(f"`{required}`" for choice in choices for required in choice["required"])

    found = ""
    for rule in table.get("allOf", []):
        if rule.get("if", {}).get("required") == [key]:
            above = " if above 0" if "properties" in rule["if"] else ""
            excluded = rule["then"].get("not")
            found += f" Not with {names(excluded['anyOf'])}." if excluded else f" Needs {names(rule['then']['anyOf'])}{above}."
        elif {"required": [key]} in rule.get("anyOf", []):
            found += f" Needed: {names(rule['anyOf'])}."
    return found


def key_table(name, described):
    """The table of keys by a schema."""
    schema = json.loads((ROOT / "fmu-src" / "resources" / f"{name}.schema.json").read_text(encoding="utf-8"))
    table = schema["$defs"][described] if described else schema
    rows = ["| key | type | unit | default | meaning |", "|---|---|---|---|---|"]
    for key, entry in sorted(table["properties"].items()):
        whole = resolved(schema, entry)
        meaning = " ".join(whole.get("description", "").split())
        unit = UNIT.search(meaning)
        unit = unit.group(1) if unit else next((it for end, it in SUFFIXES.items() if key.endswith(end)), "")
        default = whole.get("default")
        default = "" if default is None else "`" + re.sub(r"\.0\b", "", json.dumps(default)) + "`"
        shown = "*" if key in table.get("required", []) else default
        meaning = (UNIT.sub("", meaning, count=1) + items(schema, entry) + rules(table, key)).replace("|", "\\|")
        rows.append(f"| `{key}` | {type_of(schema, entry)} | {unit} | {shown} | {meaning} |")
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize("page", sorted(BOOK.glob("files/*.md")), ids=lambda page: page.name)
def test_tables_of_keys_follow_the_schemas(page):
    text = page.read_text(encoding="utf-8")
    anew = KEYS.sub(lambda found: found.group(0).split("\n")[0] + "\n" + key_table(*found.groups()[:2]), text)
    if BLESS:
        page.write_text(anew, encoding="utf-8")
    else:
        assert text == anew


def test_every_variable_that_the_guide_names_exists(dist):
    names = set()
    for fmu in pathlib.Path(dist).glob("*.fmu"):
        for variable in read_model_description(str(fmu)).modelVariables:
            parts = re.sub(r"\[[0-9,]+\]", "", variable.name).split(".")
            names |= {".".join(parts[:k]) for k in range(1, len(parts) + 1)}
    checked = set()
    for page in BOOK.rglob("*.md"):
        text = re.sub(r"(?ms)^```.*?^```", "", page.read_text(encoding="utf-8"))
        for name in re.findall(r"`([a-z][A-Za-z0-9]*(?:\[[a-z0-9,]+\])?(?:\.[a-zA-Z0-9*|]+(?:\[[a-z0-9,]+\])?)+)`", text):
            if NO_VARIABLES.search(name):
                continue
            # In a system, names begin with the component.
            plain = re.sub(r"\[[a-z0-9,]+\]", "", name).removesuffix(".*").removeprefix("plant.")
            head, _, last = plain.rpartition(".")
            for each in last.split("|"):
                checked.add(name)
                assert f"{head}.{each}".strip(".") in names, f"{page.relative_to(BOOK)}: `{name}`"
    assert len(checked) > 100


def test_the_tutorials_run():
    names = {str(page.relative_to(BOOK)) for page in PAGES}
    tutorials = {f"tutorial/{page}.md" for page in ("own-spacecraft", "low-earth-orbit", "own-controller", "spinner")}
    assert tutorials | {"commands.md"} <= names
