//! Pinned Python environments under `target/`: the tests', Basilisk's, and the linker's for an older glibc.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shell::{self, command, output, root, run};

/// Python interpreter of the environment of studies and tests, set up on first use and again when the pins change.
pub(crate) fn interpreter() -> Result<PathBuf, String> {
    environment("python", &["harness/studies/requirements.txt", "tests/python/requirements.txt"])
}

/// `pytest` in that environment, which leaves no compiled files among the tests.
pub(crate) fn pytest() -> Result<Command, String> {
    let mut pytest = command(interpreter()?);
    pytest.args(["-m", "pytest", "-q"]).env("PYTHONDONTWRITEBYTECODE", "1");
    Ok(pytest)
}

/// Python interpreter with Basilisk, which the benchmarks alone need; its packages conflict with the tests'.
pub(crate) fn basilisk() -> Result<PathBuf, String> {
    environment("basilisk", &["tests/python/basilisk-requirements.txt"])
}

/// Folder with the programs `cargo-zigbuild` and `python -m ziglang`, which link for an older glibc.
pub(crate) fn zig_programs() -> Result<PathBuf, String> {
    let python = environment("zig", &["xtask/zig-requirements.txt"])?;
    python.parent().map(Path::to_path_buf).ok_or_else(|| format!("{} stands in no folder", python.display()))
}

/// The interpreter of a virtual environment under `target/` with the packages that these files pin.
fn environment(name: &str, requirements: &[&str]) -> Result<PathBuf, String> {
    let files = requirements.iter().map(|file| root().join(file));
    let read = |file: PathBuf| {
        std::fs::read_to_string(&file).map_err(|error| format!("cannot read {}: {error}", file.display()))
    };
    let expected = files.clone().map(read).collect::<Result<String, String>>()?;
    let folder = shell::target().join(name);
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let stamp = folder.join("requirements.txt");
    if std::fs::read_to_string(&stamp).is_ok_and(|installed| installed == expected) && shell_ok(&python) {
        return Ok(python);
    }
    run(command("python3").args(["-m", "venv", "--clear"]).arg(&folder))?;
    let files = files.flat_map(|file| ["-r".into(), file.into_os_string()]);
    run(command(&python)
        .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"])
        .args(files))?;
    std::fs::write(&stamp, expected).map_err(|error| format!("cannot write {}: {error}", stamp.display()))?;
    Ok(python)
}

/// Folder with the FMI headers, from the FMPy wheel.
pub(crate) fn fmi_headers() -> Result<PathBuf, String> {
    let code = "import fmpy, pathlib; print(pathlib.Path(fmpy.__file__).parent / 'c-code')";
    Ok(PathBuf::from(output(command(interpreter()?).args(["-c", code]))?.trim()))
}

fn shell_ok(python: &PathBuf) -> bool {
    command(python).arg("--version").output().is_ok_and(|output| output.status.success())
}
