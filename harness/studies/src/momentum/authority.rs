//! What turning panels, tilting, moving the centre of mass and alternating change in the momentum of a day, by offset and distance.
//!
//! One flight each: the attitude is commanded, the place held, panels stand by a timeline of `[[panels]]`. Momentum gathers for
//! `STEP_S` under each change both ways; half of what both leave apart, over the change, is its worth (central difference, off by
//! a share of `TURN_RAD` squared). Momentum is inertial, by the body axes of the attitude that has the Sun on -Y.

use nalgebra::Unit;

use super::variant::Variant;
use crate::StudyError;
use crate::attitude::{Attitude, Vector, across, body_direction};
use crate::case::{Case, Row, numbered};
use crate::cells::{Cells, row};
use crate::options::Cause;
use crate::report::{Outcome, Run};
use crate::settings::{Settings, set};
use drawing::{Chart, Panel, Series};

const DAY_S: f64 = 86_400.0;
const DEG: f64 = std::f64::consts::PI / 180.0;
const AU_M: f64 = 149_597_870_700.0;
/// Of the Sun, in m3/s2.
const GM_M3_S2: f64 = 1.327_124_400_18e20;

/// Distances from the Sun, in AU.
const DISTANCES_AU: [f64; 5] = [0.31, 0.35, 0.4, 0.5, 0.7];
/// Offsets of the panels from the Sun, in deg.
const OFFSETS_DEG: std::ops::RangeInclusive<u8> = 0..=60;
const SPACING_DEG: usize = 5;

/// How long momentum gathers under each change.
const STEP_S: f64 = 60.0;
/// Either way.
const TURN_RAD: f64 = 1e-3;
/// Either way; momentum is linear in it.
const SHIFT_M: f64 = 1e-3;
/// Rounding of the momentum over that time, of the greatest that gathers: a component below it is none.
const ROUNDING: f64 = 1e-12;
/// No dump: above all that gathers.
const NO_DUMP_N_M_S: f64 = 1e6;

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Control {
    Windmill,
    Offset,
    Azimuth,
    Elevation,
    /// The centre of mass along an axis.
    Center(usize),
    /// The attitude, by half a turn about the Sun line.
    Alternation,
}

impl Control {
    fn is_of_panels(self) -> bool {
        matches!(self, Self::Windmill | Self::Offset)
    }

    /// The changes that it is simulated with, and what their difference is divided by so that a degree, a centimetre or an alternation
    /// is left.
    fn changes(self) -> (&'static [f64], f64) {
        match self {
            Self::Center(_) => (&[SHIFT_M, -SHIFT_M], 2.0 * SHIFT_M / 0.01),
            Self::Alternation => (&[1.0], 1.0),
            _ => (&[TURN_RAD, -TURN_RAD], 2.0 * TURN_RAD / DEG),
        }
    }
}

/// Every control with its name in the CSV and in the picture, and what it is worth per.
const CONTROLS: [(Control, &str, &str, &str); 8] = [
    (Control::Windmill, "windmill", "windmill, across the light", "/deg"),
    (Control::Offset, "offset", "offset", "/deg"),
    (Control::Azimuth, "azimuth", "azimuth of the Sun", "/deg"),
    (Control::Elevation, "elevation", "elevation of the Sun", "/deg"),
    (Control::Center(0), "center_x", "centre of mass along X", "/cm"),
    (Control::Center(1), "center_y", "centre of mass along Y", "/cm"),
    (Control::Center(2), "center_z", "centre of mass along Z", "/cm"),
    (Control::Alternation, "alternation", "alternation", ""),
];

/// What holds while momentum gathers once.
#[derive(Clone, Copy, Debug)]
struct Point {
    offset_rad: f64,
    change: Option<(Control, f64)>,
}

impl Point {
    /// By how much a control is changed.
    fn by(&self, control: Control) -> f64 {
        self.change.filter(|(changed, _)| *changed == control).map_or(0.0, |(_, by)| by)
    }

    /// From the body to inertial axes, of which X is toward the Sun.
    fn attitude(&self) -> Attitude {
        let ahead = body_direction(0.0, 0.0);
        let sun = body_direction(self.by(Control::Azimuth), self.by(Control::Elevation));
        let half_turns = self.by(Control::Alternation);
        let turned = Attitude::from_axis_angle(&Unit::new_unchecked(sun), half_turns * std::f64::consts::PI);
        upright() * Attitude::rotation_between(&sun, &ahead).unwrap_or_default() * turned
    }

    fn settings(&self, center_m: Vector) -> Settings {
        let moved = Vector::from_fn(|axis, _| self.by(Control::Center(axis)));
        [set("command.q", self.attitude()), set("spacecraft.centerOfMass", center_m + moved)].concat()
    }
}

/// The attitude with the Sun on -Y.
fn upright() -> Attitude {
    Attitude::rotation_between(&body_direction(0.0, 0.0), &Vector::x()).unwrap_or_default()
}

/// What a distance and an offset leave, by body axes, in N m s a day.
struct Worth {
    distance_au: f64,
    offset_deg: f64,
    /// Without a change.
    still: Vector,
    /// By a degree, a centimetre, an alternation, of the controls that the spacecraft has.
    of: Vec<(Control, Vector)>,
}

impl Worth {
    fn of(&self, control: Control) -> Option<Vector> {
        self.of.iter().find(|(known, _)| *known == control).map(|(_, worth)| *worth)
    }

    /// The part along the light.
    fn along(worth: Vector) -> f64 {
        -worth.dot(&body_direction(0.0, 0.0))
    }

    /// The size of the part across it.
    fn across(worth: Vector) -> f64 {
        across(&worth, &body_direction(0.0, 0.0)).norm()
    }
}

/// What is simulated.
struct StudiedSpacecraft {
    plants: Vec<Plant>,
    /// Changed by the user.
    sets: Settings,
    center_m: Vector,
    panels: usize,
    controls: Vec<Control>,
}

/// The plant with a timeline of how its panels stand about one offset.
struct Plant {
    variant: Variant,
    offset_deg: f64,
    points: Vec<Point>,
}

/// Study `momentum/authority`.
pub(crate) fn authority(run: &mut Run<'_>) -> Outcome {
    let studied = StudiedSpacecraft::of(run)?;
    let each = DISTANCES_AU
        .into_iter()
        .flat_map(|distance_au| studied.plants.iter().map(move |it| (distance_au, it)));
    let cases = run.chosen(each, |(distance_au, plant)| studied.label(*distance_au, plant))?;
    let worths = run.all(&cases, |(distance_au, plant)| studied.simulated(*distance_au, plant))?;
    run.line(
        "What a change is worth in momentum, by distance from the Sun and offset of the panels [N.m.s/day]\n",
    );
    let cell = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"));
    let row = |worth: &Worth| {
        let windmill = worth.of(Control::Windmill);
        let size = |control| worth.of(control).map(|it| it.norm());
        let sizes = CONTROLS[1..].iter().map(|(control, ..)| cell(size(*control)));
        let head = [
            worth.distance_au.to_string(),
            if studied.panels == 0 { "-".to_owned() } else { worth.offset_deg.to_string() },
            cell(windmill.map(Worth::along)),
            cell(windmill.map(Worth::across)),
        ];
        head.into_iter().chain(sizes).collect::<Vec<String>>()
    };
    let header = "\
        distance [AU] | offset [deg] | windmill along, a deg | across | offset, a deg | azimuth, a deg | elevation, a deg | \
        centre of mass X, a cm | Y | Z | alternation";
    let rows: Vec<_> = worths.iter().map(row).collect();
    run.table(header, &rows);
    balance(run, &studied, &worths);
    run.line(REMARK);
    csv(run, &worths)?;
    run.picture("authority.svg", &chart(&studied, &worths))
}

const REMARK: &str = "\
Windmill: along the light (from the Sun to the spacecraft, its sign as for a vector) and the size of what is across it. The others:
sizes. Offset: all panels alike. Azimuth and elevation: of the Sun in the body frame. Alternation: half a turn about the Sun line,
which turns round what is across it. The CSV has all components, by the body axes of the attitude that has the Sun on -Y. Each is
a central difference of flights of MomentumPlant that is held and commanded, all its effects as its file has them.";

/// Tells at which offsets windmilling leaves nothing along the light.
fn balance(run: &mut Run<'_>, studied: &StudiedSpacecraft, worths: &[Worth]) {
    if !studied.controls.contains(&Control::Windmill) {
        let why = if studied.panels == 0 {
            "it has no panels"
        } else {
            "none of its panels has a side (`windmill_side`)"
        };
        return run.line(&format!("No windmilling: {why}.\n"));
    }
    let Some(first_au) = worths.first().map(|it| it.distance_au) else { return };
    let at: Vec<(f64, f64)> = worths
        .iter()
        .filter(|it| it.distance_au == first_au)
        .filter_map(|it| Some((it.offset_deg, Worth::along(it.of(Control::Windmill)?))))
        .collect();
    let zeros = zeros(&at);
    let shown: Vec<String> = zeros.iter().map(|zero_deg| format!("{zero_deg:.1} deg")).collect();
    let shown = if shown.is_empty() {
        "at none of these offsets".to_owned()
    } else {
        format!("at {}", shown.join(", "))
    };
    run.line(&format!("Along the light windmilling is worth nothing {shown}.\n"));
}

/// Where a function that is known at evenly spaced places is zero: of the cubic through the four places about a change of sign.
fn zeros(at: &[(f64, f64)]) -> Vec<f64> {
    // Where no torque is, rounding has signs.
    let least = 1e-9 * at.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max);
    let changes = at
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| pair[0].1 * pair[1].1 < 0.0 && pair.iter().all(|(_, value)| value.abs() > least));
    let zero = |(k, pair): (usize, &[(f64, f64)])| {
        let begin = k.saturating_sub(1).min(at.len().saturating_sub(4));
        let near = &at[begin..at.len().min(begin + 4)];
        let [mut low, mut high] = [pair[0].0, pair[1].0];
        let is_low = |x: f64| interpolated(near, x) * pair[0].1 > 0.0;
        // A hundred halvings leave nothing.
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if is_low(middle) { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    };
    changes.map(zero).collect()
}

/// The value at `x` of the polynomial through all points, by Lagrange.
fn interpolated(points: &[(f64, f64)], x: f64) -> f64 {
    let term = |(k, (at, value)): (usize, &(f64, f64))| {
        let others = points.iter().enumerate().filter(|(other, _)| *other != k);
        value * others.map(|(_, (other, _))| (x - other) / (at - other)).product::<f64>()
    };
    points.iter().enumerate().map(term).sum()
}

fn csv(run: &mut Run<'_>, worths: &[Worth]) -> Outcome {
    let own = |(_, name, _, per): (Control, &str, &str, &str)| {
        ["x", "y", "z"].map(|axis| format!("{name}_{axis}_n_m_s_d{}", per.replace('/', "_")))
    };
    let still = ["distance_au", "offset_deg", "still_x_n_m_s_d", "still_y_n_m_s_d", "still_z_n_m_s_d"];
    let header = [still.map(str::to_owned).to_vec(), CONTROLS.map(own).concat()].concat().join(" | ");
    let row = |worth: &Worth| {
        let of = |(control, ..): (Control, &str, &str, &str)| {
            worth.of(control).map_or_else(|| vec![String::new(); 3], |it| it.cells())
        };
        row![worth.distance_au, worth.offset_deg, worth.still, CONTROLS.map(of)]
    };
    run.csv("authority.csv", &header, worths.iter().map(row))
}

/// Of every control the worth by offset, a line each distance; where there are no panels by distance.
fn chart(studied: &StudiedSpacecraft, worths: &[Worth]) -> Chart {
    type Of = fn(Vector) -> f64;
    type Place = fn(&Worth) -> f64;
    let along: (&str, &str, Control, Of) =
        ("windmill, along the light", "/deg", Control::Windmill, Worth::along);
    let others = CONTROLS.map(|(control, _, title, per)| {
        let of: Of = if control == Control::Windmill { Worth::across } else { |it| it.norm() };
        (title, per, control, of)
    });
    let rows = [along].into_iter().chain(others);
    let rows = rows.filter(|(_, _, control, _)| studied.controls.contains(control));
    let (x_label, place, lines): (&str, Place, Vec<Option<f64>>) = match studied.panels {
        0 => ("distance from the Sun [AU]", |it| it.distance_au, vec![None]),
        _ => {
            let is_there = |au: &f64| worths.iter().any(|it| it.distance_au == *au);
            let lines = DISTANCES_AU.into_iter().filter(is_there).map(Some).collect();
            ("offset of the panels from the Sun [deg]", |it| it.offset_deg, lines)
        }
    };
    let panels = rows.enumerate().map(|(k, (title, per, control, of))| {
        let line = |distance_au: &Option<f64>| {
            let there = worths.iter().filter(|it| distance_au.is_none_or(|au| it.distance_au == au));
            let label = distance_au.filter(|_| k == 0).map(|au| format!("{au} AU"));
            let points = there.filter_map(|it| Some((place(it), of(it.of(control)?))));
            Series::line(label.unwrap_or_default(), points.collect())
        };
        Panel::new(format!("[N.m.s/d{per}]")).titled(title).with(lines.iter().map(line))
    });
    Chart::new("What a change is worth in momentum a day", x_label).with(panels)
}

impl StudiedSpacecraft {
    /// The plant of the options' spacecraft with a timeline of all panels' places.
    fn of(run: &Run<'_>) -> Result<Self, StudyError> {
        let template = run.options.fmu("MomentumPlant.fmu")?;
        let failed = |source| StudyError::Simulation { case: "the spacecraft".to_owned(), source };
        let (file, text) = match &run.options.spacecraft {
            Some(path) => (path.display().to_string(), files::read_text(path).map_err(Cause::from)),
            None => ("spacecraft.toml".to_owned(), Variant::text_of(&template)),
        };
        let text = text.map_err(failed)?;
        let plain = Variant::of_text(&template, &file, &text, None).map_err(failed)?;
        let panels = numbered(&plain.fmu, "panel", &["control"]).len();
        let has_sides = panels > 0
            && Variant::takes(
                &template,
                &text,
                &timeline(&[Point { offset_rad: 0.0, change: Some((Control::Windmill, TURN_RAD)) }]),
            );
        let is_there = |control: &Control| match control {
            Control::Windmill => has_sides,
            _ => panels > 0 || !control.is_of_panels(),
        };
        let controls: Vec<Control> = CONTROLS.iter().map(|(control, ..)| *control).filter(is_there).collect();
        let plant = |offset_deg: f64| {
            let offset_rad = offset_deg * DEG;
            let changes = controls
                .iter()
                .flat_map(|control| control.changes().0.iter().map(|by| Some((*control, *by))));
            let points: Vec<Point> =
                [None].into_iter().chain(changes).map(|change| Point { offset_rad, change }).collect();
            let timeline = (panels > 0).then(|| timeline(&points));
            let variant = Variant::of_text(&template, &file, &text, timeline.as_deref()).map_err(failed)?;
            Ok(Plant { variant, offset_deg, points })
        };
        let plants = offsets_deg(panels).map(plant).collect::<Result<Vec<_>, StudyError>>()?;
        let sets = run.options.assigned(plain.fmu.description())?;
        if let Some((name, _)) = sets.iter().find(|(name, _)| is_own(name)) {
            return Err(StudyError::OwnSetting { study: run.study, name: name.clone() });
        }
        let start = Case::new("the start", 1.0, 1.0).with(sets.clone());
        let center_m = start.simulate(&plain.fmu, &["spacecraft.centerOfMass"])?.first();
        Ok(Self { plants, sets, center_m, panels, controls })
    }

    fn label(&self, distance_au: f64, plant: &Plant) -> String {
        let offset = if self.panels == 0 { String::new() } else { format!(", {} deg", plant.offset_deg) };
        format!("{distance_au} AU{offset}")
    }

    fn simulated(&self, distance_au: f64, plant: &Plant) -> Result<Worth, StudyError> {
        let distance_m = distance_au * AU_M;
        let speed_m_s = (GM_M3_S2 / distance_m).sqrt();
        let stop_s = plant.points.len() as f64 * STEP_S;
        let case = Case::new(self.label(distance_au, plant), stop_s, STEP_S)
            .with(self.sets.clone())
            .with((1..=self.panels).flat_map(|number| set(&format!("panel[{number}].control"), "timeline")))
            .set("attitude.source", "commanded")
            .set("command.source", "inputs")
            .set("command.kind", "attitude")
            .set("momentum.convention", "inertial")
            .set("dump.threshold", [NO_DUMP_N_M_S; 3])
            .set("orbit.center", "sun")
            .set("orbit.source", "held")
            .set("orbit.position", [-distance_m, 0.0, 0.0])
            .set("orbit.velocity", [0.0, speed_m_s, 0.0]);
        let mut ahead = plant.points.iter();
        let mut inputs =
            |_: Row<'_>| ahead.next().map_or_else(Settings::new, |point| point.settings(self.center_m));
        let momentum_n_m_s: Vec<Vector> =
            case.steer(&plant.variant.fmu, &["momentum.inertial"], &mut inputs)?.all(0);
        // By the body axes, in N m s a day.
        let gathered =
            |pair: &[Vector]| upright().inverse_transform_vector(&(pair[1] - pair[0])) * (DAY_S / STEP_S);
        let rates: Vec<Vector> = momentum_n_m_s.windows(2).map(gathered).collect();
        let least = ROUNDING * rates.iter().map(Vector::amax).fold(0.0, f64::max);
        let known = |rate: Vector| rate.map(|part| if part.abs() < least { 0.0 } else { part });
        let mut rates = rates.into_iter();
        let mut take = || rates.next().unwrap_or(Vector::repeat(f64::NAN));
        let still = take();
        let worth = |control: &Control| {
            let (changes, per) = control.changes();
            let first = take();
            let other = if changes.len() > 1 { take() } else { still };
            (*control, known(first - other) / per)
        };
        let of = self.controls.iter().map(worth).collect();
        Ok(Worth { distance_au, offset_deg: plant.offset_deg, still: known(still), of })
    }
}

/// Offsets in deg; of a spacecraft without panels one.
fn offsets_deg(panels: usize) -> impl Iterator<Item = f64> {
    let count = if panels == 0 { 1 } else { usize::MAX };
    OFFSETS_DEG.step_by(SPACING_DEG).map(f64::from).take(count)
}

/// How the panels stand at each point, as a timeline.
fn timeline(points: &[Point]) -> String {
    let list = |(k, point): (usize, &Point)| {
        format!(
            "[[panels]]\nat = {:?}\nsunOffset = {:?}\nwindmill = {:?}\n",
            k as f64 * STEP_S,
            point.offset_rad + point.by(Control::Offset),
            point.by(Control::Windmill)
        )
    };
    points.iter().enumerate().map(list).collect()
}

/// Whether the study itself sets a variable.
fn is_own(name: &str) -> bool {
    const GROUPS: [&str; 7] = [
        "attitude.source",
        "command.",
        "momentum.convention",
        "dump.threshold",
        "orbit.",
        "panel[1].control",
        "start.epoch",
    ];
    GROUPS.iter().any(|own| name.starts_with(own))
        || name.starts_with("panel[") && name.ends_with("].control")
}

#[cfg(test)]
mod tests {
    //! Zeros of a cubic, attitudes by hand.
    use super::*;

    #[test]
    fn zeros_of_a_cubic_are_found() {
        let at: Vec<(f64, f64)> =
            (0..=12).map(|k| 5.0 * f64::from(k)).map(|x| (x, (x - 3.0) * (x - 31.7) * (x - 58.0))).collect();
        let found = zeros(&at);
        assert_eq!(found.len(), 3);
        found
            .iter()
            .zip([3.0, 31.7, 58.0])
            .for_each(|(found, zero)| assert!((found - zero).abs() < 1e-9, "{found}"));
        assert_eq!(zeros(&[(0.0, 1.0), (5.0, 2.0)]), [0.0; 0]);
    }

    #[test]
    fn an_attitude_has_the_sun_at_its_angles() {
        let by = |control, by| Point { offset_rad: 0.0, change: Some((control, by)) }.attitude();
        let seen = |attitude: Attitude| attitude.inverse_transform_vector(&Vector::x());
        let near = |a: Vector, b: Vector| assert!((a - b).norm() < 1e-15, "{a} {b}");
        near(seen(Point { offset_rad: 0.0, change: None }.attitude()), -Vector::y());
        near(seen(by(Control::Azimuth, 0.1)), Vector::new(0.1f64.sin(), -(0.1f64.cos()), 0.0));
        near(seen(by(Control::Elevation, 0.1)), Vector::new(0.0, -(0.1f64.cos()), -(0.1f64.sin())));
        let turned = by(Control::Alternation, 1.0);
        near(seen(turned), -Vector::y());
        near(turned.transform_vector(&Vector::z()), -upright().transform_vector(&Vector::z()));
    }
}
