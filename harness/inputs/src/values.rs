//! Times and angles on the command line.

use model_description::quantity::{self, read_with_unit};
use physics::{constants::TIME_UNITS, environment::dates};

/// Seconds, or a number with a unit of time.
pub fn duration(text: &str) -> Result<f64, String> {
    quantity::read_in(text, TIME_UNITS).ok_or_else(|| {
        "a time is a number of seconds or carries a unit (ms, s, min, h, d, a): 600, 10min, 0.5h, 90d"
            .to_owned()
    })
}

/// A time of the simulation, or a date.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Instant {
    /// In s.
    Time(f64),
    /// In s past J2000 TDB.
    Epoch(f64),
}

impl Default for Instant {
    fn default() -> Self {
        Self::Time(0.0)
    }
}

impl Instant {
    /// Its time in a flight whose time 0 has this epoch; `None` for a date where it has none.
    pub fn time_s(self, zero_epoch_s: Option<f64>) -> Option<f64> {
        match self {
            Self::Time(time_s) => Some(time_s),
            Self::Epoch(epoch_s) => zero_epoch_s.map(|zero_s| dates::span_s(zero_s, epoch_s)),
        }
    }
}

/// A time or a date.
pub fn instant(text: &str) -> Result<Instant, String> {
    if !dates::looks_like_date(text) {
        return Ok(Instant::Time(duration(text)?));
    }
    dates::epoch_s(text)
        .map(Instant::Epoch)
        .map_err(|error| format!("{error}; allowed: {}", dates::ALLOWED_DATE))
}

/// A time that passes, so more than 0 s.
pub fn span(text: &str) -> Result<f64, String> {
    match duration(text)? {
        span_s if span_s > 0.0 => Ok(span_s),
        _ => Err("allowed is more than 0 s".to_owned()),
    }
}

/// An angle with its unit, in rad.
pub fn angle(text: &str) -> Result<f64, String> {
    read_with_unit(text, "rad").ok_or_else(|| "an angle carries its unit: 60deg, 1.2rad".to_owned())
}

/// A finite number that satisfies a condition, which `allowed` states.
pub fn number(text: &str, is_allowed: impl Fn(f64) -> bool, allowed: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite() && is_allowed(*number));
    number.ok_or_else(|| format!("allowed is {allowed}"))
}

/// A quantity above 0, in the SI unit of this name or with a unit.
pub fn positive(text: &str, unit: &str) -> Result<f64, String> {
    let value = quantity::read(text, unit).filter(|value| *value > 0.0);
    value.ok_or_else(|| format!("allowed is a number of {unit} above 0, or one with a unit"))
}

/// The names between commas; those between the indices of a matrix part none.
pub fn names(text: &str) -> Vec<String> {
    let mut depth = 0;
    let names = text.split(|letter| {
        depth += i32::from(letter == '[') - i32::from(letter == ']');
        letter == ',' && depth == 0
    });
    names.map(|name| name.trim().to_owned()).collect()
}

/// The names of an option that may be given several times.
pub fn all_names(texts: &[String]) -> Vec<String> {
    texts.iter().flat_map(|text| names(text)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_split_outside_brackets() {
        assert_eq!(names("a[1,2], b"), ["a[1,2]", "b"]);
        assert_eq!(all_names(&["*[1,2].x,y".to_owned(), "z".to_owned()]), ["*[1,2].x", "y", "z"]);
    }

    #[test]
    fn times_take_the_units_of_variables() {
        for (name, factor_s) in TIME_UNITS {
            let text = format!("3 {name}");
            assert_eq!(duration(&text), Ok(3.0 * factor_s));
            assert!((quantity::read(&text, "s").unwrap() / (3.0 * factor_s) - 1.0).abs() < 1e-15, "{name}");
        }
        assert_eq!(duration("15a"), Ok(473_364_000.0));
    }

    #[test]
    fn times_take_units() {
        assert_eq!(duration("90d"), Ok(7_776_000.0));
        assert_eq!(duration("10 min"), Ok(600.0));
        assert_eq!(duration("-1.5e3"), Ok(-1500.0));
        assert_eq!(duration("250ms"), Ok(0.25));
        for bad in ["", "d", "ten", "1e999", "nan", "3w"] {
            assert!(duration(bad).is_err(), "{bad}");
        }
        assert_eq!(instant("2 h"), Ok(Instant::Time(7200.0)));
        assert_eq!(instant("2009-04-06 TDB"), Ok(Instant::Epoch(292_248_000.0)));
        assert!(instant("2009-04-06").unwrap_err().contains("UTC, Z, TDB"));
        assert_eq!(span("1 h"), Ok(3600.0));
        for bad in ["0", "-5", "-1d", "soon"] {
            assert!(span(bad).is_err(), "{bad}");
        }
    }
}
