//! Where a new FMU's libraries and licences come from.

use std::{error::Error, fs, path::Path, path::PathBuf, sync::Arc};

use files::Entries;
use loader::{Binary, Described, Fmu};
use model_description::{Description, ReadError};
use physics::spacecraft::Spacecraft;
use toml::de::DeTable;

use crate::home;

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
pub(crate) struct Source {
    binary: Arc<Binary>,
    from: From,
}

enum From {
    /// A library, and the model that is meant unless another is named.
    Library(PathBuf, Option<&'static str>),
    Template(Fmu),
}

impl Source {
    /// Opens what `--template` or `--library` names, otherwise the installed program's own library, otherwise a shipped FMU in
    /// `dist`.
    pub(crate) fn open(
        template: Option<&Path>,
        library: Option<&Path>,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let own = || home::library().map(|path| (path, Some(home::DEFAULT_MODEL)));
        let library = match (template, library) {
            (None, None) => own(),
            (_, library) => library.map(|path| (path.to_owned(), None)),
        };
        let Some((path, model)) = library else {
            let fallback = home::fmu(home::DEFAULT_MODEL);
            return Ok(Self::of_template(open_template(template.unwrap_or(&fallback))?)?);
        };
        // A bare file name would be searched in the system's library folders.
        let path = std::path::absolute(path)?;
        if let Some(found) = fs::metadata(&path).ok().as_ref().and_then(files::kind) {
            let path = path.display();
            return Err(format!("{path}: found {found}, allowed: a regular file: see --library").into());
        }
        Ok(Self { binary: Arc::new(Binary::load(&path)?), from: From::Library(path, model) })
    }

    /// The library of an FMU.
    pub(crate) fn of_template(fmu: Fmu) -> Result<Self, loader::Error> {
        Ok(Self { binary: fmu.binary()?, from: From::Template(fmu) })
    }

    /// The library or template.
    pub(crate) fn path(&self) -> &Path {
        match &self.from {
            From::Library(path, _) => path,
            From::Template(fmu) => fmu.source(),
        }
    }

    /// Whether this file is the template.
    pub(crate) fn is_at(&self, path: &Path) -> bool {
        let From::Template(fmu) = &self.from else { return false };
        fs::canonicalize(path).is_ok_and(|path| fs::canonicalize(fmu.source()).is_ok_and(|own| own == path))
    }

    /// The library, for describing.
    pub(crate) fn binary(&self) -> &Binary {
        &self.binary
    }

    /// The model that is meant unless another is named: the one that the template holds.
    pub(crate) fn own_model(&self) -> Result<String, String> {
        match &self.from {
            From::Template(fmu) => model_of(fmu, &self.binary),
            From::Library(_, Some(model)) => Ok((*model).to_owned()),
            From::Library(_, None) => Err(which(&self.binary.models()?)),
        }
    }

    /// The model for a file: the one that is meant, or the first that takes another kind of file and this one.
    pub(crate) fn model_for(&self, file: Option<&str>, text: Option<&str>) -> Result<String, String> {
        let own = self.own_model()?;
        let Some(text) = text.filter(|text| self.binary.describe(&own, file, Some(text)).is_err()) else {
            return Ok(own);
        };
        let models = self.binary.models()?;
        let Some(of_own) = models.iter().find(|model| model.model == own) else { return Ok(own) };
        if let Some(taker) = taker(&self.binary, &models, of_own, file, text) {
            return Ok(taker.model.clone());
        }
        // None takes it: the kind that it has most of is judged.
        let common = |model: &Described| common_keys(text, &model.default_setup);
        let other = models.iter().filter(|model| is_other_kind(&self.binary, model, of_own));
        let nearest = other.max_by_key(|model| common(model)).filter(|model| common(model) > common(of_own));
        Ok(nearest.map_or(own, |model| model.model.clone()))
    }

    /// Adds the libraries under the FMU's own identifier.
    pub(crate) fn add_libraries(
        &self,
        entries: &mut Entries,
        identifier: &str,
    ) -> Result<(), Box<dyn std::error::Error>> {
        match &self.from {
            From::Library(path, _) => {
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
    pub(crate) fn add_licenses(&self, entries: &mut Entries) -> Result<(), Box<dyn std::error::Error>> {
        match &self.from {
            From::Library(..) => {
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

/// Whether a model reads files, of another kind than a second one's.
fn is_other_kind(binary: &Binary, model: &Described, than: &Described) -> bool {
    model.setup_file.is_some() && binary.describe(&model.model, None, Some(&than.default_setup)).is_err()
}

/// The first model that takes a file, and another kind of file than one that does not.
pub(super) fn taker<'m>(
    binary: &Binary,
    models: &'m [Described],
    refusing: &Described,
    file: Option<&str>,
    text: &str,
) -> Option<&'m Described> {
    let takes = |model: &&Described| {
        is_other_kind(binary, model, refusing) && binary.describe(&model.model, file, Some(text)).is_ok()
    };
    models.iter().find(takes)
}

/// Opens the FMU that libraries come from.
pub(crate) fn open_template(path: &Path) -> Result<Fmu, String> {
    Fmu::open(path).map_err(|error| {
        let reason = loader::Error::chain(&error);
        format!(
            "{reason}\nA heliotorque FMU is needed, whose library reads the spacecraft: see --template (an installed program has \
             its own: cargo xtask install)"
        )
    })
}

/// The description that a library gave.
pub(crate) fn description(described: &Described) -> Result<Description, ReadError> {
    Ok(model_description::parse(described.xml.as_bytes())?.description)
}

/// The model that a heliotorque FMU holds.
pub(crate) fn model_of(fmu: &Fmu, binary: &Binary) -> Result<String, String> {
    let models = binary.models()?;
    // An FMU with its own name is recognised by the GUID.
    let holds = |model: &Described| {
        let setup = model
            .setup_file
            .as_ref()
            .and_then(|file| files::read(&fmu.folder().join("resources").join(file)).ok())
            .and_then(|bytes| String::from_utf8(bytes).ok());
        let described = binary.describe(&model.model, None, setup.as_deref()).ok();
        let own = described.and_then(|described| description(&described).ok());
        own.is_some_and(|own| own.guid == fmu.description().guid)
    };
    match models.iter().find(|model| model.model == fmu.name() || holds(model)) {
        Some(model) => Ok(model.model.clone()),
        None => Err(which(&models)),
    }
}

/// The spacecraft that an FMU holds.
///
/// # Errors
/// A library without descriptions, a model without a spacecraft, a file of it that cannot be read.
pub(crate) fn spacecraft_of(fmu: &Fmu) -> Result<Spacecraft, Box<dyn Error>> {
    let binary = fmu.binary()?;
    let model = model_of(fmu, binary.as_ref())?;
    let setup = binary.models()?.into_iter().find(|it| it.model == model).and_then(|it| it.setup_file);
    let setup = setup.ok_or_else(|| format!("{model} holds no spacecraft"))?;
    let text = files::read_text(&fmu.folder().join("resources").join(&setup))?;
    Ok(Spacecraft::from_toml(&setup, &text).map_err(|error| error.to_string())?)
}

/// How many keys two files have in common, tables inside of tables left out.
pub(crate) fn common_keys(one: &str, other: &str) -> usize {
    // What can be read of a damaged file shows its kind too.
    let (one, other) = (DeTable::parse_recoverable(one).0, DeTable::parse_recoverable(other).0);
    one.get_ref().keys().filter(|key| other.get_ref().contains_key(*key)).count()
}

fn which(models: &[Described]) -> String {
    let names: Vec<&str> = models.iter().map(|model| model.model.as_str()).collect();
    format!("which of {} shall it be? give --model", names.join(", "))
}

/// Every file below a folder with its path relative to it; nothing if there is no such folder.
fn files_below(folder: &Path) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut found = Vec::new();
    collect(folder, "", &mut found)?;
    Ok(found)
}

fn collect(folder: &Path, prefix: &str, found: &mut Vec<(String, Vec<u8>)>) -> Result<(), String> {
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
            collect(&path, &format!("{name}/"), found)?;
        } else {
            found.push((name, files::read(&path).map_err(|error| failed(&path, error))?));
        }
    }
    Ok(())
}
