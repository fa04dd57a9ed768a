//! A plan, from its file: what stands there, in SI, by the line that it stands in.

pub mod encounter;

use std::path::{Path, PathBuf};

use physics::{constants::DAY_S, toml::Place};

use self::encounter::{Compare, Flyby, MonteCarlo, Update};
use crate::{
    kind::FileKind,
    plan::description::{ActivityDescription, ContactDescription, MomentumPlanDescription},
    reading::{self, ALLOWED_SPAN, At, Builder, Written},
    values,
};

/// An activity that might be added.
#[derive(Clone, Debug)]
pub struct Activity {
    /// Its name.
    pub name: String,
    /// Start and stop.
    pub span: [values::Instant; 2],
    /// Keys and values as a timeline has them, a line each.
    pub command: String,
}

/// A plan file.
#[derive(Clone, Debug)]
pub struct PlanFile {
    /// The file.
    pub file: PathBuf,
    /// Its mission.
    pub mission: At<PathBuf>,
    /// Time from the start during which the mission stays as it is.
    pub freeze_s: At<f64>,
    /// Distance of rows, in s, where it is written.
    pub every_s: Option<f64>,
    /// Length of a window.
    pub window_s: At<f64>,
    /// Limit of the momentum, where it is written.
    pub limit_n_m_s: Option<f64>,
    /// Fraction of the limit that stays unused.
    pub margin: f64,
    /// File of a refit.
    pub refit: Option<At<PathBuf>>,
    /// Number of dumps that the plan may have.
    pub dumps: usize,
    /// Largest change off the baseline, in rad; 0 where it is kept.
    pub offset_rad: f64,
    /// With its place where it is written.
    pub windmill_rad: (f64, Option<At<()>>),
    /// Largest tilt, where it is written.
    pub azimuth_rad: Option<f64>,
    /// Likewise in elevation.
    pub elevation_rad: Option<f64>,
    /// Largest fraction of a window in the alternate attitude.
    pub alternation: f64,
    /// Ground contacts.
    pub contacts: Vec<At<[values::Instant; 2]>>,
    /// Fraction of every window that contacts take.
    pub contact_share: f64,
    /// Activities whose price is reported.
    pub activities: Vec<At<Activity>>,
    /// Keys that stand there and count in cruise alone.
    pub of_cruise: Vec<At<()>>,
    /// Tables of a flyby, with their places.
    pub flyby: Option<At<Flyby>>,
    /// `[update]`.
    pub update: Option<At<Update>>,
    /// `[compare]`.
    pub compare: Option<At<Compare>>,
    /// `[montecarlo]`.
    pub monte_carlo: Option<At<MonteCarlo>>,
}

impl PlanFile {
    /// Reads a plan.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, String> {
        reading::read(FileKind::Plan, file, |builder, it| builder.plan(file, it))
    }

    /// A problem at a place of the file.
    pub fn problem<T>(&self, at: &At<T>, what: &str) -> String {
        at.problem(&self.file, what)
    }

    /// Whether it has an aim, or is to say where the mission as it is passes a planet.
    pub fn has_aim(&self) -> bool {
        self.flyby.as_ref().is_none_or(|at| at.it.aimpoint.is_some())
    }

    /// Every time that counts by the clock of the mission.
    pub fn instants_mut(&mut self) -> impl Iterator<Item = &mut values::Instant> {
        let flyby = self.flyby.iter_mut().flat_map(|at| [&mut at.it.time, &mut at.it.from]);
        let next = self.compare.iter_mut().map(|at| &mut at.it.next.it);
        let contacts = self.contacts.iter_mut().flat_map(|at| &mut at.it);
        let activities = self.activities.iter_mut().flat_map(|at| &mut at.it.span);
        flyby.flatten().map(|at| &mut at.it).chain(next).chain(contacts).chain(activities)
    }
}

impl Builder<'_> {
    fn plan(&mut self, file: &Path, description: MomentumPlanDescription) -> PlanFile {
        let root = self.root.clone();
        let of_cruise = ["window", "windmill", "alternation", "sunOffset", "contact", "contactShare"];
        let of_cruise = of_cruise.map(|key| root.key(key)).into_iter();
        let of_cruise = of_cruise.filter(|key| key.is_written()).map(|key| self.at(&key, ()));
        let of_cruise = of_cruise.collect();
        let momentum = description.momentum.unwrap_or_default();
        let sun_offset = description.sun_offset.unwrap_or_default();
        let tilt = description.tilt.unwrap_or_default();
        let [of_momentum, of_offset, of_tilt] = ["momentum", "sunOffset", "tilt"].map(|key| root.key(key));
        let mission = self.path(&root.key("mission"), &description.mission, Path::is_file);
        let largest_rad =
            self.angle(&of_offset.key("largest"), sun_offset.largest.as_deref()).unwrap_or(LARGEST_RAD);
        let windmill = root.key("windmill");
        let windmill_rad = self.angle(&windmill, description.windmill.as_deref());
        let share = root.key("contactShare");
        if description.contact_share.is_some() && description.contact.is_some() {
            share.report("contactShare beside [[contact]]", "one of them");
        }
        let margin = of_momentum.key("margin");
        if momentum.margin.is_some() && momentum.refit.is_some() {
            margin.report("margin beside refit", "one of them");
        }
        let freeze_s = self.span(&root.key("freeze"), description.freeze.as_deref(), 14.0 * DAY_S, 0.0);
        let every = |written: &Written| written.duration_s().filter(|every_s| *every_s >= MIN_EVERY_S);
        let allowed = format_args!("a time from 1 min on: {ALLOWED_SPAN}");
        let every_s = self.read(&root.key("every"), description.every.as_deref(), every, allowed);
        let window_s = self.span(&root.key("window"), description.window.as_deref(), 3.0 * DAY_S, 3600.0);
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
            every_s,
            window_s: self.at(&root.key("window"), window_s),
            limit_n_m_s: self.momentum(&of_momentum.key("limit"), momentum.limit.as_deref()),
            margin: self.share(&margin, momentum.margin.as_deref(), 0.0, 0.99),
            refit: momentum.refit.map(|path| {
                let key = of_momentum.key("refit");
                let path = self.path(&key, &path, Path::is_file);
                self.at(&key, path)
            }),
            dumps: self.count(&of_momentum.key("dumps"), momentum.dumps.as_deref(), 0).unwrap_or(0) as usize,
            offset_rad: if sun_offset.change == Some(true) { largest_rad } else { 0.0 },
            windmill_rad: (
                windmill_rad.unwrap_or(WINDMILL_RAD),
                windmill_rad.map(|_| self.at(&windmill, ())),
            ),
            azimuth_rad: self.angle(&of_tilt.key("azimuth"), tilt.azimuth.as_deref()),
            elevation_rad: self.angle(&of_tilt.key("elevation"), tilt.elevation.as_deref()),
            alternation: self.share(&root.key("alternation"), description.alternation.as_deref(), 0.5, 1.0),
            contacts,
            contact_share: self.share(&share, description.contact_share.as_deref(), 0.0, 1.0),
            activities: activities
                .filter_map(|(index, it)| self.activity(&root.key("activity").item(index), it))
                .collect(),
            of_cruise,
        }
    }

    fn contacts(
        &mut self,
        list: &Place<'_>,
        contacts: &[ContactDescription],
    ) -> Vec<At<[values::Instant; 2]>> {
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
                let found = format!("{}, before the contact above ends", *contact.start);
                let allowed = "contacts in the order of time, none overlapping";
                place.key("start").report(found, allowed);
            }
            found.push(self.at(&place, span));
        }
        found
    }

    fn activity(&mut self, place: &Place<'_>, activity: ActivityDescription) -> Option<At<Activity>> {
        let span = self.spanned(place, &activity.start, &activity.stop);
        let key = place.key("command");
        let command = &*activity.command;
        let Written::Table(table) = command else {
            key.report(command, "a table with the keys of a command in a timeline");
            return None;
        };
        for clock in ["at", "until"].into_iter().filter(|clock| table.contains_key(*clock)) {
            key.key(clock).report("it", "start and stop of the activity alone");
        }
        let command = table.iter().map(|(name, value)| format!("{name} = {}\n", inline(value))).collect();
        Some(self.at(place, Activity { name: activity.name, span: span?, command }))
    }
}

/// Least distance of rows, in s.
const MIN_EVERY_S: f64 = 60.0;
const LARGEST_RAD: f64 = 5.0 * core::f64::consts::PI / 180.0;
const WINDMILL_RAD: f64 = 2.0 * core::f64::consts::PI / 180.0;

/// As TOML has it in one line.
fn inline(written: &Written) -> String {
    match written {
        Written::Integer(_) | Written::Boolean(_) => written.to_string(),
        Written::Number(number) => format!("{number:?}"),
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
