//! Two axes at two targets are TRIAD's attitude, and their rate is its derivative.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Vector3};

use super::*;
use crate::guidance::geometry::moving::{moving, rotation_value};
use crate::guidance::tests::geometry::Random;
use crate::guidance::tests::orbit::{TestOrbit, about_mercury, rate_error};
use crate::spacecraft::{NamedAttitude, TargetItem, TargetedAxis};

const ITEMS: [TargetItem; 7] = [
    TargetItem::Nadir,
    TargetItem::Velocity,
    TargetItem::OrbitNormal,
    TargetItem::Sun,
    TargetItem::Earth,
    TargetItem::Star,
    TargetItem::EclipticNorth,
];

/// Where everything stands, as plain vectors.
#[derive(Clone, Copy)]
struct Place {
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    sun: Vector3<f64>,
    earth: Vector3<f64>,
    star: Vector3<f64>,
}

impl Place {
    fn random(random: &mut Random) -> Self {
        Self {
            position: random.direction() * 7e6,
            velocity: random.direction() * 3e3,
            sun: random.direction() * 6e10,
            earth: random.direction() * 1e11,
            star: random.direction(),
        }
    }

    /// Unit vector to a target, by hand.
    fn toward(&self, item: TargetItem) -> Vector3<f64> {
        let obliquity_rad = 84_381.448_f64.to_radians() / 3600.0;
        match item {
            TargetItem::Nadir => -self.position,
            TargetItem::Velocity => self.velocity,
            TargetItem::OrbitNormal => self.position.cross(&self.velocity),
            TargetItem::Sun => self.sun - self.position,
            TargetItem::Earth => self.earth - self.position,
            TargetItem::Star => self.star,
            TargetItem::EclipticNorth => Vector3::new(0.0, -obliquity_rad.sin(), obliquity_rad.cos()),
        }
        .normalize()
    }

    /// Puts a target into this direction, if it can be put anywhere.
    fn put(&mut self, item: TargetItem, direction: Vector3<f64>) -> bool {
        match item {
            TargetItem::Sun => self.sun = self.position + direction * 6e10,
            TargetItem::Earth => self.earth = self.position + direction * 1e11,
            TargetItem::Star => self.star = direction.normalize(),
            TargetItem::Nadir
            | TargetItem::Velocity
            | TargetItem::OrbitNormal
            | TargetItem::EclipticNorth => {
                return false;
            }
        }
        true
    }

    fn ephemeris(&self) -> EphemerisAtTime {
        EphemerisAtTime {
            velocity: fixed(self.velocity),
            ..about_mercury(self.position, self.sun, self.earth)
        }
    }

    fn target(&self, item: TargetItem) -> PointingTarget {
        item.target([self.star.y.atan2(self.star.x), self.star.z.asin()])
    }
}

/// Columns of TRIAD (Black 1964): the first vector, their normal, and the third axis.
fn triad(first: &Vector3<f64>, second: &Vector3<f64>) -> Matrix3<f64> {
    let (along, normal) = (first.normalize(), first.cross(second).normalize());
    Matrix3::from_columns(&[along, normal, along.cross(&normal)])
}

#[test]
fn every_pair_of_targets_is_triads_attitude() {
    let mut random = Random(17);
    let (mut near, mut nearest) = (0, 1.0_f64);
    for case in 0..10_000 {
        let mut place = Place::random(&mut random);
        let [align, constrain] = loop {
            let pair = [random.one_of(&ITEMS), random.one_of(&ITEMS)];
            if pair[0] != pair[1] {
                break pair;
            }
        };
        let mut axes = [random.direction(), random.direction()];
        if case % 3 == 0 {
            let off = random.direction() * 10_f64.powf(random.within(-8.0, -2.0));
            let _ = place.put(constrain, place.toward(align) + off)
                || place.put(align, place.toward(constrain) + off);
        } else if case % 3 == 1 {
            axes[1] = axes[0] + random.direction() * 10_f64.powf(random.within(-8.0, -2.0));
        }
        let targets = [align, constrain].map(|item| place.toward(item));
        let sines =
            [targets[0].cross(&targets[1]).norm(), axes[0].normalize().cross(&axes[1].normalize()).norm()];
        let least = sines[0].min(sines[1]);
        if least < 2e-9 {
            // At 1e-9 the substitute takes over.
            continue;
        }
        near += i32::from(least < 1e-4);
        nearest = nearest.min(least);
        let targeted = |axis_body: Vector3<f64>, item| TargetedAxis {
            axis_body: axis_body * 3.0,
            target: place.target(item),
        };
        let given = AlignedAxes { align: targeted(axes[0], align), constrain: targeted(axes[1], constrain) };
        let found = aligned_vectors(&given, &place.ephemeris()).unwrap().pointing().unwrap();
        assert!(!found.degenerate, "{case}");
        let expected = triad(&targets[0], &targets[1]) * triad(&axes[0], &axes[1]).transpose();
        let off = (rotation_value(&found.inertial_from_body).matrix() - expected).norm();
        // A direction is known to some 1e-16, a normal to that over the sine.
        assert!(
            off < 1e-15 * (4.0 + 2.0 / sines[0] + 2.0 / sines[1]),
            "{case}: {align:?} {constrain:?} {off:e} {sines:?}"
        );
    }
    assert!(near > 1000 && nearest < 1e-7, "{near} {nearest:e}");
}

#[test]
fn the_rate_of_every_pair_is_the_derivative() {
    let orbit = TestOrbit::new(12.0);
    for align in ITEMS {
        for constrain in ITEMS.into_iter().filter(|item| *item != align) {
            let star = |item: TargetItem| item.target([1.0, -0.4]);
            let axes = AlignedAxes {
                align: TargetedAxis { axis_body: Vector3::new(0.1, 0.2, 1.0), target: star(align) },
                constrain: TargetedAxis { axis_body: Vector3::new(1.0, -0.5, 0.2), target: star(constrain) },
            };
            let attitude = |time_s: f64| {
                let vectors = aligned_vectors(&axes, &orbit.ephemeris(time_s))?;
                Some(vectors.pointing()?.inertial_from_body)
            };
            for time_s in [-9000.0, -900.0, 60.0, 1500.0, 15_000.0] {
                let off = rate_error(attitude, time_s, 0.5, 1e-5).unwrap();
                assert!(off < 1e-6, "{align:?} {constrain:?} at {time_s} s: {off:e}");
            }
        }
    }
}

#[test]
fn targets_on_one_line_give_way_to_the_substitute() {
    let place = Place { star: Vector3::new(0.0, 0.6, 0.8), ..Place::random(&mut Random(3)) };
    for axis in [1.0, -1.0] {
        let sun = place.position + Vector3::new(0.0, 0.6, 0.8) * (6e10 * axis);
        let ephemeris = Place { sun, ..place }.ephemeris();
        let targeted = |axis_body, item| TargetedAxis { axis_body, target: place.target(item) };
        let axes = AlignedAxes {
            align: targeted(Vector3::x(), TargetItem::Star),
            constrain: targeted(Vector3::y(), TargetItem::Sun),
        };
        let found = aligned_vectors(&axes, &ephemeris).unwrap().pointing().unwrap();
        assert!(found.degenerate);
        let rotation = rotation_value(&found.inertial_from_body);
        assert_relative_eq!(rotation * Vector3::x(), place.star, epsilon = 1e-15);
        // +Y toward the north of EME2000: none of it is left along Z.
        assert_relative_eq!((rotation * Vector3::z()).z, 0.0, epsilon = 1e-15);
        assert!((rotation * Vector3::y()).z > 0.0);
    }
}

#[test]
fn a_given_quaternion_is_the_attitude_and_stands_still() {
    let q = [0.36, -0.48, 0.64, 0.48];
    let axes = NamedAttitude::Inertial(q).axes(&[]).unwrap();
    let moving_place = EphemerisAtTime {
        position: moving(Vector3::x() * 7e6, Vector3::y() * 3e3),
        ..Place::random(&mut Random(5)).ephemeris()
    };
    let found = aligned_vectors(&axes, &moving_place).unwrap().pointing().unwrap();
    let [x, y, z, w] = q;
    // A(q) takes EME2000 to the body.
    let v = Vector3::new(x, y, z);
    let body_from_inertial = Matrix3::identity() * (w * w - v.norm_squared()) + v * v.transpose() * 2.0
        - v.cross_matrix() * (2.0 * w);
    let rotation = rotation_value(&found.inertial_from_body);
    let norm = v.norm_squared() + w * w;
    assert_relative_eq!(rotation.matrix().transpose(), body_from_inertial / norm, epsilon = 1e-15);
    assert_eq!(found.frame().rate_body_rad_s, Vector3::zeros());
}
