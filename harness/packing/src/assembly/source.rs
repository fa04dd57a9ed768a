//! Sources of a new FMU's libraries and licences.

use std::{
    error::Error,
    fs, iter,
    path::{Path, PathBuf},
    sync::Arc,
};

use files::Entries;
use fmi::{Binary, Described, Fmu, Requirements};
use inputs::home;
use model_description::{Description, ReadError};
use physics::spacecraft::Spacecraft;
use toml::de::DeTable;

/// The licences of this project and of the crates it links, for FMUs packed from its own library.
const LICENSES: [(&str, &[u8]); 4] = [
    ("license.txt", include_bytes!("license.txt")),
    ("LICENSE-APACHE.txt", include_bytes!("../../../../LICENSE-APACHE")),
    ("LICENSE-MIT.txt", include_bytes!("../../../../LICENSE-MIT")),
    ("THIRD-PARTY.txt", include_bytes!("../../../../fmu-src/component/THIRD-PARTY.txt")),
];
/// Folder of licences by FMI 2.0.5 (2.3); `license.txt` there is the entry.
const FOLDER: &str = "documentation/licenses";

/// Shared libraries, one per platform, or an FMU with them.
pub struct Source {
    binary: Arc<Binary>,
    from: From,
}

/// Library for a platform.
struct Platform {
    /// Folder below `binaries/`.
    folder: &'static str,
    suffix: &'static str,
    path: PathBuf,
}

impl Platform {
    /// The host, whose library is loaded.
    fn host(path: PathBuf) -> Result<Self, String> {
        let folder = fmi::platform_folders().first().ok_or("FMI names no platform like this one")?;
        Ok(Self { folder, suffix: std::env::consts::DLL_SUFFIX, path })
    }

    /// Platform of a library file.
    fn of_file(path: PathBuf) -> Result<Self, Box<dyn Error>> {
        let requirements = Requirements::read(&path)?;
        let folder = requirements.platform_folders().first().ok_or_else(|| {
            format!(
                "{}: found {}, allowed: a platform that FMI names: see --library",
                path.display(),
                requirements.format
            )
        })?;
        Ok(Self { folder, suffix: requirements.suffix(), path })
    }
}

enum From {
    /// Libraries, the host's first, and the default model.
    Libraries(Vec<Platform>, Option<&'static str>),
    Template(Fmu),
}

impl Source {
    /// Opens what `--template` or `--library` names, otherwise the installed program's own library, otherwise a shipped FMU in
    /// `dist`.
    pub fn open(template: Option<&Path>, libraries: &[PathBuf]) -> Result<Self, Box<dyn Error>> {
        let own = || home::library().filter(|_| template.is_none());
        let given = libraries.first().map(|path| (path.clone(), None));
        let Some((first, model)) = given.or_else(|| own().map(|path| (path, Some(home::DEFAULT_MODEL))))
        else {
            let fallback = home::fmu(home::DEFAULT_MODEL);
            return Ok(Self::of_template(open_template(template.unwrap_or(&fallback))?)?);
        };
        for path in iter::once(&first).chain(libraries) {
            if let Some(found) = fs::metadata(path).ok().as_ref().and_then(files::kind) {
                let path = path.display();
                return Err(format!("{path}: found {found}, allowed: a regular file: see --library").into());
            }
        }
        // A bare file name would be searched in the system's library folders.
        let first = std::path::absolute(first)?;
        let binary = Arc::new(Binary::load(&first)?);
        let mut platforms = vec![Platform::host(first)?];
        for path in libraries.iter().skip(1) {
            let platform = Platform::of_file(path.clone())?;
            if let Some(other) = platforms.iter().find(|other| other.folder == platform.folder) {
                let (path, other, folder) = (path.display(), other.path.display(), platform.folder);
                return Err(format!(
                    "{path} is for {folder}, as {other} is, allowed: one a platform: see --library"
                )
                .into());
            }
            platforms.push(platform);
        }
        Ok(Self { binary, from: From::Libraries(platforms, model) })
    }

    /// The library of an FMU.
    pub fn of_template(fmu: Fmu) -> Result<Self, fmi::Error> {
        Ok(Self { binary: fmu.binary()?, from: From::Template(fmu) })
    }

    /// The host's library, or the template.
    pub fn path(&self) -> &Path {
        self.paths()[0]
    }

    /// The libraries or the template.
    pub fn paths(&self) -> Vec<&Path> {
        match &self.from {
            From::Libraries(platforms, _) => {
                platforms.iter().map(|platform| platform.path.as_path()).collect()
            }
            From::Template(fmu) => vec![fmu.source()],
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

    /// The model that is meant unless another is named: the one that the template holds.
    pub fn own_model(&self) -> Result<String, String> {
        match &self.from {
            From::Template(fmu) => model_of(fmu, &self.binary),
            From::Libraries(_, Some(model)) => Ok((*model).to_owned()),
            From::Libraries(_, None) => Err(which(&self.binary.models()?)),
        }
    }

    /// The model for a file: the one that is meant, or the first that takes another kind of file and this one.
    pub fn model_for(&self, file: Option<&str>, text: Option<&str>) -> Result<String, String> {
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
    pub fn add_libraries(
        &self,
        entries: &mut Entries,
        identifier: &str,
    ) -> Result<(), Box<dyn std::error::Error>> {
        match &self.from {
            From::Libraries(platforms, _) => {
                for Platform { folder, suffix, path } in platforms {
                    let bytes = files::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
                    entries.add(&format!("binaries/{folder}/{identifier}{suffix}"), bytes)?;
                }
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
            From::Libraries(..) => {
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
pub fn open_template(path: &Path) -> Result<Fmu, String> {
    Fmu::open(path).map_err(|error| {
        let reason = fmi::Error::chain(&error);
        format!(
            "{reason}\nA heliotorque FMU is needed, whose library reads the spacecraft: see --template (an installed program has \
             its own: cargo xtask install)"
        )
    })
}

/// The description that a library gave.
pub fn description(described: &Described) -> Result<Description, ReadError> {
    Ok(model_description::parse(described.xml.as_bytes())?.description)
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
pub fn spacecraft_of(fmu: &Fmu) -> Result<Spacecraft, Box<dyn Error>> {
    let binary = fmu.binary()?;
    let model = model_of(fmu, binary.as_ref())?;
    let setup = binary.models()?.into_iter().find(|it| it.model == model).and_then(|it| it.setup_file);
    let setup = setup.ok_or_else(|| format!("{model} holds no spacecraft"))?;
    let text = files::read_text(&fmu.folder().join("resources").join(&setup))?;
    Ok(Spacecraft::from_toml(&setup, &text).map_err(|error| error.to_string())?)
}

/// How many keys two files have in common, tables inside of tables left out.
pub fn common_keys(one: &str, other: &str) -> usize {
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
    let failed = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    let mut found = Vec::new();
    let mut folders = vec![(folder.to_owned(), String::new())];
    while let Some((folder, prefix)) = folders.pop() {
        let entries = match fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
            Err(error) => return Err(failed(&folder, error)),
        };
        for entry in entries {
            let path = entry.map_err(|error| failed(&folder, error))?.path();
            let name = format!("{prefix}{}", path.file_name().unwrap_or_default().to_string_lossy());
            if path.is_dir() {
                folders.push((path, format!("{name}/")));
            } else {
                found.push((name, files::read(&path).map_err(|error| failed(&path, error))?));
            }
        }
    }
    Ok(found)
}
