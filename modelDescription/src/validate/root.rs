//! The root element's attributes, the interfaces and the default experiment.

use super::{Check, ElementLocation};
use crate::finding::Code;
use crate::lexical::double;
use crate::names::is_c_identifier;
use crate::write::illegal_characters;

impl Check<'_> {
    pub(super) fn root(&mut self) {
        let all = self.description;
        for (name, text) in [("modelName", &all.model_name), ("guid", &all.guid)] {
            self.require(!text.trim().is_empty(), Code::EmptyText, ElementLocation::Root, || {
                format!("{name} is empty; it should name something")
            });
        }
        if let Some(text) = &all.generation_date_and_time {
            self.require(is_date_time(text), Code::DateTime, ElementLocation::Root, || {
                format!(
                    "generationDateAndTime is `{text}`; allowed is an xs:dateTime such as 2026-01-02T03:04:05Z"
                )
            });
        }
        let has_interface = all.co_simulation.is_some() || all.model_exchange.is_some();
        self.require(has_interface, Code::NoInterface, ElementLocation::Root, || {
            "has neither CoSimulation nor ModelExchange; at least one is required".to_owned()
        });
        for (element, name, c) in illegal_characters(all) {
            let message = format!(
                "attribute `{name}` of <{element}> holds U+{:04X}; allowed are tab, line breaks and characters from U+0020",
                u32::from(c)
            );
            self.add(Code::IllegalCharacter, ElementLocation::Root, message);
        }
    }

    pub(super) fn interfaces(&mut self) {
        let all = self.description;
        let model_exchange = all.model_exchange.as_ref().map(|it| {
            let states = (it.can_get_and_set_fmu_state, it.can_serialize_fmu_state);
            (ElementLocation::ModelExchange, &it.model_identifier, states, &it.source_files)
        });
        let co_simulation = all.co_simulation.as_ref().map(|it| {
            let states = (it.can_get_and_set_fmu_state, it.can_serialize_fmu_state);
            (ElementLocation::CoSimulation, &it.model_identifier, states, &it.source_files)
        });
        for (place, identifier, states, source_files) in model_exchange.into_iter().chain(co_simulation) {
            self.require(is_c_identifier(identifier), Code::ModelIdentifier, place, || {
                format!(
                    "modelIdentifier is `{identifier}`; allowed are letters, digits and `_`, not starting with a digit"
                )
            });
            self.require(states != (false, true), Code::SerializeWithoutState, place, || {
                "canSerializeFMUstate is true but canGetAndSetFMUstate is false; allowed is true with canGetAndSetFMUstate true"
                    .to_owned()
            });
            self.unique(Code::DuplicateSourceFile, source_files.iter().map(String::as_str), |_| place);
        }
    }

    pub(super) fn experiment(&mut self) {
        let Some(experiment) = self.description.default_experiment else { return };
        for (name, time) in [("startTime", experiment.start_time), ("stopTime", experiment.stop_time)] {
            if let Some(time) = time.filter(|time| !time.is_finite()) {
                let message = format!("{name} is {}; allowed is a finite time in s", double(time));
                self.add(Code::ExperimentTime, ElementLocation::Experiment, message);
            }
        }
        let start = experiment.start_time.unwrap_or(0.0);
        let stop = experiment.stop_time.unwrap_or(f64::INFINITY);
        let is_before_start = stop < start;
        self.require(!is_before_start, Code::StopBeforeStart, ElementLocation::Experiment, || {
            format!("stopTime {stop} s lies before startTime {start} s; allowed is startTime or later")
        });
        let above_zero = [
            ("stepSize", experiment.step_size, Code::StepSize),
            ("tolerance", experiment.tolerance, Code::Tolerance),
        ];
        for (name, value, code) in above_zero {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                let message = format!("{name} is {}; allowed is a finite number above 0", double(value));
                self.add(code, ElementLocation::Experiment, message);
            }
        }
    }
}

/// Whether the text is an xs:dateTime: `-?YYYY-MM-DDThh:mm:ss(.s+)?(Z|[+-]hh:mm)?`.
fn is_date_time(text: &str) -> bool {
    let date_and_clock = text.split_once('T');
    date_and_clock.is_some_and(|(date, clock)| is_date(date) == Some(true) && is_clock(clock) == Some(true))
}

fn is_date(date: &str) -> Option<bool> {
    let mut parts = date.strip_prefix('-').unwrap_or(date).splitn(3, '-');
    let year = parts.next()?;
    let (month, day) = (two_digits(parts.next()?, 12)?, two_digits(parts.next()?, 31)?);
    // Only the last digits decide on leap years: 10000 is a multiple of 400.
    let last: u32 = year.get(year.len().checked_sub(4)?..)?.parse().ok()?;
    let leap = last.is_multiple_of(4) && (!last.is_multiple_of(100) || last.is_multiple_of(400));
    let days = match month {
        2 => 28 + u32::from(leap),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    };
    let year_good = all_digits(year) && (year.len() == 4 || !year.starts_with('0'));
    Some(year_good && month > 0 && (1..=days).contains(&day))
}

fn is_clock(text: &str) -> Option<bool> {
    let (clock, zone) = text.split_at(text.find(['Z', '+', '-']).unwrap_or(text.len()));
    let zone_good = match zone.split_at_checked(1) {
        None => true,
        Some(("Z", rest)) => rest.is_empty(),
        Some((_, rest)) => {
            let (hours, minutes) = rest.split_once(':')?;
            (two_digits(hours, 14)?, two_digits(minutes, 59)?) <= (14, 0)
        }
    };
    let mut parts = clock.splitn(3, ':');
    let (hours, minutes) = (two_digits(parts.next()?, 24)?, two_digits(parts.next()?, 59)?);
    let seconds = parts.next()?;
    let (seconds, fraction) = seconds.split_once('.').unwrap_or((seconds, "0"));
    let seconds = two_digits(seconds, 59)?;
    let is_midnight = minutes == 0 && seconds == 0 && fraction.bytes().all(|b| b == b'0');
    Some(zone_good && all_digits(fraction) && (hours < 24 || is_midnight))
}

fn all_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

fn two_digits(text: &str, max: u32) -> Option<u32> {
    let value = text.parse().ok().filter(|_| text.len() == 2 && all_digits(text))?;
    (value <= max).then_some(value)
}
