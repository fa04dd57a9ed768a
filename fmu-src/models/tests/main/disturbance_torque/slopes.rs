//! Directional derivatives are slopes, and appear only where dependencies are declared.

use std::collections::{BTreeMap, BTreeSet};

use fmi_export::Status;
use model_description::Causality;

use super::driver::{Dice, Disturbance};

/// Slopes of every output along every input, against central differences over many geometries.
fn check_slopes(mut fmu: Disturbance, seed: u64, in_shadow: bool) {
    fmu.start();
    let mut dice = Dice(seed);
    let outputs = fmu.references(Causality::Output);
    let vectors = fmu.vectors_of(&outputs);
    let mut checked = vec![0; outputs.len()];
    for _ in 0..40 {
        let (inputs, values) = dice.inputs(&fmu, in_shadow);
        // A direction that moves everything by about a thousandth of what matters.
        let scale = |reference: u32| match fmu.name(reference).split('.').next().unwrap() {
            "sun" => 5.8e10,
            "planet" if !fmu.name(reference).contains("pole") => 2.4e6,
            _ => 1.0,
        };
        let along: Vec<f64> = inputs.iter().map(|at| (dice.next() - 0.5) * scale(*at)).collect();
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
    check_slopes(Disturbance::messenger(), 1, false);
}

#[test]
fn directional_derivatives_with_shadows_are_slopes() {
    check_slopes(Disturbance::shadowed(), 2, false);
}

#[test]
fn directional_derivatives_by_cells_are_slopes() {
    check_slopes(Disturbance::messenger().by_cells(12), 4, false);
}

#[test]
fn directional_derivatives_in_the_penumbra_are_slopes() {
    check_slopes(Disturbance::messenger(), 3, true);
}

/// Over many geometries, in light and penumbra, an output changes with an input only if it says so; and every
/// declared dependency is seen at least once.
#[test]
fn what_depends_is_declared() {
    // Cells of the planet have a pole, rings have none.
    for mut fmu in [Disturbance::messenger().by_cells(6), Disturbance::shadowed().by_cells(6)] {
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
        let mut dice = Dice(77);
        for round in 0..120 {
            let (at, values) = dice.inputs(&fmu, round % 3 == 0);
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
        let total = fmu.at("torque.total[2]");
        assert_eq!(seen[&total], declared[&total]);
        let lit = fmu.at("sun.litFraction");
        assert_eq!(seen[&lit], declared[&lit]);
    }
}

#[test]
fn derivatives_by_anything_but_inputs_are_refused() {
    let mut fmu = Disturbance::messenger();
    fmu.start();
    let (output, flux) = (fmu.at("force.solar[2]"), fmu.at("solar.flux"));
    let mut result = [0.0];
    assert_eq!(fmu.fmu.get_directional_derivative(&[output], &[flux], &[1.0], &mut result), Status::Error);
}
