//! Shipped missions to the flybys of Mercury: what they set, and the dates of their legs.

use model_description::Description;
use planner::{Failure, flyby::epoch_s};
use toml::{Table, Value};

use crate::settings::{Settings, set};

pub(super) const DAY_S: f64 = 86_400.0;

/// A shipped mission to a flyby.
pub(super) struct Mission {
    /// Name of its file.
    pub name: &'static str,
    text: &'static str,
    /// Up to when its legs are simulated, in s: seven hours and more before the closest approach, so that none ends in the planet.
    pub stop_s: f64,
    /// When the path is to be met again behind the flyby, UTC: the next flyby.
    next: &'static str,
}

/// 2008-01-14.
pub(super) const FLYBY_1: Mission = Mission {
    name: "messenger-flyby1.toml",
    text: include_str!("../../../../fmu-src/resources/examples/missions/messenger-flyby1.toml"),
    stop_s: 26.5 * DAY_S,
    next: "2008-10-06T08:40:00 UTC",
};
/// 2008-10-06.
pub(super) const FLYBY_2: Mission = Mission {
    name: "messenger-flyby2.toml",
    text: include_str!("../../../../fmu-src/resources/examples/missions/messenger-flyby2.toml"),
    stop_s: 201.0 * DAY_S,
    next: "2009-09-29T00:00:00 UTC",
};

impl Mission {
    /// What it sets, the epoch of its start among it.
    ///
    /// # Errors
    /// A file without start or values, values that the model does not take.
    pub(super) fn settings(&self, description: &Description) -> Result<Settings, Failure> {
        let file: Table = self.text.parse()?;
        let start = file.get("start").and_then(Value::as_str).ok_or("start: found none")?;
        let values = file.get("set").and_then(Value::as_table).ok_or("[set]: found none")?;
        let mut settings = set("start.epoch", epoch_s(start)?);
        for (name, value) in values {
            settings.extend(loader::parse_assignment(description, &format!("{name}={}", written(value)))?);
        }
        Ok(settings)
    }

    /// The date at which the path is to be met again, in s past J2000 TDB.
    pub(super) fn next_epoch_s(&self) -> f64 {
        epoch_s(self.next).unwrap_or(f64::NAN)
    }
}

/// A value as `--set` has it.
fn written(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(all) => all.iter().map(written).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    }
}
