//! The limb point on the terminator once round an orbit over noon and midnight: how many there are, and which is taken.

use super::disc::{View, disc_chart};
use super::flight::{
    DEFAULT_EPOCH_S, Fmus, GEOMETRY, PointingCase, PointingGeometry, PointingSample, Simulated,
};
use super::limb_point::{Found, PLUS_Z, triaxial};
use crate::StudyError;
use crate::attitude::{Vector, across, angle_rad, greatest};
use crate::cells::row;
use crate::report::{Outcome, Run};
use crate::settings::set;
use drawing::{Chart, Panel, PlanePanel, Series};

/// 25 days in, the orbit passes over noon and midnight.
const EPOCH_S: f64 = DEFAULT_EPOCH_S + 25.0 * 86_400.0;
const ORBIT_S: u32 = 43_200;
/// Between samples that are looked at, in s.
const EVERY: usize = 60;
/// Bounds of the Sun keep-in zone, in deg (eqs 23 and 24).
const ZONE_DEG: [f64; 2] = [15.0, 13.0];

/// Simulates it without constraints: on this orbit the Sun would leave its zone.
pub(super) fn simulated(fmus: &Fmus) -> Result<Simulated, StudyError> {
    let off = ["keepIn.enabled", "hotPole.enabled", "monitor.enabled"].map(|name| set(name, false));
    fmus.simulated(&PointingCase {
        label: "terminator",
        epoch_s: EPOCH_S,
        true_anomaly_deg: 0.0,
        seconds: ORBIT_S,
        parameters: [triaxial(), off.concat()].concat(),
        command: &|_: &PointingGeometry| set("pointing.scenario", "limbTerminator"),
    })
}

/// One sample and the solutions found along the terminator.
struct Point<'a> {
    sample: &'a PointingSample,
    solutions: Vec<Vector>,
    /// Of the solutions the nearer to the downtrack direction; none where there is none.
    nearer: Option<Vector>,
    boresight: Vector,
    found: Option<Found>,
}

/// Prints and draws it.
pub(super) fn print(run: &mut Run<'_>, simulated: &Simulated) -> Outcome {
    let points: Vec<Point<'_>> =
        simulated.samples.iter().step_by(EVERY).map(|sample| point(sample, simulated)).collect();
    run.line("\nLimb on the terminator over an orbit that passes over noon and midnight, no constraints:\n");
    let total = points.len();
    let count = |n: usize| points.iter().filter(|point| point.solutions.len() == n).count();
    let two = || points.iter().filter_map(|point| Some((point, point.nearer?)));
    let aim_rad = |(point, aim): (&Point<'_>, Vector)| {
        angle_rad(&point.boresight, &(aim - point.sample.place.position_m))
    };
    let reported = points.iter().filter(|point| point.sample.reachable != point.solutions.is_empty()).count();
    let nadir_rad = |point: &Point<'_>| angle_rad(&point.boresight, &point.sample.place.nadir_m());
    let elevations = || points.iter().map(|point| point.sun_deg()[1]);
    let [least, most] = [f64::min, f64::max].map(|pick| elevations().reduce(pick).unwrap_or(f64::NAN));
    let inside =
        points.iter().filter(|point| (0..2).all(|i| point.sun_deg()[i].abs() <= ZONE_DEG[i])).count();
    let share = |n: usize| format!("{:.1} % ({n} of {total} minutes)", 100.0 * n as f64 / total as f64);
    let rows = [
        ("two solutions", share(count(2))),
        ("none: +Z to the planet's centre", share(count(0))),
        ("target.reachable says which", format!("{reported} of {total}")),
        (
            "+Z off the solution nearer to downtrack, greatest",
            format!("{:.1e} rad", greatest(two().map(aim_rad))),
        ),
        (
            "+Z off the centre where there is none, greatest",
            format!(
                "{:.1e} rad",
                greatest(points.iter().filter(|point| point.nearer.is_none()).map(nadir_rad))
            ),
        ),
        (
            "height residual, greatest",
            format!(
                "{:.1e} m",
                greatest(two().filter_map(|(point, _)| Some(point.found.as_ref()?.height_m)))
            ),
        ),
        ("Sun elevation in the body frame", format!("{least:+.1} to {most:+.1} deg")),
        ("Sun azimuth, greatest", format!("{:.1e} deg", greatest(points.iter().map(|p| p.sun_deg()[0])))),
        ("Sun within its zone of 15 by 13 deg", share(inside)),
    ];
    run.table("terminator limb | ", &rows.map(|(name, value)| vec![name.to_owned(), value]));
    write(run, &points)?;
    run.picture("limb-terminator.svg", &chart(&points))?;
    draw_discs(run, simulated, &points)
}

fn point<'a>(sample: &'a PointingSample, simulated: &Simulated) -> Point<'a> {
    let (place, ellipsoid) = (&sample.place, simulated.planet.at(sample.place.epoch_s));
    let solutions = ellipsoid.terminator_limb_points(&place.position_m, &place.sun_m());
    let up = place.position_m.normalize();
    let along = |x: &Vector| {
        let track = across(&place.velocity_m_s, &up);
        let to = x - place.position_m;
        to.dot(&track) / to.norm()
    };
    let nearer = solutions.iter().copied().max_by(|a, b| along(a).total_cmp(&along(b)));
    let found = nearer.and_then(|_| Found::of(sample, &ellipsoid));
    Point { sample, solutions, nearer, boresight: sample.inertial(&PLUS_Z), found }
}

impl Point<'_> {
    fn sun_deg(&self) -> [f64; 2] {
        self.sample.body_angles_deg(&self.sample.place.to_sun_m)
    }

    /// About the local vertical from downtrack; none where +Z is at the centre.
    fn azimuth_deg(&self) -> f64 {
        let azimuth = |_: &Found| View::at(&self.sample.place).azimuth_deg(&self.boresight);
        self.found.as_ref().map_or(f64::NAN, azimuth)
    }
}

fn write(run: &mut Run<'_>, points: &[Point<'_>]) -> Outcome {
    let own = "solutions | reachable | azimuth_deg | height_m | sun_azimuth_deg | sun_elevation_deg";
    let rows = points.iter().map(|point| {
        let height_m = point.found.as_ref().map_or(f64::NAN, |found| found.height_m);
        let solutions = row![point.solutions.len(), point.sample.reachable];
        row![solutions, point.azimuth_deg(), height_m, point.sun_deg(), point.sample.geometry()]
    });
    run.csv("limb-terminator.csv", &format!("{own} | {GEOMETRY}"), rows)
}

fn chart(points: &[Point<'_>]) -> Chart {
    let over = |value: &dyn Fn(&Point<'_>) -> f64| {
        points.iter().map(|point| (point.sample.place.time_s / 3600.0, value(point))).collect::<Vec<_>>()
    };
    let line = |value: &dyn Fn(&Point<'_>) -> f64| vec![Series::line("", over(value))];
    Chart::new("Limb on the terminator over one orbit", "time since periapsis [h]").with([
        Panel::new("solutions").range(-0.2, 2.2).whole().with(line(&|point| point.solutions.len() as f64)),
        Panel::new("azimuth [deg]").with([Series::dots(
            "of the commanded limb point, from downtrack",
            over(&|point| point.azimuth_deg()),
        )]),
        Panel::new("Sun elevation [deg]")
            .marks("keep-in zone", vec![-ZONE_DEG[1], ZONE_DEG[1]])
            .with([Series::line("in the body frame", over(&|p| p.sun_deg()[1]))]),
    ])
}

/// The disc where the solutions are two, and where there is none.
fn draw_discs(run: &mut Run<'_>, simulated: &Simulated, points: &[Point<'_>]) -> Outcome {
    // Far out, so that the disc is small, and in the middle of the gap.
    let two = points.iter().find(|point| point.sample.place.time_s >= 10_800.0 && point.nearer.is_some());
    let gap: Vec<&Point<'_>> = points.iter().filter(|point| point.nearer.is_none()).collect();
    let panels: Vec<PlanePanel> =
        two.into_iter().chain(gap.get(gap.len() / 2).copied()).map(|point| panel(point, simulated)).collect();
    let chart = disc_chart("Limb points on the terminator", panels);
    run.picture("limb-discs.svg", &chart)
}

fn panel(point: &Point<'_>, simulated: &Simulated) -> PlanePanel {
    let place = &point.sample.place;
    let view = View::at(place);
    let mut panel = view.disc("", &simulated.planet.at(place.epoch_s), &place.sun_m());
    let found = if point.solutions.is_empty() { "none, the terminator is hidden" } else { "two" };
    panel.title = format!("{:.2} h after periapsis: {found}", place.time_s / 3600.0);
    panel.series.push(Series::rings(
        "limb points on the terminator",
        point.solutions.iter().map(|x| view.point(x)).collect(),
    ));
    panel.series.push(Series::dots("commanded +Z", vec![view.direction(&point.boresight)]));
    panel
}
