//! Dates where a variable is an epoch or a time of the simulation: read on the command line and in missions, shown beside the
//! seconds.

use std::borrow::Cow;

use fmi::Error;
use model_description::{Causality, Description, ScalarVariable, VariableRole, start_values, value};
pub use physics::constants::DAY_S;
use physics::environment::dates;

/// The UTC date of an epoch in s past J2000 TDB; `None` where UTC has no leap seconds yet.
pub fn date(epoch_s: f64) -> Option<String> {
    let date = dates::utc(epoch_s);
    dates::epoch_s(&date).is_ok_and(|read_s| (read_s - epoch_s).abs() <= 1e-3).then_some(date)
}

/// Epoch of an option's date, in s past J2000 TDB.
///
/// # Errors
/// What is no date, with what is allowed.
pub fn date_option(option: &str, written: &str) -> Result<f64, String> {
    dates::epoch_s(written)
        .map_err(|error| format!("{option}: found {written:?}, {error}, allowed: {}", dates::ALLOWED_DATE))
}

/// From when a parameter counts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Since {
    /// As the simulation does.
    Zero,
    /// From the start, where downlinks are counted from there.
    Start,
}

/// Parameters that are times.
const TIMES: [(&str, Since); 3] = [
    ("burn.start", Since::Zero),
    ("guided.downlinkStart", Since::Start),
    ("guided.downlinkEnd", Since::Start),
];
/// From where downlinks are counted, and its item for the start.
const REFERENCE: (&str, &str) = ("guided.downlinkReference", "start");

/// References of dates: the values that hold together, and the time of the start.
pub struct Dates<'a> {
    description: &'a Description,
    /// As for `--set`; the last one of a name counts.
    settings: Vec<&'a str>,
    start_s: f64,
}

impl<'a> Dates<'a> {
    /// In an FMU or a system with these settings, which begins at this time, otherwise at its own default.
    pub fn new(
        description: &'a Description,
        settings: impl IntoIterator<Item = &'a str>,
        start_s: Option<f64>,
    ) -> Self {
        let default_s = description.default_experiment.and_then(|experiment| experiment.start_time);
        let start_s = start_s.or(default_s).unwrap_or(0.0);
        Self { description, settings: settings.into_iter().collect(), start_s }
    }

    /// A setting `name=value` with seconds for a date, where the variable is an epoch or a time; any other as it is.
    ///
    /// # Errors
    ///
    /// What is neither a number with a unit nor a date, and a date that nothing is there to count by.
    pub fn in_seconds<'s>(&self, setting: &'s str) -> Result<Cow<'s, str>, Error> {
        let Some((name, written)) = setting.split_once('=') else { return Ok(setting.into()) };
        let (name, written) = (name.trim(), written.trim());
        let Some(variable) = self.variable(name) else { return Ok(setting.into()) };
        let time = TIMES.iter().find(|(time, _)| component(&variable.name, time).is_some());
        if time.is_none() && !is_epoch(variable) {
            return Ok(setting.into());
        }
        let Err(misfit) = value::read(self.description, variable, written) else { return Ok(setting.into()) };
        let refused = |what: String| Error::Value { variable: variable.name.clone(), what };
        let epoch_s = dates::epoch_s(written).map_err(|error| {
            let (allowed, dated) = (misfit.allowed, dates::ALLOWED_DATE);
            refused(format!("found {written:?}, {error}, allowed: {allowed}, or {dated}"))
        })?;
        let value_s = match time {
            None => epoch_s,
            Some((time, since)) => {
                let of = component(&variable.name, time).unwrap_or_default();
                self.time_s(of, *since, epoch_s)
                    .map_err(|why| refused(format!("found the date {written:?}, {why}")))?
            }
        };
        Ok(format!("{name}={value_s}").into())
    }

    /// The time of the simulation at an epoch.
    ///
    /// # Errors
    ///
    /// No epoch of the start, or components of a system that start at different ones.
    pub fn simulation_s(&self, epoch_s: f64) -> Result<f64, String> {
        let epochs = starts(self.description)
            .map(|it| self.epoch_s(&it.name).map(|epoch_s| (it.name.as_str(), epoch_s)));
        let epochs: Vec<(&str, f64)> = epochs.collect::<Result<_, String>>()?;
        let [(first, start_epoch_s), others @ ..] = &epochs[..] else { return Err(no_epoch()) };
        match others.iter().find(|(_, other_s)| other_s != start_epoch_s) {
            Some((other, _)) => {
                Err(format!("while {first} and {other} differ, allowed: a time, or equal epochs"))
            }
            None => Ok(self.start_s + dates::span_s(*start_epoch_s, epoch_s)),
        }
    }

    /// Value of a parameter of this component at an epoch.
    fn time_s(&self, component: &str, since: Since, epoch_s: f64) -> Result<f64, String> {
        let start =
            starts(self.description).find(|it| it.name.starts_with(component)).ok_or_else(no_epoch)?;
        let start_epoch_s = self.epoch_s(&start.name)?;
        let since_start_s = dates::span_s(start_epoch_s, epoch_s);
        if since == Since::Zero {
            return Ok(self.start_s + since_start_s);
        }
        let (name, item) = REFERENCE;
        let name = format!("{component}{name}");
        match self.item(&name) {
            Some(found) if found == item => Ok(since_start_s),
            found => {
                let found = found.unwrap_or("something else");
                Err(format!(
                    "while {name} is {found}, allowed: a time after that, or {name}={item} beside it"
                ))
            }
        }
    }

    fn variable(&self, name: &str) -> Option<&'a ScalarVariable> {
        self.description.variables.iter().find(|it| it.name.eq_ignore_ascii_case(name))
    }

    /// Value set for this name.
    fn set(&self, name: &str) -> Option<&'a str> {
        let values = self.settings.iter().filter_map(|setting| setting.split_once('='));
        values.rev().find(|(set, _)| set.trim().eq_ignore_ascii_case(name)).map(|(_, value)| value.trim())
    }

    /// The value of a variable, as set or by its start value.
    fn value(&self, name: &str) -> Option<(&'a ScalarVariable, value::Value)> {
        let variable = self.variable(name)?;
        let value = match self.set(name) {
            Some(written) => value::read(self.description, variable, written).ok(),
            None => value::start(variable),
        };
        Some((variable, value?))
    }

    fn epoch_s(&self, name: &str) -> Result<f64, String> {
        let dated = self.set(name).and_then(|written| dates::epoch_s(written).ok());
        let number = || match self.value(name)? {
            (_, value::Value::Real(epoch_s)) => Some(epoch_s),
            _ => None,
        };
        dated.or_else(number).ok_or_else(no_epoch)
    }

    fn item(&self, name: &str) -> Option<&'a str> {
        let (variable, value::Value::Integer(number)) = self.value(name)? else { return None };
        let items = value::items(self.description, variable);
        items.iter().find(|item| item.value == number).map(|item| item.name.as_str())
    }
}

fn no_epoch() -> String {
    "which nothing counts: there is no epoch of the start, allowed: a time in s or with a unit".to_owned()
}

/// Prefix of a name in a system, with its dot; empty in an FMU.
fn component<'a>(variable: &'a str, name: &str) -> Option<&'a str> {
    variable.strip_suffix(name).filter(|before| before.is_empty() || before.ends_with('.'))
}

/// Whether a variable is an epoch, in s past J2000 TDB.
pub fn is_epoch(variable: &ScalarVariable) -> bool {
    variable.role() == Some(VariableRole::Epoch)
}

/// The epochs of the start, one of an FMU, in a system those of its components.
pub fn starts(description: &Description) -> impl Iterator<Item = &ScalarVariable> {
    let fixed = [Causality::Parameter, Causality::Local];
    let epochs = description.with_role(VariableRole::Epoch);
    epochs.filter(move |it| fixed.contains(&it.causality) && value::start(it).is_some())
}

/// The epoch of time 0 in s past J2000 TDB in a flight from `start_s`, by the epochs that its parameters give, where they are one.
pub fn zero_epoch_s(description: &Description, sets: &[(String, value::Value)], start_s: f64) -> Option<f64> {
    let mut epochs_s = starts(description).filter_map(|it| start_values::real(description, sets, &it.name));
    let first_s = epochs_s.next()?;
    epochs_s.all(|other_s| other_s == first_s).then_some(first_s - start_s)
}

/// Whether a parameter of this name is a time that takes a date.
pub fn is_time(name: &str) -> bool {
    TIMES.iter().any(|(time, _)| *time == name)
}
