//! Directional derivatives are slopes, and appear only where dependencies are declared.

use std::collections::{BTreeMap, BTreeSet};

use model_description::Causality;
use model_description::Status;

use super::super::random::RandomNumbers;
use super::driver::{DENSITY_KG_M3, Disturbance, FIELD_T, MOLAR_MASS_KG_MOL, SPEED_M_S, TEMPERATURE_K};

/// Slopes of every output along every input, against central differences over many geometries.
fn check_slopes(mut fmu: Disturbance, seed: u64, in_shadow: bool) {
    fmu.start();
    let mut random = RandomNumbers(seed);
    let outputs = fmu.references(Causality::Output);
    let vectors = fmu.vectors_of(&outputs);
    let mut checked = vec![0; outputs.len()];
    for _ in 0..40 {
        let (inputs, values) = random.inputs(&fmu, in_shadow);
        // A direction that moves everything by about a thousandth of what matters.
        let scale = |reference: u32| match fmu.name(reference).split('.').next().unwrap() {
            "atmosphere" => match fmu.name(reference).trim_start_matches("atmosphere.") {
                "density" => DENSITY_KG_M3,
                "temperature" => TEMPERATURE_K,
                "molarMass" => MOLAR_MASS_KG_MOL,
                _ => SPEED_M_S,
            },
            "magneticField" => FIELD_T,
            "sun" => 5.8e10,
            "planet" if !fmu.name(reference).contains("pole") => 2.4e6,
            _ => 1.0,
        };
        let along: Vec<f64> = inputs.iter().map(|at| (random.next() - 0.5) * scale(*at)).collect();
        let base = fmu.outputs_at(&inputs, &values, &outputs);
        let exact = fmu.slopes(&outputs, &inputs, &along);
        let quotient = |fmu: &mut Disturbance, h: f64| {
            let mut at = |h: f64| {
                let moved: Vec<f64> = values.iter().zip(&along).map(|(v, a)| v + h * a).collect();
                fmu.outputs_at(&inputs, &moved, &outputs)
            };
            let (high, low) = (at(h), at(-h));
            high.iter().zip(low).map(|(high, low)| (high - low) / (2.0 * h)).collect::<Vec<f64>>()
        };
        let h = if in_shadow { 1e-8 } else { 1e-6 };
        let (near, far) = (quotient(&mut fmu, h), quotient(&mut fmu, 2.0 * h));
        // A component may pass through 0: compare with the largest of its vector.
        for i in 0..outputs.len() {
            let size = vectors[i].iter().map(|&k| exact[k].abs() + base[k].abs()).fold(0.0, f64::max);
            // Away from edges, where the quotients do not depend on the step, and above rounding.
            if (near[i] - far[i]).abs() > 2e-7 * size || size * h < 1e3 * f64::EPSILON * base[i].abs() {
                continue;
            }
            let slope = (4.0 * near[i] - far[i]) / 3.0;
            let allowed = 1e-6 * size + 4.0 * f64::EPSILON * base[i].abs() / h;
            assert!((slope - exact[i]).abs() <= allowed, "{}: {slope} {}", fmu.name(outputs[i]), exact[i]);
            checked[i] += 1;
        }
    }
    for (output, count) in outputs.iter().zip(checked) {
        assert!(count >= 30, "only {count} of 40 slopes of {} could be checked", fmu.name(*output));
    }
}

#[test]
fn directional_derivatives_are_slopes() {
    check_slopes(Disturbance::messenger().near_the_earth(), 1, false);
}

#[test]
fn directional_derivatives_with_shadows_are_slopes() {
    check_slopes(Disturbance::shadowed().near_the_earth(), 2, false);
}

#[test]
fn directional_derivatives_by_cells_are_slopes() {
    check_slopes(Disturbance::messenger().near_the_earth().by_cells(12), 4, false);
}

#[test]
fn directional_derivatives_in_the_penumbra_are_slopes() {
    check_slopes(Disturbance::messenger().near_the_earth(), 5, true);
}

/// Over many geometries, in light and penumbra, an output changes with an input only if it says so; and every
/// input that the whole torque and the lit fraction declare is seen to act.
#[test]
fn what_depends_is_declared() {
    // Cells of the planet have a pole, rings have none.
    for mut fmu in [
        Disturbance::messenger().near_the_earth().by_cells(6),
        Disturbance::shadowed().near_the_earth().by_cells(6),
    ] {
        fmu.start();
        let outputs = fmu.references(Causality::Output);
        let inputs = fmu.references(Causality::Input);
        let reference_of =
            |fmu: &Disturbance, index: u32| fmu.description.variables[index as usize - 1].value_reference;
        let declared: BTreeMap<u32, BTreeSet<u32>> = fmu
            .description
            .structure
            .outputs
            .iter()
            // Value references of texts are counted on their own.
            .filter(|unknown| {
                let variable = &fmu.description.variables[unknown.index as usize - 1];
                matches!(variable.kind, model_description::VariableKind::Real { .. })
            })
            .map(|unknown| {
                let known = unknown.dependencies.as_ref().unwrap();
                let known = known.iter().map(|index| reference_of(&fmu, *index)).collect();
                (reference_of(&fmu, unknown.index), known)
            })
            .collect();
        let mut seen: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        let mut random = RandomNumbers(77);
        for round in 0..120 {
            let (at, values) = random.inputs(&fmu, round % 3 == 0);
            fmu.outputs_at(&at, &values, &outputs);
            for known in &inputs {
                let slopes = fmu.slopes(&outputs, &[*known], &[1.0]);
                for (output, slope) in outputs.iter().zip(slopes) {
                    if slope != 0.0 {
                        seen.entry(*output).or_default().insert(*known);
                    }
                }
            }
        }
        for (output, knowns) in &seen {
            for known in knowns {
                let (output_name, known_name) = (fmu.name(*output), fmu.name(*known));
                assert!(declared[output].contains(known), "{output_name} depends on {known_name}");
            }
        }
        let total = ["torque.total[1]", "torque.total[2]", "torque.total[3]"].map(|name| fmu.at(name));
        let whole = |of: &BTreeMap<u32, BTreeSet<u32>>| -> BTreeSet<u32> {
            total.iter().flat_map(|output| of[output].clone()).collect()
        };
        assert_eq!(whole(&seen), whole(&declared));
        let lit = fmu.at("sun.litFraction");
        assert_eq!(seen[&lit], declared[&lit]);
    }
}

#[test]
fn derivatives_by_parameters_are_for_initialization_only() {
    let mut fmu = Disturbance::messenger().near_the_earth();
    fmu.start();
    let (output, flux) = (fmu.at("force.solar[2]"), fmu.at("solar.flux"));
    let mut result = [0.0];
    assert_eq!(fmu.fmu.get_directional_derivative(&[output], &[flux], &[1.0], &mut result), Status::Error);
}

/// Weights of the central difference of the eighth order at 1, 2, 3 and 4 steps.
const EIGHTH: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Largest step of the study, relative.
const FIRST_STEP: f64 = 3e-3;

fn largest_force(fmu: &Disturbance, outputs: &[u32], values: &[f64]) -> f64 {
    let forces = outputs.iter().zip(values).filter(|(at, _)| fmu.name(**at).starts_with("force."));
    forces.map(|(_, value)| value.abs()).fold(0.0, f64::max)
}

/// Slopes along every Real parameter in Initialization Mode, against differences of the eighth order at a row of steps:
/// the closest of them counts, as rounding takes over where the method's error ends.
fn check_parameter_slopes(mut fmu: Disturbance, seed: u64, in_shadow: bool) {
    assert_eq!(fmu.fmu.setup_experiment(0.0, None), Status::Ok);
    assert_eq!(fmu.fmu.enter_initialization_mode(), Status::Ok);
    let mut random = RandomNumbers(seed);
    let outputs = fmu.references(Causality::Output);
    let vectors = fmu.vectors_of(&outputs);
    let parameters = fmu.references(Causality::Parameter);
    let defaults = fmu.read(&parameters);
    let least_inertia = fmu.real("spacecraft.inertia[1,1]");
    let mut moved = BTreeSet::new();
    for _ in 0..6 {
        let (inputs, values) = random.inputs(&fmu, in_shadow);
        assert_eq!(fmu.fmu.set_real(&inputs, &values), Status::Ok);
        for (k, parameter) in parameters.iter().enumerate() {
            let name = fmu.name(*parameter).to_owned();
            // An inertia is symmetric; what is above the diagonal is below it.
            let twin = name.strip_prefix("spacecraft.inertia[").map(|it| {
                let (row, column) = it.trim_end_matches(']').split_once(',').unwrap();
                fmu.at(&format!("spacecraft.inertia[{column},{row}]"))
            });
            let at: Vec<u32> =
                [Some(*parameter), twin.filter(|it| it != parameter)].into_iter().flatten().collect();
            let along = vec![1.0; at.len()];
            let exact = fmu.slopes(&outputs, &at, &along);
            let base = fmu.read(&outputs);
            // Away from limits: absorptivity and reflectivity add up to 1 by default.
            let centre = match name.as_str() {
                "planet.radius" => defaults[k] * 0.98,
                "planet.absorptivity" | "planet.diffuseReflectivity" | "planet.emissivity" => {
                    defaults[k] * 0.9
                }
                // Fractions, some of which are 0 by the file.
                _ if name.starts_with("optics.") => defaults[k] * 0.9 + 0.01,
                _ => defaults[k],
            };
            let put = |fmu: &mut Disturbance, value: f64| {
                let status = fmu.fmu.set_real(&at, &vec![value; at.len()]);
                assert_eq!(status, Status::Ok, "{name} = {value}");
            };
            put(&mut fmu, centre);
            let (exact, base) = match centre == defaults[k] {
                true => (exact, base),
                false => (fmu.slopes(&outputs, &at, &along), fmu.read(&outputs)),
            };
            let size = if twin.is_some() { least_inertia } else { centre.abs() };
            let mut nearest = vec![f64::INFINITY; outputs.len()];
            for exponent in 0..=5 {
                let h = size * FIRST_STEP * 0.1_f64.powi(exponent);
                let mut slopes = vec![0.0; outputs.len()];
                for (weight, steps) in EIGHTH.iter().zip(1..) {
                    for sign in [1.0, -1.0] {
                        put(&mut fmu, centre + sign * f64::from(steps) * h);
                        for (slope, value) in slopes.iter_mut().zip(fmu.read(&outputs)) {
                            *slope += sign * weight * value / h;
                        }
                    }
                }
                for (near, (slope, exact)) in nearest.iter_mut().zip(slopes.iter().zip(&exact)) {
                    *near = near.min((slope - exact).abs());
                }
            }
            put(&mut fmu, defaults[k]);
            for i in 0..outputs.len() {
                let largest = |of: &[f64]| vectors[i].iter().map(|&k| of[k].abs()).fold(0.0, f64::max);
                // A torque rounds as the forces of its parts do, on arms of a few metres.
                let of_force =
                    fmu.name(outputs[i]).contains("orce") || fmu.name(outputs[i]).contains("torque");
                let rounded = if of_force { largest_force(&fmu, &outputs, &base) } else { base[i].abs() };
                let allowed = 1e-7 * largest(&exact) + 4.0 * f64::EPSILON * rounded / (size * FIRST_STEP);
                let (output, off) = (fmu.name(outputs[i]), nearest[i]);
                assert!(off <= allowed, "{output} by {name}: {off:e} off, allowed {allowed:e}");
                if exact[i] != 0.0 {
                    moved.insert(name.clone());
                }
            }
        }
    }
    let all: BTreeSet<String> = parameters.iter().map(|it| fmu.name(*it).to_owned()).collect();
    // An emissivity goes with the night's heat only, the Sun's radius with its penumbra; every other parameter moves something
    // somewhere.
    if !in_shadow {
        moved.insert("sun.radius".to_owned());
    }
    assert_eq!(moved, all);
}

#[test]
fn slopes_along_parameters_are_those_of_differences() {
    check_parameter_slopes(Disturbance::messenger().near_the_earth(), 11, false);
    check_parameter_slopes(Disturbance::shadowed().near_the_earth(), 12, false);
}

#[test]
fn slopes_along_parameters_by_cells_are_those_of_differences() {
    check_parameter_slopes(Disturbance::messenger().near_the_earth().by_cells(6), 13, false);
}

#[test]
fn slopes_along_parameters_in_the_penumbra_are_those_of_differences() {
    check_parameter_slopes(Disturbance::messenger().near_the_earth(), 14, true);
}
