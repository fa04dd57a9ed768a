//! The simulations of paper 000's study and how one is simulated.

use loader::Fmu;

use crate::case::{self, chosen, run_all};
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

    fn set(self, case: case::Case) -> case::Case {
        let tilt = |positive| if positive { 1 } else { 2 };
        match self {
            Self::Study => case,
            Self::Later => case.real("start.epoch", START_S + 40.0 * DAY_S),
            Self::OrbitPlane => case.integer("orbit.frame", 1),
            Self::Ecliptic => case.integer("orbit.frame", 4),
            Self::Tilts(plus_x, minus_x) => {
                case.integer("panel[1].tilt", tilt(plus_x)).integer("panel[2].tilt", tilt(minus_x))
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

    fn simulate(&self, fmu: &Fmu) -> Result<Simulated, StudyError> {
        let has_panels = self.shade == Shade::PlatesAndPanels;
        let mut case = case::Case::new(self.label(), 90.0 * DAY_S, STEP_S)
            .boolean("solar.fixedPressure", true)
            .boolean("gravityGradient.enabled", false)
            .integer("eclipse.method", 4)
            .boolean("panel[1].enabled", has_panels)
            .boolean("panel[2].enabled", has_panels)
            .integer("sunshade.shape", if self.shade == Shade::Cylinder { 2 } else { 1 })
            .integer("momentum.convention", if self.convention == Convention::BodyIntegral { 2 } else { 1 })
            .real("spacecraft.centerOfMass[3]", self.offset_m)
            .real("dump.reinitFraction", self.reinit);
        for axis in 1..=3 {
            case = case.real(&format!("dump.threshold[{axis}]"), self.threshold_n_m_s);
        }
        let names = ["momentum.body[1]", "dump.count", "dump.lastTime"];
        let recorded = self.choice.set(case).simulate(fmu, &names)?;
        let mut dumps_d: Vec<f64> = recorded.columns[2]
            .iter()
            .filter(|&&time_s| time_s >= 0.0)
            .map(|time_s| time_s / DAY_S)
            .collect();
        dumps_d.dedup();
        Ok(Simulated {
            case: *self,
            times_d: recorded.times_s.iter().map(|time_s| time_s / DAY_S).collect(),
            count: recorded.last(1) as i64,
            momentum_x_n_m_s: recorded.columns[0].clone(),
            dumps_d,
        })
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

/// Simulates those of `cases` that `options` leaves.
pub fn simulate_all(
    study: &'static str,
    options: &Options,
    cases: Vec<Case>,
) -> Result<Vec<Simulated>, StudyError> {
    let cases = chosen(study, options, cases, Case::label)?;
    let fmu = options.fmu("MomentumPlant.fmu")?;
    run_all(options, &cases, |case| case.simulate(&fmu))
}
