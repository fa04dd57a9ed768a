//! How a plant points while it guides itself, by the start values of its variables: in a sentence, and what is odd about it.

use std::path::PathBuf;

use fmi::{Times, Value};
use inputs::variables::{item, real, start};
use model_description::Description;
use physics::{
    bodies::Body,
    enumeration::Enumerated,
    environment::orbit::period_s,
    spacecraft::{DownlinkWindows, Spacecraft, TimeAfterPeriapsis},
};
use terminal::short;

/// Variable that chooses the body that a plant orbits.
const CENTER: &str = "orbit.center";
/// A half turn to within rounding: no limit.
const EVERYWHERE_DEG: f64 = 89.999;

/// The start values of one plant of a model or a system.
struct Plant<'a> {
    description: &'a Description,
    sets: &'a [(String, Value)],
    /// Windows of the file; shares of the period follow the orbit.
    windows: Option<DownlinkWindows>,
    prefix: &'a str,
}

/// Prefix of a plant's variables, and the windows of its spacecraft's file.
pub type Windows = (String, DownlinkWindows);

/// The windows of a spacecraft's file, if it has any.
pub fn windows_of(text: &str) -> Option<Windows> {
    Some((String::new(), Spacecraft::from_toml("", text).ok()?.downlinks?))
}

/// The windows of the files in FMUs that are unpacked in these folders, each after what its variables begin with.
pub fn windows_in(parts: &[(String, PathBuf)]) -> Vec<Windows> {
    let windows = parts.iter().filter_map(|(prefix, folder)| {
        let text = files::read_text(&folder.join("resources").join("spacecraft.toml")).ok()?;
        Some((prefix.clone(), windows_of(&text)?.1))
    });
    windows.collect()
}

/// A warning for each plant whose downlinks are always or never open.
pub fn warnings(description: &Description, sets: &[(String, Value)], windows: &[Windows]) -> Vec<String> {
    plants(description, sets, windows).filter_map(|plant| plant.window_warning()).collect()
}

/// Rows of an orbit below which its extremes are missed.
const ROWS_OF_ORBIT: f64 = 8.0;

/// A warning for each plant of whose orbits rows so far apart show too little, where the run has a whole one.
pub fn sparse_rows(
    description: &Description,
    sets: &[(String, Value)],
    times: &Times,
    every_s: f64,
) -> Vec<String> {
    let sparse = |plant: Plant<'_>| {
        let period_s = plant.period_s().filter(|period_s| *period_s <= times.stop_s - times.start_s)?;
        (every_s * ROWS_OF_ORBIT > period_s).then(|| {
            let [every, period] = [every_s, period_s].map(hours);
            format!(
                "{}: rows {every} apart show too little of an orbit of {period}: its least and greatest values are missed, and \
                 what repeats with it looks slow; see --every and --step",
                plant.name("orbit.semiMajorAxis")
            )
        })
    };
    plants(description, sets, &[]).filter_map(sparse).collect()
}

/// How the plant points; `None` of what is no plant.
pub fn sentence(description: &Description, windows: &[Windows]) -> Option<String> {
    plants(description, &[], windows).next()?.sentence()
}

fn plants<'a>(
    description: &'a Description,
    sets: &'a [(String, Value)],
    windows: &'a [Windows],
) -> impl Iterator<Item = Plant<'a>> {
    let prefixes = description.variables.iter().filter_map(|variable| variable.name.strip_suffix(CENTER));
    prefixes.map(move |prefix| {
        let windows = windows.iter().find(|(of, _)| of == prefix).map(|(_, windows)| *windows);
        Plant { description, sets, windows, prefix }
    })
}

impl Plant<'_> {
    fn name(&self, name: &str) -> String {
        format!("{}{name}", self.prefix)
    }

    fn real(&self, name: &str) -> Option<f64> {
        real(self.description, self.sets, &self.name(name))
    }

    fn item(&self, name: &str) -> Option<&str> {
        item(self.description, self.sets, &self.name(name))
    }

    fn every(&self) -> Option<f64> {
        start(self.description, self.sets, &self.name("guided.downlinkEvery")).map(|value| value.to_f64())
    }

    /// Whether the orbit phase's own guidance gives the attitude.
    fn guides_itself(&self) -> bool {
        match self.item("attitude.source") {
            Some("guided") => true,
            Some("commanded" | "controlled") => self.item("command.source") == Some("guidance"),
            _ => false,
        }
    }

    /// Whether it is in downlink throughout.
    fn is_in_cruise(&self) -> bool {
        self.item("guided.phase") == Some("cruise")
    }

    /// Begin and end as shares of the period, where the file gives them so and nothing sets them.
    fn shares(&self) -> [Option<f64>; 2] {
        let Some(windows) = self.windows else { return [None; 2] };
        let is_set = |name: &str| self.sets.iter().any(|(set, _)| *set == self.name(name));
        let share = |time: TimeAfterPeriapsis, name| time.period_share().filter(|_| !is_set(name));
        [share(windows.start, "guided.downlinkStart"), share(windows.stop, "guided.downlinkEnd")]
    }

    fn window_s(&self) -> Option<[f64; 2]> {
        let time_s = |share: Option<f64>, name: &str| match (share, self.period_s()) {
            (Some(share), Some(period_s)) if period_s.is_finite() => Some(share * period_s),
            _ => self.real(name),
        };
        let [start, end] = self.shares();
        Some([time_s(start, "guided.downlinkStart")?, time_s(end, "guided.downlinkEnd")?])
    }

    /// Between two periapses, in s; `None` where that is not known before the flight, infinite about the Sun.
    fn period_s(&self) -> Option<f64> {
        let center = self.item(CENTER)?;
        let body = Body::ITEMS.iter().find(|row| row.name == center)?.variant;
        if body == Body::Sun {
            return Some(f64::INFINITY);
        }
        let is_set = |name: &str| self.sets.iter().any(|(set, _)| *set == self.name(name));
        let axis = "orbit.semiMajorAxis";
        // Elements that nobody sets follow a centre that somebody does.
        if self.item("orbit.source") != Some("elements") || (is_set(CENTER) && !is_set(axis)) {
            return None;
        }
        let gm = "planet.gravitationalParameter";
        let gm_m3_s2 = if is_set(CENTER) && !is_set(gm) { body.data().gm_m3_s2 } else { self.real(gm)? };
        Some(period_s(gm_m3_s2, self.real(axis)?))
    }

    fn window_warning(&self) -> Option<String> {
        let ([begin_s, end_s], every) = (self.window_s()?, self.every()?);
        let is_periodic = self.item("guided.downlinkReference") == Some("periapsis") && every > 0.0;
        if !is_periodic || !self.guides_itself() || self.is_in_cruise() {
            return None;
        }
        let cycle_s = every * self.period_s().filter(|period_s| period_s.is_finite())?;
        let window = format!(
            "{}, downlinkEnd, downlinkEvery: a window from {} to {} every {}",
            self.name("guided.downlinkStart"),
            hours(begin_s),
            hours(end_s),
            hours(cycle_s)
        );
        if end_s - begin_s >= cycle_s {
            Some(format!(
                "{window} is always open: the spacecraft is in downlink for ever and never observes"
            ))
        } else if begin_s >= end_s {
            Some(format!("{window} is never open: there is no downlink"))
        } else {
            None
        }
    }

    fn sentence(&self) -> Option<String> {
        let rule = self.item("guided.scienceRule")?;
        if !self.guides_itself() {
            let source = self.item("attitude.source")?;
            return Some(match source {
                "free" => "as its wheels and thrusters turn it (attitude.source free)".to_owned(),
                _ => format!("as the inputs command.* say (attitude.source {source})"),
            });
        }
        if self.is_in_cruise() {
            return Some("downlink throughout (guided.phase cruise), the Sun on -Y".to_owned());
        }
        let limit_deg = self.real("keepIn.elevation")?.to_degrees();
        let is_limited = limit_deg < EVERYWHERE_DEG;
        let limit = short((limit_deg * 1e6).round() / 1e6);
        let science = match rule {
            "sunPointing" => "-Y at the Sun, +Z toward ecliptic north".to_owned(),
            "inertial" => "held in guided.attitude".to_owned(),
            "aligned" => format!("{}, {}", self.axis("align", "at")?, self.axis("constrain", "toward")?),
            _ if self.item(CENTER) == Some("sun") => "-Y at the Sun, +Z toward the north".to_owned(),
            "lvlh" => "nadir with +Z, -Y along the orbit normal".to_owned(),
            "yawSteering" => "nadir with +Z, rolled so that the panels' axis is across the Sun".to_owned(),
            "nadir" if is_limited => format!("nadir with +Z, the Sun within {limit} deg of -Y"),
            "nadir" => "nadir with +Z, rolled so that the Sun is nearest to -Y".to_owned(),
            "scaled" => {
                let gain = short(self.real("guided.scienceGain")?);
                format!("-Y at the Sun, +Z pitched toward nadir by {gain} of the way, at most {limit} deg")
            }
            _ => "-Y along the line from the planet to the Sun, -Z to the north of the planet's orbit"
                .to_owned(),
        };
        Some(format!("{science}, {}", self.downlinks()?))
    }

    /// An axis of the rule aligned and its target.
    fn axis(&self, group: &str, preposition: &str) -> Option<String> {
        let target = self.item(&format!("guided.{group}.target"))?;
        let component = |i: i32| Some(short(self.real(&format!("guided.{group}.axis[{i}]"))?));
        let [x, y, z] = [component(1)?, component(2)?, component(3)?];
        Some(format!("({x}, {y}, {z}) {preposition} {target}"))
    }

    fn downlinks(&self) -> Option<String> {
        let ([begin_s, end_s], every) = (self.window_s()?, self.every()?);
        let written = |share: Option<f64>, time_s: f64| match share {
            Some(share) => format!("{} %", short((share * 1e5).round() / 1e3)),
            None => hours(time_s),
        };
        let [start, end] = self.shares();
        let window = format!("from {} to {}", written(start, begin_s), written(end, end_s));
        let is_once = self.item("guided.downlinkReference") == Some("start");
        Some(match every {
            _ if begin_s >= end_s => "no downlinks".to_owned(),
            _ if is_once => format!("one downlink {window} after the start"),
            0.0 => "no downlinks".to_owned(),
            _ if self.item(CENTER) == Some("sun") => "no downlinks".to_owned(),
            1.0 => format!("downlink {window} after every periapsis"),
            _ => format!("downlink {window} after one of {every} periapses"),
        })
    }
}

/// A time in hours.
fn hours(time_s: f64) -> String {
    format!("{} h", short((time_s / 3.6).round() / 1000.0))
}

#[cfg(test)]
mod tests;
