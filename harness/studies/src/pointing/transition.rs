//! Figures 7 and 8: from downlink to the camera at nadir, as commanded.

use super::flight::{
    DEFAULT_EPOCH_S, Fmus, GEOMETRY, PointingCase, PointingGeometry, PointingSample, Simulated,
};
use crate::StudyError;
use crate::attitude::{angle_rad, greatest};
use crate::cells::row;
use crate::report::{Outcome, Run};
use crate::settings::{Settings, set};
use crate::verdict::{agrees, compared};
use drawing::{Chart, Mark, Panel, Series};

/// Sun and Earth are 33 deg apart as seen from the spacecraft, as the paper's antenna azimuth of -33 deg asks for with the
/// Sun at azimuth and elevation 0. The paper prints no epoch.
pub(crate) const EPOCH_S: f64 = DEFAULT_EPOCH_S + 3.15 * 86_400.0;
/// Assumed: ten hours past periapsis, the end of the paper's eight hours of downlink about apoapsis.
pub(crate) const TRUE_ANOMALY_DEG: f64 = 215.0;
/// "The commanded slew begins at 500 seconds".
pub(crate) const SLEW_S: f64 = 500.0;
const END_S: u32 = 1000;

/// A label, and whether the camera's angle is commanded again every second after the slew, so that the Sun stays on -Y;
/// otherwise the angle of the slew stays.
type CameraCase = (&'static str, bool);

const CASES: [CameraCase; 2] = [("camera follows", true), ("camera held", false)];

fn simulated((label, is_followed): CameraCase, fmus: &Fmus) -> Result<Simulated, StudyError> {
    let command = |place: &PointingGeometry| -> Settings {
        let camera = || {
            // -Y at the Sun and the camera at nadir: the camera stands as far sunward of +Z as nadir does.
            let sun_nadir_rad = angle_rad(&place.to_sun_m, &place.nadir_m());
            set("boresight.angle", core::f64::consts::FRAC_PI_2 - sun_nadir_rad)
        };
        if place.time_s == 0.0 {
            set("pointing.scenario", "downlink")
        } else if place.time_s == SLEW_S {
            [set("pointing.scenario", "gimbal"), set("aimpoint.option", "nadir"), camera()].concat()
        } else if place.time_s > SLEW_S && is_followed {
            camera()
        } else {
            Vec::new()
        }
    };
    fmus.simulated(&PointingCase {
        label,
        epoch_s: EPOCH_S,
        true_anomaly_deg: TRUE_ANOMALY_DEG,
        seconds: END_S,
        parameters: Vec::new(),
        command: &command,
    })
}

/// What the figures show at one second: azimuth and elevation of Sun, Earth and Mercury in the body frame, in deg.
fn angles_deg(sample: &PointingSample) -> [[f64; 2]; 3] {
    let place = &sample.place;
    [place.to_sun_m, place.to_earth, place.nadir_m()].map(|to| sample.body_angles_deg(&to))
}

/// The commanded curves of Figures 7 and 8.
pub(crate) fn transition(run: &mut Run<'_>) -> Outcome {
    let cases = run.chosen(CASES, |(label, _)| (*label).to_owned())?;
    let fmus = Fmus::open(run.options)?;
    let simulated = run.all(&cases, |case| Ok((*case, simulated(*case, &fmus)?)))?;
    run.line(
        "Downlink until 500 s, then the camera at nadir (paper 001, Figures 7 and 8, commanded curves)\n",
    );
    let rows =
        simulated.iter().flat_map(|((label, _), simulated)| rows(label, simulated)).collect::<Vec<_>>();
    run.table("case | quantity | paper | ours | verdict", &rows);
    run.line(REMARK);
    write(run, &simulated)?;
    if let Some((_, simulated)) = simulated.first() {
        run.picture("transition-quaternion.svg", &quaternion_chart(simulated))?;
        run.picture("transition-angles.svg", &angle_chart(simulated))?;
    }
    Ok(())
}

const REMARK: &str = "\
Not reproduced: the paper prints neither the epoch nor the place on the orbit, and no numbers of the curves; so the
quaternions of Figure 7 and the azimuth and elevation of Mercury in Figure 8 cannot be compared, and its slew angle is
unspecified. Chosen: 2009-04-09 03:36 TDB, when the Earth is 33 deg from the Sun, and a true anomaly of 215 deg at the
start, where the paper's eight hours of downlink about apoapsis end; elsewhere on this orbit the slew is anything up to
180 deg. The paper puts azimuth -33 deg into the +X,+Y quadrant; by its own angles it is in the -X,-Y quadrant. The
estimated curves are those of control/transition. Camera follows: its angle is commanded again every second, so that
the Sun stays on -Y; camera held: the angle of 500 s stays, and the Sun's elevation takes up how nadir moves.";

fn rows(label: &str, simulated: &Simulated) -> Vec<Vec<String>> {
    let at = |second: f64| simulated.samples.iter().find(|sample| sample.place.time_s == second);
    let (Some(before), Some(after)) = (at(SLEW_S - 1.0), at(SLEW_S)) else { return Vec::new() };
    let sun = [0, 1].map(|i| greatest(simulated.samples.iter().map(|sample| angles_deg(sample)[0][i])));
    let before_slew = simulated.samples.iter().filter(|sample| sample.place.time_s < SLEW_S);
    let elevation = greatest(before_slew.map(|sample| angles_deg(sample)[1][1]));
    let azimuth = angles_deg(before)[1][0];
    // Adding zero takes the sign from a zero.
    let planet = angles_deg(after)[2].map(|x| (100.0 * x).round() / 100.0 + 0.0);
    let slew_deg = before.q.angle_to(&after.q).to_degrees();
    let mdis_deg = after.mdis_angle_rad.to_degrees();
    let constrained = simulated.samples.iter().filter(|sample| sample.constrained).count();
    let row = |what: &str, ours: String, verdict: &str| compared(&format!("{label} | {what}"), ours, verdict);
    vec![
        row(
            "Earth azimuth before the slew | -33 deg",
            format!("{azimuth:.2} deg"),
            agrees((azimuth + 33.0).abs() < 0.05),
        ),
        row(
            "Earth elevation before the slew, greatest | 0 deg",
            format!("{elevation:.1e} deg"),
            agrees(elevation < 1e-9),
        ),
        row("Sun azimuth, greatest | 0 deg", format!("{:.1e} deg", sun[0]), agrees(sun[0] < 1e-9)),
        row("Sun elevation, greatest | 0 deg", format!("{:.1e} deg", sun[1]), agrees(sun[1] < 1e-9)),
        row("slew angle | not printed", format!("{slew_deg:.3} deg"), "-"),
        row(
            "Mercury azimuth / elevation after the slew | not printed",
            format!("{:.2} / {:.2} deg", planet[0], planet[1]),
            "-",
        ),
        row(
            "camera angle after the slew | in range (-50 to 40 deg)",
            format!("{mdis_deg:.3} deg"),
            agrees((-50.0..=40.0).contains(&mdis_deg)),
        ),
        row("samples changed by a constraint | none", constrained.to_string(), agrees(constrained == 0)),
    ]
}

fn write(run: &mut Run<'_>, simulated: &[(CameraCase, Simulated)]) -> Outcome {
    let own = "\
        case | sun_azimuth_deg | sun_elevation_deg | earth_azimuth_deg | earth_elevation_deg | \
        mercury_azimuth_deg | mercury_elevation_deg | mdis_angle_deg";
    let rows = simulated.iter().flat_map(|((label, _), simulated)| {
        simulated.samples.iter().map(|sample| {
            let mdis_deg = sample.mdis_angle_rad.to_degrees();
            row![*label, angles_deg(sample), mdis_deg, sample.geometry()]
        })
    });
    run.csv("transition.csv", &format!("{own} | {GEOMETRY}"), rows)
}

/// A line over time, interrupted at the slew.
fn over_time(label: &str, simulated: &Simulated, value: impl Fn(&PointingSample) -> f64) -> Series {
    let mut points = Vec::new();
    for sample in &simulated.samples {
        if sample.place.time_s == SLEW_S {
            points.push((SLEW_S, f64::NAN));
        }
        points.push((sample.place.time_s, value(sample)));
    }
    Series::line(label, points)
}

fn quaternion_chart(simulated: &Simulated) -> Chart {
    let panel = |i: usize| {
        Panel::new(format!("q{}", i + 1)).with([over_time(
            if i == 0 { "commanded" } else { "" },
            simulated,
            |sample| sample.q[i],
        )])
    };
    Chart::new("Commanded quaternion over the transition", "time [s]").with((0..4).map(panel))
}

fn angle_chart(simulated: &Simulated) -> Chart {
    let panel = |name: &str, i: usize| {
        Panel::new(format!("{name} [deg]")).with([
            over_time("Mercury", simulated, |sample| angles_deg(sample)[2][i]),
            over_time("Earth", simulated, |sample| angles_deg(sample)[1][i]),
            // Dashed, as it lies on one of the others all the time.
            over_time("Sun", simulated, |sample| angles_deg(sample)[0][i]).drawn(Mark::Dashed),
        ])
    };
    Chart::new("Sun, Earth and Mercury in the commanded body frame", "time [s]")
        .with([panel("azimuth", 0), panel("elevation", 1)])
}
