"""The manual and the reference flight inside each FMU: what the page says to type runs, and `check` sees what deviates."""

import html
import re
import shutil
import subprocess
import sys
import zipfile

import pytest

FMUS = ["MomentumPlant", "MessengerFull", "DisturbanceTorque", "SpinPlant", "Guidance"]
FOLDER = "extra/org.fmi-standard.fmi-ls-ref"


def page_of(fmu):
    with zipfile.ZipFile(fmu) as archive:
        return archive.read("documentation/index.html").decode()


def sections(page):
    """The headings' ids in their order."""
    return re.findall(r'<h2 id="(\w+)">', page)


def code(page, section):
    (block,) = re.findall(rf'<h2 id="{section}">.*?<pre><code>(.*?)</code></pre>', page, re.DOTALL)[:1]
    return html.unescape(block)


def run(text, folder):
    ran = subprocess.run([sys.executable, "-c", text], cwd=folder, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def numbers(text):
    return [float(number) for number in re.findall(r"-?\d+\.?\d*(?:e[-+]?\d+)?", text)]


@pytest.mark.parametrize("name", FMUS)
def test_a_manual_begins_with_the_model_and_ends_with_its_flags(dist, name):
    found = sections(page_of(dist / f"{name}.fmu"))
    assert found[:5] == ["about", "example", "loop", "frames", "spacecraft"]
    assert found[-1] == "facts"


@pytest.mark.parametrize("name", FMUS)
def test_a_manuals_examples_run(dist, name, tmp_path):
    shutil.copy(dist / f"{name}.fmu", tmp_path)
    page = page_of(dist / f"{name}.fmu")
    first, loop = run(code(page, "example"), tmp_path), run(code(page, "loop"), tmp_path)
    assert any(value != 0 for value in numbers(first)), first
    # What each loop is for: the rates damped, the body on the Sun, the momentum along inertial Y, an attitude that is one.
    last = numbers(loop.split(":")[-1] if "off" not in loop else loop)
    if name in ("MomentumPlant", "MessengerFull"):
        assert all(abs(rate) < 1e-4 for rate in last), loop
    elif name == "DisturbanceTorque":
        assert abs(last[0]) < 1e-5, loop
    elif name == "SpinPlant":
        assert last[1] > 10 * max(abs(last[0]), abs(last[2])), loop
    else:
        assert sum(part**2 for part in last) == pytest.approx(1.0, abs=1e-12), loop


@pytest.mark.parametrize("name", FMUS)
def test_fmpy_meets_the_reference_flight_by_the_manuals_lines(dist, name, tmp_path):
    shutil.copy(dist / f"{name}.fmu", tmp_path)
    text = code(page_of(dist / f"{name}.fmu"), "reference")
    assert len([line for line in text.splitlines() if line.strip()]) <= 14
    found = run(text, tmp_path)
    (deviation,) = numbers(found.split("largest deviation:")[1])
    assert deviation <= 1e-9, found


def changed(fmu, into, change):
    """A copy of an FMU with one text of its reference flight changed."""
    with zipfile.ZipFile(fmu) as archive, zipfile.ZipFile(into, "w", zipfile.ZIP_DEFLATED) as copy:
        for entry in archive.infolist():
            content = archive.read(entry)
            if entry.filename.startswith(FOLDER):
                content = change(entry.filename.removeprefix(FOLDER + "/"), content.decode()).encode()
            copy.writestr(entry, content)
    return into


def check(heliotorque, fmu):
    return subprocess.run(
        [heliotorque, "check", str(fmu), "--probe", "reference", "--verbose"], capture_output=True, text=True
    )


@pytest.mark.parametrize("name", FMUS)
def test_check_replays_the_flight(dist, heliotorque, name):
    ran = check(heliotorque, dist / f"{name}.fmu")
    assert ran.returncode == 0, ran.stdout
    assert re.search(rf"{name}_out.csv: 41 rows of \d+ columns, (no deviation|the largest deviation \d)", ran.stdout)


def test_check_names_what_deviates(dist, heliotorque, tmp_path):
    def scale_last_row(name, text):
        if not name.endswith("_out.csv"):
            return text
        *rows, last = text.rstrip("\n").split("\n")
        column = rows[0].split(",").index("torque.total[1]")
        cells = last.split(",")
        cells[column] = repr(float(cells[column]) * (1 + 1e-6))
        return "\n".join([*rows, ",".join(cells)]) + "\n"

    fmu = changed(dist / "DisturbanceTorque.fmu", tmp_path / "DisturbanceTorque.fmu", scale_last_row)
    ran = check(heliotorque, fmu)
    assert ran.returncode == 1
    assert re.search(r"failed\s+DisturbanceTorque_out.csv: torque.total\[1\] at 2400 s: found .*, allowed: .* within 1e-9", ran.stdout)


def test_a_flight_without_a_stated_tolerance_is_judged_as_by_other_tools(dist, heliotorque, tmp_path):
    def bare(name, text):
        if name != "fmi-ls-manifest.xml":
            return text
        return re.sub(r">\s*<Annotations>.*?</Annotations>\s*</Related>", "/>", text, flags=re.DOTALL)

    # Without its inputs, which only the annotation names, a flight of constant start values is another one.
    ran = check(heliotorque, changed(dist / "DisturbanceTorque.fmu", tmp_path / "DisturbanceTorque.fmu", bare))
    assert ran.returncode == 1 and "no tolerance is stated" in ran.stdout, ran.stdout


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda name, text: text.replace("fmiReferences", "other"), "allowed: <fmiReferences>"),
        (lambda name, text: text.replace('_out.csv"', '_gone.csv"'), "_gone.csv"),
        (lambda name, text: text.replace('source="', 'source="../../../../../../'), "allowed: a file inside the FMU"),
        (lambda name, text: text.replace("time,", "when,"), "when"),
        (lambda name, text: text.replace("torque.total[1]", "torque.totally"), "no variable"),
    ],
    ids=["root", "missing", "outside", "header", "column"],
)
def test_a_flight_that_cannot_be_simulated_is_named(dist, heliotorque, tmp_path, change, expected):
    ran = check(heliotorque, changed(dist / "DisturbanceTorque.fmu", tmp_path / "DisturbanceTorque.fmu", change))
    assert ran.returncode == 1 and expected in ran.stdout, ran.stdout
