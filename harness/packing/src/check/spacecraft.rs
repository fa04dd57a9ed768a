//! `heliotorque check my.toml`: whether a spacecraft can be packed.
//!
//! The library itself reads the file, so that what passes here passes in every FMU made from it.

use std::{collections::BTreeSet, error::Error, path::Path};

use drawing::scenes::dish_of;
use files::outcome::Refusal;
use fmi::{
    Described, Value,
    conformance::{Finding, Section},
};
use inputs::{reading::refusal, variables};
use model_description::Description;
use physics::{
    environment::sun::SOLAR_FLUX_W_M2,
    spacecraft::{Spacecraft, Thruster},
    spin::spinner::Spinner,
};
use toml::Table;

use super::figures::{self, Sunlight};
use crate::{
    assembly::{
        Parts, Source, assemble, can_read_map, common_keys, description, reference_flight, unused_map,
    },
    pointing,
};

/// Verdict on a file.
#[derive(Debug)]
pub enum Judged {
    /// Taken, with warnings.
    Taken {
        /// Figures, as text.
        summary: String,
        /// Warnings, a sentence each.
        warnings: Vec<String>,
    },
    /// Refused as a file of a kind.
    Refused {
        /// Problems.
        problems: Refusal,
        /// The kind.
        kind: String,
    },
}

impl Judged {
    /// Verdict as findings.
    pub fn section(&self) -> Section {
        match self {
            Self::Taken { summary, warnings } => {
                let warnings = warnings.iter().map(Finding::note);
                Section::new("file", [Finding::good(summary)].into_iter().chain(warnings))
            }
            Self::Refused { problems, kind } => Section::new(kind, problems.text.lines().map(Finding::bad)),
        }
    }
}

/// Text of the spacecraft that models have by default.
pub const DEFAULT_SPACECRAFT: &str = physics::spacecraft::MESSENGER_TOML;

/// Has the models of the template's library read the file, the template's own first.
///
/// # Errors
/// A library that cannot be opened or does not read the file.
pub fn judged(path: &Path, template: Option<&Path>, text: &str) -> Result<Judged, Box<dyn Error>> {
    let file = &*path.display().to_string();
    let source = Source::open(template, &[])?;
    let binary = source.binary();
    let own = source.own_model().ok();
    let mut refusals = Vec::new();
    let mut taken = None;
    let mut map = None;
    for model in binary.models()?.into_iter().filter(|model| model.setup_file.is_some()) {
        match binary.describe(&model.model, Some(file), Some(text)) {
            Ok(described) => {
                let description = description(&described)?;
                if can_read_map(&description) {
                    map = unused_map(text, &described.model, &description);
                }
                taken = taken.or(Some((described, description)));
            }
            Err(reason) => refusals.push((model, reason)),
        }
    }
    // A model that takes the rest of the file is one that its start values are for.
    let rest = without_start_values(text);
    let of_start = |model: &Described| {
        rest.as_ref().is_some_and(|rest| binary.describe(&model.model, None, Some(rest)).is_ok())
    };
    // The kinds of file are far apart: what the other models miss in it would hide what is wrong.
    let is_own = |model: &Described| Some(&model.model) == own.as_ref();
    let rank = |model: &Described| (common_keys(text, &model.default_setup), is_own(model));
    let fittest = refusals.iter().max_by_key(|(model, _)| rank(model));
    let of_start = refusals.iter().filter(|(model, _)| of_start(model)).max_by_key(|(model, _)| rank(model));
    // One that fits better and fails without its start values too has the reason.
    let has_reason = |model: &Described| fittest.is_none_or(|(best, _)| rank(model) >= rank(best));
    if let Some((model, problems)) = of_start.filter(|(model, _)| taken.is_some() || has_reason(model)) {
        return Ok(refused(model, counted(file, text, problems)));
    }
    // Each model takes its own kind of file; one that takes this one is enough.
    if let Some((described, description)) = taken {
        // What passes here can be packed, and an FMU that cannot simulate is not.
        let parts = Parts { spacecraft: Some(path), model: Some(&described.model), ..Parts::default() };
        let assembled = assemble(&source, &parts)?;
        let logged = match reference_flight(&assembled.entries, &described.reference_inputs) {
            Ok((_, logged)) => logged,
            Err(reason) => return Ok(refused(&described, format!("{file}: {reason}").into())),
        };
        let windows = pointing::windows_of(text);
        let points = pointing::sentence(&description, windows.as_slice())
            .map_or_else(String::new, |it| figures::row("points", &it));
        let windows = pointing::warnings(&description, &[], windows.as_slice());
        let (figures, own) = Spacecraft::from_toml("", text)
            .map_or_else(|_| levers(text), |it| figures::report(&it, sunlight(&description)));
        // Said once: the FMU's log warns of these too.
        let are_said = [("[planet_map]", map.is_some()), ("guided.downlinkStart", !windows.is_empty())];
        let is_new = |text: &&String| {
            let is_said = |(begin, is_said): &(&str, bool)| *is_said && text.starts_with(begin);
            !are_said.iter().any(is_said) && !own.iter().any(|it| it.contains(text.as_str()))
        };
        let warnings = own.iter().chain(&map).chain(&windows).chain(logged.iter().filter(is_new));
        let summary = format!(
            "{file}: ok for {}: {}; the FMU will have {} variables{points}{figures}",
            described.model,
            contents(text),
            description.variables.len()
        );
        return Ok(Judged::Taken { summary, warnings: warnings.cloned().collect() });
    }
    let Some(fittest) = fittest else {
        return Err(format!("{}: none of its models reads a file", source.path().display()).into());
    };
    let takes_the_same =
        |model: &Described| binary.describe(&model.model, None, Some(&fittest.0.default_setup)).is_ok();
    let chosen = refusals.iter().find(|(model, _)| is_own(model) && takes_the_same(model));
    let (model, problems) = chosen.unwrap_or(fittest);
    Ok(refused(model, counted(file, text, problems)))
}

/// How the FMU takes sunlight as it is packed.
fn sunlight(description: &Description) -> Sunlight {
    let start = |name: &str| variables::start(description, &[], name);
    Sunlight {
        flux_w_m2: start("solar.flux").map_or(SOLAR_FLUX_W_M2, |value| value.to_f64()),
        has_shadows: start("shadowing.enabled") == Some(Value::Boolean(true)),
    }
}

/// Problems that a model finds in the file.
fn refused(model: &Described, problems: Refusal) -> Judged {
    Judged::Refused { problems, kind: format!("a file of {}, which cannot be packed with it", model.model) }
}

/// Problems that a library lists, counted by the reader that the library has where it lists the same; otherwise a line each.
fn counted(file: &str, text: &str, listed: &str) -> Refusal {
    let read = [Spacecraft::from_toml(file, text).err(), Spinner::parse(file, text).err()];
    let mut known = read.into_iter().flatten().map(refusal);
    known.find(|it| it.text == listed).unwrap_or_else(|| {
        let lines = listed.lines().filter(|line| !line.starts_with(char::is_whitespace));
        Refusal { text: listed.to_owned(), count: lines.count().max(1) }
    })
}

/// The file without its start values, if it has any.
fn without_start_values(text: &str) -> Option<String> {
    let mut file: Table = text.parse().ok()?;
    file.remove("start")?;
    Some(file.to_string())
}

/// Devices of a spinner, and a warning for each thruster that turns nothing.
fn levers(text: &str) -> (String, Vec<String>) {
    let Ok(spinner) = Spinner::parse("", text) else { return Default::default() };
    let devices = figures::of_spinner(&spinner);
    let has_none =
        |thruster: &&Thruster| thruster.torque_body_n_m.norm() <= 1e-6 * thruster.force_body_n.norm();
    let warnings = spinner.thrusters.iter().filter(has_none).map(|thruster| {
        let name = &thruster.name;
        format!("thruster `{name}` has no lever: it pushes through the centre of mass and turns nothing")
    });
    (devices, warnings.collect())
}

/// How many of each part the file describes.
fn contents(text: &str) -> String {
    let mut parts = Vec::new();
    let mut count = |of: &str, count: usize| match count {
        0 => {}
        1 => parts.push(format!("1 {of}")),
        _ if of.ends_with('h') => parts.push(format!("{count} {of}es")),
        _ => parts.push(format!("{count} {of}s")),
    };
    if let Ok(spacecraft) = Spacecraft::from_toml("", text) {
        let dishes: BTreeSet<&str> = spacecraft.plates.iter().filter_map(|it| dish_of(&it.name)).collect();
        count("panel", spacecraft.panels.len());
        count("plate", spacecraft.plates.iter().filter(|it| dish_of(&it.name).is_none()).count());
        count("dish", dishes.len());
        count("wheel", spacecraft.wheels.len());
        count("thruster", spacecraft.thrusters.len());
        count("tank", spacecraft.tanks.len());
        count("instrument", spacecraft.instruments.len());
        count("antenna", spacecraft.antennas.len());
        if let Some(shade) = spacecraft.sunshade {
            count("sunshade plate", shade.plates.len());
            count("sunshade cylinder", usize::from(shade.cylinder.is_some()));
        }
    } else if let Ok(spinner) = Spinner::parse("", text) {
        count("group", spinner.groups.len());
        count("thruster", spinner.thrusters.len());
        count("star tracker", 1);
        count("Sun sensor", 1);
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    //! Parts are counted as the reader of the file gives them.

    use super::*;

    #[test]
    fn keys_in_common_are_counted_even_of_a_torn_file() {
        let file = "name = 1\n[mass]\nkg = 2\n[[wheels]]\nkg = 3\n";
        assert_eq!(common_keys(file, "kg = 1\n[mass]\n[[wheels]]\n[[wheels]]\n"), 2);
        assert_eq!(common_keys("name = 'A\n[mass]\n[[wheels]]\n", file), 3);
        assert_eq!(common_keys("", file), 0);
    }

    #[test]
    fn parts_are_counted() {
        let messenger = include_str!("../../../../fmu-src/resources/messenger.toml");
        assert_eq!(
            contents(messenger),
            "2 panels, 4 wheels, 5 instruments, 2 antennas, 8 sunshade plates, 1 sunshade cylinder"
        );
        let ace = include_str!("../../../../fmu-src/resources/ace.toml");
        assert_eq!(contents(ace), "8 groups, 10 thrusters, 1 star tracker, 1 Sun sensor");
        assert_eq!(contents("no toml"), "");
    }
}
