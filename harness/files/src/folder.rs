//! Folders that take the files of a command.

use std::{
    fs, io,
    path::{Component, Path, PathBuf},
};

/// Folder for the files of a command, created where it is missing; what was created and is empty when this value is dropped goes again,
/// so that a command that is refused leaves none.
#[derive(Debug)]
pub struct OutputFolder {
    /// Created, the innermost last.
    created: Vec<PathBuf>,
}

impl OutputFolder {
    /// Creates a folder that `option` names, with those above it.
    ///
    /// # Errors
    /// A path that is no folder or cannot be created.
    pub fn create(path: &Path, option: &str) -> Result<Self, String> {
        let missing = path.ancestors().take_while(|it| !it.as_os_str().is_empty() && !it.exists());
        let mut created: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        created.reverse();
        let refused = |error: io::Error| format!("{}: {error}: see {option}", path.display());
        // Dropped, this removes what an error leaves.
        let folder = Self { created };
        fs::create_dir_all(path).map_err(refused)?;
        Ok(folder)
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        // A folder with anything in it is not removed.
        let _ = self.created.iter().rev().try_for_each(fs::remove_dir);
    }
}

/// Removes a file that a program of ours left; one that is gone needs no removing.
pub fn remove(path: &Path) -> Result<(), String> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(format!("{}: {error}", path.display())),
        _ => Ok(()),
    }
}

/// Whether a path, which need not be there yet, is a folder or a place in it, behind all links.
pub fn leads_below(path: &Path, folder: &Path) -> bool {
    let here = |path: &Path| if path.as_os_str().is_empty() { PathBuf::from(".") } else { path.to_owned() };
    // A link that leads to nothing yet is there, and leads nowhere.
    let there = path.ancestors().find(|it| fs::symlink_metadata(here(it)).is_ok()).unwrap_or(path);
    let is_plain = |rest: &Path| rest.components().all(|part| matches!(part, Component::Normal(_)));
    path.strip_prefix(there).is_ok_and(is_plain)
        && fs::canonicalize(here(there))
            .is_ok_and(|there| fs::canonicalize(here(folder)).is_ok_and(|folder| there.starts_with(folder)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_created_and_stayed_empty_goes() {
        let scratch = tempfile::tempdir().unwrap();
        let deep = scratch.path().join("a/b");
        drop(OutputFolder::create(&deep, "--output").unwrap());
        assert!(!scratch.path().join("a").exists());
        let folder = OutputFolder::create(&deep, "--output").unwrap();
        fs::write(scratch.path().join("a/file"), "x").unwrap();
        drop(folder);
        assert!(!deep.exists() && scratch.path().join("a/file").exists());
        drop(OutputFolder::create(&scratch.path().join("a"), "--output").unwrap());
        assert!(scratch.path().join("a").exists());
        let refused = OutputFolder::create(&scratch.path().join("a/file/b"), "--output").unwrap_err();
        assert!(refused.ends_with("see --output"), "{refused}");
    }

    #[test]
    fn paths_lead_below_a_folder_behind_links() {
        let scratch = tempfile::tempdir().unwrap();
        let at = |name: &str| scratch.path().join(name);
        fs::create_dir_all(at("home/deep")).unwrap();
        fs::create_dir(at("away")).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(at("away"), at("home/link")).unwrap();
        for (name, expected) in [
            ("home", true),
            ("home/deep/new/newer", true),
            ("home/deep/../new", true),
            ("home/new/../../away", false),
            ("home/../away/new", false),
            ("away", false),
        ] {
            assert_eq!(leads_below(&at(name), &at("home")), expected, "{name}");
        }
        #[cfg(unix)]
        assert!(!leads_below(&at("home/link/new"), &at("home")));
    }
}
