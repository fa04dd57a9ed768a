//! What times and angles on the command line mean.

use physics::{constants::ASTRONOMICAL_UNIT_M, environment::dates};

/// Seconds, or a number with a unit of time.
pub(crate) fn duration(text: &str) -> Result<f64, String> {
    const UNITS: [(&str, f64); 6] =
        [("ms", 1e-3), ("min", 60.0), ("s", 1.0), ("h", 3600.0), ("d", 86_400.0), ("", 1.0)];
    let text = text.trim();
    let unit = UNITS.iter().find(|(unit, _)| text.ends_with(unit));
    let (number, factor) =
        unit.map_or((text, 1.0), |(unit, factor)| (&text[..text.len() - unit.len()], *factor));
    match number.trim_end().parse::<f64>() {
        Ok(number) if (number * factor).is_finite() => Ok(number * factor),
        _ => Err("a time is a number of seconds or carries a unit: 600, 10min, 0.5h, 90d".to_owned()),
    }
}

/// A time of the simulation, or a date.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Instant {
    /// In s.
    Time(f64),
    /// In s past J2000 TDB.
    Epoch(f64),
}

/// A time or a date.
pub(crate) fn instant(text: &str) -> Result<Instant, String> {
    let ends = ["UTC", "TDB"].iter().any(|scale| text.trim_end().ends_with(scale));
    if !ends && !dates::looks_like_date(text) {
        return Ok(Instant::Time(duration(text)?));
    }
    dates::epoch_s(text)
        .map(Instant::Epoch)
        .map_err(|error| format!("{error}; allowed: {}", dates::ALLOWED_DATE))
}

/// A time that passes, so more than 0 s.
pub(crate) fn span(text: &str) -> Result<f64, String> {
    match duration(text)? {
        span_s if span_s > 0.0 => Ok(span_s),
        _ => Err("allowed is more than 0 s".to_owned()),
    }
}

/// An angle with its unit, in rad.
pub(crate) fn angle(text: &str) -> Result<f64, String> {
    let number = |unit: &str| text.trim().strip_suffix(unit)?.trim_end().parse::<f64>().ok();
    let angle_rad = number("deg").map(f64::to_radians).or_else(|| number("rad"));
    angle_rad
        .filter(|angle_rad| angle_rad.is_finite())
        .ok_or_else(|| "an angle carries its unit: 60deg, 1.2rad".to_owned())
}

/// A length with its unit, in m.
pub(crate) fn length(text: &str) -> Result<f64, String> {
    const UNITS: [(&str, f64); 5] =
        [("km", 1e3), ("cm", 1e-2), ("mm", 1e-3), ("AU", ASTRONOMICAL_UNIT_M), ("m", 1.0)];
    let text = text.trim();
    let number = |(unit, factor): &(&str, f64)| {
        Some(text.strip_suffix(unit)?.trim_end().parse::<f64>().ok()? * factor)
    };
    let length_m = UNITS.iter().find_map(number).filter(|length_m| length_m.is_finite());
    length_m.ok_or_else(|| "a length carries its unit: 200 km, 2 cm, 0.5 AU".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert!(instant("2009-04-06").unwrap_err().contains("UTC or TDB"));
        assert_eq!([length("200 km"), length("-1cm"), length("3 m")], [Ok(2e5), Ok(-0.01), Ok(3.0)]);
        assert!(length("200").is_err() && length("far").is_err());
        assert_eq!(span("1 h"), Ok(3600.0));
        for bad in ["0", "-5", "-1d", "soon"] {
            assert!(span(bad).is_err(), "{bad}");
        }
    }
}
