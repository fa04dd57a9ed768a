//! Context of drawings of a run: names from the spacecraft's file, and the values that quantities are compared with.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use fmi::Value;
use inputs::{mission::Limit, variables};
use model_description::{Description, labels};
use physics::{
    spacecraft::{Spacecraft, Thruster},
    spin::spinner::Spinner,
};

/// Names and bounds.
#[derive(Clone, Debug, Default)]
pub struct DisplayContext {
    names: BTreeMap<String, String>,
    bounds: BTreeMap<String, (String, f64)>,
    limits: BTreeMap<String, Vec<f64>>,
    /// Epoch of time 0 in s past J2000 TDB, where the flight has dates.
    pub zero_epoch_s: Option<f64>,
}

impl DisplayContext {
    /// Context of an FMU or a system: each part by the prefix of its variables and the folder it is unpacked in, the values set before
    /// the run, and its limits.
    pub fn new(
        parts: &[(String, PathBuf)],
        described: &Description,
        sets: &[(String, Value)],
        limits: &[Limit],
    ) -> Self {
        let mut known = Self::default();
        for (prefix, folder) in parts {
            for (counted, name) in names_in(folder) {
                known.names.insert(format!("{prefix}{counted}"), name);
            }
        }
        for variable in &described.variables {
            let bound = variable.annotation.as_ref().and_then(|it| it.limited_by.as_ref());
            let bound = bound.and_then(|name| Some((name, variables::real(described, sets, name)?)));
            if let Some((name, value)) = bound.filter(|(_, value)| *value > 0.0) {
                known.bounds.insert(variable.name.clone(), (bound_label(&variable.name, name), value));
            }
        }
        let labels = labels::of_groups(described).into_iter();
        known.names.extend(labels.map(|(group, label)| (group.to_owned(), label.to_owned())));
        for limit in limits {
            let values = [limit.min, limit.max].into_iter().flatten();
            known.limits.entry(limit.name.clone()).or_default().extend(values);
        }
        known
    }

    /// With the epoch of time 0 in s past J2000 TDB, where the flight has dates.
    #[must_use]
    pub fn dated(self, zero_epoch_s: Option<f64>) -> Self {
        Self { zero_epoch_s, ..self }
    }

    /// The name in the file of what a variable belongs to, such as that of `wheel[2]` for `wheel[2].speed`.
    pub fn name(&self, variable: &str) -> Option<&str> {
        let end = variable.rfind("].")? + 1;
        self.names.get(&variable[..end]).map(String::as_str)
    }

    /// Returns the bound of a variable in both directions: its name, and its value in the variable's unit.
    pub fn bound(&self, variable: &str) -> Option<(&str, f64)> {
        self.bounds.get(variable).map(|(label, value)| (label.as_str(), *value))
    }

    /// The limits that the mission sets it, in its unit.
    pub fn limits(&self, variable: &str) -> &[f64] {
        self.limits.get(variable).map_or(&[], Vec::as_slice)
    }
}

/// Returns the name of a bound in a picture: without what it has in common with the variable, and without the index of an element.
fn bound_label(variable: &str, bound: &str) -> String {
    let shared = variable.bytes().zip(bound.bytes()).take_while(|(one, other)| one == other).count();
    let own = bound[..shared].rfind('.').map_or(bound, |dot| &bound[dot + 1..]);
    variables::vector(own).unwrap_or(own).to_owned()
}

/// Panels, wheels, thrusters and tanks of the spacecraft in an FMU's resources, if there is one.
fn names_in(folder: &Path) -> Vec<(String, String)> {
    let Ok(entries) = fs::read_dir(folder.join("resources")) else { return Vec::new() };
    let files = entries.flatten().map(|entry| entry.path());
    let texts = files.filter_map(|path| fs::read_to_string(path).ok());
    texts.flat_map(|text| names_of(&text)).collect()
}

fn names_of(text: &str) -> Vec<(String, String)> {
    fn counted<T>(kind: &str, parts: &[T], name: fn(&T) -> &String) -> Vec<(String, String)> {
        let parts = parts.iter().enumerate();
        parts.map(|(k, part)| (format!("{kind}[{}]", k + 1), name(part).clone())).collect()
    }
    let thrusters = |thrusters: &[Thruster]| counted("thruster", thrusters, |thruster| &thruster.name);
    if let Ok(spacecraft) = Spacecraft::from_toml("", text) {
        return [
            counted("panel", &spacecraft.panels, |panel| &panel.name),
            counted("wheel", &spacecraft.wheels, |wheel| &wheel.name),
            thrusters(&spacecraft.thrusters),
            counted("tank", &spacecraft.tanks, |tank| &tank.name),
        ]
        .concat();
    }
    Spinner::parse("", text).map_or_else(|_| Vec::new(), |spinner| thrusters(&spinner.thrusters))
}

#[cfg(test)]
mod tests {
    //! Names and bounds of a plant within a system, and by itself.

    use super::*;

    const PLANT: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Plant" guid="{plant}">
  <CoSimulation modelIdentifier="Plant"/>
  <ModelVariables>
    <ScalarVariable name="p.dump.threshold[2]" valueReference="0" causality="parameter" variability="fixed"><Real start="4"/></ScalarVariable>
    <ScalarVariable name="p.momentum.body[2]" valueReference="1" causality="output"><Real/>
      <Annotations><Tool name="io.github.heliotorque"><Variable limitedBy="p.dump.threshold[2]"/></Tool></Annotations></ScalarVariable>
    <ScalarVariable name="p.wheel[1].speed" valueReference="2" causality="output"><Real/></ScalarVariable>
    <ScalarVariable name="p.plate[7].temperature" valueReference="3" causality="output" description="lid: Temperature."><Real/></ScalarVariable>
    <ScalarVariable name="p.plate[7].force[1]" valueReference="4" causality="output" description="lid: Force of sunlight."><Real/></ScalarVariable>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>"#;

    #[test]
    fn names_and_bounds_are_those_of_the_part() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("resources")).unwrap();
        fs::write(
            folder.path().join("resources").join("spacecraft.toml"),
            physics::spacecraft::MESSENGER_TOML,
        )
        .unwrap();
        let description = model_description::parse(PLANT.as_bytes()).unwrap().description;
        let parts = [("p.".to_owned(), folder.path().to_owned())];
        let limit =
            Limit { name: "p.wheel[1].speed".to_owned(), min: None, max: Some(3.0), at: String::new() };
        let known = DisplayContext::new(&parts, &description, &[], &[limit]);
        let spacecraft = Spacecraft::from_toml("", physics::spacecraft::MESSENGER_TOML).unwrap();
        assert_eq!(known.name("p.wheel[1].speed"), Some(spacecraft.wheels[0].name.as_str()));
        assert_eq!(known.name("p.plate[7].temperature"), Some("lid"));
        assert_eq!(known.name("p.momentum.body[2]"), None);
        assert_eq!(known.bound("p.momentum.body[2]"), Some(("dump.threshold", 4.0)));
        assert_eq!(known.bound("p.wheel[1].speed"), None);
        assert_eq!(known.limits("p.wheel[1].speed"), [3.0]);
        assert_eq!(bound_label("p.wheel[2].momentum", "p.wheel[2].capacity"), "capacity");
        assert_eq!(bound_label("sun.azimuth", "keepIn.azimuth"), "keepIn.azimuth");
        let set = [("p.dump.threshold[2]".to_owned(), Value::Real(7.0))];
        let set = DisplayContext::new(&parts, &description, &set, &[]);
        assert_eq!(set.bound("p.momentum.body[2]"), Some(("dump.threshold", 7.0)));
    }
}
