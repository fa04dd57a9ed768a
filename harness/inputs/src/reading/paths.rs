//! Paths in files, which are relative to the file's folder.

use std::path::{Path, PathBuf};

use physics::toml::Place;
use serde::Deserialize;

use super::tables::Checked;
use crate::home;

macro_rules! paths {
    ($($(#[$about:meta])* $name:ident = $complete:expr;)+) => {$(
        $(#[$about])*
        #[derive(Clone, Debug, Deserialize, schemars::JsonSchema)]
        #[serde(transparent)]
        #[schemars(inline)]
        pub struct $name(String, #[serde(skip)] PathBuf);

        impl Checked for $name {
            fn check(&mut self, at: &Place<'_>, folder: &Path) {
                if self.0.is_empty() {
                    at.report("an empty string", "the path of a file");
                    return;
                }
                let complete: fn(&Path, &str, &Place<'_>) -> PathBuf = $complete;
                self.1 = complete(folder, &self.0, at);
            }
        }

        impl physics::toml::Written for $name {
            type Value = PathBuf;

            fn value(&self) -> PathBuf {
                self.1.clone()
            }
        }
    )+};
}

paths! {
    /// File that is read.
    InputFile = |folder, name, at| found(folder.join(name), at);
    /// File that is read; a shipped FMU stands in for one that is not there.
    ShippedFile = |folder, name, at| found(home::found(folder.join(name)), at);
    /// File or folder that is written; `-` is the standard output.
    OutputPath = |folder, name, _| if name == "-" { name.into() } else { folder.join(name) };
}

/// Reports a file that is missing, unless the key itself is refused.
fn found(path: PathBuf, at: &Place<'_>) -> PathBuf {
    if !path.exists() && !at.has_reported() {
        let found = format_args!("{}, which is not there", path.display());
        at.report(found, "a file; paths are relative to this one's folder");
    }
    path
}
