//! Dates where a variable is an epoch: read on the command line, shown beside the seconds.

use std::borrow::Cow;

use loader::Error;
use model_description::{Description, ScalarVariable, VariableKind, value};
use physics::environment::dates;
pub use planner::ephemeris::utc_date as date;

/// What the description of an epoch says.
const SAYS_EPOCH: &str = "past J2000 TDB";

/// Whether a variable is an epoch: a Real in s past J2000 TDB.
pub fn is_epoch(description: &Description, variable: &ScalarVariable) -> bool {
    matches!(variable.kind, VariableKind::Real { .. })
        && value::unit(description, variable) == Some("s")
        && variable.description.as_deref().is_some_and(|text| text.contains(SAYS_EPOCH))
}

/// A setting `name=value` with seconds for a date, where the variable is an epoch; any other as it is.
///
/// # Errors
///
/// What is neither a number with a unit nor a date.
pub fn in_seconds<'a>(description: &Description, setting: &'a str) -> Result<Cow<'a, str>, Error> {
    let Some((name, written)) = setting.split_once('=') else { return Ok(setting.into()) };
    let (name, written) = (name.trim(), written.trim());
    let mut named = description.variables.iter().filter(|it| it.name.eq_ignore_ascii_case(name));
    let Some(variable) = named.next().filter(|variable| is_epoch(description, variable)) else {
        return Ok(setting.into());
    };
    match value::read(description, variable, written) {
        Ok(_) => Ok(setting.into()),
        Err(misfit) => match dates::epoch_s(written) {
            Ok(epoch_s) => Ok(format!("{name}={epoch_s}").into()),
            Err(error) => {
                let (allowed, dated) = (misfit.allowed, dates::ALLOWED_DATE);
                let what = format!("found {written:?}, {error}, allowed: {allowed}, or {dated}");
                Err(Error::Value { variable: variable.name.clone(), what })
            }
        },
    }
}
