//! Sun and planet on the axes of the spacecraft, where faces stand edge-on, the terminator lies below, Sun, planet and
//! normals are parallel or perpendicular: outputs and directional derivatives are finite.

use model_description::Causality;
use models::DisturbanceTorque;

use crate::disturbance_torque::Disturbance;
use crate::named_model::NamedModel;

const AXES: [[f64; 3]; 6] =
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
const RADIUS_M: f64 = 2.4394e6;

#[test]
fn on_the_axes_everything_is_finite() {
    let cylinder = include_str!("../../fmu-src/resources/messenger.toml");
    for mut fmu in
        [Disturbance::messenger(), Disturbance::shadowed(), Disturbance::from_text("cylinder", cylinder)]
    {
        fmu.start();
        let outputs = fmu.references(Causality::Output);
        let inputs = fmu.references(Causality::Input);
        for (planet, sun) in AXES.iter().flat_map(|planet| AXES.iter().map(move |sun| (planet, sun))) {
            // The Sun on an axis as seen from the spacecraft, then as seen from the planet.
            for (from_planet, angle) in [(0.0, 0.0), (1.0, 0.0), (1.0, core::f64::consts::FRAC_PI_2)] {
                let planet_m = planet.map(|x| 2.0 * RADIUS_M * x);
                let sun_m = [0, 1, 2].map(|i| 5.8e10 * sun[i] + from_planet * planet_m[i]);
                let value = |reference: &u32| {
                    let name = fmu.name(*reference);
                    let axis = || name.as_bytes()[name.len() - 2] as usize - usize::from(b'1');
                    match name.split('.').next() {
                        Some("sun") => sun_m[axis()],
                        Some("planet") => planet_m[axis()],
                        Some(panel) if panel.starts_with("panel") => angle,
                        _ => 0.0,
                    }
                };
                let values: Vec<f64> = inputs.iter().map(value).collect();
                let found = fmu.outputs_at(&inputs, &values, &outputs);
                assert!(found.iter().all(|x| x.is_finite()), "planet {planet:?}, sun {sun:?}: {found:?}");
                for known in &inputs {
                    for (output, slope) in outputs.iter().zip(fmu.slopes(&outputs, &[*known], &[1.0])) {
                        let (output, known) = (fmu.name(*output), fmu.name(*known));
                        assert!(slope.is_finite(), "{output} by {known}: planet {planet:?}, sun {sun:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_place_inside_the_sun_is_refused_with_a_planet_and_without() {
    const SUN_RADIUS_M: f64 = 6.957e8;
    for planet in [0.0, 1.0] {
        let named = NamedModel::<DisturbanceTorque>::shipped();
        let at = |distance: f64| {
            let sets = [("planet.present", planet), ("planet.positionBody[3]", 1e11 * planet)];
            let sets = [&sets[..], &[("sun.positionBody[2]", -distance * SUN_RADIUS_M)]].concat();
            named.initialize(0.0, &sets).map(drop)
        };
        let refused = at(0.99).unwrap_err().to_string();
        assert!(refused.contains("from the Sun's centre, allowed is more than its radius"), "{refused}");
        at(1.01).unwrap();
    }
}
