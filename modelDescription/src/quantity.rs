//! Quantities as people write them: a number and its unit, read by the table of units.

use crate::units;

/// Splits a text into a number and its unit, which may be empty. Words such as `inf` are no numbers, so that a unit may begin
/// with any letter.
pub fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let ends = (1..=text.len()).rev().filter(|&end| text.is_char_boundary(end));
    ends.filter(|&end| text[..end].trim_end().ends_with(|last: char| last.is_ascii_digit() || last == '.'))
        .find_map(|end| Some((text[..end].trim_end().parse().ok()?, text[end..].trim())))
}

/// Reads a finite quantity by the factors of units; a number alone has the factor 1.
pub fn read_in<'u>(text: &str, units: impl IntoIterator<Item = (&'u str, f64)>) -> Option<f64> {
    let (number, suffix) = split(text)?;
    let factor = match suffix {
        "" => 1.0,
        _ => units.into_iter().find(|(name, _)| *name == suffix)?.1,
    };
    Some(number * factor).filter(|value| value.is_finite())
}

/// Reads a quantity in the SI unit of this name, or in one of the units that it is shown in; a number alone is SI.
pub fn read(text: &str, unit: &str) -> Option<f64> {
    let shown = units::find(unit).into_iter().flat_map(|known| known.display);
    read_in(text, shown.map(|(name, factor)| (*name, 1.0 / factor)).chain([(unit, 1.0)]))
}

/// Reads a quantity that carries its unit, as an angle does; 0 has none.
pub fn read_with_unit(text: &str, unit: &str) -> Option<f64> {
    let (number, suffix) = split(text)?;
    if suffix.is_empty() && number != 0.0 { None } else { read(text, unit) }
}

/// Reads it in a unit that the SI unit is shown in, exactly as written where it is written in that unit.
pub fn read_shown(text: &str, unit: &str, shown: &str) -> Option<f64> {
    match split(text)? {
        (number, suffix) if suffix == shown => Some(number).filter(|number| number.is_finite()),
        _ => {
            let (_, factor) = units::find(unit)?.display.iter().find(|(name, _)| *name == shown)?;
            read_with_unit(text, unit).map(|value| value * factor)
        }
    }
}

/// Whether an angle in rad is beyond a turn, as one is that was meant in degrees.
pub fn is_beyond_turn(angle_rad: f64) -> bool {
    angle_rad.abs() > core::f64::consts::TAU
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_units() {
        for (text, unit, expected) in [
            ("-3", "m", -3.0),
            (" 0.5 km", "m", 500.0),
            ("2m", "m", 2.0),
            ("1 AU", "m", 149_597_870_700.0),
            ("4.2 km/s", "m/s", 4200.0),
            ("250ms", "s", 0.25),
            ("-1.5e3", "s", -1500.0),
            ("180 deg", "rad", core::f64::consts::PI),
            ("5rpm", "rad/s", core::f64::consts::PI / 6.0),
        ] {
            let found = read(text, unit).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-15, "{text}: {found}");
        }
        for (text, unit) in
            [("", "s"), ("d", "s"), ("1 s", "m"), ("nan", "m"), ("inf", "m"), ("1e999", "s"), ("3w", "s")]
        {
            assert_eq!(read(text, unit), None, "{text}");
        }
        assert_eq!(
            ["0", "10", "10rad"].map(|text| read_with_unit(text, "rad")),
            [Some(0.0), None, Some(10.0)]
        );
        assert_eq!(read_shown("400 deg", "rad", "deg"), Some(400.0));
        assert!((read_shown("1rad", "rad", "deg").unwrap() - 1_f64.to_degrees()).abs() < 1e-13);
        assert_eq!(read_shown("4", "rad", "deg"), None);
    }
}
