//! The flights of paper 000's study and how one is flown.

use indicatif::{ProgressBar, ProgressStyle};
use loader::{Fmu, Value};
use rayon::prelude::*;

use crate::{Options, StudyError};

const DAY_S: f64 = 86_400.0;
const STEP_S: f64 = 600.0;

/// What the Sun pushes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    /// The section of a cylinder that Tables 2 and 3 were computed with.
    Cylinder,
    /// The eight plates of the later design.
    Plates,
    /// Those, and both panels 65 deg off the Sun, as the paper's next series had them.
    PlatesAndPanels,
}

impl Shade {
    /// For tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::Cylinder => "cylinder",
            Self::Plates => "plates",
            Self::PlatesAndPanels => "plates and panels",
        }
    }
}

/// Meaning of momentum in the body frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// The paper's.
    BodyIntegral,
    /// The physical one.
    Inertial,
}

impl Convention {
    /// For tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::BodyIntegral => "paper's",
            Self::Inertial => "inertial",
        }
    }
}

/// One flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Dump threshold of all axes, in N m s.
    pub threshold_n_m_s: f64,
    /// Sunshade.
    pub shade: Shade,
    /// Momentum.
    pub convention: Convention,
    /// Z component of the centre of mass, in m.
    pub offset_m: f64,
}

impl Case {
    /// What it is called in files and filters.
    pub fn label(&self) -> String {
        format!(
            "dumps only, {} N.m.s, {}, {} momentum, Z {}",
            self.threshold_n_m_s,
            self.shade.label(),
            self.convention.label(),
            self.offset_label()
        )
    }

    /// The offset as the paper writes it.
    pub fn offset_label(&self) -> String {
        if self.offset_m == 0.0 { "0 cm".to_owned() } else { format!("{:.2} cm", self.offset_m * 100.0) }
    }

    fn sets(&self) -> Vec<(String, Value)> {
        let mut sets = vec![
            ("solar.fixedPressure".to_owned(), Value::Boolean(true)),
            ("gravityGradient.enabled".to_owned(), Value::Boolean(false)),
            ("eclipse.model".to_owned(), Value::Integer(4)),
            ("panel[1].enabled".to_owned(), Value::Boolean(self.shade == Shade::PlatesAndPanels)),
            ("panel[2].enabled".to_owned(), Value::Boolean(self.shade == Shade::PlatesAndPanels)),
            ("sunshade.model".to_owned(), Value::Integer(if self.shade == Shade::Cylinder { 2 } else { 1 })),
            (
                "momentum.convention".to_owned(),
                Value::Integer(if self.convention == Convention::BodyIntegral { 2 } else { 1 }),
            ),
            ("spacecraft.centerOfMass[3]".to_owned(), Value::Real(self.offset_m)),
        ];
        sets.extend(
            (1..=3).map(|axis| (format!("dump.threshold[{axis}]"), Value::Real(self.threshold_n_m_s))),
        );
        sets
    }
}

/// A finished flight.
#[derive(Clone, Debug)]
pub struct Flown {
    /// What was flown.
    pub case: Case,
    /// Communication points, in days.
    pub times_d: Vec<f64>,
    /// X momentum in the body frame, in N m s.
    pub momentum_x_n_m_s: Vec<f64>,
    /// Number of dumps.
    pub count: i64,
    /// Time of each dump, in days; of several within one communication step the last.
    pub dumps_d: Vec<f64>,
}

/// Every case, the paper's first.
pub fn all() -> Vec<Case> {
    let mut cases = Vec::new();
    let alone: &[Shade] = &[Shade::Cylinder, Shade::Plates];
    for (threshold_n_m_s, shades) in [(4.0, alone), (7.0, alone), (5.5, &[Shade::PlatesAndPanels])] {
        for convention in [Convention::BodyIntegral, Convention::Inertial] {
            for &shade in shades {
                for offset_m in [0.0, -0.0254, -0.0508] {
                    cases.push(Case { threshold_n_m_s, shade, convention, offset_m });
                }
            }
        }
    }
    cases
}

/// Flies every case that `options` leaves, on all cores; the order of results does not depend on theirs.
pub fn fly_all(study: &'static str, options: &Options) -> Result<Vec<Flown>, StudyError> {
    let only = options.only.as_deref().unwrap_or_default();
    let cases: Vec<Case> = all().into_iter().filter(|case| case.label().contains(only)).collect();
    if cases.is_empty() {
        let known = all().iter().map(Case::label).collect::<Vec<_>>().join("\n  ");
        return Err(StudyError::NothingLeft { study, only: only.to_owned(), known });
    }
    let fmu = options.fmu("MomentumPlant.fmu")?;
    let bar = if options.progress { ProgressBar::new(cases.len() as u64) } else { ProgressBar::hidden() };
    if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {pos}/{len} flights {elapsed}") {
        bar.set_style(style);
    }
    bar.set_message("flying 90 days");
    let flown = cases
        .par_iter()
        .map(|case| {
            let flown = fly(&fmu, case);
            bar.inc(1);
            flown
        })
        .collect();
    bar.finish_and_clear();
    flown
}

fn fly(fmu: &Fmu, case: &Case) -> Result<Flown, StudyError> {
    let failed =
        |source: Box<dyn std::error::Error + Send + Sync>| StudyError::Flight { case: case.label(), source };
    let names = ["momentum.body[1]", "dump.count", "dump.lastTime"];
    let record = names.iter().filter_map(|name| fmu.position(name)).collect();
    let options = loader::Options {
        stop_s: Some(90.0 * DAY_S),
        step_s: Some(STEP_S),
        sets: case.sets(),
        record: Some(record),
        ..loader::Options::default()
    };
    let recording = loader::simulate(fmu, options).map_err(|stopped| failed(Box::new(*stopped)))?.recording;
    let numbers = |name: &str| {
        recording
            .column(name)
            .map(loader::Column::numbers)
            .ok_or_else(|| failed(format!("no variable {name}").into()))
    };
    let (momentum_x_n_m_s, counts, last_s) = (numbers(names[0])?, numbers(names[1])?, numbers(names[2])?);
    let mut dumps_d: Vec<f64> =
        last_s.iter().filter(|&&time_s| time_s >= 0.0).map(|time_s| time_s / DAY_S).collect();
    dumps_d.dedup();
    Ok(Flown {
        case: *case,
        times_d: recording.times_s.iter().map(|time_s| time_s / DAY_S).collect(),
        momentum_x_n_m_s,
        count: counts.last().map_or(0, |count| *count as i64),
        dumps_d,
    })
}
