//! Tanks and thrusters, from their descriptions: checks every value, and that they belong together.

use super::describe_devices::{TankDescription, ThrusterDescription};
use super::part_reader::PartReader;
use crate::constants::STANDARD_GRAVITY_M_S2;
use crate::spacecraft::tank::{Blowdown, Tank};
use crate::spacecraft::thruster::{Thruster, ThrusterSet, ValveTiming};
use crate::toml::{KeyPath, Named, hint};

/// A tank that holds a part of `mass_kg`.
pub(crate) fn tank(part: &mut PartReader<'_, '_>, description: &TankDescription) -> Tank {
    let pressure_pa = description.pressure_pa();
    let blowdown = description
        .ullage_m3
        .map(|ullage_m3| Blowdown { ullage_m3: ullage_m3.0, density_kg_m3: description.density_kg_m3() });
    let allowed_pa = description.allowed_pressure_pa.unwrap_or([0.0, f64::MAX]);
    let [least_pa, greatest_pa] = allowed_pa;
    if !(least_pa >= 0.0 && greatest_pa > least_pa) {
        part.report(
            "allowed_pressure_pa",
            format_args!("{allowed_pa:?}"),
            "two rising numbers, not negative",
        );
    } else if !(least_pa..=greatest_pa).contains(&pressure_pa) {
        let allowed = format!("a range around pressure_pa = {pressure_pa}");
        part.report("allowed_pressure_pa", format_args!("{allowed_pa:?}"), allowed);
    }
    Tank {
        name: description.called(part.index),
        position_body_m: description.position_body_m(),
        propellant_kg: description.propellant_kg.0,
        pressure_pa,
        allowed_pa,
        blowdown,
    }
}

/// A thruster that one of `tanks` feeds, of one of `sets` or none.
pub(crate) fn thruster(
    part: &mut PartReader<'_, '_>,
    description: &ThrusterDescription,
    tanks: &[Tank],
    sets: &[String],
) -> Thruster {
    let force_n = description.force_n.0;
    let valve = ValveTiming {
        min_on_s: description.min_on_time_s(),
        rise_s: description.rise_time_s(),
        tail_off_s: description.tail_off_time_s(),
    };
    let position_body_m = description.position_body_m();
    let force_body_n = description.direction_body() * force_n;
    Thruster {
        name: description.called(part.index),
        position_body_m,
        force_body_n,
        torque_body_n_m: position_body_m.cross(&force_body_n),
        flow_kg_s: force_n / (description.specific_impulse_s.0 * STANDARD_GRAVITY_M_S2),
        valve,
        scatter: description.scatter(),
        power_w: description.power_w.map(f64::from),
        set: description.set.as_deref().and_then(|name| ThrusterSet::named(sets, name)),
        attitude_control: description.attitude_control(),
        tank: tank_of(part, tanks, description.tank.as_deref()),
        at_pressure_pa: description.at_pressure_pa.map(f64::from),
        plume_half_angle_rad: description.plume_half_angle_rad(),
    }
}

/// Index of the tank of this name, the first without one.
fn tank_of(part: &mut PartReader<'_, '_>, tanks: &[Tank], name: Option<&str>) -> usize {
    if tanks.is_empty() {
        if !part.check.is_stand_in(&KeyPath::root().key("tanks")) {
            part.check.report(&part.at, "a thruster without a tank", "at least one of [[tanks]] in the file");
        }
        return 0;
    }
    let Some(name) = name else { return 0 };
    let names: Vec<&str> = tanks.iter().map(|tank| tank.name.as_str()).collect();
    names.iter().position(|known| *known == name).unwrap_or_else(|| {
        let allowed = format!("a name under [[tanks]]: {}", names.join(", "));
        part.report("tank", format_args!("the unknown tank `{name}`{}", hint(name, &names)), allowed);
        0
    })
}
