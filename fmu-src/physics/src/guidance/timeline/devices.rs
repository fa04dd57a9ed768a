//! Devices and bodies that a command names: gimbal, steered antenna, instruments by name or row, the body of the file.

use super::quantity::Quantity;
use crate::bodies::Body;
use crate::enumeration::Enumerated;
use crate::spacecraft::Spacecraft;
use crate::toml::{Place, nearest};

/// Reports `found`, which points the instrument on the gimbal, where no instrument has one.
pub(super) fn check_gimbal(spacecraft: &Spacecraft, at: &Place<'_>, found: String) {
    if !spacecraft.instruments.iter().any(|instrument| instrument.gimbal.is_some()) {
        let allowed =
            "what needs no gimbal: no instrument of the spacecraft has one ([[instruments]] gimbal)";
        at.report(found, allowed);
    }
}

/// Reports `found`, which points a steered antenna, where no antenna is steered.
pub(super) fn check_fan(spacecraft: &Spacecraft, at: &Place<'_>, found: String) {
    if !spacecraft.antennas.iter().any(|named| named.antenna.fan().is_some()) {
        let allowed = "another option, or none in a downlink: no antenna of the spacecraft is steered in the XY plane \
                       ([[antennas]] azimuth_deg)";
        at.report(found, allowed);
    }
}

/// Returns the number of an instrument given by name or number; 0 for an unknown one, which is reported.
pub(super) fn instrument(spacecraft: &Spacecraft, at: &Place<'_>, given: &Quantity) -> u32 {
    let names: Vec<&str> = spacecraft.instruments.iter().map(|instrument| instrument.name.as_str()).collect();
    let (found, hint) = match given {
        Quantity::Text(text) => {
            let found = names.iter().position(|name| name == text).map(|index| index + 1);
            (found, nearest(text, &names))
        }
        Quantity::Number(number) => ((0..=names.len()).find(|index| *index as f64 == *number), None),
        _ => (None, None),
    };
    let hint = hint.map(|name| format!(" (did you mean {name:?}?)")).unwrap_or_default();
    let allowed = if names.is_empty() {
        "0, which is +Z: the spacecraft has no [[instruments]]".to_owned()
    } else {
        format!("0 for +Z, or of the spacecraft's [[instruments]] the name or row: {}", names.join(", "))
    };
    let found = at.known(found, format_args!("the unknown instrument {given}{hint}"), allowed);
    found.and_then(|index| u32::try_from(index).ok()).unwrap_or_default()
}

/// Returns the body as given; reports `custom` where the spacecraft's file describes none.
pub(super) fn body(spacecraft: &Spacecraft, at: &Place<'_>, given: Option<Body>) -> Option<Body> {
    if given == Some(Body::Custom) && spacecraft.body.is_none() {
        let known = Body::ALL.map(Enumerated::name).join(", ");
        let allowed = format!("{known}, and custom where the spacecraft's file has a table [body]");
        at.report("\"custom\"", allowed);
    }
    given
}
