//! Where a new FMU's libraries and licences come from.

use std::{fs, path::Path, path::PathBuf, sync::Arc};

use ::files::Entries;
use loader::{Binary, Described, Fmu};

use crate::args::Pack;

/// The licences of this project and of the crates it links, for FMUs packed from its own library.
const LICENSES: [(&str, &[u8]); 4] = [
    ("license.txt", include_bytes!("license.txt")),
    ("LICENSE-APACHE.txt", include_bytes!("../../../../LICENSE-APACHE")),
    ("LICENSE-MIT.txt", include_bytes!("../../../../LICENSE-MIT")),
    ("THIRD-PARTY.txt", include_bytes!("../../../../fmu-src/component/THIRD-PARTY.txt")),
];
/// Where FMI 2.0.5 keeps them (2.3); `license.txt` there is the entry.
const FOLDER: &str = "documentation/licenses";

/// A shared library, or an FMU that has one for each of its platforms.
pub struct Source {
    binary: Arc<Binary>,
    from: From,
}

enum From {
    Library(PathBuf),
    Template(Fmu),
}

impl Source {
    /// Opens what `--library` or `--template` names.
    pub fn open(arguments: &Pack) -> Result<Self, Box<dyn std::error::Error>> {
        let Some(path) = arguments.library.as_deref() else {
            let fmu = open_template(&arguments.template)?;
            return Ok(Self { binary: fmu.binary()?, from: From::Template(fmu) });
        };
        // A bare file name would be searched in the system's library folders.
        let path = std::path::absolute(path)?;
        if let Some(found) = fs::metadata(&path).ok().as_ref().and_then(files::kind) {
            let path = path.display();
            return Err(format!("{path}: found {found}, allowed: a regular file: see --library").into());
        }
        Ok(Self { binary: Arc::new(Binary::load(&path)?), from: From::Library(path) })
    }

    /// The library or template.
    pub fn path(&self) -> &Path {
        match &self.from {
            From::Library(path) => path,
            From::Template(fmu) => fmu.source(),
        }
    }

    /// Whether this file is the template.
    pub fn is_at(&self, path: &Path) -> bool {
        let From::Template(fmu) = &self.from else { return false };
        fs::canonicalize(path).is_ok_and(|path| fs::canonicalize(fmu.source()).is_ok_and(|own| own == path))
    }

    /// The library, for describing.
    pub fn binary(&self) -> &Binary {
        &self.binary
    }

    /// The model's name: `--model`, otherwise the one that the template holds.
    pub fn model(&self, arguments: &Pack) -> Result<String, String> {
        if let Some(model) = &arguments.model {
            return Ok(model.clone());
        }
        match &self.from {
            From::Template(fmu) => model_of(fmu, &self.binary),
            From::Library(_) => Err(which(&self.binary.models()?)),
        }
    }

    /// Adds the libraries under the FMU's own identifier.
    pub fn add_libraries(
        &self,
        entries: &mut Entries,
        identifier: &str,
    ) -> Result<(), Box<dyn std::error::Error>> {
        match &self.from {
            From::Library(path) => {
                let bytes = files::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
                let platform =
                    loader::platform_folders().first().ok_or("FMI names no platform like this one")?;
                let file = format!("binaries/{platform}/{identifier}{}", std::env::consts::DLL_SUFFIX);
                entries.add(&file, bytes)?;
            }
            From::Template(fmu) => {
                let old = &fmu.co_simulation()?.model_identifier;
                for (path, bytes) in files_below(&fmu.folder().join("binaries"))? {
                    let Some((platform, file)) = path.split_once('/') else { continue };
                    let renamed = match file.strip_prefix(old.as_str()) {
                        Some(suffix) if suffix.starts_with('.') => format!("{identifier}{suffix}"),
                        _ => file.to_owned(),
                    };
                    entries.add(&format!("binaries/{platform}/{renamed}"), bytes)?;
                }
            }
        }
        Ok(())
    }

    /// Adds the licences.
    pub fn add_licenses(&self, entries: &mut Entries) -> Result<(), Box<dyn std::error::Error>> {
        match &self.from {
            From::Library(_) => {
                for (name, bytes) in LICENSES {
                    entries.add(&format!("{FOLDER}/{name}"), bytes.to_vec())?;
                }
            }
            From::Template(fmu) => {
                for (name, bytes) in files_below(&fmu.folder().join(FOLDER))? {
                    entries.add(&format!("{FOLDER}/{name}"), bytes)?;
                }
            }
        }
        Ok(())
    }
}

/// Opens the FMU that libraries come from.
pub fn open_template(path: &Path) -> Result<Fmu, String> {
    Fmu::open(path).map_err(|error| {
        let reason = loader::Error::chain(&error);
        format!("{reason}\nA heliotorque FMU is needed, whose library reads the spacecraft: see --template")
    })
}

/// The model that a heliotorque FMU holds.
pub fn model_of(fmu: &Fmu, binary: &Binary) -> Result<String, String> {
    let models = binary.models()?;
    // An FMU with its own name is recognised by the GUID.
    let holds = |model: &Described| {
        let setup = model
            .setup_file
            .as_ref()
            .and_then(|file| files::read(&fmu.folder().join("resources").join(file)).ok())
            .and_then(|bytes| String::from_utf8(bytes).ok());
        let described = binary.describe(&model.model, None, setup.as_deref());
        described
            .ok()
            .and_then(|described| model_description::parse(described.xml.as_bytes()).ok())
            .is_some_and(|parsed| parsed.description.guid == fmu.description().guid)
    };
    match models.iter().find(|model| model.model == fmu.name() || holds(model)) {
        Some(model) => Ok(model.model.clone()),
        None => Err(which(&models)),
    }
}

fn which(models: &[Described]) -> String {
    let names: Vec<&str> = models.iter().map(|model| model.model.as_str()).collect();
    format!("which of {} shall it be? give --model", names.join(", "))
}

/// Every file below a folder with its path relative to it; nothing if there is no such folder.
fn files_below(folder: &Path) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut files = Vec::new();
    collect(folder, "", &mut files)?;
    Ok(files)
}

fn collect(folder: &Path, prefix: &str, files: &mut Vec<(String, Vec<u8>)>) -> Result<(), String> {
    let failed = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(failed(folder, error)),
    };
    for entry in entries {
        let path = entry.map_err(|error| failed(folder, error))?.path();
        let name = format!("{prefix}{}", path.file_name().unwrap_or_default().to_string_lossy());
        if path.is_dir() {
            collect(&path, &format!("{name}/"), files)?;
        } else {
            files.push((name, ::files::read(&path).map_err(|error| failed(&path, error))?));
        }
    }
    Ok(())
}
