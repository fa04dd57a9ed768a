//! An FMU's files, put together: description from the library, spacecraft with its start values, libraries.

use std::path::Path;

use files::Entries;
use fmi::{Binary, Described};
use inputs::{kind::FileKind, mission::Mission};
use model_description::Description;
use physics::toml::nearest;

use super::{
    orbit_default, per_plate, schedule,
    source::{Source, description, taker},
    start,
};

/// Parts of an FMU.
#[derive(Clone, Copy, Default)]
pub struct Parts<'a> {
    /// The spacecraft; otherwise the model's own.
    pub spacecraft: Option<&'a Path>,
    /// The model; otherwise the one that takes the spacecraft.
    pub model: Option<&'a str>,
    /// Commands over time.
    pub timeline: Option<&'a Path>,
    /// Positions over time.
    pub ephemeris: Option<&'a Path>,
    /// A mission that names some of these.
    pub origin: Option<&'a Mission>,
    /// A mission, whose values become start values.
    pub mission: Option<&'a Mission>,
    /// Start values, written as for `--set`.
    pub sets: &'a [String],
    /// Values of variables that become local constants, written as for `--set`.
    pub fixes: &'a [String],
    /// Whether plates have outputs.
    pub per_plate: bool,
    /// Its name; otherwise the model's.
    pub name: Option<&'a str>,
}

impl<'a> Parts<'a> {
    /// Takes the files that a mission names where no others are given; its values are left out.
    pub fn with_files_of(self, mission: &'a Mission) -> Result<Self, String> {
        if mission.fmu.is_some() {
            let file = mission.file.display();
            return Err(format!(
                "{file}: found `fmu`, which is packed already, allowed: spacecraft or model"
            ));
        }
        Ok(Self {
            spacecraft: self.spacecraft.or(mission.spacecraft.as_deref()),
            model: self.model.or(mission.model.as_ref().map(|model| model.it.as_str())),
            timeline: self.timeline.or(mission.timeline.as_deref()),
            ephemeris: self.ephemeris.or(mission.ephemeris.as_deref()),
            origin: Some(mission),
            ..self
        })
    }

    /// Refuses a model that the library does not have, if the mission names it.
    fn check_model(&self, source: &Source) -> Result<(), String> {
        let named = self.origin.and_then(|mission| Some((mission, mission.model.as_ref()?)));
        let Some((mission, model)) = named else { return Ok(()) };
        let models = source.binary().models()?;
        let names: Vec<&str> = models.iter().map(|model| model.model.as_str()).collect();
        if self.model != Some(&model.it) || names.contains(&model.it.as_str()) {
            return Ok(());
        }
        let near = nearest(&model.it, &names).map(|near| format!(" (did you mean {near:?}?)"));
        let (found, near) = (&model.it, near.unwrap_or_default());
        Err(model.problem(
            &mission.file,
            &format!("found the unknown model {found:?}{near}, allowed: {}", names.join(", ")),
        ))
    }
}

/// An FMU but for its documents.
pub struct Assembled {
    /// Description, libraries and resources.
    pub entries: Entries,
    /// Its name.
    pub identifier: String,
    /// Description of the model by itself.
    pub described: Described,
    /// The description with the FMU's own name and start values.
    pub description: Description,
    /// The text of the spacecraft.
    pub setup: String,
}

/// Puts an FMU together.
///
/// # Errors
/// Whatever the library refuses, and names and values that the model does not take.
pub fn assemble(source: &Source, parts: &Parts<'_>) -> Result<Assembled, Box<dyn std::error::Error>> {
    parts.check_model(source)?;
    let spacecraft = parts.spacecraft.map(|path| FileKind::Spacecraft.read(path)).transpose()?;
    let file = parts.spacecraft.map(|path| path.display().to_string());
    let model = match parts.model {
        Some(model) => model.to_owned(),
        None => source.model_for(file.as_deref(), spacecraft.as_deref())?,
    };
    let described =
        source.binary().describe(&model, file.as_deref(), spacecraft.as_deref()).map_err(|refusal| {
            with_hint(source.binary(), &model, file.as_deref(), spacecraft.as_deref(), refusal)
        })?;
    let mut description = description(&described)?;
    let mut setup = spacecraft.unwrap_or_else(|| described.default_setup.clone());
    let mut settings = Vec::new();
    if let Some(mission) = parts.mission {
        mission.resolve(&description, parts.sets, None)?;
        settings.extend(mission.settings(&description));
    }
    if let Some(epoch) = parts.origin.filter(|_| parts.mission.is_none()).and_then(|it| it.epoch_s())
        && start::has_dates(&setup)
    {
        // Dates in the file count from the epoch that the mission starts at.
        let at = parts.origin.map(|mission| epoch.place(&mission.file)).unwrap_or_default();
        let starts = inputs::epoch::starts(&description);
        settings.extend(starts.map(|it| (at.clone(), format!("{}={}", it.name, epoch.it))));
    }
    if let Some(mission) = parts.origin.filter(|_| parts.mission.is_none()) {
        let own = (&described, &description);
        settings.extend(orbit_default::of_mission(source.binary(), own, &setup, mission));
    }
    settings.extend(parts.sets.iter().map(|set| (format!("--set {set}"), set.clone())));
    let fixed = parts.fixes.iter().map(|fix| (format!("--fix {fix}"), fix.clone())).collect();
    for (table, settings) in [(start::START, settings), (start::FIXED, fixed)] {
        let Some((at, _)) = settings.first() else { continue };
        if described.setup_file.is_none() {
            return Err(format!("{at}: {model} reads no file that values could stand in").into());
        }
        setup = start::with_values(&setup, table, &model, &description, &settings)?;
        description = self::description(&source.binary().describe(&model, file.as_deref(), Some(&setup))?)?;
    }
    if parts.per_plate {
        // After the user's own text was read as it stands, so that errors name its lines.
        setup = per_plate::asking(&setup)?;
        description = per_plate::describe(source.binary(), &model, file.as_deref(), &setup)?;
    }
    if let Some(mission) = parts.mission {
        let mut experiment = description.default_experiment.unwrap_or_default();
        experiment.start_time = mission.start_s().or(experiment.start_time);
        experiment.stop_time = mission.stop_s().or(experiment.stop_time);
        experiment.step_size = mission.step_s.or(experiment.step_size);
        description.default_experiment = Some(experiment);
    }
    let mut schedules = Vec::new();
    let given = [
        (schedule::TIMELINE, FileKind::Timeline, parts.timeline),
        (schedule::EPHEMERIS, FileKind::Ephemeris, parts.ephemeris),
    ];
    for (kind, meant, path) in given {
        let Some(path) = path else { continue };
        let (shown, text) = (path.display().to_string(), meant.read(path)?);
        let given = (shown.as_str(), text.as_str());
        let name = kind.checked(source.binary(), &described, file.as_deref(), &setup, given)?;
        schedules.push((name, text));
    }
    let identifier = parts.name.unwrap_or(&model).to_owned();
    rename(&mut description, &identifier)?;

    let mut entries = Entries::default();
    entries.add("modelDescription.xml", model_description::to_xml(&description).into_bytes())?;
    source.add_libraries(&mut entries, &identifier)?;
    if let Some(name) = &described.setup_file {
        entries.add(&format!("resources/{name}"), setup.clone().into_bytes())?;
    }
    for (name, text) in schedules {
        entries.add(&format!("resources/{name}"), text.into_bytes())?;
    }
    Ok(Assembled { entries, identifier, described, description, setup })
}

/// A refusal, with the model that takes the file if it is of another kind than this model's.
fn with_hint(
    binary: &Binary,
    model: &str,
    file: Option<&str>,
    text: Option<&str>,
    refusal: String,
) -> String {
    let models = binary.models().unwrap_or_default();
    let own = models.iter().find(|it| it.model == model);
    match own.zip(text).and_then(|(own, text)| taker(binary, &models, own, file, text)) {
        Some(other) => format!("{refusal}\nthis is a file of {}: see --model", other.model),
        None => refusal,
    }
}

/// Gives the FMU its own name. The library finds its model by the GUID, which stays.
fn rename(description: &mut Description, identifier: &str) -> Result<(), String> {
    if !model_description::names::is_c_identifier(identifier) {
        return Err(format!(
            "--name {identifier:?} is no C identifier: letters, digits and _, not starting with a digit"
        ));
    }
    identifier.clone_into(&mut description.model_name);
    if let Some(co_simulation) = &mut description.co_simulation {
        identifier.clone_into(&mut co_simulation.model_identifier);
    }
    Ok(())
}
