//! Figures of a spacecraft's file, for `heliotorque check`, with devices and warnings.

use nalgebra::Vector3;
use physics::{
    environment::sun::SOLAR_FLUX_W_M2,
    momentum::WheelArray,
    plant::{ControlDefaults, NEVER_DUMPED_N_M_S},
    plausibility::{Figures, ThrusterFigures, TorqueBothWays, warnings},
    spacecraft::{Instrument, MountedSunSensor, NamedAntenna, Spacecraft},
    spin::spinner::Spinner,
};
use terminal::rounded as number;

const AXES: [&str; 3] = ["X", "Y", "Z"];

/// How a packed FMU takes sunlight.
#[derive(Clone, Copy)]
pub(super) struct Sunlight {
    /// At 1 AU.
    pub flux_w_m2: f64,
    /// Whether surfaces shadow one another.
    pub has_shadows: bool,
}

/// Lines of figures of a file that is taken, and warnings.
pub(super) fn report(spacecraft: &Spacecraft, sunlight: Sunlight) -> (String, Vec<String>) {
    let figures = Figures::new(spacecraft);
    let rows = body(&figures, sunlight).into_iter().chain(devices(spacecraft, &figures));
    (rows.map(|(name, value)| row(name, &value)).collect(), warnings(spacecraft, &figures))
}

/// A line of the report.
pub(super) fn row(name: &str, value: &str) -> String {
    format!("\n  {name:<21}{value}")
}

/// Lines of what a spinner carries.
pub(super) fn of_spinner(spinner: &Spinner) -> String {
    let thrusters = spinner.thrusters.iter().map(|it| ThrusterFigures {
        name: it.name.clone(),
        force_body_n: it.force_body_n,
        torque_body_n_m: it.torque_body_n_m,
        meets: None,
    });
    let tracker = &spinner.star_tracker;
    let tracker = format!(
        "boresight at azimuth {} deg, {} deg wide",
        number(tracker.azimuth_deg),
        number(tracker.field_of_view_deg)
    );
    let sensor = format!("slit at azimuth {} deg", number(spinner.sun_sensor.azimuth_deg));
    let names = core::iter::once("thrusters").chain(core::iter::repeat(""));
    let thrusters: Vec<String> = thrusters.map(|it| thruster(&it)).collect();
    let rows = names.zip(thrusters).chain([("star tracker", tracker), ("Sun sensor", sensor)]);
    rows.map(|(name, value)| row(name, &value)).collect()
}

/// Extents, areas, mass and torque.
fn body(figures: &Figures, sunlight: Sunlight) -> Vec<(&'static str, String)> {
    let mass = &figures.mass_properties;
    let extents = AXES.into_iter().enumerate().map(|(axis, name)| {
        format!("{name} {} to {}", number(figures.least_body_m[axis]), number(figures.greatest_body_m[axis]))
    });
    let facing = AXES.into_iter().enumerate().map(|(axis, name)| {
        let (plus, minus) = (figures.area_toward_plus_m2[axis], figures.area_toward_minus_m2[axis]);
        format!("+{name} {}, -{name} {}", number(plus), number(minus))
    });
    let hull = match figures.center_of_mass_outside_m {
        Some(outside_m) => format!("{} m outside of the hull of all surfaces", number(outside_m)),
        None => "inside of the hull of all surfaces".to_owned(),
    };
    vec![
        ("extents", format!("{} m", extents.collect::<Vec<_>>().join(", "))),
        ("area that faces", format!("{} m2", facing.collect::<Vec<_>>().join(", "))),
        ("area toward the Sun", format!("{} m2 sunlit, the Sun on -Y", number(figures.sunlit_area_m2))),
        ("centre of mass", format!("{} m, {hull}", triple(&mass.center_of_mass_body_m))),
        ("radii of gyration", format!("{} m about X, Y, Z", triple(&figures.gyration_radii_m))),
        ("torque at 1 AU", torque(figures, sunlight)),
    ]
}

/// Torque of sunlight, as the FMU simulates it, and otherwise where that differs.
fn torque(figures: &Figures, sunlight: Sunlight) -> String {
    let micro = 1e6 * sunlight.flux_w_m2 / SOLAR_FLUX_W_M2;
    let shown = |solar: Option<(Vector3<f64>, Vector3<f64>)>| {
        solar.map_or_else(
            || "cannot be computed".to_owned(),
            |(_, torque_n_m)| format!("{} uN m", triple(&(torque_n_m * micro))),
        )
    };
    let (without, with) = (shown(figures.solar), shown(figures.shadowed_solar));
    match (without == with, sunlight.has_shadows) {
        (true, _) => format!("{with} by sunlight, with or without shadows"),
        (false, true) => format!("{with} by sunlight with shadows (shadowing.enabled), {without} without"),
        (false, false) => {
            format!("{without} by sunlight without shadows, {with} with them (shadowing.enabled)")
        }
    }
}

/// Wheels, thrusters, tanks, Sun sensors, instruments, antennas; none of what the file has none of.
fn devices(spacecraft: &Spacecraft, figures: &Figures) -> Vec<(&'static str, String)> {
    let mut rows = Vec::new();
    let mut listed = |name, lines: Vec<String>| {
        let names = core::iter::once(name).chain(core::iter::repeat(""));
        rows.extend(names.zip(lines));
    };
    let wheels = match figures.wheels {
        _ if spacecraft.wheels.is_empty() => None,
        None => Some("do not hold momentum in every direction".to_owned()),
        Some(held) => Some(format!(
            "hold {} N m s in any direction (inscribed sphere), {} on all axes at once (guaranteed box), {} by least-norm sharing",
            number(held.sphere_n_m_s),
            number(held.box_n_m_s),
            number(held.least_norm_box_n_m_s)
        )),
    };
    listed("wheels", wheels.into_iter().collect());
    listed("thrusters", figures.thrusters.iter().map(thruster).collect());
    listed("torque of thrusters", figures.thruster_torque.iter().map(both_ways).collect());
    let tanks = spacecraft.tanks.iter().map(|tank| {
        format!("{}: {} kg at {} m", tank.name, number(tank.propellant_kg), triple(&tank.position_body_m))
    });
    listed("tanks", tanks.collect());
    let six = MountedSunSensor::six();
    let sun_sensors = spacecraft.sun_sensors.iter().map(|sensor| {
        let half_deg = number(sensor.half_field_of_view_rad.to_degrees());
        format!("{}: looks along {}, {half_deg} deg to each side", sensor.name, triple(&sensor.axis_body))
    });
    if spacecraft.sun_sensors == six {
        listed("Sun sensors", vec!["six along the body axes, 60 deg to each side".to_owned()]);
    } else {
        listed("Sun sensors", sun_sensors.collect());
    }
    listed("instruments", spacecraft.instruments.iter().map(instrument).collect());
    listed("antennas", spacecraft.antennas.iter().map(antenna).collect());
    listed("dumps", dumps(spacecraft));
    rows
}

/// Cases without a dump, and dumps that cost nothing.
fn dumps(spacecraft: &Spacecraft) -> Vec<String> {
    let axes: Vec<_> = spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect();
    let thresholds_n_m_s =
        ControlDefaults::new(spacecraft, &WheelArray::from_axes(&axes)).dump_threshold_n_m_s;
    let is_given = spacecraft.start.iter().any(|entry| entry.name.starts_with("dump.threshold"));
    let never =
        AXES.into_iter().zip(&thresholds_n_m_s).filter(|(_, it)| !is_given && **it >= NEVER_DUMPED_N_M_S);
    let never: Vec<&str> = never.map(|(name, _)| name).collect();
    let mut lines = Vec::new();
    if !never.is_empty() {
        lines.push(format!(
            "never about {}, where no wheels hold momentum, unless dump.threshold is set",
            never.join(", ")
        ));
    }
    if spacecraft.thrusters.is_empty() && never.len() < AXES.len() {
        lines.push("ideal, without propellant: there are no [[thrusters]]".to_owned());
    }
    lines
}

/// Boresight, and how far a gimbal turns it.
fn instrument(instrument: &Instrument) -> String {
    let gimbal = instrument.gimbal.as_ref().map_or_else(String::new, |gimbal| {
        let [from_deg, to_deg] = [gimbal.minimum_rad, gimbal.maximum_rad].map(f64::to_degrees);
        let axis = triple(&gimbal.axis_body);
        format!(", turned about {axis} by {} to {} deg", number(from_deg), number(to_deg))
    });
    format!("{}: looks along {}{gimbal}", instrument.name, triple(&instrument.boresight_body))
}

/// Range of its directions, and its beam.
fn antenna(named: &NamedAntenna) -> String {
    let [across_deg, along_deg] = [named.antenna.across_rad, named.antenna.along_rad].map(f64::to_degrees);
    let beam =
        format!("beam of {} deg across that plane, {} along it", number(across_deg), number(along_deg));
    format!("{}: {}, {beam}", named.name, named.antenna.range)
}

/// Force, jet, torque and what the plume meets.
fn thruster(thruster: &ThrusterFigures) -> String {
    let force_n = thruster.force_body_n.norm();
    let meets = thruster.meets.as_ref();
    let meets = meets.map_or_else(String::new, |name| format!(", its plume meets `{name}`"));
    format!(
        "{}: {} N, jet along {}, torque {} N m{meets}",
        thruster.name,
        number(force_n),
        triple(&(-thruster.force_body_n / force_n)),
        triple(&thruster.torque_body_n_m)
    )
}

/// By axis, both senses or one.
fn both_ways(torque: &TorqueBothWays) -> String {
    let axes = AXES.into_iter().enumerate().map(|(axis, name)| {
        let (plus, minus) = (torque.plus_n_m[axis], torque.minus_n_m[axis]);
        match (plus > 0.0, minus > 0.0) {
            (true, true) => format!("{name} +{}, -{} (both senses)", number(plus), number(minus)),
            (true, false) => format!("{name} +{} (one sense)", number(plus)),
            (false, true) => format!("{name} -{} (one sense)", number(minus)),
            (false, false) => format!("{name} none"),
        }
    });
    format!("{} N m at most", axes.collect::<Vec<_>>().join("; "))
}

fn triple(vector: &Vector3<f64>) -> String {
    let [x, y, z]: [f64; 3] = (*vector).into();
    format!("({}, {}, {})", number(x), number(y), number(z))
}

#[cfg(test)]
mod tests {
    //! What is printed of a shipped spacecraft and of one with a slip.

    use super::*;

    const LIGHT: Sunlight = Sunlight { flux_w_m2: SOLAR_FLUX_W_M2, has_shadows: false };

    #[test]
    fn figures_are_reported_in_lines_that_a_person_reads() {
        let text = include_str!("../../../../fmu-src/resources/messenger.toml");
        let spacecraft = Spacecraft::from_toml("messenger.toml", text).unwrap();
        let expected = [
            "",
            "  extents              X -3.071 to 3.071, Y -1.096 to 0.7165, Z -1.345 to 0.5713 m",
            "  area that faces      +X 1.173, -X 1.173, +Y 0, -Y 6.533, +Z 0, -Z 4.532 m2",
            "  area toward the Sun  6.533 m2 sunlit, the Sun on -Y",
            "  centre of mass       (0, 0, 0) m, inside of the hull of all surfaces",
            "  radii of gyration    (0.534, 0.8511, 0.8323) m about X, Y, Z",
            "  torque at 1 AU       (-0.00207, 0, 0) uN m by sunlight, with or without shadows",
            "  wheels               hold 13.06 N m s in any direction (inscribed sphere), 9.238 on all axes at once (guaranteed box), 6.158 by least-norm sharing",
            "  Sun sensors          six along the body axes, 60 deg to each side",
        ];
        let (reported, _) = report(&spacecraft, LIGHT);
        assert!(reported.starts_with(&expected.join("\n")), "{reported}");
    }

    #[test]
    fn every_device_has_its_row() {
        let text = include_str!("../../../../fmu-src/resources/messenger-full.toml");
        let spacecraft = Spacecraft::from_toml("messenger-full.toml", text).unwrap();
        let [without, with] =
            [false, true].map(|has_shadows| report(&spacecraft, Sunlight { has_shadows, ..LIGHT }).0);
        for thruster in &spacecraft.thrusters {
            assert_eq!(
                without
                    .matches(&format!(
                        " {}: {} N, jet along ",
                        thruster.name,
                        number(thruster.force_body_n.norm())
                    ))
                    .count(),
                1
            );
        }
        for part in [
            "LVA: 660 N, jet along (0, 0, -1), torque (0, 0, 0) N m",
            "  tanks                main: 60 kg at (0, 0, 0) m",
            "(both senses); Y ",
            "uN m by sunlight without shadows, (",
            "MDIS: looks along (0, 0, 1), turned about (1, 0, 0) by -50 to 40 deg",
            "  antennas             sunshade: steered in the XY plane from azimuth -90 to 0 deg, beam of 4 deg across that plane, 15 along it",
            "back: steered in the XY plane from azimuth 90 to 180 deg, ",
        ] {
            assert!(without.contains(part), "{part}: {without}");
        }
        assert!(with.contains(" by sunlight with shadows (shadowing.enabled), ("), "{with}");
    }

    #[test]
    fn a_slip_is_warned_of() {
        let text = include_str!("../../../../fmu-src/resources/messenger.toml");
        let text = text.replacen("mass_kg = ", "mass_kg = 1e-5 # ", 1);
        let (_, warnings) = report(&Spacecraft::from_toml("messenger.toml", &text).unwrap(), LIGHT);
        assert!(warnings.iter().any(|it| it.starts_with("by its inertia the mass lies ")), "{warnings:?}");
    }
}
