//! Instruments: where each looks, fixed in the body frame or on a gimbal.

use nalgebra::Vector3;
use serde::Serialize;

use super::part_reader::PartReader;
use crate::toml::{HalfTurnEither, Place, UnitVector, Written, tables};

tables! {
/// An instrument.
struct InstrumentDescription called "instrument" {
    /// Name for messages and the manual.
    name: String,
    /// Unit vector of its boresight, body frame; on a gimbal at angle 0.
    boresight as boresight_body: UnitVector,
    gimbal: Option<GimbalDescription>,
}

/// A gimbal that turns an instrument about one axis: at most one instrument has one.
struct GimbalDescription makes #[derive(Clone, Copy, Debug, PartialEq, Serialize)] pub struct GimbalMount {
    /// Unit vector of its axis, body frame, perpendicular to the boresight; angles count right-handed about it.
    axis as axis_body: UnitVector,
    /// Least angle, in deg.
    minimum_deg as minimum_rad: HalfTurnEither,
    /// Greatest angle, in deg.
    maximum_deg as maximum_rad: HalfTurnEither,
}
}

/// An instrument.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Instrument {
    /// For messages and the manual.
    pub name: String,
    /// Unit vector of its boresight; on a gimbal at angle 0.
    pub boresight_body: Vector3<f64>,
    /// Gimbal that turns the instrument; `None` if it is fixed to the body.
    pub gimbal: Option<GimbalMount>,
}

/// Reads an instrument.
pub(super) fn instrument(part: &PartReader<'_>, description: &InstrumentDescription) -> Instrument {
    let boresight_body = description.boresight_body();
    let gimbal =
        part.optional("gimbal", description.gimbal.as_ref(), |part, it| gimbal(part, it, &boresight_body));
    Instrument { name: description.name.clone(), boresight_body, gimbal }
}

fn gimbal(
    part: &PartReader<'_>,
    description: &GimbalDescription,
    boresight_body: &Vector3<f64>,
) -> GimbalMount {
    let [minimum_deg, maximum_deg] = [description.minimum_deg.0, description.maximum_deg.0];
    if minimum_deg > maximum_deg {
        let allowed = format!("an angle from `minimum_deg`, {minimum_deg} deg, to 180 deg");
        part.key("maximum_deg").report(maximum_deg, allowed);
    }
    let made = description.value();
    let axis_body = part.key("axis").perpendicular(made.axis_body, boresight_body, "boresight");
    GimbalMount { axis_body, ..made }
}

/// At most one instrument has a gimbal.
pub(super) fn check_gimbals(at: &Place<'_>, instruments: &[Instrument]) {
    let mut with_gimbal = at.items(instruments).filter(|(_, instrument)| instrument.gimbal.is_some());
    let Some((_, first)) = with_gimbal.next() else { return };
    for (at, _) in with_gimbal {
        let found = format!("a gimbal beside that of `{}`", first.name);
        at.key("gimbal").report(found, "one instrument with a gimbal");
    }
}
