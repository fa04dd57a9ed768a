//! The pinned Python environment of the tests, under `target/`.

use std::path::PathBuf;

use crate::shell::{self, command, output, root, run};

/// Python interpreter of the tests' environment, set up on first use and again when the pins change.
pub fn interpreter() -> Result<PathBuf, String> {
    let requirements = root().join("tests").join("python").join("requirements.txt");
    let expected = std::fs::read_to_string(&requirements)
        .map_err(|error| format!("cannot read {}: {error}", requirements.display()))?;
    let folder = shell::target().join("python");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let stamp = folder.join("requirements.txt");
    if std::fs::read_to_string(&stamp).is_ok_and(|installed| installed == expected) && shell_ok(&python) {
        return Ok(python);
    }
    run(command("python3").args(["-m", "venv", "--clear"]).arg(&folder))?;
    run(command(&python)
        .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"])
        .arg(&requirements))?;
    std::fs::write(&stamp, expected).map_err(|error| format!("cannot write {}: {error}", stamp.display()))?;
    Ok(python)
}

/// Folder with the FMI headers, from the FMPy wheel.
pub fn fmi_headers() -> Result<PathBuf, String> {
    let code = "import fmpy, pathlib; print(pathlib.Path(fmpy.__file__).parent / 'c-code')";
    Ok(PathBuf::from(output(command(interpreter()?).args(["-c", code]))?.trim()))
}

fn shell_ok(python: &PathBuf) -> bool {
    command(python).arg("--version").output().is_ok_and(|output| output.status.success())
}
