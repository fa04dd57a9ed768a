//! The planet's disc as the spacecraft sees it: angles from nadir, limb, night side, terminator.

use super::flight::PointingGeometry;
use super::planet::Ellipsoid;
use crate::attitude::{Vector, across};
use drawing::{PlaneChart, PlanePanel, Series};

/// A view toward nadir: downtrack to the right, the orbit's left up.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    from_m: Vector,
    right: Vector,
    up: Vector,
    nadir: Vector,
}

/// A chart of discs.
pub(super) fn disc_chart(title: &str, panels: Vec<PlanePanel>) -> PlaneChart {
    let [x_label, y_label] = ["downtrack of nadir [deg]", "left of the track [deg]"].map(str::to_owned);
    PlaneChart { title: title.to_owned(), x_label, y_label, panels, ..PlaneChart::default() }
}

const POINTS: u32 = 720;

impl View {
    /// From where the spacecraft is.
    pub(super) fn at(place: &PointingGeometry) -> Self {
        let nadir = place.nadir_m().normalize();
        let right = across(&place.velocity_m_s, &nadir).normalize();
        // Seen along nadir: right, up and the direction to the viewer are right-handed.
        Self { from_m: place.position_m, right, up: right.cross(&nadir), nadir }
    }

    /// The direction with these tangents to the right and up.
    pub(super) fn ray(&self, x: f64, y: f64) -> Vector {
        self.nadir + self.right * x + self.up * y
    }

    /// A direction: the angle from nadir in deg, laid off at its position angle.
    pub(super) fn direction(&self, direction: &Vector) -> (f64, f64) {
        let [x, y] = [&self.right, &self.up].map(|axis| axis.dot(direction));
        let side = x.hypot(y);
        let angle_deg = side.atan2(direction.dot(&self.nadir)).to_degrees();
        if side == 0.0 { (0.0, 0.0) } else { (angle_deg * x / side, angle_deg * y / side) }
    }

    /// A point by its vector from the planet's centre.
    pub(super) fn point(&self, point_m: &Vector) -> (f64, f64) {
        self.direction(&(point_m - self.from_m))
    }

    /// Azimuth of a direction about the local vertical, right-handed about up from downtrack, in deg.
    pub(super) fn azimuth_deg(&self, direction: &Vector) -> f64 {
        // Right-handed about up, as seen from above: counterclockwise.
        self.up.dot(direction).atan2(self.right.dot(direction)).to_degrees()
    }

    /// Angular radius of the disc, in deg.
    pub(super) fn radius_deg(&self, ellipsoid: &Ellipsoid) -> f64 {
        let limb = ellipsoid.limb(&self.from_m, POINTS);
        limb.iter().map(|x| self.point(x)).map(|(x, y)| x.hypot(y)).fold(0.0, f64::max)
    }

    /// Limb, terminator and night side.
    pub(super) fn disc(&self, title: &str, ellipsoid: &Ellipsoid, sun: &Vector) -> PlanePanel {
        let limb = ellipsoid.limb(&self.from_m, POINTS);
        let terminator = ellipsoid.great_ellipse(sun, POINTS);
        let seen = run(&terminator, |x| ellipsoid.beyond_limb(x, &self.from_m) > 0.0);
        let dark = run(&limb, |x| !Ellipsoid::is_day(x, sun));
        let mut night = dark.clone();
        match (night.last(), seen.first(), seen.last()) {
            (Some(end), Some(first), Some(last)) => {
                let nearer = (end - first).norm() <= (end - last).norm();
                if nearer { night.extend(&seen) } else { night.extend(seen.iter().rev()) }
            }
            (None, _, _) => night.clear(),
            _ => {}
        }
        let points = |list: &[Vector]| list.iter().map(|x| self.point(x)).collect::<Vec<_>>();
        let mut around = points(&limb);
        around.extend(around.first().copied());
        PlanePanel {
            title: title.to_owned(),
            areas: vec![points(&night)],
            series: vec![
                Series::line("limb", around),
                Series::dashed("terminator, night side shaded", points(&seen)),
            ],
            half_width: 1.25 * self.radius_deg(ellipsoid),
            ..PlanePanel::default()
        }
    }
}

/// The points of a closed curve that pass, in order, beginning after a gap.
fn run(curve: &[Vector], passes: impl Fn(&Vector) -> bool) -> Vec<Vector> {
    let count = curve.len();
    let start = (0..count).find(|k| passes(&curve[*k]) && !passes(&curve[(k + count - 1) % count]));
    let from = start.unwrap_or(0);
    (0..count).map(|k| curve[(from + k) % count]).filter(passes).collect()
}
