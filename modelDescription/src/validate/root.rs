//! The root element's attributes, the interfaces and the default experiment.

use super::{Check, Place};
use crate::finding::Code;
use crate::lexical::double;
use crate::names::is_c_identifier;
use crate::write::illegal_characters;

impl Check<'_> {
    pub(super) fn root(&mut self) {
        let all = self.description;
        for (name, text) in [("modelName", &all.model_name), ("guid", &all.guid)] {
            if text.trim().is_empty() {
                self.add(Code::EmptyText, Place::Root, format!("{name} is empty; it should name something"));
            }
        }
        if let Some(text) = &all.generation_date_and_time
            && !is_date_time(text)
        {
            let message = format!(
                "generationDateAndTime is `{text}`; allowed is an xs:dateTime such as 2026-01-02T03:04:05Z"
            );
            self.add(Code::DateTime, Place::Root, message);
        }
        if all.co_simulation.is_none() && all.model_exchange.is_none() {
            let message = "has neither CoSimulation nor ModelExchange; at least one is required".to_owned();
            self.add(Code::NoInterface, Place::Root, message);
        }
        for (element, name, c) in illegal_characters(all) {
            let message = format!(
                "attribute `{name}` of <{element}> holds U+{:04X}; allowed are tab, line breaks and characters from U+0020",
                u32::from(c)
            );
            self.add(Code::IllegalCharacter, Place::Root, message);
        }
    }

    pub(super) fn interfaces(&mut self) {
        let all = self.description;
        let model_exchange = all.model_exchange.as_ref().map(|it| {
            let states = (it.can_get_and_set_fmu_state, it.can_serialize_fmu_state);
            (Place::ModelExchange, &it.model_identifier, states, &it.source_files)
        });
        let co_simulation = all.co_simulation.as_ref().map(|it| {
            let states = (it.can_get_and_set_fmu_state, it.can_serialize_fmu_state);
            (Place::CoSimulation, &it.model_identifier, states, &it.source_files)
        });
        for (place, identifier, states, source_files) in model_exchange.into_iter().chain(co_simulation) {
            if !is_c_identifier(identifier) {
                let message = format!(
                    "modelIdentifier is `{identifier}`; allowed are letters, digits and `_`, not starting with a digit"
                );
                self.add(Code::ModelIdentifier, place, message);
            }
            if states == (false, true) {
                let message = "canSerializeFMUstate is true but canGetAndSetFMUstate is false; allowed is true with \
                               canGetAndSetFMUstate true";
                self.add(Code::SerializeWithoutState, place, message.to_owned());
            }
            self.unique(Code::DuplicateSourceFile, source_files.iter().map(String::as_str), |_| place);
        }
    }

    pub(super) fn experiment(&mut self) {
        let Some(experiment) = self.description.default_experiment else { return };
        for (name, time) in [("startTime", experiment.start_time), ("stopTime", experiment.stop_time)] {
            if let Some(time) = time.filter(|time| !time.is_finite()) {
                let message = format!("{name} is {}; allowed is a finite time in s", double(time));
                self.add(Code::ExperimentTime, Place::Experiment, message);
            }
        }
        let start = experiment.start_time.unwrap_or(0.0);
        if let Some(stop) = experiment.stop_time.filter(|stop| *stop < start) {
            let message =
                format!("stopTime {stop} s lies before startTime {start} s; allowed is startTime or later");
            self.add(Code::StopBeforeStart, Place::Experiment, message);
        }
        let above_zero = [
            ("stepSize", experiment.step_size, Code::StepSize),
            ("tolerance", experiment.tolerance, Code::Tolerance),
        ];
        for (name, value, code) in above_zero {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                let message = format!("{name} is {}; allowed is a finite number above 0", double(value));
                self.add(code, Place::Experiment, message);
            }
        }
    }
}

/// Whether the text is an xs:dateTime: `-?YYYY-MM-DDThh:mm:ss(.s+)?(Z|[+-]hh:mm)?`.
fn is_date_time(text: &str) -> bool {
    let Some((date, clock)) = text.split_once('T') else { return false };
    let mut date = date.strip_prefix('-').unwrap_or(date).splitn(3, '-');
    let (Some(year), Some(month), Some(day)) = (date.next(), date.next(), date.next()) else { return false };
    let year_digits = year.len() >= 4 && year.bytes().all(|b| b.is_ascii_digit());
    if !year_digits || (year.len() > 4 && year.starts_with('0')) {
        return false;
    }
    let (Some(month), Some(day)) = (two_digits(month, 12), two_digits(day, 31)) else { return false };
    // Only the last digits decide on leap years: 10000 is a multiple of 400.
    let year: u32 = year[year.len() - 4..].parse().unwrap_or(0);
    let leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let days = match month {
        2 => 28 + u32::from(leap),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    };
    if month == 0 || day == 0 || day > days {
        return false;
    }
    let zone = clock.find(['Z', '+', '-']).unwrap_or(clock.len());
    let (clock, zone) = clock.split_at(zone);
    let zone_good = match zone.split_at_checked(1) {
        None => true,
        Some(("Z", rest)) => rest.is_empty(),
        Some((_, rest)) => rest.split_once(':').is_some_and(|(hours, minutes)| {
            match (two_digits(hours, 14), two_digits(minutes, 59)) {
                (Some(14), Some(minutes)) => minutes == 0,
                (Some(_), Some(_)) => true,
                _ => false,
            }
        }),
    };
    let mut clock = clock.splitn(3, ':');
    let (Some(hours), Some(minutes), Some(seconds)) = (clock.next(), clock.next(), clock.next()) else {
        return false;
    };
    let (seconds, fraction) = seconds.split_once('.').unwrap_or((seconds, "0"));
    let fraction_good = !fraction.is_empty() && fraction.bytes().all(|b| b.is_ascii_digit());
    zone_good
        && fraction_good
        && match (two_digits(hours, 24), two_digits(minutes, 59), two_digits(seconds, 59)) {
            (Some(24), Some(minutes), Some(seconds)) => {
                minutes == 0 && seconds == 0 && fraction.bytes().all(|b| b == b'0')
            }
            (Some(_), Some(_), Some(_)) => true,
            _ => false,
        }
}

fn two_digits(text: &str, max: u32) -> Option<u32> {
    if text.len() != 2 || !text.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    text.parse().ok().filter(|value| *value <= max)
}
