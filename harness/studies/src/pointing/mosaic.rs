//! Mosaics: frames of MDIS and of an instrument along +Z during inertial, body and planet-fixed scans.

use super::camera::Frame;
use super::disc::{View, disc_chart};
use super::flight::{Fmus, GEOMETRY, Simulated};
use super::scans::{CASES, ScanCase};
use crate::attitude::{Vector, angle_rad, greatest};
use crate::cells::row;
use crate::report::{Outcome, Run};
use drawing::{PlaneChart, Series};

/// A mosaic that was simulated.
struct Mosaic {
    case: ScanCase,
    simulated: Simulated,
    numbers: Numbers,
}

struct Numbers {
    frames: usize,
    /// Share of the disc seen midway that some frame shows.
    coverage: f64,
    /// Share of that in two frames or more.
    twice: f64,
    /// Of neighbours in time: share of the surface in a frame that the next one shows too.
    overlaps: Vec<f64>,
    /// Greatest and at frames, in deg/s.
    rates_deg_s: [f64; 2],
    /// Greatest of the Sun's in the body frame, in deg.
    sun_deg: [f64; 2],
    constrained: usize,
}

impl Numbers {
    fn of(case: &ScanCase, simulated: &Simulated) -> Self {
        let frames = case.frames(simulated);
        let overlap = |pair: &[Frame<'_>]| {
            let (surface, _) = pair[0].surface_m();
            surface.iter().filter(|x| pair[1].shows(x)).count() as f64 / surface.len().max(1) as f64
        };
        let disc = disc_lattice(simulated);
        let shown: Vec<usize> =
            disc.iter().map(|x| frames.iter().filter(|frame| frame.shows(x)).count()).collect();
        let at_least = |times: usize| shown.iter().filter(|n| **n >= times).count() as f64;
        let rate = |rate: &Vector| rate.norm().to_degrees();
        let sun =
            |i: usize| greatest(simulated.samples.iter().map(|s| s.body_angles_deg(&s.place.to_sun_m)[i]));
        Self {
            frames: frames.len(),
            coverage: at_least(1) / disc.len().max(1) as f64,
            twice: at_least(2) / at_least(1),
            overlaps: frames.windows(2).map(overlap).collect(),
            rates_deg_s: [
                greatest(simulated.samples.iter().map(|s| rate(&s.rate_rad_s))),
                greatest(frames.iter().map(|frame| rate(&frame.sample.rate_rad_s))),
            ],
            sun_deg: [sun(0), sun(1)],
            constrained: simulated.samples.iter().filter(|s| s.constrained || !s.scan_active).count(),
        }
    }
}

/// Side of the lattice of directions over the disc.
const DISC: u32 = 240;

/// Points of the surface evenly over the disc seen midway, along the planet's axes.
fn disc_lattice(simulated: &Simulated) -> Vec<Vector> {
    let Some(sample) = simulated.samples.get(simulated.samples.len() / 2) else { return Vec::new() };
    let (view, ellipsoid) = (View::at(&sample.place), simulated.planet.at(sample.place.epoch_s));
    let radius = view.radius_deg(&ellipsoid).to_radians().tan();
    let at = |k: u32| radius * ((2.0 * f64::from(k) + 1.0) / f64::from(DISC) - 1.0);
    (0..DISC * DISC)
        .filter_map(|k| ellipsoid.hit(&sample.place.position_m, &view.ray(at(k % DISC), at(k / DISC))))
        .map(|hit| ellipsoid.along_axes(&hit))
        .collect()
}

/// Footprints of three scans.
pub(crate) fn mosaic(run: &mut Run<'_>) -> Outcome {
    let cases = run.chosen(CASES, |case| case.label.to_owned())?;
    let fmus = Fmus::open(run.options)?;
    let mosaics = run.all(&cases, |case| {
        let simulated = case.simulated(&fmus)?;
        Ok(Mosaic { case: *case, numbers: Numbers::of(case, &simulated), simulated })
    })?;
    run.line("Mosaics by scans with reversals and pauses (paper 001, \"Scan patterns\")\n");
    let header = "\
        scan | camera | frames | disc covered | of that twice | overlap with the next | greatest rate | \
        at frames | Sun azimuth / elevation | constrained";
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let rows: Vec<Vec<String>> = mosaics
        .iter()
        .map(|Mosaic { case, numbers, simulated }| {
            let [least, most] = [f64::min, f64::max]
                .map(|pick| numbers.overlaps.iter().copied().reduce(pick).unwrap_or(f64::NAN));
            vec![
                case.label.to_owned(),
                format!("{}, {} deg", case.camera.name, case.camera.field_deg),
                numbers.frames.to_string(),
                percent(numbers.coverage),
                percent(numbers.twice),
                format!("{} to {}", percent(least), percent(most)),
                format!("{:.4} deg/s", numbers.rates_deg_s[0]),
                format!("{:.4} deg/s", numbers.rates_deg_s[1]),
                format!("{:.1e} / {:.2} deg", numbers.sun_deg[0], numbers.sun_deg[1]),
                format!("{} of {} s", numbers.constrained, simulated.samples.len()),
            ]
        })
        .collect();
    run.table(header, &rows);
    run.line(REMARK);
    write(run, &mosaics)?;
    for mosaic in &mosaics {
        run.picture(&format!("mosaic-{}.svg", mosaic.case.label), &mosaic.chart())?;
    }
    Ok(())
}

const REMARK: &str = "\
Covered: of the disc as seen midway, by solid angle, what some frame shows. Overlap: of the surface in a frame what the
next one in time shows too. Rates and the Sun's angles in the body frame: the greatest; constrained: seconds at which a
constraint changed the command or no scan was active. Frames of the inertial and the planet-fixed scan are taken at rest,
those of the body scan along the moving rows. Both axes of a scan begin together, as the paper gives an axis no delay.
The fields are those published of MDIS; the one along +Z, rates, durations and pauses are assumed.";

fn write(run: &mut Run<'_>, mosaics: &[Mosaic]) -> Outcome {
    let own = "\
        scan | frame | field_deg | mdis_angle_deg | latitude_deg | longitude_deg | on_disc | \
        overlap_with_next | rate_deg_s | off_nadir_deg";
    let mut rows = Vec::new();
    for Mosaic { case, simulated, numbers } in mosaics {
        for (index, frame) in case.frames(simulated).iter().enumerate() {
            let (sample, place) = (frame.sample, &frame.sample.place);
            let [x, y, z] = frame.middle_m().into();
            let mdis_deg = if case.camera.on_platform { sample.mdis_angle_rad.to_degrees() } else { 0.0 };
            let overlap = numbers.overlaps.get(index).copied().unwrap_or(f64::NAN);
            rows.push(row![
                case.label,
                index + 1,
                case.camera.field_deg,
                mdis_deg,
                z.atan2(x.hypot(y)).to_degrees(),
                y.atan2(x).to_degrees(),
                frame.surface_m().1,
                overlap,
                sample.rate_rad_s.norm().to_degrees(),
                angle_rad(&frame.boresight(), &place.nadir_m()).to_degrees(),
                sample.geometry(),
            ]);
        }
    }
    run.csv("mosaic.csv", &format!("{own} | {GEOMETRY}"), rows)
}

impl Mosaic {
    /// Footprints on the disc as seen midway.
    fn chart(&self) -> PlaneChart {
        let Self { case, simulated, .. } = self;
        let frames = case.frames(simulated);
        let middle = simulated.samples.len() / 2;
        let place = simulated.samples[middle].place;
        let (view, ellipsoid) = (View::at(&place), simulated.planet.at(place.epoch_s));
        let seen = |fixed: &Vector| view.point(&ellipsoid.inertial(fixed));
        let mut panel = view.disc("", &ellipsoid, &place.sun_m());
        let outlines = frames.iter().flat_map(|frame| {
            let outline = frame.outline_m();
            outline.iter().map(seen).chain([(f64::NAN, f64::NAN)]).collect::<Vec<_>>()
        });
        let middles: Vec<(f64, f64)> = frames.iter().map(|frame| seen(&frame.middle_m())).collect();
        panel.title =
            format!("{} frames, {:.2} deg field, numbered in time", frames.len(), case.camera.field_deg);
        panel.series.push(Series::line("frames", outlines.collect()));
        panel.series.push(Series::dashed("middles in sequence", middles.clone()));
        let reach = panel.series.iter().flat_map(|series| &series.points);
        let reach =
            reach.filter(|(x, _)| x.is_finite()).fold(0.0, |a: f64, (x, y)| a.max(x.abs()).max(y.abs()));
        panel.half_width = 1.08 * reach;
        // Across the rows, up or to the right: beside the line that joins the middles.
        let (x, y) = match middles[..] {
            [a, b, ..] => (b.0 - a.0, b.1 - a.1),
            _ => (1.0, 0.0),
        };
        let sign = if x.abs() >= y.abs() { x.signum() } else { -y.signum() };
        let length = sign * 0.03 * panel.half_width / x.hypot(y);
        let aside = (-length * y, length * x);
        let number = |(k, (x, y)): (usize, &(f64, f64))| ((x + aside.0, y + aside.1), (k + 1).to_string());
        panel.texts = middles.iter().enumerate().map(number).collect();
        disc_chart(case.title, vec![panel])
    }
}
