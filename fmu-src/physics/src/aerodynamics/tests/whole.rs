//! A spacecraft with panels: shadows against rays, derivatives against differences, faces, temperatures, no air.

use approx::assert_relative_eq;

use super::*;
use crate::numerics::scalar::{Dual64, Scalar};
use crate::spacecraft::{Panel, Polygon};

/// A bus with a panel on a side and a plate over it, every one with both faces.
const WINGED: &str = r#"
name = "winged"
[mass_properties]
mass_kg = 100.0
center_of_mass_m = [0, 0, 0]
inertia_kg_m2 = [[10, 0, 0], [0, 10, 0], [0, 0, 10]]
[optics.black]
specular = 0
diffuse = 0
energy_accommodation = 0.8
[optics.rough]
specular = 0
diffuse = 0
drag_coefficient = 2.8
energy_accommodation = 1.0
normal_accommodation = 0.7
tangential_accommodation = 0.5
wall_temperature_k = 400
[[boxes]]
name = "bus"
center_m = [0, 0, 0]
size_m = [1.0, 1.2, 1.6]
optics = "black"
rear_optics = "black"
[[plates]]
polygon_m = [[0.9, -0.4, 0.2], [0.9, 0.5, 0.2], [0.6, 0.5, 1.5], [0.6, -0.4, 1.5]]
optics = "rough"
rear_optics = "black"
[[panels]]
polygon_m = [[0.8, 0, -0.5], [2.8, 0, -0.5], [2.8, 0, 0.5], [0.8, 0, 0.5]]
optics = "black"
rear_optics = "rough"
"#;

/// What a ray against the flow from a point far upstream meets first: index of the polygon and how far along.
fn first_met(outlines: &[Polygon], from: &Vector3<f64>, along: &Vector3<f64>) -> Option<(usize, f64)> {
    let met = outlines.iter().enumerate().filter_map(|(index, outline)| {
        let (v, normal) = (outline.vertices_m(), outline.normal());
        let distance = normal.dot(&(v[0] - from)) / normal.dot(along);
        let point = from + along * distance;
        let inside = (0..v.len()).all(|k| {
            let (a, b) = (v[k], v[(k + 1) % v.len()]);
            normal.dot(&(b - a).cross(&(point - a))) >= 0.0
        });
        inside.then_some((index, distance))
    });
    met.min_by(|a, b| a.1.total_cmp(&b.1))
}

fn turned(panel: &Panel, angle_rad: f64) -> Polygon {
    let axis = nalgebra::Unit::new_normalize(panel.axis_body);
    let turn = nalgebra::Rotation3::from_axis_angle(&axis, angle_rad);
    panel.polygon.as_ref().unwrap().moved(|v| panel.center_body_m + turn * (v - panel.center_body_m))
}

/// By the law dragCoefficient every ray exerts its force where it first meets a face.
#[test]
fn shadows_are_those_of_rays() {
    let spacecraft = spacecraft(WINGED);
    let model = model(&spacecraft, LAWS[0]);
    let angle_rad = 0.7;
    let mut outlines: Vec<_> = spacecraft.plates.iter().map(|plate| plate.polygon.clone().unwrap()).collect();
    outlines.push(turned(&spacecraft.panels[0], angle_rad));
    // Drag coefficients of front and rear.
    let mut coefficients: Vec<_> = spacecraft.plates.iter().map(|plate| plate.faces.gas_surface).collect();
    coefficients.push(spacecraft.panels[0].faces.gas_surface);
    const RAYS: u32 = 400_000;
    for upstream in [[1.0, 0.2, 0.1], [0.5, -0.7, 0.6], [-0.3, 0.5, 0.9]] {
        let upstream = Vector3::from(upstream).normalize();
        let flow = thin_air(upstream * 7600.0);
        let (east, half_m) = (upstream.cross(&Vector3::z()).normalize(), 3.5);
        let north = upstream.cross(&east);
        let cell_m2 = 4.0 * half_m * half_m / f64::from(RAYS);
        let mut expected = ForceTorque::zero();
        for k in 0..RAYS {
            // The additive recurrence of the plastic number (Roberts 2018): no edge runs along a row of rays.
            let [a, b] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2]
                .map(|step| ((0.5 + f64::from(k) * step).fract() * 2.0 - 1.0) * half_m);
            let from = upstream * 10.0 + east * a + north * b;
            if let Some((index, distance)) = first_met(&outlines, &from, &-upstream) {
                let is_rear = outlines[index].normal().dot(&upstream) < 0.0;
                let coefficient = coefficients[index][usize::from(is_rear)].drag_coefficient;
                let pressure_pa = 0.5 * flow.density_kg_m3 * 7600.0 * 7600.0 * coefficient;
                let force_n = -upstream * (pressure_pa * cell_m2);
                expected += ForceTorque::at_arm(&(from - upstream * distance), force_n);
            }
        }
        let found = load(&model, &flow, &[angle_rad]);
        let tolerance = 1e-3 * expected.force_body_n.norm();
        assert_relative_eq!(found.force_body_n, expected.force_body_n, epsilon = tolerance);
        assert_relative_eq!(found.torque_body_n_m, expected.torque_body_n_m, epsilon = tolerance);
        let options = AerodynamicOptions {
            law: AerodynamicLaw::DragCoefficient,
            shadowing: false,
            ..AerodynamicOptions::default()
        };
        let open = load(&AerodynamicModel::new(&spacecraft, &options).unwrap(), &flow, &[angle_rad]);
        assert!((open.force_body_n - found.force_body_n).norm() > 10.0 * tolerance, "{upstream}");
    }
}

/// Seeds: density, temperature, molar mass, velocity, angle of the panel, centre of mass.
fn at_numbers<T: Scalar>(
    model: &AerodynamicModel,
    numbers: &[T; 10],
    workspace: &mut AerodynamicWorkspace<T>,
) -> [T; 6] {
    let [density_kg_m3, temperature_k, molar_mass_kg_mol, x, y, z, angle_rad, a, b, c] = *numbers;
    let velocity_body_m_s = Vector3::new(x, y, z);
    let flow = AirFlow { density_kg_m3, temperature_k, molar_mass_kg_mol, velocity_body_m_s };
    let found = model.load(&flow, &[angle_rad], &Vector3::new(a, b, c), Walls::OWN, workspace);
    let [f, t] = [found.force_body_n, found.torque_body_n_m];
    [f.x, f.y, f.z, t.x, t.y, t.z]
}

#[test]
fn derivatives_of_all_laws_are_slopes() {
    let spacecraft = spacecraft(WINGED);
    for velocity in [[7100.0, -2000.0, 1500.0], [2500.0, -3700.0, 5700.0]] {
        let [x, y, z] = velocity;
        let start = [1e-11, 1000.0, 0.018, x, y, z, 0.4, 0.2, -0.1, 0.3];
        for law in LAWS {
            let model = model(&spacecraft, law);
            let mut workspace = AerodynamicWorkspace::default();
            let scale =
                at_numbers(&model, &start, &mut workspace).map(f64::abs).into_iter().fold(0.0, f64::max);
            assert!(workspace.shadows_cut() > 0);
            for seed in 0..start.len() {
                let mut dual = start.map(Dual64::constant);
                // Relative, but for angle and place.
                let step = if seed < 6 { start[seed] } else { 1.0 };
                dual[seed] = Dual64::new(start[seed], step);
                let exact = at_numbers(&model, &dual, &mut AerodynamicWorkspace::default());
                let mut side = |h: f64| {
                    let mut moved = start;
                    moved[seed] += h * step;
                    at_numbers(&model, &moved, &mut workspace)
                };
                let (above, below) = (side(1e-5), side(-1e-5));
                for (k, exact) in exact.iter().enumerate() {
                    let slope = (above[k] - below[k]) / 2e-5;
                    assert!(
                        (slope - exact.eps).abs() < 1e-8 * scale,
                        "{law:?} by {seed} of {k}: {} {slope}",
                        exact.eps
                    );
                }
            }
        }
    }
}

/// The bus's side, half in the plate's shadow, turns through the flow's direction.
#[test]
fn a_shadowed_face_passes_the_flow_without_a_step() {
    let spacecraft = spacecraft(WINGED);
    for law in LAWS {
        let model = model(&spacecraft, law);
        let toward = |tilt_rad: f64| {
            let flow = thin_air(Vector3::new(tilt_rad, 0.3, 1.0).normalize() * 7600.0);
            load(&model, &flow, &[0.0])
        };
        let (before, after) = (toward(-1e-9), toward(1e-9));
        let force_n = after.force_body_n.norm();
        assert!((after.force_body_n - before.force_body_n).norm() < 1e-7 * force_n, "{law:?}");
        assert!((after.torque_body_n_m - before.torque_body_n_m).norm() < 1e-7 * force_n, "{law:?}");
    }
}

/// Panels without an angle are at 0; a face's own temperature takes precedence over its material's.
#[test]
fn wall_temperatures_of_a_heat_balance_replace_those_of_the_materials() {
    let spacecraft = spacecraft(WINGED);
    let flow = thin_air(Vector3::new(7600.0, 500.0, -300.0));
    let count = AerodynamicModel::new(&spacecraft, &AerodynamicOptions::default()).unwrap().face_count();
    for law in &LAWS[1..] {
        let mut hot = spacecraft.clone();
        let faces = hot.plates.iter_mut().map(|plate| &mut plate.faces.gas_surface);
        for face in faces.chain(hot.panels.iter_mut().map(|panel| &mut panel.faces.gas_surface)).flatten() {
            face.wall_temperature_k = 500.0;
        }
        let (cold, hot) = (model(&spacecraft, *law), model(&hot, *law));
        let temperatures_k = vec![500.0; count];
        let mut workspace = AerodynamicWorkspace::default();
        let walls = Walls { temperatures_k: Some(&temperatures_k), ..Walls::OWN };
        let given = cold.load(&flow, &[0.0], &Vector3::zeros(), walls, &mut workspace);
        assert_eq!(given, load(&hot, &flow, &[]));
        assert_ne!(given, load(&cold, &flow, &[]));
    }
}

#[test]
fn no_air_exerts_no_force_and_a_little_exerts_its_slope() {
    let spacecraft = spacecraft(WINGED);
    for law in LAWS {
        let model = model(&spacecraft, law);
        let flow = thin_air(Vector3::new(7600.0, 500.0, -300.0));
        let none = AirFlow { density_kg_m3: 0.0, temperature_k: 0.0, molar_mass_kg_mol: 0.0, ..flow };
        assert_eq!(load(&model, &none, &[]), ForceTorque::zero());
        let seeded = AirFlow {
            density_kg_m3: Dual64::new(0.0, 1.0),
            temperature_k: Dual64::constant(flow.temperature_k),
            molar_mass_kg_mol: Dual64::constant(flow.molar_mass_kg_mol),
            velocity_body_m_s: flow.velocity_body_m_s.map(Dual64::constant),
        };
        let mut workspace = AerodynamicWorkspace::default();
        let slope = model.load(&seeded, &[], &Vector3::zeros(), Walls::OWN, &mut workspace).force_body_n;
        let force_n = load(&model, &flow, &[]).force_body_n;
        assert_relative_eq!(slope.map(|x| x.eps) * 1e-11, force_n, epsilon = 1e-14 * force_n.norm());
    }
}
