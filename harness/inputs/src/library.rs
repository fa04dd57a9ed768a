//! The library that judges what a file says of its mission, as the command of the file takes it.

use std::path::Path;

use files::outcome::Refusal;

use crate::{home, mission::Mission};

/// FMU of `--template`; otherwise the installed program's library, or a shipped FMU in `dist`.
#[derive(Clone, Copy)]
pub struct Library<'a> {
    template: Option<&'a Path>,
}

impl<'a> Library<'a> {
    /// By the option.
    pub fn new(template: Option<&'a Path>) -> Self {
        Self { template }
    }

    /// The option.
    pub fn template(self) -> Option<&'a Path> {
        self.template
    }

    /// Sentence on what is not judged where no library can be found; the mission is only read then.
    ///
    /// # Errors
    /// Everything wrong in the mission's file.
    pub fn unjudged(self, simulated: &Path) -> Result<Option<String>, Refusal> {
        let has_library =
            self.template.is_some() || home::library().is_some() || home::fmu(home::DEFAULT_MODEL).is_file();
        if has_library || simulated.extension().is_none_or(|extension| extension != "toml") {
            return Ok(None);
        }
        if Mission::read(simulated)?.fmu.is_some() {
            return Ok(None);
        }
        let shown = simulated.display();
        Ok(Some(format!(
            "; not judged, as no library was found (see --template): names, values and times by the variables of {shown}"
        )))
    }
}
