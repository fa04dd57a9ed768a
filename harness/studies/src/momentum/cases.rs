//! The simulations of paper 000's study and how one is simulated.

use indicatif::{ProgressBar, ProgressStyle};
use loader::{Fmu, Value};
use rayon::prelude::*;

use crate::{Options, StudyError};

const DAY_S: f64 = 86_400.0;
const STEP_S: f64 = 600.0;
/// 2009-04-06, in s past J2000 TDB: the FMU's default `start.epoch`.
const START_S: f64 = 292_248_000.0;

/// Where the paper's dumps leave a component: at the opposite threshold.
pub const PAPER_REINIT: f64 = 1.0;
/// Where the FMU's do by default.
pub const OWN_REINIT: f64 = 0.9;

const OFFSETS_M: [f64; 3] = [0.0, -0.0254, -0.0508];

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

/// What a simulation chooses otherwise than the study does, where the paper prints nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Nothing: the FMU's own start date, orbit frame and panel tilts.
    Study,
    /// Start 40 days later.
    Later,
    /// Orbital elements referred to Mercury's orbit plane.
    OrbitPlane,
    /// Orbital elements referred to the ecliptic.
    Ecliptic,
    /// Senses of the panels' tilts off the Sun: whether +X and -X turn right-handed about their axes.
    Tilts(bool, bool),
}

impl Choice {
    /// For tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::Study => "study's own",
            Self::Later => "start 40 days later",
            Self::OrbitPlane => "Mercury's orbit plane",
            Self::Ecliptic => "ecliptic",
            Self::Tilts(true, true) => "panel tilts + +",
            Self::Tilts(true, false) => "panel tilts + -",
            Self::Tilts(false, true) => "panel tilts - +",
            Self::Tilts(false, false) => "panel tilts - -",
        }
    }

    fn sets(self) -> Vec<(String, Value)> {
        let option = |name: &str, item| (name.to_owned(), Value::Integer(item));
        let tilt = |positive| if positive { 1 } else { 2 };
        match self {
            Self::Study => Vec::new(),
            Self::Later => vec![("start.epoch".to_owned(), Value::Real(START_S + 40.0 * DAY_S))],
            Self::OrbitPlane => vec![option("orbit.frame", 1)],
            Self::Ecliptic => vec![option("orbit.frame", 4)],
            Self::Tilts(plus_x, minus_x) => {
                vec![option("panel[1].tilt", tilt(plus_x)), option("panel[2].tilt", tilt(minus_x))]
            }
        }
    }
}

/// One simulation.
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
    /// Share of the threshold, of opposite sign, at which a dump leaves a component.
    pub reinit: f64,
    /// What else differs.
    pub choice: Choice,
}

impl Case {
    /// What it is called in files and filters.
    pub fn label(&self) -> String {
        format!(
            "dumps only, {} N.m.s, to {}, {}, {} momentum{}, Z {}",
            self.threshold_n_m_s,
            self.reinit_label(),
            self.shade.label(),
            self.convention.label(),
            if self.choice == Choice::Study { String::new() } else { format!(", {}", self.choice.label()) },
            self.offset_label()
        )
    }

    /// Where dumps leave a component, as a share of the opposite threshold.
    pub fn reinit_label(&self) -> String {
        format!("{:.1}", self.reinit)
    }

    /// The offset as the paper writes it.
    pub fn offset_label(&self) -> String {
        if self.offset_m == 0.0 { "0 cm".to_owned() } else { format!("{:.2} cm", self.offset_m * 100.0) }
    }

    fn sets(&self) -> Vec<(String, Value)> {
        let mut sets = vec![
            ("solar.fixedPressure".to_owned(), Value::Boolean(true)),
            ("gravityGradient.enabled".to_owned(), Value::Boolean(false)),
            ("eclipse.method".to_owned(), Value::Integer(4)),
            ("panel[1].enabled".to_owned(), Value::Boolean(self.shade == Shade::PlatesAndPanels)),
            ("panel[2].enabled".to_owned(), Value::Boolean(self.shade == Shade::PlatesAndPanels)),
            ("sunshade.shape".to_owned(), Value::Integer(if self.shade == Shade::Cylinder { 2 } else { 1 })),
            (
                "momentum.convention".to_owned(),
                Value::Integer(if self.convention == Convention::BodyIntegral { 2 } else { 1 }),
            ),
            ("spacecraft.centerOfMass[3]".to_owned(), Value::Real(self.offset_m)),
            ("dump.reinitFraction".to_owned(), Value::Real(self.reinit)),
        ];
        sets.extend(self.choice.sets());
        sets.extend(
            (1..=3).map(|axis| (format!("dump.threshold[{axis}]"), Value::Real(self.threshold_n_m_s))),
        );
        sets
    }
}

/// A finished simulation.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// What was simulated.
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

/// Tables 2 and 3: the paper's own dumps first, then the FMU's default ones.
pub fn all() -> Vec<Case> {
    let own_rule = [Convention::BodyIntegral, Convention::Inertial];
    let alone: &[Shade] = &[Shade::Cylinder, Shade::Plates];
    let with_panels: &[Shade] = &[Shade::PlatesAndPanels];
    let mut cases = Vec::new();
    for (reinit, conventions, shades_alone) in
        [(PAPER_REINIT, &own_rule[..1], &alone[..1]), (OWN_REINIT, &own_rule[..], alone)]
    {
        for (threshold_n_m_s, shades) in [(4.0, shades_alone), (7.0, shades_alone), (5.5, with_panels)] {
            for &convention in conventions {
                for &shade in shades {
                    cases.extend(OFFSETS_M.map(|offset_m| Case {
                        threshold_n_m_s,
                        shade,
                        convention,
                        offset_m,
                        reinit,
                        choice: Choice::Study,
                    }));
                }
            }
        }
    }
    cases
}

/// Simulations over what the paper leaves open: start date and orbit frame, and the senses of the panels' tilts.
pub fn open() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut extend = |reinit, threshold_n_m_s, shade, choices: &[Choice]| {
        for &choice in choices {
            cases.extend(OFFSETS_M.map(|offset_m| Case {
                threshold_n_m_s,
                shade,
                convention: Convention::BodyIntegral,
                offset_m,
                reinit,
                choice,
            }));
        }
    };
    for reinit in [PAPER_REINIT, OWN_REINIT] {
        for threshold_n_m_s in [4.0, 7.0] {
            let choices = [Choice::Study, Choice::Later, Choice::OrbitPlane, Choice::Ecliptic];
            extend(reinit, threshold_n_m_s, Shade::Cylinder, &choices);
        }
        let tilts = [(true, true), (false, false), (true, false), (false, true)];
        extend(
            reinit,
            5.5,
            Shade::PlatesAndPanels,
            &tilts.map(|(plus_x, minus_x)| Choice::Tilts(plus_x, minus_x)),
        );
    }
    cases
}

/// Runs every one of `cases` that `options` leaves, on all cores; the order of results does not depend on theirs.
pub fn simulate_all(
    study: &'static str,
    options: &Options,
    cases: Vec<Case>,
) -> Result<Vec<Simulated>, StudyError> {
    let only = options.only.as_deref().unwrap_or_default();
    let known = cases.iter().map(Case::label).collect::<Vec<_>>().join("\n  ");
    let cases: Vec<Case> = cases.into_iter().filter(|case| case.label().contains(only)).collect();
    if cases.is_empty() {
        return Err(StudyError::NothingLeft { study, only: only.to_owned(), known });
    }
    let fmu = options.fmu("MomentumPlant.fmu")?;
    let bar = if options.progress { ProgressBar::new(cases.len() as u64) } else { ProgressBar::hidden() };
    if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {pos}/{len} simulations {elapsed}") {
        bar.set_style(style);
    }
    bar.set_message("running 90 days");
    let simulated = cases
        .par_iter()
        .map(|case| {
            let simulated = simulate(&fmu, case);
            bar.inc(1);
            simulated
        })
        .collect();
    bar.finish_and_clear();
    simulated
}

fn simulate(fmu: &Fmu, case: &Case) -> Result<Simulated, StudyError> {
    let failed = |source: Box<dyn std::error::Error + Send + Sync>| StudyError::Simulation {
        case: case.label(),
        source,
    };
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
    Ok(Simulated {
        case: *case,
        times_d: recording.times_s.iter().map(|time_s| time_s / DAY_S).collect(),
        momentum_x_n_m_s,
        count: counts.last().map_or(0, |count| *count as i64),
        dumps_d,
    })
}
