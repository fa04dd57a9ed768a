//! Limb points at azimuths, and the scan of the limb's height, where the Sun stays in its zone.

use super::disc::{View, disc_chart};
use super::flight::{DEFAULT_EPOCH_S, Fmus, GEOMETRY, PointingCase, PointingGeometry, Simulated};
use super::limb_orbit;
use super::limb_point::{Found, PLUS_Z, triaxial};
use crate::StudyError;
use crate::attitude::Vector;
use crate::cells::row;
use crate::report::{Outcome, Run};
use crate::settings::set;
use drawing::{PlanePanel, Series};

/// Six days in, orbit and terminator lie in nearly one plane: the Sun is across nadir and limb all the way round.
const EPOCH_S: f64 = DEFAULT_EPOCH_S + 6.0 * 86_400.0;
const TRUE_ANOMALY_DEG: f64 = 170.0;
const AZIMUTHS_DEG: [f64; 8] = [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0];
/// Of the scan.
const SCAN_AZIMUTH_DEG: f64 = 60.0;
const HEIGHT_RATE_M_S: f64 = 1000.0;
const SCAN_S: u32 = 300;

/// What one case simulates.
#[derive(Clone, Copy, Debug, PartialEq)]
enum LimbCase {
    Azimuth(f64),
    Scan,
    Terminator,
}

impl LimbCase {
    fn label(&self) -> String {
        match self {
            Self::Azimuth(azimuth_deg) => format!("azimuth {azimuth_deg} deg"),
            Self::Scan => "height scan".to_owned(),
            Self::Terminator => "terminator".to_owned(),
        }
    }

    fn simulated(&self, fmus: &Fmus) -> Result<Simulated, StudyError> {
        let (azimuth_deg, height_rate_m_s, seconds) = match *self {
            Self::Azimuth(azimuth_deg) => (azimuth_deg, 0.0, 1),
            Self::Scan => (SCAN_AZIMUTH_DEG, HEIGHT_RATE_M_S, SCAN_S),
            Self::Terminator => return limb_orbit::simulated(fmus),
        };
        let command = move |_: &PointingGeometry| {
            [
                set("pointing.scenario", "limbGeneric"),
                set("limb.azimuth", f64::to_radians(azimuth_deg)),
                set("limb.heightRate", height_rate_m_s),
            ]
            .concat()
        };
        fmus.simulated(&PointingCase {
            label: &self.label(),
            epoch_s: EPOCH_S,
            true_anomaly_deg: TRUE_ANOMALY_DEG,
            seconds,
            parameters: triaxial(),
            command: &command,
        })
    }
}

/// Limb points at azimuths, on the terminator over an orbit, and a scan of the limb's height.
pub(crate) fn limb(run: &mut Run<'_>) -> Outcome {
    let all = AZIMUTHS_DEG.map(LimbCase::Azimuth).into_iter().chain([LimbCase::Scan, LimbCase::Terminator]);
    let cases = run.chosen(all, LimbCase::label)?;
    let fmus = Fmus::open(run.options)?;
    let simulated = run.all(&cases, |case| Ok((*case, case.simulated(&fmus)?)))?;
    run.line("Limb pointing (paper 001, eqs 20 to 22 and Figure 6)\n");
    let azimuths: Vec<(f64, &Simulated)> = simulated
        .iter()
        .filter_map(|(case, simulated)| match case {
            LimbCase::Azimuth(azimuth_deg) => Some((*azimuth_deg, simulated)),
            _ => None,
        })
        .collect();
    let of = |requested: LimbCase| {
        simulated.iter().find(|(case, _)| *case == requested).map(|(_, simulated)| simulated)
    };
    if !azimuths.is_empty() {
        print_azimuths(run, &azimuths)?;
    }
    if let Some(scan) = of(LimbCase::Scan) {
        print_scan(run, scan)?;
    }
    if let Some(orbit) = of(LimbCase::Terminator) {
        limb_orbit::print(run, orbit)?;
    }
    run.line(REMARK);
    Ok(())
}

const REMARK: &str = "\
Heights are found from the commanded attitude alone: of the points of the line along +Z the one whose radius meets the
ellipsoid at the limb (eq 21), its height along the radius; the residual is that less the commanded height. Radii of
2440.53, 2439.28 and 2438.26 km along the planet's own axes. Azimuths are right-handed about up from downtrack, an
assumption: the paper does not print their sense.";

fn print_azimuths(run: &mut Run<'_>, azimuths: &[(f64, &Simulated)]) -> Outcome {
    let own = "\
        azimuth_deg | found_azimuth_deg | off_nadir_deg | height_m | sun_azimuth_deg | sun_elevation_deg | \
        reachable";
    let header = format!("{own} | {GEOMETRY}");
    let (mut rows, mut shown, mut limb_points) = (Vec::new(), Vec::new(), Vec::new());
    let mut disc = None;
    for (azimuth_deg, simulated) in azimuths {
        let Some(sample) = simulated.samples.first() else { continue };
        let ellipsoid = simulated.planet.at(sample.place.epoch_s);
        let Some(found) = Found::of(sample, &ellipsoid) else { continue };
        let view = View::at(&sample.place);
        let found_deg = found.azimuth_deg.rem_euclid(360.0);
        shown.push(vec![
            format!("{azimuth_deg:.0} deg"),
            format!("{found_deg:.9} deg"),
            format!("{:.4} deg", found.off_nadir_deg),
            format!("{:+.1e} m", found.height_m),
            format!("{:.1e} / {:+.3} deg", found.sun_deg[0], found.sun_deg[1]),
            if sample.reachable && !sample.constrained { "on the limb" } else { "constrained" }.to_owned(),
        ]);
        let Found { off_nadir_deg, height_m, sun_deg, .. } = found;
        let numbers = row![*azimuth_deg, found_deg, off_nadir_deg, height_m, sun_deg];
        rows.push(row![numbers, sample.reachable, sample.geometry()]);
        let at = view.point(&found.foot_m);
        limb_points.push((at, format!("{azimuth_deg:.0}")));
        disc.get_or_insert_with(|| view.disc("limb at azimuths", &ellipsoid, &sample.place.sun_m()));
    }
    run.table(
        "azimuth | of +Z | off nadir | height residual | Sun azimuth / elevation in the body frame | ",
        &shown,
    );
    run.csv("limb.csv", &header, rows)?;
    let Some(mut panel) = disc else { return Ok(()) };
    panel.title = format!("true anomaly {TRUE_ANOMALY_DEG} deg, labels: azimuth [deg]");
    panel.series.push(Series::dots("limb points commanded", limb_points.iter().map(|(at, _)| *at).collect()));
    panel.texts = limb_points.into_iter().map(|((x, y), text)| ((1.11 * x, 1.11 * y), text)).collect();
    let chart = disc_chart("Generic limb points", vec![panel]);
    run.picture("limb.svg", &chart)
}

fn print_scan(run: &mut Run<'_>, simulated: &Simulated) -> Outcome {
    let header = format!("commanded_height_m | height_m | sun_azimuth_deg | sun_elevation_deg | {GEOMETRY}");
    let (mut rows, mut shown, mut track) = (Vec::new(), Vec::new(), Vec::new());
    let (mut creep_m, mut last): (f64, Option<Vector>) = (0.0, None);
    let Some(first) = simulated.samples.first() else { return Ok(()) };
    // All seen from the place of the first sample, as directions of +Z.
    for sample in &simulated.samples {
        let ellipsoid = simulated.planet.at(sample.place.epoch_s);
        let Some(found) = Found::of(sample, &ellipsoid) else { continue };
        let commanded_m = HEIGHT_RATE_M_S * sample.place.time_s;
        let fixed = ellipsoid.along_axes(&found.foot_m);
        creep_m += last.replace(fixed).map_or(0.0, |last| (fixed - last).norm());
        rows.push(row![commanded_m, found.height_m, found.sun_deg, sample.geometry()]);
        track.push(View::at(&sample.place).direction(&sample.inertial(&PLUS_Z)));
        if sample.place.time_s % 60.0 == 0.0 {
            shown.push(vec![
                format!("{:.0} s", sample.place.time_s),
                format!("{:.0} km", commanded_m / 1e3),
                format!("{:+.1e} m", found.height_m - commanded_m),
                format!("{:.4} deg", found.off_nadir_deg),
                format!("{:.1} km", creep_m / 1e3),
                format!("{:.1e} / {:+.3} deg", found.sun_deg[0], found.sun_deg[1]),
            ]);
        }
    }
    run.line(&format!(
        "\nScan of the limb's height at azimuth {SCAN_AZIMUTH_DEG} deg, {:.0} km/s:\n",
        HEIGHT_RATE_M_S / 1e3
    ));
    run.table(
        "\
        time | commanded height | height residual | off nadir | limb point's way on the surface | \
        Sun azimuth / elevation in the body frame",
        &shown,
    );
    run.csv("limb-scan.csv", &header, rows)?;
    let (view, ellipsoid) = (View::at(&first.place), simulated.planet.at(first.place.epoch_s));
    let mut whole = view.disc("the disc", &ellipsoid, &first.place.sun_m());
    whole.series.push(Series::line("track of +Z over the scan", track.clone()));
    let ends = (track.first().copied().unwrap_or_default(), track.last().copied().unwrap_or_default());
    let marks: Vec<(f64, f64)> = track.iter().copied().step_by(60).collect();
    whole.series.push(Series::dots("every 60 s", marks.clone()));
    let aside = 0.09;
    let close = PlanePanel {
        title: "the limb, heights in km".to_owned(),
        centre: (0.5 * (ends.0.0 + ends.1.0), 0.5 * (ends.0.1 + ends.1.1)),
        half_width: 0.8,
        texts: marks
            .iter()
            .enumerate()
            .map(|(k, (x, y))| {
                (
                    (x + 1.6 * aside, y - 0.5 * aside),
                    format!("{:.0}", 60.0 * k as f64 * HEIGHT_RATE_M_S / 1e3),
                )
            })
            .collect(),
        ..whole.clone()
    };
    let chart = disc_chart("Scan of the limb's height", vec![whole, close]);
    run.picture("limb-scan.svg", &chart)
}
