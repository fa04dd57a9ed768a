//! Which antenna is nearest, and what a beam covers.
use super::*;
use crate::guidance::tests::geometry::Random;

/// MESSENGER's antenna on the sunshade.
pub(crate) const SUNSHADE: Option<AntennaRow> = Some(AntennaRow(0));
/// MESSENGER's antenna on the back.
pub(crate) const BACK: Option<AntennaRow> = Some(AntennaRow(1));

pub(crate) fn fan(from_deg: f64, to_deg: f64) -> Antenna {
    let [middle_rad, half_rad] = [0.5 * (from_deg + to_deg), 0.5 * (to_deg - from_deg)].map(f64::to_radians);
    let range = AntennaRange::Fan(FanAzimuths { middle_rad, half_rad });
    Antenna { range, across_rad: 4_f64.to_radians(), along_rad: 15_f64.to_radians() }
}

pub(crate) fn fixed_along(axis_body: Vector3<f64>) -> Antenna {
    Antenna { range: AntennaRange::Axis(axis_body), ..fan(0.0, 1.0) }
}

pub(crate) fn antennas(list: &[Antenna]) -> Antennas {
    let named = |antenna: &Antenna| NamedAntenna { name: String::new(), antenna: *antenna };
    Antennas::new(&list.iter().map(named).collect::<Vec<_>>())
}

/// MESSENGER's.
pub(crate) fn quadrants() -> Antennas {
    antennas(&[fan(-90.0, 0.0), fan(90.0, 180.0)])
}

#[test]
fn a_fan_over_180_deg_stays_within_a_turn() {
    let all = antennas(&[fan(170.0, 190.0)]);
    for (requested_deg, found_deg, outside_deg) in
        [(175.0_f64, 175.0_f64, 0.0_f64), (-175.0, -175.0, 0.0), (160.0, 170.0, 10.0), (-100.0, -170.0, 70.0)]
    {
        let found = all.nearest_fan(requested_deg.to_radians());
        assert!((found.azimuth_rad.to_degrees() - found_deg).abs() < 1e-10, "{requested_deg}: {found:?}");
        assert!((found.outside_rad.to_degrees() - outside_deg).abs() < 1e-10, "{requested_deg}: {found:?}");
    }
}

#[test]
fn the_nearest_antenna_has_the_least_angle() {
    let list = [fan(-40.0, 20.0), fixed_along(Vector3::z()), fixed_along(Vector3::new(0.6, 0.8, 0.0))];
    let all = antennas(&list);
    let mut random = Random(41);
    for _ in 0..2_000 {
        let direction = random.direction();
        let found = all.toward(&direction).antenna.unwrap();
        let off_rad = |index: usize| match list[index].axis_body() {
            Some(axis_body) => axis_body.angle(&direction),
            None => (-4000..=2000)
                .map(|k| (f64::from(k) * 0.01).to_radians())
                .map(|azimuth_rad| Vector3::new(azimuth_rad.sin(), -azimuth_rad.cos(), 0.0).angle(&direction))
                .fold(f64::INFINITY, f64::min),
        };
        let least_rad = (0..3).map(off_rad).fold(f64::INFINITY, f64::min);
        assert!(off_rad(usize::from(found.0)) < least_rad + 1e-4, "{direction}");
    }
}

#[test]
fn a_fixed_beam_is_an_ellipse_about_its_axis() {
    let all = antennas(&[fixed_along(Vector3::new(0.0, -1.0, 0.0)), fixed_along(Vector3::z())]);
    let degrees = |deg: f64| deg.to_radians();
    // Along X and across it, about -Y and about +Z.
    for (row, turn) in [(0, [Vector3::z(), Vector3::x()]), (1, [Vector3::y(), Vector3::x()])] {
        let axis_body = all.get(AntennaRow(row)).unwrap().axis_body().unwrap();
        let beam = AntennaAzimuth::fixed(AntennaRow(row), &axis_body);
        for (along_deg, across_deg, is_in) in [
            (0.0, 0.0, true),
            (7.4, 0.0, true),
            (7.6, 0.0, false),
            (0.0, 1.9, true),
            (0.0, 2.1, false),
            (5.4, 1.5, false),
        ] {
            let off = turn[0] * degrees(along_deg) + turn[1] * degrees(across_deg);
            let direction = nalgebra::Rotation3::new(off) * axis_body;
            assert_eq!(all.covers(&beam, &direction, None), is_in, "{row}: {along_deg} {across_deg}");
        }
        // A width that is set counts across alone.
        let wide = nalgebra::Rotation3::new(turn[1] * degrees(2.9)) * axis_body;
        assert!(!all.covers(&beam, &wide, None) && all.covers(&beam, &wide, Some(degrees(3.0))));
        assert!(!all.covers(&beam, &-axis_body, None));
    }
}
