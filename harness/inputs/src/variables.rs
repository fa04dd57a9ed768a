//! Variables by what people write of them: start values, settings, selections.

use fmi::{Error, Recording, Value};
use model_description::{Description, ScalarVariable, VariableKind, names, value};
use nalgebra::Vector3;

use crate::epoch::{self, Dates};
pub use model_description::start_values::{item, real, start};

/// The values of settings, written as for `--set`.
///
/// # Errors
/// What is no variable, and what it does not take.
pub fn assigned(description: &Description, settings: &[String]) -> Result<Vec<(String, Value)>, Error> {
    assigned_by(&Dates::new(description, settings.iter().map(String::as_str), None), description, settings)
}

/// The same where dates are counted by more than the settings.
///
/// # Errors
/// What is no variable, and what it does not take.
pub fn assigned_by(
    dates: &Dates<'_>,
    description: &Description,
    settings: &[String],
) -> Result<Vec<(String, Value)>, Error> {
    let mut sets = Vec::new();
    for setting in settings {
        sets.extend(fmi::parse_assignment(description, &dates.in_seconds(setting)?)?);
    }
    Ok(sets)
}

/// A momentum that no component reaches, in N m s: `dump.threshold` of flights without dumps.
pub const NEVER_N_M_S: f64 = 1e9;

/// Values of the elements of a vector.
pub fn elements(name: &str, vector: Vector3<f64>) -> impl Iterator<Item = (String, Value)> + use<> {
    let names = [1, 2, 3].map(|axis| format!("{name}[{axis}]"));
    names.into_iter().zip(<[f64; 3]>::from(vector).map(Value::Real))
}

/// The numbers of a recorded variable.
pub fn numbers(recording: &Recording, name: &str) -> Result<Vec<f64>, String> {
    let column = recording.column(name).ok_or_else(|| format!("the FMU has no output {name}"))?;
    Ok(column.numbers())
}

/// A recorded vector, row by row.
pub fn vectors(recording: &Recording, name: &str) -> Result<Vec<Vector3<f64>>, String> {
    let [x, y, z] = [1, 2, 3].map(|axis| numbers(recording, &format!("{name}[{axis}]")));
    let (x, y, z) = (x?, y?, z?);
    Ok((0..x.len()).map(|row| Vector3::new(x[row], y[row], z[row])).collect())
}

/// A warning for each name that is set more than once; `option` is where.
pub fn repeated(option: &str, settings: &[String]) -> Vec<String> {
    let name = |setting: &String| setting.split_once('=').map(|(name, _)| name.trim().to_lowercase());
    let later = |at: usize| settings[at + 1..].iter().rev().find(|other| name(other) == name(&settings[at]));
    let is_first = |at: usize| settings[..at].iter().all(|other| name(other) != name(&settings[at]));
    (0..settings.len())
        .filter(|at| is_first(*at))
        .filter_map(|at| Some((&settings[at], later(at)?)))
        .map(|(first, last)| format!("{option} {first} stands before {option} {last}, which counts"))
        .collect()
}

/// Says so on the terminal.
pub fn warn_of_repeated(option: &str, settings: &[String]) {
    repeated(option, settings).iter().for_each(|warning| terminal::note(&format!("warning: {warning}")));
}

/// Positions of everything that some patterns mean, each once; `select` says what one means.
///
/// # Errors
/// A pattern that means nothing.
pub fn selected(
    description: &Description,
    patterns: &[impl AsRef<str>],
    select: fn(&Description, &str) -> Result<Vec<usize>, Error>,
) -> Result<Vec<usize>, Error> {
    let mut positions = Vec::new();
    for pattern in patterns {
        let found = select(description, pattern.as_ref())?;
        positions
            .extend(found.into_iter().filter(|position| !positions.contains(position)).collect::<Vec<_>>());
    }
    Ok(positions)
}

/// Elements of one vector or matrix, which differ in their start values alone; or one variable.
pub struct VariableRow<'d>(&'d [&'d ScalarVariable]);

/// Variables in rows.
pub fn rows<'d>(variables: &'d [&'d ScalarVariable]) -> impl Iterator<Item = VariableRow<'d>> {
    let without_start = |kind: &VariableKind| {
        let mut kind = kind.clone();
        match &mut kind {
            VariableKind::Real { start, .. } => *start = None,
            VariableKind::Integer { start, .. } | VariableKind::Enumeration { start, .. } => *start = None,
            VariableKind::Boolean { start, .. } => *start = None,
            VariableKind::String { start, .. } => *start = None,
        }
        kind
    };
    let is_alike = move |one: &&ScalarVariable, other: &&ScalarVariable| {
        vector(&one.name).is_some()
            && vector(&one.name) == vector(&other.name)
            && (one.causality, one.variability) == (other.causality, other.variability)
            && one.description == other.description
            && without_start(&one.kind) == without_start(&other.kind)
    };
    variables.chunk_by(is_alike).map(VariableRow)
}

impl<'d> VariableRow<'d> {
    /// The first of them.
    pub fn first(&self) -> &'d ScalarVariable {
        self.0[0]
    }

    /// Its name: `momentum.body[1..3]`, `spacecraft.inertia[1..3,1..3]`.
    pub fn name(&self) -> String {
        let [first, .., last] = self.0 else { return self.first().name.clone() };
        let Some(vector) = vector(&first.name) else { return first.name.clone() };
        let indices = |name: &'d str| name[vector.len() + 1..].trim_end_matches(']').split(',');
        let ranges = indices(&first.name).zip(indices(&last.name));
        let range =
            |(from, to): (&str, &str)| if from == to { from.to_owned() } else { format!("{from}..{to}") };
        format!("{vector}[{}]", ranges.map(range).collect::<Vec<_>>().join(","))
    }

    /// Joins `text` of each, once where it is the same for all.
    pub fn joined(&self, text: impl Fn(&ScalarVariable) -> String) -> String {
        let mut texts: Vec<String> = self.0.iter().map(|variable| text(variable)).collect();
        if texts.iter().all(|text| *text == texts[0]) {
            texts.truncate(1);
        }
        texts.join(", ")
    }
}

/// The vector that an element is of.
pub fn vector(name: &str) -> Option<&str> {
    names::element(name).map(|(vector, _)| vector)
}

/// The start value, in the variable's unit, with the display unit or date behind it and the item's name.
pub fn start_text(description: &Description, variable: &ScalarVariable) -> String {
    match value::start(variable) {
        Some(Value::Real(start)) => {
            let date = epoch::is_epoch(variable).then(|| epoch::date(start)).flatten();
            match (date, fmi::display_unit(description, variable)) {
                (Some(date), _) => format!("{start} ({date})"),
                (None, Some((name, factor, offset))) if start != 0.0 => {
                    let shown = terminal::short(factor * start + offset);
                    format!("{} ({shown} {name})", terminal::short(start))
                }
                _ => terminal::short(start),
            }
        }
        Some(Value::Integer(start)) => {
            let item = value::items(description, variable).iter().find(|item| item.value == start);
            item.map_or_else(|| start.to_string(), |item| format!("{start} ({})", item.name))
        }
        Some(Value::Text(start)) => format!("{start:?}"),
        Some(truth) => truth.to_string(),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use model_description::value;

    use super::*;

    #[test]
    fn elements_that_are_alike_stand_in_a_row() {
        let variable = |name: &str, start: f64| ScalarVariable {
            name: name.to_owned(),
            kind: VariableKind::Real {
                declared_type: None,
                attributes: Default::default(),
                start: Some(start),
                derivative: None,
                reinit: None,
            },
            ..ScalarVariable::default()
        };
        let names = ["a[1]", "a[2]", "b", "c[1,1]", "c[1,2]", "c[2,1]", "c[2,2]", "d[3]", "e[2].f"];
        let all: Vec<ScalarVariable> = names.iter().map(|name| variable(name, 4.0)).collect();
        let all: Vec<&ScalarVariable> = all.iter().collect();
        let shown: Vec<String> = rows(&all).map(|row| row.name()).collect();
        assert_eq!(shown, ["a[1..2]", "b", "c[1..2,1..2]", "d[3]", "e[2].f"]);
        let [one, other] = [variable("a[1]", 1.0), variable("a[2]", 2.0)];
        let start =
            |variable: &ScalarVariable| value::start(variable).map_or(String::new(), |it| it.to_string());
        let starts: Vec<String> = rows(&[&one, &other]).map(|row| row.joined(start)).collect();
        assert_eq!(starts, ["1, 2"]);
        assert_eq!(rows(&all[..2]).next().unwrap().joined(start), "4");
    }

    #[test]
    fn a_name_that_is_set_twice_is_warned_of_once() {
        let settings = ["a=1", "b=2", " A =3", "a[1]=2", "a=4"].map(str::to_owned);
        assert_eq!(repeated("--set", &settings), ["--set a=1 stands before --set a=4, which counts"]);
        assert!(repeated("--set", &settings[..2]).is_empty());
    }
}
