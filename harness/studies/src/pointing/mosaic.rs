//! Mosaics: frames of MDIS and of an instrument along +Z during inertial, body and planet-fixed scans.

use super::camera::{Camera, Frame};
use super::disc::{View, X_LABEL, Y_LABEL};
use super::flight::{
    DEFAULT_EPOCH_S, Flight, Flown, Fmus, GEOMETRY, Place, Settings, digits, flag, number, real,
    vector_setting,
};
use crate::case::{chosen, run_all};
use crate::chart::{PlaneChart, Series};
use crate::vector::{Vector, angle_rad, dot, norm, sum, unit};
use crate::{Options, Report, StudyError};

const TRUE_ANOMALY_DEG: f64 = 175.0;

/// The published fields of MDIS; the field along +Z is assumed to be that of its narrow one.
const WIDE: Camera = Camera { name: "MDIS wide-angle", field_deg: 10.5, on_platform: true };
const NARROW: Camera = Camera { name: "MDIS narrow-angle", field_deg: 1.5, on_platform: true };
const PLUS_Z: Camera = Camera { name: "+Z instrument", field_deg: 1.5, on_platform: false };

/// Motion of one axis: it moves by `step`, holds, and moves on or back.
#[derive(Clone, Copy, Debug)]
struct Motion {
    /// In deg for rotations, in m for translations.
    step: f64,
    duration_s: f64,
    pause_s: f64,
    segments: i32,
    reverse: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// `scan.frame` inertialTranslation.
    Inertial,
    /// body.
    Body,
    /// planetTranslation.
    PlanetFixed,
}

/// One mosaic.
#[derive(Clone, Copy, Debug)]
struct Case {
    label: &'static str,
    title: &'static str,
    camera: Camera,
    kind: Kind,
    /// Days from the default start.
    day: f64,
    /// The camera's angle, in deg.
    mdis_deg: f64,
    /// Along the rows, and from row to row.
    fast: Motion,
    slow: Motion,
    /// Frames of each motion along a row: the first so long after it began, and time between them, in s.
    first_s: f64,
    every_s: f64,
    per_motion: u32,
}

const CASES: [Case; 3] = [
    Case {
        label: "inertial",
        title: "MDIS wide-angle, inertial scan",
        camera: WIDE,
        kind: Kind::Inertial,
        day: 12.0,
        mdis_deg: -19.0,
        fast: Motion { step: 2.0e6, duration_s: 60.0, pause_s: 40.0, segments: 6, reverse: true },
        slow: Motion { step: 1.4e6, duration_s: 60.0, pause_s: 140.0, segments: 3, reverse: false },
        first_s: 90.0,
        every_s: 0.0,
        per_motion: 1,
    },
    Case {
        label: "body",
        title: "+Z instrument, body scan",
        camera: PLUS_Z,
        kind: Kind::Body,
        day: 6.0,
        mdis_deg: 0.0,
        fast: Motion { step: 15.0, duration_s: 120.0, pause_s: 20.0, segments: 3, reverse: true },
        slow: Motion { step: 1.3, duration_s: 10.0, pause_s: 130.0, segments: 3, reverse: false },
        first_s: 10.0,
        every_s: 10.0,
        per_motion: 12,
    },
    Case {
        label: "planet",
        title: "MDIS narrow-angle, planet-fixed scan",
        camera: NARROW,
        kind: Kind::PlanetFixed,
        day: 12.0,
        mdis_deg: -19.0,
        fast: Motion { step: 3.7e5, duration_s: 40.0, pause_s: 20.0, segments: 10, reverse: true },
        slow: Motion { step: 3.7e5, duration_s: 40.0, pause_s: 80.0, segments: 5, reverse: false },
        first_s: 50.0,
        every_s: 0.0,
        per_motion: 1,
    },
];

impl Motion {
    fn cycle_s(&self) -> f64 {
        self.duration_s + self.pause_s
    }

    fn end_s(&self) -> f64 {
        self.cycle_s() * f64::from(self.segments)
    }

    /// From where it begins so that its positions lie about zero.
    fn start(&self) -> f64 {
        let last = if self.reverse { self.step } else { self.step * f64::from(self.segments + 1) };
        -0.5 * last
    }

    fn settings(&self, axis: usize, rate: &str, unit: f64) -> Settings {
        let name = |of: &str| format!("scan.{of}[{}]", axis + 1);
        vec![
            real(&name(rate), unit * self.step / self.duration_s),
            real(&name("duration"), self.duration_s),
            real(&name("pause"), self.pause_s),
            number(&name("segments"), self.segments),
            flag(&name("reverse"), self.reverse),
        ]
    }
}

impl Case {
    fn seconds(&self) -> u32 {
        self.fast.end_s().max(self.slow.end_s()) as u32
    }

    fn epoch_s(&self) -> f64 {
        DEFAULT_EPOCH_S + 86_400.0 * self.day
    }

    /// The two of these axes that lie most across the line of sight: along rows, and from row to row.
    fn across(axes: &[Vector; 3], toward: &Vector) -> [usize; 2] {
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| dot(&axes[*a], toward).abs().total_cmp(&dot(&axes[*b], toward).abs()));
        [order[1], order[0]]
    }

    /// What is commanded from the first place on.
    fn settings(&self, place: &Place, axes: &[Vector; 3], radius_m: f64) -> Settings {
        let nadir = unit(&place.nadir_m());
        let degree = f64::to_radians(1.0);
        match self.kind {
            Kind::Body => {
                // Rows about Y, from row to row about X; the boresight begins where the scan turns it to +Z midway.
                let (about_y, about_x) = (degree * self.fast.start(), degree * self.slow.start());
                let (sin_y, cos_y) = about_y.sin_cos();
                let (sin_x, cos_x) = about_x.sin_cos();
                let boresight = [sin_y, -sin_x * cos_y, cos_x * cos_y];
                let generic = [
                    number("pointing.scenario", 1),
                    number("boresight.option", 1),
                    number("aimpoint.option", 12),
                    number("bodyRoll.option", 1),
                    number("externalRoll.option", 3),
                    number("scan.frame", 1),
                ];
                let mut settings = generic.to_vec();
                settings.extend(vector_setting("boresight.vector", &boresight));
                settings.extend(vector_setting("bodyRoll.vector", &[0.0, -1.0, 0.0]));
                settings.extend(self.fast.settings(1, "rate", degree));
                settings.extend(self.slow.settings(0, "rate", degree));
                settings
            }
            Kind::Inertial | Kind::PlanetFixed => {
                let [fast, slow] = Self::across(axes, &nadir);
                let mut start = [0.0; 3];
                (start[fast], start[slow]) = (self.fast.start(), self.slow.start());
                let (option, frame) = match self.kind {
                    Kind::PlanetFixed => {
                        // About the point below the spacecraft.
                        let below = axes.map(|axis| dot(&axis, &nadir) * -radius_m);
                        start = sum(&start, &below);
                        (6, 4)
                    }
                    _ => (5, 3),
                };
                let mut settings = vec![
                    number("pointing.scenario", 4),
                    real("boresight.angle", degree * self.mdis_deg),
                    number("aimpoint.option", option),
                    number("scan.frame", frame),
                ];
                settings.extend(vector_setting("aimpoint.position", &start));
                settings.extend(self.fast.settings(fast, "speed", 1.0));
                settings.extend(self.slow.settings(slow, "speed", 1.0));
                settings
            }
        }
    }

    fn fly(&self, fmus: &Fmus) -> Result<Mosaic, StudyError> {
        // A flight of one second shows where the planet's axes are.
        let flight = Flight {
            label: self.label,
            epoch_s: self.epoch_s(),
            true_anomaly_deg: TRUE_ANOMALY_DEG,
            seconds: 0,
            parameters: Vec::new(),
            command: &|_: &Place| Vec::new(),
        };
        let planet = fmus.fly(&flight)?.planet;
        let axes = match self.kind {
            Kind::PlanetFixed => *planet.at(self.epoch_s()).axes(),
            Kind::Inertial | Kind::Body => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        let command = |place: &Place| {
            if place.time_s == 0.0 { self.settings(place, &axes, planet.radii_m[0]) } else { Vec::new() }
        };
        let flown = fmus.fly(&Flight { seconds: self.seconds(), command: &command, ..flight })?;
        Ok(Mosaic { case: *self, numbers: Numbers::of(self, &flown), flown })
    }

    /// Its frames; none while the axis from row to row moves.
    fn frames<'a>(&self, flown: &'a Flown) -> Vec<Frame<'a>> {
        let cycle_s = self.fast.cycle_s();
        let times_s = (0..self.fast.segments).flat_map(|motion| {
            let begin_s = f64::from(motion) * cycle_s + self.first_s;
            (0..self.per_motion).map(move |k| begin_s + f64::from(k) * self.every_s)
        });
        times_s
            .filter_map(|time_s| flown.samples.get(time_s as usize))
            .map(|sample| self.camera.frame(sample, &flown.planet))
            .collect()
    }
}

/// A mosaic that was flown.
struct Mosaic {
    case: Case,
    flown: Flown,
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
    fn of(case: &Case, flown: &Flown) -> Self {
        let frames = case.frames(flown);
        let overlap = |pair: &[Frame<'_>]| {
            let (surface, _) = pair[0].surface_m();
            surface.iter().filter(|x| pair[1].shows(x)).count() as f64 / surface.len().max(1) as f64
        };
        let disc = disc_lattice(flown);
        let shown: Vec<usize> =
            disc.iter().map(|x| frames.iter().filter(|frame| frame.shows(x)).count()).collect();
        let at_least = |times: usize| shown.iter().filter(|n| **n >= times).count() as f64;
        let rate = |rate: &Vector| norm(rate).to_degrees();
        let greatest = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
        let sun =
            |i: usize| greatest(&mut flown.samples.iter().map(|s| s.body_angles_deg(&s.place.to_sun_m)[i]));
        Self {
            frames: frames.len(),
            coverage: at_least(1) / disc.len().max(1) as f64,
            twice: at_least(2) / at_least(1),
            overlaps: frames.windows(2).map(overlap).collect(),
            rates_deg_s: [
                greatest(&mut flown.samples.iter().map(|s| rate(&s.rate_rad_s))),
                greatest(&mut frames.iter().map(|frame| rate(&frame.sample.rate_rad_s))),
            ],
            sun_deg: [sun(0), sun(1)],
            constrained: flown.samples.iter().filter(|s| s.constrained || !s.scan_active).count(),
        }
    }
}

/// Side of the lattice of directions over the disc.
const DISC: u32 = 240;

/// Points of the surface evenly over the disc seen midway, along the planet's axes.
fn disc_lattice(flown: &Flown) -> Vec<Vector> {
    let Some(sample) = flown.samples.get(flown.samples.len() / 2) else { return Vec::new() };
    let (view, ellipsoid) = (View::at(&sample.place), flown.planet.at(sample.place.epoch_s));
    let radius = view.radius_deg(&ellipsoid).to_radians().tan();
    let at = |k: u32| radius * ((2.0 * f64::from(k) + 1.0) / f64::from(DISC) - 1.0);
    (0..DISC * DISC)
        .filter_map(|k| ellipsoid.hit(&sample.place.position_m, &view.ray(at(k % DISC), at(k / DISC))))
        .map(|hit| ellipsoid.along_axes(&hit))
        .collect()
}

/// Footprints of three scans.
pub fn mosaic(options: &Options) -> Result<Report, StudyError> {
    let cases = chosen("pointing/mosaic", options, CASES, |case| case.label.to_owned())?;
    let fmus = Fmus::open(options)?;
    let mosaics = run_all(options, &cases, |case| case.fly(&fmus))?;
    let mut report = Report::default();
    report.line("Mosaics by scans with reversals and pauses (paper 001, \"Scan patterns\")\n");
    let header = [
        "scan",
        "camera",
        "frames",
        "disc covered",
        "of that twice",
        "overlap with the next",
        "greatest rate",
        "at frames",
        "Sun azimuth / elevation",
        "constrained",
    ];
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let rows: Vec<Vec<String>> = mosaics
        .iter()
        .map(|Mosaic { case, numbers, flown }| {
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
                format!("{} of {} s", numbers.constrained, flown.samples.len()),
            ]
        })
        .collect();
    report.table(&header, &rows);
    report.line(REMARK);
    write(&mut report, options, &mosaics)?;
    for mosaic in &mosaics {
        report.plane(options, &format!("mosaic-{}.svg", mosaic.case.label), &mosaic.chart())?;
    }
    Ok(report)
}

const REMARK: &str = "\
Covered: of the disc as seen midway, by solid angle, what some frame shows. Overlap: of the surface in a frame what the
next one in time shows too. Rates and the Sun's angles in the body frame: the greatest; constrained: seconds at which a
constraint changed the command or no scan was active. Frames of the inertial and the planet-fixed scan are taken at rest,
those of the body scan along the moving rows. Both axes of a scan begin together, as the paper gives an axis no delay.
The fields are those published of MDIS; the one along +Z, rates, durations and pauses are assumed.";

fn write(report: &mut Report, options: &Options, mosaics: &[Mosaic]) -> Result<(), StudyError> {
    let own = ["scan", "frame", "field_deg", "mdis_angle_deg", "latitude_deg", "longitude_deg", "on_disc"];
    let header = [&own[..], &["overlap_with_next", "rate_deg_s", "off_nadir_deg"], &GEOMETRY].concat();
    let mut rows = Vec::new();
    for Mosaic { case, flown, numbers } in mosaics {
        for (index, frame) in case.frames(flown).iter().enumerate() {
            let (sample, place) = (frame.sample, &frame.sample.place);
            let [x, y, z] = frame.middle_m();
            let mdis_deg = if case.camera.on_platform { sample.mdis_angle_rad.to_degrees() } else { 0.0 };
            let mut row = vec![case.label.to_owned(), (index + 1).to_string()];
            let numbers = [
                case.camera.field_deg,
                mdis_deg,
                z.atan2(x.hypot(y)).to_degrees(),
                y.atan2(x).to_degrees(),
                frame.surface_m().1,
                numbers.overlaps.get(index).copied().unwrap_or(f64::NAN),
                norm(&sample.rate_rad_s).to_degrees(),
                angle_rad(&frame.boresight(), &place.nadir_m()).to_degrees(),
            ];
            row.extend(numbers.map(digits));
            row.extend(sample.geometry());
            rows.push(row);
        }
    }
    report.csv(options, "mosaic.csv", &header, rows)
}

impl Mosaic {
    /// Footprints on the disc as seen midway.
    fn chart(&self) -> PlaneChart {
        let Self { case, flown, .. } = self;
        let frames = case.frames(flown);
        let middle = flown.samples.len() / 2;
        let place = flown.samples[middle].place;
        let (view, ellipsoid) = (View::at(&place), flown.planet.at(place.epoch_s));
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
        // Beside the line that joins the middles.
        let number =
            |(k, (x, y)): (usize, &(f64, f64))| ((*x, y + 0.03 * panel.half_width), (k + 1).to_string());
        panel.texts = middles.iter().enumerate().map(number).collect();
        PlaneChart {
            title: case.title.to_owned(),
            x_label: X_LABEL.to_owned(),
            y_label: Y_LABEL.to_owned(),
            panels: vec![panel],
        }
    }
}
