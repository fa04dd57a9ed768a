//! Installation of each platform, as archives and as wheels in `dist/`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::build::{Built, scratch};
use crate::platforms::{ALL, Platform, WINDOWS};
use crate::shell::{Outcome, command, output, root, run};
use crate::{dist, install, notices, python};

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The project's licences, and those of the crates that the library links; those of the program are found by platform.
const LICENSES: [&str; 3] = ["LICENSE-APACHE", "LICENSE-MIT", "fmu-src/component/THIRD-PARTY.txt"];

/// Writes `dist/heliotorque-<version>-<platform>.tar.gz`, for Windows `.zip`.
pub(crate) fn write(built: &Built) -> Outcome {
    let folder = emptied("archives")?;
    for (platform, it) in ALL.iter().zip(built.each()) {
        let name = format!("heliotorque-{VERSION}-{}", platform.folder);
        let prefix = folder.join(&name);
        install::below(&prefix, it, Some(&built.heliotorque))?;
        add_licenses(&prefix, platform)?;
        let format = if platform.folder == WINDOWS.folder { "zip" } else { "gztar" };
        let code = "import shutil, sys; base, format, folder, name = sys.argv[1:]; \
                    print(shutil.make_archive(base, format, folder, name))";
        let archive = root().join("dist").join(&name);
        let mut make = command("python3");
        run(make.args(["-c", code]).arg(archive).arg(format).arg(&folder).arg(&name))?;
    }
    Ok(())
}

/// Builds for every platform, writes the wheels, then tests the host's.
pub(crate) fn wheels() -> Outcome {
    let built = dist::all_platforms()?;
    write_wheels(&built)?;
    try_wheel()
}

/// Writes `dist/heliotorque-<version>-py3-none-<tag>.whl`.
pub(crate) fn write_wheels(built: &Built) -> Outcome {
    let folder = emptied("wheels")?;
    let source = root().join("harness").join("wheel");
    for (platform, it) in ALL.iter().zip(built.each()) {
        let whole = folder.join(platform.wheel_tag);
        let package = whole.join("heliotorque");
        install::below(&package, it, None)?;
        add_licenses(&package.join("licenses"), platform)?;
        install::copy(&source.join("heliotorque").join("__init__.py"), &package)?;
        run(command("python3")
            .arg(source.join("build.py"))
            .arg(&whole)
            .args([VERSION, platform.wheel_tag])
            .arg(root().join("dist")))?;
    }
    Ok(())
}

/// Installs the host's wheel into a fresh virtual environment and simulates an FMU of it, by its own command and by FMPy.
pub(crate) fn try_wheel() -> Outcome {
    let folder = emptied("wheel-environment")?;
    run(command("python3").args(["-m", "venv"]).arg(&folder))?;
    let [python, program] = ["python", "heliotorque"].map(|name| folder.join("bin").join(name));
    run(command(&python).args("-m pip install --quiet --no-index".split(' ')).arg(wheel(&ALL[0])))?;
    let code = "import heliotorque; print(heliotorque.fmu('MomentumPlant'))";
    // In a folder without dist/.
    let fmu = output(command(&python).args(["-c", code]).current_dir(&folder))?;
    let fmu = PathBuf::from(fmu.trim());
    if !fmu.starts_with(&folder) {
        return Err(format!(
            "the FMU of the wheel is {}, allowed: below {}",
            fmu.display(),
            folder.display()
        ));
    }
    let own = folder.join("own.csv");
    let times = ["--stop", "1d", "--quiet", "--record", "momentum.body", "--output"];
    run(command(&program).arg("run").arg(&fmu).args(times).arg(&own).current_dir(&folder))?;
    run(command(python::interpreter()?).arg("tests/python/wheel.py").arg(&fmu).arg(&own))
}

/// The folder that the wheel of a platform was installed into, as pip does it for that platform.
pub(crate) fn installed(platform: &Platform) -> Result<PathBuf, String> {
    let folder = emptied(&format!("installed-{}", platform.folder))?;
    run(command(python::interpreter()?)
        .args("-m pip install --quiet --no-index --no-deps --only-binary :all: --platform".split(' '))
        .args([platform.wheel_tag, "--target"])
        .arg(&folder)
        .arg(wheel(platform)))?;
    Ok(folder)
}

/// The wheel of a platform.
fn wheel(platform: &Platform) -> PathBuf {
    root().join("dist").join(format!("heliotorque-{VERSION}-py3-none-{}.whl", platform.wheel_tag))
}

fn add_licenses(folder: &Path, platform: &Platform) -> Outcome {
    LICENSES.iter().try_for_each(|name| install::copy(&root().join(name), folder).map(|_| ()))?;
    let file = folder.join("THIRD-PARTY-PROGRAM.txt");
    let text = notices::of_program(platform.target)?;
    fs::write(&file, text).map_err(|error| format!("{}: {error}", file.display()))
}

/// An empty scratch folder.
fn emptied(name: &str) -> Result<PathBuf, String> {
    let folder = scratch(name)?;
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    fs::remove_dir_all(&folder).map_err(failed)?;
    fs::create_dir_all(&folder).map_err(failed)?;
    Ok(folder)
}
