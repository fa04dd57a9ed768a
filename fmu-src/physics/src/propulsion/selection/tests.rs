//! Against thrusters whose best choice is known by symmetry, and against a search over all small sets.
use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

fn thruster(at: [f64; 3], force: [f64; 3]) -> Thruster {
    Thruster::plain(Vector3::from(at), Vector3::from(force))
}

/// Pairs on the six faces of a cube, pushing along it: twelve thrusters, a couple each way about each axis.
fn couples() -> Vec<Thruster> {
    let mut all = Vec::new();
    for axis in 0..3 {
        for sense in [1.0, -1.0] {
            for side in [1.0, -1.0] {
                let (mut at, mut force) = ([0.0; 3], [0.0; 3]);
                at[(axis + 1) % 3] = side;
                force[(axis + 2) % 3] = 4.0 * side * sense;
                all.push(thruster(at, force));
            }
        }
    }
    all
}

fn given(thrusters: &[Thruster], times: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
    let both = thrusters.iter().zip(times);
    let torque = both.clone().map(|(it, time)| it.position_body_m.cross(&it.force_body_n) * *time);
    (torque.sum(), both.map(|(it, time)| it.force_body_n * *time).sum())
}

#[test]
fn couples_give_torque_without_force() {
    let thrusters = couples();
    let found =
        ThrusterSelection::new(&thrusters, |_| true, &Vector3::zeros(), Preference::LeastForce).unwrap();
    let requested = Vector3::new(0.5, -2.0, 1.0);
    let times: Vec<f64> = found.on_times_s(&requested).collect();
    let (torque, force) = given(&thrusters, &times);
    assert_relative_eq!(torque, requested, epsilon = 1e-13);
    assert!(force.norm() < 1e-12, "{force}");
    // 4 N at 1 m twice.
    assert_relative_eq!(found.least_torque_n_m(), 8.0, max_relative = 1e-12);
}

#[test]
fn a_thruster_without_lever_is_named() {
    let axial = [thruster([0.0, 0.0, -1.0], [0.0, 0.0, 22.0])];
    let error =
        ThrusterSelection::new(&axial, |_| true, &Vector3::zeros(), Preference::LeastForce).unwrap_err();
    assert!(error.to_string().contains("+X"), "{error}");
    let no_left_turn = couples().into_iter().enumerate().filter(|(k, _)| !(10..12).contains(k));
    let some: Vec<Thruster> = no_left_turn.map(|(_, it)| it).collect();
    let error =
        ThrusterSelection::new(&some, |_| true, &Vector3::zeros(), Preference::LeastOnTime).unwrap_err();
    assert_eq!(error.axis, "-Z");
}

#[test]
fn the_weakest_that_suffice_are_taken() {
    let mut thrusters = couples();
    thrusters.extend(couples().into_iter().map(|it| {
        let force_body_n = it.force_body_n * 5.0;
        Thruster { force_body_n, torque_body_n_m: it.torque_body_n_m * 5.0, ..it }
    }));
    let found = ThrusterSelection::of_the_finest(&thrusters, |_| true, &Vector3::zeros());
    let times: Vec<f64> = found.unwrap().on_times_s(&Vector3::new(1.0, 1.0, 1.0)).collect();
    assert!(times[12..].iter().all(|it| *it == 0.0) && times[..12].iter().sum::<f64>() > 0.0);
    // Without the weak ones about Z, the strong ones come in.
    let found = ThrusterSelection::of_the_finest(&thrusters, |k| !(8..12).contains(&k), &Vector3::zeros());
    let times: Vec<f64> = found.unwrap().on_times_s(&Vector3::z()).collect();
    assert!(times[20..].iter().any(|it| *it > 0.0));
}

/// The least t'W t over all sets of at most three thrusters, and of pairs of such sets, found by trying.
fn least_on_time(thrusters: &[Thruster], requested: &Vector3<f64>) -> f64 {
    let torque: Vec<Vector3<f64>> =
        thrusters.iter().map(|it| it.position_body_m.cross(&it.force_body_n)).collect();
    let n = thrusters.len() as u32;
    // Every set of thrusters: the shortest on-times on it, if none is negative.
    (1_u32..1 << n)
        .filter_map(|set| {
            let members: Vec<usize> = (0..n).filter(|k| set >> k & 1 == 1).map(|k| k as usize).collect();
            let gram: Matrix3<f64> = members.iter().map(|k| torque[*k] * torque[*k].transpose()).sum();
            let dual = gram.pseudo_inverse(1e-10 * gram.norm()).ok()? * requested;
            let times: Vec<f64> = members.iter().map(|k| torque[*k].dot(&dual)).collect();
            let given: Vector3<f64> = members.iter().zip(&times).map(|(k, t)| torque[*k] * *t).sum();
            let fits = (given - requested).norm() < 1e-9 && times.iter().all(|t| *t >= -1e-12);
            fits.then(|| times.iter().map(|t| t * t).sum::<f64>())
        })
        .fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn no_set_of_thrusters_takes_less(
        places in prop::collection::vec((prop::array::uniform3(-1.0..1.0_f64), prop::array::uniform3(-5.0..5.0_f64)), 4..9)
    ) {
        let thrusters: Vec<Thruster> = places.iter().map(|(at, force)| thruster(*at, *force)).collect();
        let found = ThrusterSelection::new(&thrusters, |_| true, &Vector3::zeros(), Preference::LeastOnTime);
        for (axis, sign, _) in SENSES {
            let mut requested = Vector3::zeros();
            requested[axis] = sign;
            let least = least_on_time(&thrusters, &requested);
            match &found {
                Ok(selection) => {
                    let times: Vec<f64> = selection.on_times_s(&requested).collect();
                    let (torque, _) = given(&thrusters, &times);
                    prop_assert!((torque - requested).norm() < 1e-9);
                    let square: f64 = times.iter().map(|t| t * t).sum();
                    // Thrusters with hardly a lever are left to rounding on both sides.
                    prop_assert!(square > 1e4 || (square / least - 1.0).abs() < 1e-4, "{square} {least}");
                }
                Err(error) if error.axis == SENSES.iter().find(|it| it.0 == axis && it.1 == sign).unwrap().2 => {
                    prop_assert!(least > 1e6, "{error}, {least}");
                }
                Err(_) => {}
            }
        }
    }
}
