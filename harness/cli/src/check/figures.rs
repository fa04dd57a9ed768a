//! What a spacecraft's file comes to, for `heliotorque check`: figures to judge and warnings.

use nalgebra::Vector3;
use physics::{
    plausibility::{Figures, warnings},
    spacecraft::Spacecraft,
};
use terminal::short;

/// Lines of figures and warnings of a file that is good.
pub fn report(spacecraft: &Spacecraft) -> String {
    let figures = Figures::of(spacecraft);
    let mut text = String::new();
    let has_wheels = !spacecraft.wheels.is_empty();
    for (name, value) in rows(&figures).into_iter().filter(|(name, _)| has_wheels || *name != "wheels") {
        text.push_str(&row(name, &value));
    }
    for warning in warnings(spacecraft, &figures) {
        text.push_str(&format!("\nwarning: {warning}"));
    }
    text
}

/// A line of the report.
pub fn row(name: &str, value: &str) -> String {
    format!("\n  {name:<21}{value}")
}

fn rows(figures: &Figures) -> Vec<(&'static str, String)> {
    let axes = ["X", "Y", "Z"];
    let number = |value: f64| short(rounded(value));
    let triple = |vector: &Vector3<f64>| {
        let [x, y, z]: [f64; 3] = (*vector).into();
        format!("{}, {}, {}", number(x), number(y), number(z))
    };
    let mass = &figures.mass_properties;
    let extents = axes.into_iter().enumerate().map(|(axis, name)| {
        format!("{name} {} to {}", number(figures.least_body_m[axis]), number(figures.greatest_body_m[axis]))
    });
    let facing = axes.into_iter().enumerate().map(|(axis, name)| {
        let (plus, minus) = (figures.area_toward_plus_m2[axis], figures.area_toward_minus_m2[axis]);
        format!("+{name} {}, -{name} {}", number(plus), number(minus))
    });
    let hull = match figures.center_of_mass_outside_m {
        Some(outside_m) => format!("{} m outside of the hull of all surfaces", number(outside_m)),
        None => "inside of the hull of all surfaces".to_owned(),
    };
    let torque = figures.solar_torque_body_n_m.map_or_else(
        || "cannot be computed".to_owned(),
        |torque_n_m| format!("({}) uN m by sunlight", triple(&(torque_n_m * 1e6))),
    );
    let wheels = figures.wheels_hold_n_m_s.map_or_else(
        || "do not hold momentum in every direction".to_owned(),
        |held_n_m_s| format!("hold {} N m s in any direction", number(held_n_m_s)),
    );
    vec![
        ("extents", format!("{} m", extents.collect::<Vec<_>>().join(", "))),
        ("area that faces", format!("{} m2", facing.collect::<Vec<_>>().join(", "))),
        ("area toward the Sun", format!("{} m2 sunlit, the Sun on -Y", number(figures.sunlit_area_m2))),
        ("centre of mass", format!("({}) m, {hull}", triple(&mass.center_of_mass_body_m))),
        ("radii of gyration", format!("{} m about X, Y, Z", triple(&figures.gyration_radii_m))),
        ("torque at 1 AU", torque),
        ("wheels", wheels),
    ]
}

/// To four significant digits; what is lost in the rounding of larger numbers is 0.
fn rounded(value: f64) -> f64 {
    if value.abs() < 1e-9 { 0.0 } else { format!("{value:.3e}").parse().unwrap_or(value) }
}

#[cfg(test)]
mod tests {
    //! What is printed of a shipped spacecraft and of one with a slip.

    use super::*;

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
            "  radii of gyration    0.534, 0.8511, 0.8323 m about X, Y, Z",
            "  torque at 1 AU       (-0.00207, 0, 0) uN m by sunlight",
            "  wheels               hold 10.67 N m s in any direction",
        ];
        assert_eq!(report(&spacecraft), expected.join("\n"));
    }

    #[test]
    fn a_slip_is_warned_of() {
        let text = include_str!("../../../../fmu-src/resources/messenger.toml");
        let text = text.replacen("mass_kg = ", "mass_kg = 1e-5 # ", 1);
        let reported = report(&Spacecraft::from_toml("messenger.toml", &text).unwrap());
        assert!(reported.contains("\nwarning: by its inertia the mass lies "), "{reported}");
    }
}
