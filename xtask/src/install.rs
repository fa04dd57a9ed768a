//! `cargo xtask install`: the program on the path, its library and FMUs where it looks for them from any folder.

use std::{
    env,
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
};

use crate::build::Built;
use crate::shell::{self, Outcome, root, run};
use crate::{build, dist};

/// Folder of the program below the prefix.
const PROGRAM_FOLDER: &str = "bin";

/// Folder of the library and the FMUs below the prefix; the program looks there from its own folder.
const LIBRARY_FOLDER: [&str; 2] = ["lib", "heliotorque"];

/// Folder in which `man` looks for pages of commands, next to the folder of the program.
const MANUAL_FOLDER: [&str; 3] = ["share", "man", "man1"];

/// Leaves out building and packing.
const BUILT: &str = "--built";

/// Builds and packs everything, unless that is built already by an option, then copies it below the prefix that `options` name,
/// otherwise `~/.local`.
pub(crate) fn install(options: &[String]) -> Outcome {
    let is_built = options.iter().any(|option| option == BUILT);
    let others: Vec<String> = options.iter().filter(|option| *option != BUILT).cloned().collect();
    let prefix = prefix(&others)?;
    let built = if is_built { build::latest() } else { dist::dist()? };
    for installed in below(&prefix, &built, Some(&*built.heliotorque))? {
        println!("{}", installed.display());
    }
    let binaries = prefix.join(PROGRAM_FOLDER);
    let is_on_path = env::var_os("PATH").is_some_and(|path| env::split_paths(&path).any(|it| it == binaries));
    if !is_on_path {
        eprintln!(
            "{} is not on PATH; for this shell and, in its startup file, for others:\n  export PATH=\"{0}:$PATH\"",
            binaries.display()
        );
    }
    Ok(())
}

/// Copies program, library and FMUs of a platform below a prefix, for the host also systems and the manual.
pub(crate) fn below(
    prefix: &Path,
    built: &Built,
    writes_manual: Option<&Path>,
) -> Result<Vec<PathBuf>, String> {
    let under = |parts: &[&str]| parts.iter().fold(prefix.to_owned(), |path, part| path.join(part));
    let [binaries, folder, manual] = [&[PROGRAM_FOLDER], &LIBRARY_FOLDER[..], &MANUAL_FOLDER[..]].map(under);
    let mut files = vec![(built.heliotorque.clone(), &binaries), (built.library.clone(), &folder)];
    files.extend(packed("fmu")?.into_iter().map(|path| (path, &folder)));
    if let Some(program) = writes_manual {
        files.extend(packed("ssp")?.into_iter().map(|path| (path, &folder)));
        files.extend(pages(program)?.into_iter().map(|path| (path, &manual)));
    }
    files.iter().map(|(from, to)| copy(from, to)).collect()
}

fn prefix(options: &[String]) -> Result<PathBuf, String> {
    const ALLOWED: &str = "allowed: --prefix FOLDER, otherwise ~/.local; --built";
    let given = match options {
        [] => None,
        [flag, folder] if flag == "--prefix" => Some(folder.as_str()),
        [flag] => {
            Some(flag.strip_prefix("--prefix=").ok_or_else(|| format!("install: found {flag}; {ALLOWED}"))?)
        }
        other => return Err(format!("install: found {}; {ALLOWED}", other.join(" "))),
    };
    let folder = match given {
        Some("") => return Err(format!("install: --prefix names no folder; {ALLOWED}")),
        Some(folder) => PathBuf::from(folder),
        None => {
            let home = env::var_os("HOME").filter(|home| !home.is_empty());
            let home = home.ok_or_else(|| format!("install: there is no home folder (HOME); {ALLOWED}"))?;
            Path::new(&home).join(".local")
        }
    };
    std::path::absolute(&folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// The FMUs or systems of `dist/`, by name.
fn packed(extension: &str) -> Result<Vec<PathBuf>, String> {
    files_in(&root().join("dist"), extension)
}

/// The manual's pages, as the program writes them.
fn pages(program: &Path) -> Result<Vec<PathBuf>, String> {
    let folder = build::scratch("man")?;
    run(shell::command(program).args(["man", "--output"]).arg(&folder))?;
    files_in(&folder, "1")
}

/// The files of a folder with this extension, by name.
fn files_in(folder: &Path, extension: &str) -> Result<Vec<PathBuf>, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_file() && path.extension() == Some(OsStr::new(extension)) {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

/// Copies a file into a folder under its own name: whole or not at all, also over a program that runs.
pub(crate) fn copy(from: &Path, folder: &Path) -> Result<PathBuf, String> {
    let name = from.file_name().ok_or_else(|| format!("{} is no file", from.display()))?;
    let to = folder.join(name);
    let mut part = name.to_owned();
    part.push(".part");
    let part = folder.join(part);
    let copied =
        fs::create_dir_all(folder).and_then(|()| fs::copy(from, &part)).and_then(|_| fs::rename(&part, &to));
    copied.map_err(|error| format!("{}: {error}: see --prefix", to.display()))?;
    Ok(to)
}
