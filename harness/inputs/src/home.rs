//! Files that an installed program finds by its own path: its library and the shipped FMUs.

use std::path::{Path, PathBuf};

use model_description::Description;

/// Their folder relative to the program's; `cargo xtask install` puts them there.
const FROM_PROGRAM: &str = "../lib/heliotorque";
/// Folder of the FMUs of `cargo xtask dist`, for a program that is not installed.
const DIST: &str = "dist";

/// The model that is packed and read for unless another is named.
pub const DEFAULT_MODEL: &str = "MomentumPlant";

/// Values of `generationTool` by this project's exporter: its own name where a model names no tool.
const TOOLS: [&str; 2] = ["heliotorque", "fmi-export"];

/// Whether this project's exporter made the FMU with this description.
pub fn is_ours(description: &Description) -> bool {
    let tool = description.generation_tool.as_deref().and_then(|tool| tool.split(' ').next());
    tool.is_some_and(|tool| TOOLS.contains(&tool))
}

/// The folder beside the program, if the program is installed.
pub fn installed() -> Option<PathBuf> {
    // Behind links: a link to the program in another folder leads to its own.
    let program = std::env::current_exe().and_then(|program| files::canonical(&program)).ok()?;
    let folder = program.parent()?.join(FROM_PROGRAM);
    library_in(&folder).is_file().then(|| files::canonical(&folder).unwrap_or(folder))
}

/// The shared library of all models, if the program is installed.
pub fn library() -> Option<PathBuf> {
    installed().map(|folder| library_in(&folder))
}

/// The folder with the shipped FMUs: the installed program's, otherwise `dist`.
pub fn dist() -> PathBuf {
    installed().unwrap_or_else(|| PathBuf::from(DIST))
}

/// A shipped FMU.
pub fn fmu(model: &str) -> PathBuf {
    dist().join(format!("{model}.fmu"))
}

/// The file itself; a shipped FMU or system in place of one that is not there, named alone or in `dist`.
pub fn found(file: PathBuf) -> PathBuf {
    let is_shipped = file.parent().is_some_and(|folder| folder == Path::new("") || folder == Path::new(DIST));
    let shipped = file.file_name().filter(|_| is_shipped && !file.exists()).map(|name| dist().join(name));
    match shipped.filter(|shipped| shipped.is_file()) {
        Some(shipped) => {
            terminal::note(&format!("{} is not here: {}", file.display(), shipped.display()));
            shipped
        }
        None => file,
    }
}

fn library_in(folder: &Path) -> PathBuf {
    let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    folder.join(format!("{prefix}heliotorque{suffix}"))
}
