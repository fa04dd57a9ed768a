//! `cargo xtask install`: the program on the path, its library and FMUs where it looks for them from any folder.

use std::{
    env,
    path::{Path, PathBuf},
};

use crate::prefix::{PROGRAM_FOLDER, below};
use crate::shell::Outcome;
use crate::{build, dist, paths};

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
    paths::at(&folder, std::path::absolute(&folder))
}
