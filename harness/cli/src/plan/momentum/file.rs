//! A plan, from its file: what stands there, in SI, by the line that it stands in.

pub(in crate::plan) mod encounter;

use std::path::{Path, PathBuf};

use physics::{
    environment::dates,
    toml::{Checker, Document, Place},
};

use self::encounter::{Compare, Flyby, MonteCarlo, Update};
use super::description::{ActivityDescription, ContactDescription, Description};
pub(super) use crate::mission::At;
use crate::{kind::FileKind, mission::Written, values};

const DAY_S: f64 = 86_400.0;
const ALLOWED_SPAN: &str = "a number of s or one with a unit: 600, \"12 h\", \"3 d\"";
const ALLOWED_ANGLE: &str = "a number of rad or one with a unit: \"2 deg\"";
const ALLOWED_MOMENTUM: &str = "a number of N.m.s above 0, or one with that unit: 5.5, \"5.5 N.m.s\"";

/// An activity that might be added.
#[derive(Clone, Debug)]
pub(super) struct Activity {
    pub name: String,
    pub span: [values::Instant; 2],
    /// Keys and values as a timeline has them, a line each.
    pub command: String,
}

/// A plan file.
#[derive(Clone, Debug)]
pub(super) struct PlanFile {
    pub file: PathBuf,
    pub mission: At<PathBuf>,
    pub freeze_s: At<f64>,
    pub window_s: At<f64>,
    pub limit_n_m_s: Option<f64>,
    pub margin: f64,
    pub refit: Option<At<PathBuf>>,
    pub dumps: usize,
    /// Largest change off the baseline, in rad; 0 where it is kept.
    pub offset_rad: f64,
    /// With its place where it is written.
    pub windmill_rad: (f64, Option<At<()>>),
    /// Largest tilt, where it is written.
    pub azimuth_rad: Option<f64>,
    pub elevation_rad: Option<f64>,
    pub alternation: f64,
    pub contacts: Vec<At<[values::Instant; 2]>>,
    pub contact_share: f64,
    pub activities: Vec<At<Activity>>,
    /// Keys that stand there and count in cruise alone.
    pub of_cruise: Vec<At<()>>,
    /// Tables of a flyby, with their places.
    pub flyby: Option<At<Flyby>>,
    pub update: Option<At<Update>>,
    pub compare: Option<At<Compare>>,
    pub monte_carlo: Option<At<MonteCarlo>>,
}

impl PlanFile {
    /// Reads a plan.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub(super) fn read(file: &Path) -> Result<Self, String> {
        Self::parse(file, &FileKind::Plan.read(file)?)
    }

    fn parse(file: &Path, text: &str) -> Result<Self, String> {
        let shown = file.display().to_string();
        let document = Document::parse(&shown, text).map_err(|error| error.to_string())?;
        let (description, findings) = document.read::<Description>().map_err(|error| error.to_string())?;
        let folder = file.parent().unwrap_or(Path::new(""));
        let mut builder = Builder { check: Checker::new(&document, findings), folder };
        let plan = builder.plan(file, description);
        builder.check.finish(plan).map_err(|error| error.to_string())
    }

    /// A problem at a place of the file.
    pub(super) fn problem<T>(&self, at: &At<T>, what: &str) -> String {
        format!("{}:{}: {}: {what}", self.file.display(), at.line, at.key)
    }
}

struct Builder<'d> {
    check: Checker<'d>,
    folder: &'d Path,
}

impl Builder<'_> {
    fn plan(&mut self, file: &Path, description: Description) -> PlanFile {
        let root = Place::root();
        let written = [
            ("window", description.window.is_some()),
            ("windmill", description.windmill.is_some()),
            ("alternation", description.alternation.is_some()),
            ("sunOffset", description.sun_offset.is_some()),
            ("contact", description.contact.is_some()),
            ("contactShare", description.contact_share.is_some()),
        ];
        let of_cruise = written.into_iter().filter(|(_, is)| *is).map(|(key, _)| self.at(&root.key(key), ()));
        let of_cruise = of_cruise.collect();
        let momentum = description.momentum.unwrap_or_default();
        let sun_offset = description.sun_offset.unwrap_or_default();
        let tilt = description.tilt.unwrap_or_default();
        let [of_momentum, of_offset, of_tilt] = ["momentum", "sunOffset", "tilt"].map(|key| root.key(key));
        let mission = self.path(&root.key("mission"), &description.mission);
        let largest_rad =
            self.angle(&of_offset.key("largest"), sun_offset.largest.as_ref()).unwrap_or(LARGEST_RAD);
        let windmill = root.key("windmill");
        let windmill_rad = self.angle(&windmill, description.windmill.as_ref());
        let share = root.key("contactShare");
        if description.contact_share.is_some() && description.contact.is_some() {
            self.check.report(&share, "contactShare beside [[contact]]", "one of them");
        }
        let margin = of_momentum.key("margin");
        if momentum.margin.is_some() && momentum.refit.is_some() {
            self.check.report(&margin, "margin beside refit", "one of them");
        }
        let freeze_s = self.span(&root.key("freeze"), description.freeze.as_ref(), 14.0 * DAY_S, 0.0);
        let window_s = self.span(&root.key("window"), description.window.as_ref(), 3.0 * DAY_S, 3600.0);
        let contacts = description.contact.unwrap_or_default();
        let contacts = self.contacts(&root.key("contact"), &contacts);
        let activities = description.activity.unwrap_or_default().into_iter().enumerate();
        let [flyby, update, compare, monte_carlo] =
            ["flyby", "update", "compare", "montecarlo"].map(|key| root.key(key));
        let of_flyby = description.flyby.and_then(|it| self.flyby(&flyby, it));
        let of_update = description.update.and_then(|it| self.update(&update, it));
        let of_compare = description.compare.and_then(|it| self.compare(&compare, it));
        let of_monte_carlo = description.montecarlo.map(|it| self.monte_carlo(&monte_carlo, it));
        PlanFile {
            flyby: of_flyby.map(|it| self.at(&flyby, it)),
            update: of_update.map(|it| self.at(&update, it)),
            compare: of_compare.map(|it| self.at(&compare, it)),
            monte_carlo: of_monte_carlo.map(|it| self.at(&monte_carlo, it)),
            file: file.to_owned(),
            mission: self.at(&root.key("mission"), mission),
            freeze_s: self.at(&root.key("freeze"), freeze_s),
            window_s: self.at(&root.key("window"), window_s),
            limit_n_m_s: self.momentum(&of_momentum.key("limit"), momentum.limit.as_ref()),
            margin: self.share(&margin, momentum.margin.as_ref(), 0.0, 0.99),
            refit: momentum.refit.map(|path| {
                let key = of_momentum.key("refit");
                let path = self.path(&key, &path);
                self.at(&key, path)
            }),
            dumps: self.count(&of_momentum.key("dumps"), momentum.dumps.as_ref()),
            offset_rad: if sun_offset.change == Some(true) { largest_rad } else { 0.0 },
            windmill_rad: (
                windmill_rad.unwrap_or(WINDMILL_RAD),
                windmill_rad.map(|_| self.at(&windmill, ())),
            ),
            azimuth_rad: self.angle(&of_tilt.key("azimuth"), tilt.azimuth.as_ref()),
            elevation_rad: self.angle(&of_tilt.key("elevation"), tilt.elevation.as_ref()),
            alternation: self.share(&root.key("alternation"), description.alternation.as_ref(), 0.5, 1.0),
            contacts,
            contact_share: self.share(&share, description.contact_share.as_ref(), 0.0, 1.0),
            activities: activities
                .filter_map(|(index, it)| self.activity(&root.key("activity").item(index), it))
                .collect(),
            of_cruise,
        }
    }

    fn at<T>(&self, place: &Place, it: T) -> At<T> {
        At { it, key: place.to_string(), line: self.check.line(place) }
    }

    fn path(&mut self, place: &Place, path: &str) -> PathBuf {
        let found = self.folder.join(path);
        if !self.check.has_stand_in(place) && !found.is_file() {
            let shown = format!("{}, which is not there", found.display());
            self.check.report(place, shown, "a file; paths are relative to this one's folder");
        }
        found
    }

    fn span(&mut self, place: &Place, written: Option<&Written>, default_s: f64, least_s: f64) -> f64 {
        let Some(written) = written else { return default_s };
        let span_s = written.setting().and_then(|text| values::duration(&text).ok());
        match span_s.filter(|span_s| *span_s >= least_s) {
            Some(span_s) => span_s,
            None => {
                let least = if least_s > 0.0 { "from 1 h on" } else { "from 0 on" };
                self.check.report(place, written, format_args!("a time {least}: {ALLOWED_SPAN}"));
                default_s
            }
        }
    }

    /// An angle from 0 to 90 deg.
    fn angle(&mut self, place: &Place, written: Option<&Written>) -> Option<f64> {
        let written = written?;
        let angle_rad = match written {
            Written::Number(angle_rad) => Some(*angle_rad),
            Written::Integer(0) => Some(0.0),
            Written::Text(text) => values::angle(text).ok(),
            _ => None,
        };
        let angle_rad = angle_rad.filter(|it| (0.0..=core::f64::consts::FRAC_PI_2).contains(it));
        if angle_rad.is_none() {
            self.check.report(place, written, format_args!("an angle from 0 to 90 deg: {ALLOWED_ANGLE}"));
        }
        angle_rad
    }

    fn momentum(&mut self, place: &Place, written: Option<&Written>) -> Option<f64> {
        let written = written?;
        let number = match written {
            Written::Number(number) => Some(*number),
            Written::Integer(number) => Some(*number as f64),
            Written::Text(text) => {
                let text = text.trim();
                text.strip_suffix("N.m.s").unwrap_or(text).trim_end().parse().ok()
            }
            _ => None,
        };
        let momentum = number.filter(|number: &f64| *number > 0.0 && number.is_finite());
        if momentum.is_none() {
            self.check.report(place, written, ALLOWED_MOMENTUM);
        }
        momentum
    }

    fn share(&mut self, place: &Place, written: Option<&Written>, default: f64, most: f64) -> f64 {
        let Some(written) = written else { return default };
        let number = match written {
            Written::Number(number) => Some(*number),
            Written::Integer(number) => Some(*number as f64),
            _ => None,
        };
        number.filter(|number| (0.0..=most).contains(number)).unwrap_or_else(|| {
            self.check.report(place, written, format_args!("a share from 0 to {most}"));
            default
        })
    }

    fn count(&mut self, place: &Place, written: Option<&Written>) -> usize {
        let Some(written) = written else { return 0 };
        let number =
            if let Written::Integer(number) = written { usize::try_from(*number).ok() } else { None };
        number.unwrap_or_else(|| {
            self.check.report(place, written, "a whole number from 0 on");
            0
        })
    }

    fn instant(&mut self, place: &Place, written: &Written) -> Option<values::Instant> {
        let number = matches!(written, Written::Number(_) | Written::Integer(_) | Written::Text(_));
        let instant = written.setting().filter(|_| number).and_then(|text| values::instant(&text).ok());
        if instant.is_none() && !self.check.has_stand_in(place) {
            let allowed = format!("{}; or simulation time, {ALLOWED_SPAN}", dates::ALLOWED_DATE);
            self.check.report(place, written, allowed);
        }
        instant
    }

    fn spanned(&mut self, place: &Place, start: &Written, stop: &Written) -> Option<[values::Instant; 2]> {
        let span = [self.instant(&place.key("start"), start)?, self.instant(&place.key("stop"), stop)?];
        let is_ordered = match span {
            [values::Instant::Time(a), values::Instant::Time(b)]
            | [values::Instant::Epoch(a), values::Instant::Epoch(b)] => a < b,
            _ => {
                self.check.report(
                    &place.key("stop"),
                    stop,
                    "a date as start is one, or both simulation times",
                );
                return None;
            }
        };
        if !is_ordered {
            let found = format!("{stop}, not after `start`");
            self.check.report(&place.key("stop"), found, format_args!("a time after {start}"));
        }
        Some(span)
    }

    fn contacts(&mut self, list: &Place, contacts: &[ContactDescription]) -> Vec<At<[values::Instant; 2]>> {
        let mut found: Vec<At<[values::Instant; 2]>> = Vec::new();
        for (index, contact) in contacts.iter().enumerate() {
            let place = list.item(index);
            let Some(span) = self.spanned(&place, &contact.start, &contact.stop) else { continue };
            let overlaps = found.last().is_some_and(|last| match (last.it[1], span[0]) {
                (values::Instant::Time(a), values::Instant::Time(b))
                | (values::Instant::Epoch(a), values::Instant::Epoch(b)) => b < a,
                _ => false,
            });
            if overlaps {
                let found = format!("{}, before the contact above ends", contact.start);
                self.check.report(
                    &place.key("start"),
                    found,
                    "contacts in the order of time, none overlapping",
                );
            }
            found.push(self.at(&place, span));
        }
        found
    }

    fn activity(&mut self, place: &Place, activity: ActivityDescription) -> Option<At<Activity>> {
        let span = self.spanned(place, &activity.start, &activity.stop);
        let key = place.key("command");
        let Written::Table(table) = &activity.command else {
            if !self.check.has_stand_in(&key) {
                self.check.report(
                    &key,
                    &activity.command,
                    "a table with the keys of a command in a timeline",
                );
            }
            return None;
        };
        for clock in ["at", "until"].into_iter().filter(|clock| table.contains_key(*clock)) {
            self.check.report(&key.key(clock), "it", "start and stop of the activity alone");
        }
        let command = table.iter().map(|(name, value)| format!("{name} = {}\n", inline(value))).collect();
        Some(self.at(place, Activity { name: activity.name, span: span?, command }))
    }
}

const LARGEST_RAD: f64 = 5.0 * core::f64::consts::PI / 180.0;
const WINDMILL_RAD: f64 = 2.0 * core::f64::consts::PI / 180.0;

/// As TOML has it in one line.
fn inline(written: &Written) -> String {
    match written {
        Written::Integer(number) => number.to_string(),
        Written::Number(number) => format!("{number:?}"),
        Written::Boolean(truth) => truth.to_string(),
        Written::Text(text) => toml_edit::Value::from(text.as_str()).to_string(),
        Written::List(items) => {
            format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", "))
        }
        Written::Table(table) => {
            let entries = table.iter().map(|(name, value)| format!("{name} = {}", inline(value)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}

#[cfg(test)]
mod tests;
