//! Paper 000's open questions: dumps and momentum rate with what is misaligned, unequal, or takes its time to turn.

use loader::Fmu;

use super::cases::{Choice, Convention, DAY_S, DumpsTo, MomentumCase, SPAN_D, Shade, Strategy};
use super::variant::{Edit, Variant};
use crate::StudyError;
use crate::attitude::Vector;
use crate::report::{Outcome, Run};

/// Above all that gathers.
const NO_DUMP_N_M_S: f64 = 1e6;
/// The paper's plates and panels without targets; what changes and the campaign differ from it.
const CASE: MomentumCase = MomentumCase {
    strategy: Strategy::DumpsOnly,
    threshold_n_m_s: 5.5,
    dumps_to: DumpsTo::OWN,
    shade: Shade::PlatesAndPanels,
    convention: Convention::BodyIntegral,
    offset_in: [0, 0, -1],
    choice: Choice::Study,
};
/// What the campaign of every change varies, by item: bodyIntegral and inertial; dumpsOnly, reactive, predictive.
const CONVENTIONS: (&str, &[f64]) = ("momentum.convention", &[2.0, 1.0]);
const STRATEGIES: (&str, &[f64]) = ("momentum.strategy", &[1.0, 2.0, 3.0]);
const DEG: f64 = std::f64::consts::PI / 180.0;

/// A change of file and parameters.
struct Change {
    what: &'static str,
    edits: &'static [Edit],
    sets: &'static [(&'static str, f64)],
}

const SHADE: Edit = Edit { after: "[sunshade]", from: "rotation_deg = [0.0, 0.0, 0.0]", to: "" };
const AXIS: Edit = Edit { after: "name = \"+X\"", from: "axis = [1.0, 0.0, 0.0]", to: "" };
const NORMAL: Edit = Edit { after: "name = \"+X\"", from: "zero_normal = [0.0, -1.0, 0.0]", to: "" };
const OTHER_AXIS: Edit = Edit { after: "name = \"-X\"", ..AXIS };
const OTHER_NORMAL: Edit = Edit { after: "name = \"-X\"", ..NORMAL };
const AGED: Edit = Edit {
    after: "",
    from: "[optics.solar-cells]",
    to: "[optics.aged]\nspecular = 0.10\ndiffuse = 0.35\n\n[optics.solar-cells]",
};
const AGED_SIDE: Edit =
    Edit { after: "name = \"side +X\"", from: "optics = \"shade-cloth\"", to: "optics = \"aged\"" };
const AGED_FRONT: Edit = Edit { after: "name = \"front\"", ..AGED_SIDE };
const AGED_TOP: Edit = Edit { after: "name = \"top front\"", ..AGED_SIDE };

const OFFSETS: [&str; 2] = ["panel[1].sunOffset", "panel[2].sunOffset"];
const AXIS_UP: &str = "axis = [0.99984770, 0.0, 0.01745241]";
const AXIS_AHEAD: &str = "axis = [0.99984770, -0.01745241, 0.0]";
const NORMAL_AHEAD: &str = "zero_normal = [-0.01745241, -0.99984770, 0.0]";

const fn edited(what: &'static str, edits: &'static [Edit]) -> Change {
    Change { what, edits, sets: &[] }
}

const fn set(what: &'static str, sets: &'static [(&'static str, f64)]) -> Change {
    Change { what, edits: &[], sets }
}

const CHANGES: &[Change] = &[
    edited("nothing", &[]),
    edited("shade turned 1 deg about X", &[Edit { to: "rotation_deg = [1.0, 0.0, 0.0]", ..SHADE }]),
    edited("shade turned 1 deg about Y", &[Edit { to: "rotation_deg = [0.0, 1.0, 0.0]", ..SHADE }]),
    edited("shade turned 1 deg about Z", &[Edit { to: "rotation_deg = [0.0, 0.0, 1.0]", ..SHADE }]),
    edited("axis of +X panel 1 deg toward Z", &[Edit { to: AXIS_UP, ..AXIS }]),
    edited(
        "axis of +X panel 1 deg toward -Y",
        &[Edit { to: AXIS_AHEAD, ..AXIS }, Edit { to: NORMAL_AHEAD, ..NORMAL }],
    ),
    edited(
        "axes of both panels 1 deg toward -Y",
        &[
            Edit { to: AXIS_AHEAD, ..AXIS },
            Edit { to: NORMAL_AHEAD, ..NORMAL },
            Edit { to: AXIS_AHEAD, ..OTHER_AXIS },
            Edit { to: NORMAL_AHEAD, ..OTHER_NORMAL },
        ],
    ),
    set("+X panel at 66 deg", &[(OFFSETS[0], 66.0 * DEG)]),
    set("panels at 66 and 64 deg", &[(OFFSETS[0], 66.0 * DEG), (OFFSETS[1], 64.0 * DEG)]),
    set("panels at 66 and 66 deg", &[(OFFSETS[0], 66.0 * DEG), (OFFSETS[1], 66.0 * DEG)]),
    edited("side +X at specular 0.10", &[AGED, AGED_SIDE]),
    edited("front at specular 0.10", &[AGED, AGED_FRONT]),
    edited("top front at specular 0.10", &[AGED, AGED_TOP]),
    set("turns at 0.1 deg/s", &[("guided.slewRate", 0.1 * DEG)]),
    set("turns at 0.01 deg/s", &[("guided.slewRate", 0.01 * DEG)]),
];

/// Study `momentum/sensitivity`.
pub(crate) fn sensitivity(run: &mut Run<'_>) -> Outcome {
    let changes = run.chosen(CHANGES, |change| change.what.to_owned())?;
    let template = run.options.fmu("MomentumPlant.fmu")?;
    let rows = run.all(&changes, |change| simulated(change, &template))?;
    run.line("Small changes of the spacecraft: dumps in 90 days and momentum a day (paper 000, plates and panels)\n");
    let header = "change | dumps, paper's | paper's a day [N.m.s] | dumps, inertial | inertial a day [N.m.s]";
    run.table_and_csv("sensitivity.csv", header, rows)?;
    run.line(REMARK);
    Ok(())
}

const REMARK: &str = "\
Dumps: with dumps only / reactive / predictive targets; 5.5 N.m.s, to 0.9 of the opposite threshold, centre of mass at
Z = -2.54 cm. Momentum a day: mean magnitude of what each of the 90 days adds without dumps or targets. Unchanged: panels at
65 deg, shade cloth of specular 0.15, turns at once. An axis of a panel is turned with its cell side.";

/// Effect of one change, as a row.
fn simulated(change: &Change, template: &Fmu) -> Result<Vec<String>, StudyError> {
    let failed = |source| StudyError::Simulation { case: change.what.to_owned(), source };
    let variant = Variant::of(template, change.edits).map_err(failed)?;
    let fmu = &variant.fmu;
    let case = change.sets.iter().fold(CASE.settings(), |case, (name, value)| case.set(name, *value));
    // By convention dumps by strategy, and the mean magnitude of what a day without dumps and targets adds.
    let (mut dumps, mut daily_n_m_s) = ([[0_i64; 3]; 2], [f64::NAN; 2]);
    let runs = case.campaign(fmu, &[CONVENTIONS, STRATEGIES]).map_err(failed)?;
    for (count, run) in dumps.as_flattened_mut().iter_mut().zip(&runs) {
        *count = run.simulate(fmu, &["dump.count"])?.last(0) as i64;
    }
    let undumped =
        case.set("dump.threshold", [NO_DUMP_N_M_S; 3]).campaign(fmu, &[CONVENTIONS]).map_err(failed)?;
    let names = ["momentum.body", "momentum.inertial"];
    for ((daily_n_m_s, run), name) in daily_n_m_s.iter_mut().zip(&undumped).zip(names) {
        let ends = run.clone().every(DAY_S).simulate(fmu, &[name])?.all::<Vector>(0);
        *daily_n_m_s = ends.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum::<f64>() / SPAN_D;
    }
    let cells = dumps.iter().zip(daily_n_m_s).flat_map(|(dumps, daily_n_m_s)| {
        [dumps.map(|count| count.to_string()).join(" / "), format!("{daily_n_m_s:.4}")]
    });
    Ok([change.what.to_owned()].into_iter().chain(cells).collect())
}
