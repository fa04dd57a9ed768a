//! Which thruster a burn fires unless it is reported.

use crate::spin::spinner::Spinner;

/// ACE's file with its thrusters and groups taken out and these put in: name, position, direction.
fn with_thrusters(thrusters: &[(&str, [f64; 3], [f64; 3])]) -> Spinner {
    let ace = include_str!("../../../../resources/ace.toml");
    let (before, rest) = ace.split_at(ace.find("[[thruster]]").unwrap());
    let after = &rest[rest.find("[star_tracker]").unwrap()..];
    let tables: String = thrusters
        .iter()
        .map(|(name, position, direction)| {
            format!("[[thruster]]\nname = \"{name}\"\nforce_n = 4.0\nposition_m = {position:?}\ndirection = {direction:?}\n")
        })
        .collect();
    Spinner::parse("own.toml", &format!("{before}{tables}{after}")).unwrap()
}

#[test]
fn a_steering_thruster_tilts_the_momentum_and_has_an_opposite() {
    let spin = ("spin", [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let along = ("along", [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
    let right = ("right", [0.5, 0.0, -0.4], [0.0, 0.0, 1.0]);
    let left = ("left", [-0.5, 0.0, -0.4], [0.0, 0.0, 1.0]);
    let canted = ("canted", [0.5, 0.2, -0.4], [0.0, 0.6, 0.8]);
    assert_eq!(with_thrusters(&[spin, along, right, left]).steering_pair(), Some((2, Some(3))));
    assert_eq!(with_thrusters(&[spin, right]).steering_pair(), Some((1, None)));
    assert_eq!(with_thrusters(&[spin, along]).steering_pair(), None);
    assert_eq!(with_thrusters(&[canted, spin]).steering_pair(), Some((0, None)), "better than none");
    assert_eq!(with_thrusters(&[canted, left]).steering_pair(), Some((1, None)));
}

#[test]
fn the_first_pair_of_ace_is_the_papers() {
    let ace = Spinner::parse("ace.toml", include_str!("../../../../resources/ace.toml")).unwrap();
    let (first, opposite) = ace.steering_pair().unwrap();
    let name = |k: usize| ace.thrusters[k].name.as_str();
    assert_eq!((name(first), opposite.map(name)), ("IIIR", Some("IVR")));
}
