//! The scans of the mosaics: motion of each axis, what is commanded, when frames are taken.

use nalgebra::Matrix3;

use super::camera::{Camera, Frame};
use super::flight::{DEFAULT_EPOCH_S, Fmus, PointingCase, PointingGeometry, Simulated};
use crate::StudyError;
use crate::attitude::Vector;
use crate::settings::{Settings, set};

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

/// By which frame the scan goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ScanReference {
    /// `scan.frame` inertialTranslation.
    Inertial,
    /// body.
    Body,
    /// planetTranslation.
    PlanetFixed,
}

/// One scan.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScanCase {
    /// Its name.
    pub label: &'static str,
    /// Of its picture.
    pub title: &'static str,
    /// What takes the frames.
    pub camera: Camera,
    kind: ScanReference,
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

/// The scans of the study.
pub(super) const CASES: [ScanCase; 3] = [
    ScanCase {
        label: "inertial",
        title: "MDIS wide-angle, inertial scan",
        camera: WIDE,
        kind: ScanReference::Inertial,
        day: 12.0,
        mdis_deg: -19.0,
        fast: Motion { step: 2.0e6, duration_s: 60.0, pause_s: 40.0, segments: 6, reverse: true },
        slow: Motion { step: 1.4e6, duration_s: 60.0, pause_s: 140.0, segments: 3, reverse: false },
        first_s: 90.0,
        every_s: 0.0,
        per_motion: 1,
    },
    ScanCase {
        label: "body",
        title: "+Z instrument, body scan",
        camera: PLUS_Z,
        kind: ScanReference::Body,
        day: 6.0,
        mdis_deg: 0.0,
        fast: Motion { step: 15.0, duration_s: 120.0, pause_s: 20.0, segments: 3, reverse: true },
        slow: Motion { step: 1.3, duration_s: 10.0, pause_s: 130.0, segments: 3, reverse: false },
        first_s: 10.0,
        every_s: 10.0,
        per_motion: 12,
    },
    ScanCase {
        label: "planet",
        title: "MDIS narrow-angle, planet-fixed scan",
        camera: NARROW,
        kind: ScanReference::PlanetFixed,
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
        [
            set(&name(rate), unit * self.step / self.duration_s),
            set(&name("duration"), self.duration_s),
            set(&name("pause"), self.pause_s),
            set(&name("segments"), self.segments),
            set(&name("reverse"), self.reverse),
        ]
        .concat()
    }
}

impl ScanCase {
    fn seconds(&self) -> u32 {
        self.fast.end_s().max(self.slow.end_s()) as u32
    }

    fn epoch_s(&self) -> f64 {
        DEFAULT_EPOCH_S + 86_400.0 * self.day
    }

    /// The two of these axes that lie most across the line of sight: along rows, and from row to row.
    fn across(axes: &Matrix3<f64>, toward: &Vector) -> [usize; 2] {
        let along = axes.tr_mul(toward).abs();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| along[*a].total_cmp(&along[*b]));
        [order[1], order[0]]
    }

    /// What is commanded from the first place on.
    fn settings(&self, place: &PointingGeometry, axes: &Matrix3<f64>, radius_m: f64) -> Settings {
        let nadir = place.nadir_m().normalize();
        let degree = f64::to_radians(1.0);
        match self.kind {
            ScanReference::Body => {
                // Rows about Y, from row to row about X; the boresight begins where the scan turns it to +Z midway.
                let (about_y, about_x) = (degree * self.fast.start(), degree * self.slow.start());
                let (sin_y, cos_y) = about_y.sin_cos();
                let (sin_x, cos_x) = about_x.sin_cos();
                let boresight = [sin_y, -sin_x * cos_y, cos_x * cos_y];
                let settings = [
                    set("pointing.scenario", "generic"),
                    set("boresight.option", "vector"),
                    set("aimpoint.option", "nadir"),
                    set("bodyRoll.option", "vector"),
                    set("externalRoll.option", "sun"),
                    set("scan.frame", "body"),
                    set("boresight.vector", boresight),
                    set("bodyRoll.vector", [0.0, -1.0, 0.0]),
                    self.fast.settings(1, "rate", degree),
                    self.slow.settings(0, "rate", degree),
                ];
                settings.concat()
            }
            ScanReference::Inertial | ScanReference::PlanetFixed => {
                let [fast, slow] = Self::across(axes, &nadir);
                let mut start = Vector::zeros();
                (start[fast], start[slow]) = (self.fast.start(), self.slow.start());
                let (option, frame) = match self.kind {
                    ScanReference::PlanetFixed => {
                        // About the point below the spacecraft.
                        start += axes.tr_mul(&nadir) * -radius_m;
                        ("planetFixed", "planetTranslation")
                    }
                    _ => ("planetCentered", "inertialTranslation"),
                };
                let settings = [
                    set("pointing.scenario", "gimbal"),
                    set("boresight.angle", degree * self.mdis_deg),
                    set("aimpoint.option", option),
                    set("scan.frame", frame),
                    set("aimpoint.position", start),
                    self.fast.settings(fast, "speed", 1.0),
                    self.slow.settings(slow, "speed", 1.0),
                ];
                settings.concat()
            }
        }
    }

    /// Simulates it.
    pub(super) fn simulated(&self, fmus: &Fmus) -> Result<Simulated, StudyError> {
        // A flight of one second shows where the planet's axes are.
        let flight = PointingCase {
            label: self.label,
            epoch_s: self.epoch_s(),
            true_anomaly_deg: TRUE_ANOMALY_DEG,
            seconds: 0,
            parameters: Vec::new(),
            command: &|_: &PointingGeometry| Vec::new(),
        };
        let planet = fmus.simulated(&flight)?.planet;
        let axes = match self.kind {
            ScanReference::PlanetFixed => *planet.at(self.epoch_s()).axes(),
            ScanReference::Inertial | ScanReference::Body => Matrix3::identity(),
        };
        let command = |place: &PointingGeometry| {
            if place.time_s == 0.0 { self.settings(place, &axes, planet.radii_m[0]) } else { Vec::new() }
        };
        fmus.simulated(&PointingCase { seconds: self.seconds(), command: &command, ..flight })
    }

    /// Its frames; none while the axis from row to row moves.
    pub(super) fn frames<'a>(&self, simulated: &'a Simulated) -> Vec<Frame<'a>> {
        let cycle_s = self.fast.cycle_s();
        let times_s = (0..self.fast.segments).flat_map(|motion| {
            let begin_s = f64::from(motion) * cycle_s + self.first_s;
            (0..self.per_motion).map(move |k| begin_s + f64::from(k) * self.every_s)
        });
        times_s
            .filter_map(|time_s| simulated.samples.get(time_s as usize))
            .map(|sample| self.camera.frame(sample, &simulated.planet))
            .collect()
    }
}
