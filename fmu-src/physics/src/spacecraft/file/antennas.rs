//! Antennas, from their descriptions.

use core::f64::consts::PI;

use super::describe_devices::AntennaDescription;
use super::names::check_item_name;
use super::part_reader::PartReader;
use crate::spacecraft::antennas::{Antenna, AntennaRange, FanAzimuths, NamedAntenna};

/// A fan is steered over this at most, in deg, if not all round.
const WIDEST_FAN_DEG: f64 = 180.0;

pub(crate) fn antenna(part: &mut PartReader<'_, '_>, description: &AntennaDescription) -> NamedAntenna {
    check_item_name(part.check, &part.at.key("name"), &description.name);
    let range = match (description.azimuth_deg, description.axis_body()) {
        (None, Some(axis_body)) => AntennaRange::Axis(axis_body),
        (azimuth_deg, _) => AntennaRange::Fan(
            azimuth_deg.map_or(FanAzimuths { middle_rad: 0.0, half_rad: 0.0 }, |azimuth_deg| {
                fan(part, azimuth_deg.map(f64::from))
            }),
        ),
    };
    let [across_rad, along_rad] = description.beam_rad();
    let antenna = Antenna { range, across_rad, along_rad };
    NamedAntenna { name: description.name.clone(), antenna }
}

fn fan(part: &mut PartReader<'_, '_>, [from_deg, to_deg]: [f64; 2]) -> FanAzimuths {
    let width_deg = to_deg - from_deg;
    if width_deg == 360.0 {
        return FanAzimuths { middle_rad: 0.5 * (from_deg + to_deg).to_radians(), half_rad: PI };
    }
    if !(width_deg > 0.0 && width_deg <= WIDEST_FAN_DEG) {
        let allowed =
            "from and to in deg, from -Y toward +X, 0 to 180 deg apart or 360, as in [-90, 0] or [170, 190]";
        part.report("azimuth_deg", format_args!("[{from_deg}, {to_deg}]"), allowed);
    }
    let [from_rad, to_rad] = [from_deg, to_deg].map(f64::to_radians);
    FanAzimuths { middle_rad: 0.5 * (from_rad + to_rad), half_rad: 0.5 * (to_rad - from_rad) }
}
