//! A locale with a decimal comma, for the check that a host's locale changes no number.

use std::path::{Path, PathBuf};

use crate::paths::created;
use crate::shell::{command, lacks, need, run, target};

/// Its name, as `setlocale` takes it.
const NAME: &str = "de_DE.UTF-8";
/// Variable with the folder in which the C library searches for locales first.
const VARIABLE: &str = "LOCPATH";
/// Definition of the locale.
const SOURCE: &str = "/usr/share/i18n/locales/de_DE";

/// Returns the variable that the tests need for the locale: none where it is installed already, or cannot be built.
pub(crate) fn environment() -> Result<Option<(&'static str, PathBuf)>, String> {
    let given = std::env::var_os(VARIABLE).is_some_and(|folder| is_in(Path::new(&folder)));
    if given || !cfg!(target_os = "linux") {
        return Ok(None);
    }
    let folder = target().join("locale");
    if !is_in(&folder) {
        let what_for = "the simulation under a comma locale";
        if !need("localedef", what_for)? {
            return Ok(None);
        }
        if !Path::new(SOURCE).exists() {
            return lacks(SOURCE, what_for).map(|()| None);
        }
        let locale = created(folder.clone())?.join(NAME);
        run(command("localedef").args(["-i", "de_DE", "-f", "UTF-8"]).arg(locale))?;
    }
    Ok(Some((VARIABLE, folder)))
}

fn is_in(folder: &Path) -> bool {
    folder.join(NAME).join("LC_NUMERIC").exists()
}
