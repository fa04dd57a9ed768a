//! The simulations of paper 000's study and how one is simulated.

use loader::Fmu;
pub(super) use planner::momentum::Convention;

use super::spacing::Spacing;
use crate::StudyError;
use crate::attitude::Vector;
use crate::case;
use crate::report::Run;
use crate::settings::{Settings, set};

pub(super) const DAY_S: f64 = 86_400.0;
const STEP_S: f64 = 600.0;
/// 2009-04-06, in s past J2000 TDB: the FMU's default `start.epoch`.
const START_S: f64 = 292_248_000.0;

/// How long the paper simulates.
pub(super) const SPAN_D: f64 = 90.0;
/// The paper's offsets, an inch apart.
pub(super) const INCH_M: f64 = 0.0254;

/// What the Sun pushes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shade {
    /// The section of a cylinder that Tables 2 and 3 were computed with.
    Cylinder,
    /// The eight plates of the later design.
    Plates,
    /// Those, and both panels 65 deg off the Sun, as Tables 4 and 5 have them.
    PlatesAndPanels,
}

impl Shade {
    /// For tables.
    pub(super) fn label(self) -> &'static str {
        match self {
            Self::Cylinder => "cylinder",
            Self::Plates => "plates",
            Self::PlatesAndPanels => "plates and panels",
        }
    }
}

/// The paper's momentum or the physical one, for tables.
pub(super) fn convention_label(convention: Convention) -> &'static str {
    match convention {
        Convention::BodyIntegral => "paper's",
        Convention::Inertial => "inertial",
    }
}

/// What sunlight is used for during downlinks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Strategy {
    /// Nothing.
    DumpsOnly,
    /// To bring the momentum to zero.
    Reactive,
    /// To bring it where the coming cycles keep it below the thresholds.
    Predictive,
    /// What a plan with all the days in view makes of it.
    Optimum,
}

impl Strategy {
    /// Those that the spacecraft follows, from the one that saves no dump to the one that saves most.
    pub(super) const ALL: [Self; 3] = [Self::DumpsOnly, Self::Reactive, Self::Predictive];

    /// For tables.
    pub(super) fn label(self) -> &'static str {
        match self {
            Self::DumpsOnly => "dumps only",
            Self::Reactive => "reactive",
            Self::Predictive => "predictive",
            Self::Optimum => "optimum",
        }
    }

    /// Of `momentum.strategy`.
    fn item(self) -> &'static str {
        match self {
            Self::DumpsOnly | Self::Optimum => "dumpsOnly",
            Self::Reactive | Self::Predictive => self.label(),
        }
    }
}

/// Where a thruster dump leaves a component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum DumpsTo {
    /// At this share of the threshold with the opposite sign: 1 is the paper's, 0.9 the FMU's default, 0 is zero.
    Opposite(f64),
    /// At this share of the threshold along +X, whichever side it was on; the other components at zero.
    AlongX(f64),
    /// Where the plan has it.
    Planned,
}

impl DumpsTo {
    /// The paper's.
    pub(super) const PAPER: Self = Self::Opposite(1.0);
    /// The FMU's default.
    pub(super) const OWN: Self = Self::Opposite(0.9);
    /// All momentum taken out.
    pub(super) const ZERO: Self = Self::Opposite(0.0);

    /// For tables.
    pub(super) fn label(self) -> String {
        match self {
            Self::Opposite(fraction) => format!("{fraction:.1}"),
            Self::AlongX(fraction) => format!("X {fraction:+.1}"),
            Self::Planned => "planned".to_owned(),
        }
    }

    fn set(self, case: case::Case, threshold_n_m_s: f64) -> case::Case {
        match self {
            Self::Opposite(fraction) => case.set("dump.reinitFraction", fraction),
            Self::AlongX(fraction) => {
                case.set("dump.reinitTo", "target").set("dump.target[1]", fraction * threshold_n_m_s)
            }
            // One that the plan does not have is the FMU's own.
            Self::Planned => case,
        }
    }
}

/// What a simulation chooses otherwise than the study does, where the paper prints nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
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
    /// The label of tables, and what is set.
    fn parts(self) -> (&'static str, Settings) {
        let tilts = |plus_x: &str, minus_x: &str| {
            [set("panel[1].tilt", plus_x), set("panel[2].tilt", minus_x)].concat()
        };
        match self {
            Self::Study => ("study's own", Settings::new()),
            Self::Later => ("start 40 days later", set("start.epoch", START_S + 40.0 * DAY_S)),
            Self::OrbitPlane => ("Mercury's orbit plane", set("orbit.frame", "planetOrbit")),
            Self::Ecliptic => ("ecliptic", set("orbit.frame", "ecliptic")),
            Self::Tilts(true, true) => ("panel tilts + +", tilts("positive", "positive")),
            Self::Tilts(true, false) => ("panel tilts + -", tilts("positive", "negative")),
            Self::Tilts(false, true) => ("panel tilts - +", tilts("negative", "positive")),
            Self::Tilts(false, false) => ("panel tilts - -", tilts("negative", "negative")),
        }
    }

    /// For tables.
    pub(super) fn label(self) -> &'static str {
        self.parts().0
    }
}

/// One simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MomentumCase {
    /// What sunlight is used for.
    pub strategy: Strategy,
    /// Dump threshold of all axes, in N m s.
    pub threshold_n_m_s: f64,
    /// Where dumps leave a component.
    pub dumps_to: DumpsTo,
    /// Sunshade.
    pub shade: Shade,
    /// Momentum.
    pub convention: Convention,
    /// Centre of mass, in inches as the paper steps it.
    pub offset_in: [i8; 3],
    /// What else differs.
    pub choice: Choice,
}

impl MomentumCase {
    /// What it is called in files and filters.
    pub(super) fn label(&self) -> String {
        format!(
            "{}, {} N.m.s, to {}, {}, {} momentum{}, {}{}",
            self.strategy.label(),
            self.threshold_n_m_s,
            self.dumps_to.label(),
            self.shade.label(),
            convention_label(self.convention),
            if self.choice == Choice::Study { String::new() } else { format!(", {}", self.choice.label()) },
            if self.is_along_z() { "Z " } else { "" },
            self.offset_label()
        )
    }

    /// Whether only Z is offset.
    pub(super) fn is_along_z(&self) -> bool {
        matches!(self.offset_in, [0, 0, _])
    }

    /// The offset as the paper writes it: of Z alone, or of all axes.
    pub(super) fn offset_label(&self) -> String {
        let cm = |inches: i8| 100.0 * INCH_M * f64::from(inches);
        match self.offset_in {
            [0, 0, 0] => "0 cm".to_owned(),
            [0, 0, z @ ..=-1] => format!("{:.2} cm", cm(z)),
            [0, 0, z] => format!("+{:.2} cm", cm(z)),
            [x, y, z] => format!("{:+.2}, {:+.2}, {:+.2} cm", cm(x), cm(y), cm(z)),
        }
    }

    /// The case with all that it sets.
    pub(super) fn settings(&self) -> case::Case {
        let has_panels = self.shade == Shade::PlatesAndPanels;
        let is_papers = self.convention == Convention::BodyIntegral;
        let case = case::Case::new(self.label(), SPAN_D * DAY_S, STEP_S)
            .set("solar.fixedPressure", true)
            .set("gravityGradient.enabled", false)
            .set("eclipse.method", "off")
            .set("panel[1].enabled", has_panels)
            .set("panel[2].enabled", has_panels)
            .set("sunshade.shape", if self.shade == Shade::Cylinder { "cylinder" } else { "plates" })
            .set("momentum.convention", if is_papers { "bodyIntegral" } else { "inertial" })
            .set("momentum.strategy", self.strategy.item())
            .set("spacecraft.centerOfMass", self.offset_in.map(|it| INCH_M * f64::from(it)))
            .set("dump.threshold", [self.threshold_n_m_s; 3]);
        self.dumps_to.set(case, self.threshold_n_m_s).with(self.choice.parts().1)
    }

    /// Simulates it, what `steer` answers to a recorded point being set there.
    pub(super) fn simulate(
        &self,
        fmu: &Fmu,
        steer: &mut dyn FnMut(case::RowReader<'_>) -> Settings,
    ) -> Result<Simulated, StudyError> {
        Ok(Simulated::of(*self, &self.settings().apart(APART).steer(fmu, &NAMES, steer)?))
    }

    /// Whether another differs only in the offset.
    pub(super) fn differs_only_in_offset(&self, other: &Self) -> bool {
        *self == Self { offset_in: self.offset_in, ..*other }
    }
}

/// Counter whose every increment is recorded.
const APART: &str = "dump.count";
/// Parameter that campaigns vary.
const OFFSET_Z: &str = "spacecraft.centerOfMass[3]";
/// What is recorded.
const NAMES: [&str; 4] = ["momentum.body[1]", "dump.count", "dump.lastTime", "dump.impulse"];

/// Every dump, from a recording with a point after each.
fn dumps(recorded: &case::Recorded) -> Vec<Dump> {
    let (count, last_s) = (&recorded.columns[1], &recorded.columns[2]);
    let impulses = recorded.all(3);
    let is_after = |k: &usize| count[*k] > k.checked_sub(1).map_or(0.0, |before| count[before]);
    let after = (0..count.len()).filter(is_after);
    after.map(|k| Dump { time_d: last_s[k] / DAY_S, impulse_body_n_m_s: impulses[k] }).collect()
}

/// A thruster dump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dump {
    /// When, in days.
    pub time_d: f64,
    /// What it changed the momentum by, in the body frame, in N m s.
    pub impulse_body_n_m_s: Vector,
}

/// A finished simulation.
#[derive(Clone, Debug)]
pub(super) struct Simulated {
    /// What was simulated.
    pub case: MomentumCase,
    /// Communication points, in days.
    pub times_d: Vec<f64>,
    /// X momentum in the body frame, in N m s.
    pub momentum_x_n_m_s: Vec<f64>,
    /// Number of dumps.
    pub count: i64,
    /// Each dump.
    pub dumps: Vec<Dump>,
}

impl Simulated {
    fn of(case: MomentumCase, recorded: &case::Recorded) -> Self {
        Self {
            case,
            times_d: recorded.times_s.iter().map(|time_s| time_s / DAY_S).collect(),
            count: recorded.last(1) as i64,
            momentum_x_n_m_s: recorded.columns[0].clone(),
            dumps: dumps(recorded),
        }
    }

    /// Statistics of the time between its dumps.
    pub(super) fn spacing(&self) -> Spacing {
        Spacing::of(&self.dumps.iter().map(|dump| dump.time_d).collect::<Vec<f64>>())
    }
}

/// Simulates cases with offsets along Z, one campaign per setting.
pub(super) fn simulate_campaigns(
    run: &Run<'_>,
    cases: Vec<MomentumCase>,
) -> Result<Vec<Simulated>, StudyError> {
    let cases = run.chosen(cases, MomentumCase::label)?;
    let fmu = run.options.fmu("MomentumPlant.fmu")?;
    let settings: Vec<&[MomentumCase]> = cases.chunk_by(MomentumCase::differs_only_in_offset).collect();
    let simulated = run.all(&settings, |cases| {
        let offsets_m: Vec<f64> = cases.iter().map(|case| INCH_M * f64::from(case.offset_in[2])).collect();
        let campaign = cases[0].settings().apart(APART).campaign(&fmu, &[(OFFSET_Z, &offsets_m)]);
        let runs = campaign.map_err(|source| StudyError::Simulation { case: cases[0].label(), source })?;
        let simulated = cases.iter().zip(runs).map(|(case, mut run)| {
            run.label = case.label();
            Ok(Simulated::of(*case, &run.simulate(&fmu, &NAMES)?))
        });
        simulated.collect::<Result<Vec<_>, StudyError>>()
    })?;
    Ok(simulated.concat())
}
