//! Installation of each platform, as archives and as wheels in `dist/`.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use flate2::{Compression, write::GzEncoder};
use zip::{DateTime, ZipWriter, write::SimpleFileOptions};

use crate::build::{Built, scratch};
use crate::platforms::{ALL, Platform, WINDOWS};
use crate::shell::{Outcome, command, output, root, run};
use crate::{notices, paths, prefix, python};

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The project's licences, and those of the crates that the library links; those of the program are found by platform.
const LICENSES: [&str; 3] = ["LICENSE-APACHE", "LICENSE-MIT", "fmu-src/component/THIRD-PARTY.txt"];

/// Writes `dist/heliotorque-<version>-<platform>.tar.gz`, for Windows `.zip`.
pub(crate) fn write(built: &Built) -> Outcome {
    let folder = emptied("archives")?;
    for (platform, it) in ALL.iter().zip(built.each()) {
        let name = format!("heliotorque-{VERSION}-{}", platform.folder);
        let base = folder.join(&name);
        prefix::below(&base, it, Some(&built.heliotorque))?;
        add_licenses(&base, platform)?;
        let is_zip = platform.folder == WINDOWS.folder;
        let path = paths::dist(format!("{name}.{}", if is_zip { "zip" } else { "tar.gz" }));
        let written = if is_zip { zip(&folder, &name, &path) } else { tar(&folder, &name, &path) };
        paths::at(&path, written)?;
        println!("{}", path.display());
    }
    Ok(())
}

/// Archives the folder `name` in `folder`, by name, without owners and times.
fn tar(folder: &Path, name: &str, to: &Path) -> io::Result<()> {
    let mut tar = tar::Builder::new(GzEncoder::new(File::create(to)?, Compression::best()));
    tar.mode(tar::HeaderMode::Deterministic);
    for path in files_below(&folder.join(name))? {
        tar.append_path_with_name(&path, path.strip_prefix(folder).map_err(io::Error::other)?)?;
    }
    tar.into_inner()?.finish().map(drop)
}

/// The same for Windows.
fn zip(folder: &Path, name: &str, to: &Path) -> io::Result<()> {
    let mut zip = ZipWriter::new(File::create(to)?);
    let options = SimpleFileOptions::default().last_modified_time(DateTime::default());
    for path in files_below(&folder.join(name))? {
        let relative = path.strip_prefix(folder).map_err(io::Error::other)?;
        let relative = relative.to_string_lossy().replace('\\', "/");
        zip.start_file(relative, options).map_err(io::Error::other)?;
        io::copy(&mut File::open(&path)?, &mut zip)?;
    }
    zip.finish().map_err(io::Error::other).map(drop)
}

/// Files below a folder, by name.
fn files_below(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() { found.extend(files_below(&path)?) } else { found.push(path) }
    }
    found.sort();
    Ok(found)
}

/// Writes `dist/heliotorque-<version>-py3-none-<tag>.whl`.
pub(crate) fn write_wheels(built: &Built) -> Outcome {
    let folder = emptied("wheels")?;
    let source = root().join("harness").join("wheel");
    for (platform, it) in ALL.iter().zip(built.each()) {
        let whole = folder.join(platform.wheel_tag);
        let package = whole.join("heliotorque");
        prefix::below(&package, it, None)?;
        add_licenses(&package.join("licenses"), platform)?;
        prefix::copy(&source.join("heliotorque").join("__init__.py"), &package)?;
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
    paths::dist(format!("heliotorque-{VERSION}-py3-none-{}.whl", platform.wheel_tag))
}

fn add_licenses(folder: &Path, platform: &Platform) -> Outcome {
    LICENSES.iter().try_for_each(|name| prefix::copy(&root().join(name), folder).map(|_| ()))?;
    let file = folder.join("THIRD-PARTY-PROGRAM.txt");
    paths::write(&file, notices::of_program(platform.target)?)
}

/// An empty scratch folder.
fn emptied(name: &str) -> Result<PathBuf, String> {
    let folder = scratch(name)?;
    paths::at(&folder, fs::remove_dir_all(&folder).and_then(|()| fs::create_dir_all(&folder)))?;
    Ok(folder)
}

#[cfg(test)]
mod tests {
    //! Archives hold what the folder holds, whoever wrote it and when.

    use std::{fs::FileTimes, time::SystemTime};

    use super::*;

    #[test]
    fn archives_do_not_depend_on_the_time_of_their_files() {
        let scratch = tempfile::tempdir().unwrap();
        let base = scratch.path().join("base");
        fs::create_dir_all(base.join("bin")).unwrap();
        for (file, text) in [("bin/b", "b"), ("bin/a", "a"), ("license.txt", "text")] {
            fs::write(base.join(file), text).unwrap();
        }
        for (write, ending) in [(tar as fn(&Path, &str, &Path) -> _, "tar.gz"), (zip, "zip")] {
            let [first, second] =
                ["first", "second"].map(|name| scratch.path().join(format!("{name}.{ending}")));
            write(scratch.path(), "base", &first).unwrap();
            let later = FileTimes::new().set_modified(SystemTime::UNIX_EPOCH);
            File::options().write(true).open(base.join("bin/a")).unwrap().set_times(later).unwrap();
            write(scratch.path(), "base", &second).unwrap();
            assert!(fs::read(&first).unwrap() == fs::read(&second).unwrap(), "{ending}");
        }
        let file = File::open(scratch.path().join("first.tar.gz")).unwrap();
        let mut archive = tar::Archive::new(flate2::read::GzDecoder::new(file));
        let names = archive.entries().unwrap().map(|it| it.unwrap().path().unwrap().display().to_string());
        assert_eq!(names.collect::<Vec<_>>(), ["base/bin/a", "base/bin/b", "base/license.txt"]);
        let archive = zip::ZipArchive::new(File::open(scratch.path().join("first.zip")).unwrap()).unwrap();
        let names = archive.file_names().map(|it| it.unwrap().into_owned());
        assert_eq!(names.collect::<Vec<_>>(), ["base/bin/a", "base/bin/b", "base/license.txt"]);
    }
}
