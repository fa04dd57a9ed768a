//! A leg, from its file.

use std::path::Path;

use files::outcome::Refusal;
use physics::toml::Place;

use super::{
    ArcBranch, FlybyAimpoint,
    keys::{Arrival, ArriveKeys, LegKeys, LegValues},
};
use crate::{
    kind::FileKind,
    reading::{self, At, InFile, quantities::ALLOWED_LENGTH},
};

/// A leg file.
pub type LegFile = InFile<LegValues>;

impl LegFile {
    /// Reads a leg.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, Refusal> {
        reading::read(FileKind::Leg, file, judge)
    }

    /// Aimpoint of the encounter.
    pub fn aimpoint(&self) -> At<FlybyAimpoint> {
        // Without one no file is read.
        self.arrive.aimpoint().unwrap_or(self.arrive.at.with(FlybyAimpoint::Plane { b_t_m: 0.0, b_r_m: 0.0 }))
    }
}

impl Arrival {
    fn aimpoint(&self) -> Option<At<FlybyAimpoint>> {
        FlybyAimpoint::new([&self.b_t_m, &self.b_r_m], &self.altitude_m, &self.angle_rad)
    }

    /// Whole revolutions about the Sun with their branch, where there are any.
    pub fn revolutions(&self) -> Option<(u32, ArcBranch)> {
        Some((self.revolutions.it, self.branch?))
    }
}

/// Reports an aimpoint and revolutions that are incomplete.
fn judge(keys: &LegKeys, leg: &LegValues, root: &Place<'_>) {
    let at = root.key("arrive");
    let ArriveKeys { altitude, angle, bT, bR, .. } = &keys.arrive;
    if leg.arrive.aimpoint().is_none() {
        let written = [
            ("altitude", altitude.is_some()),
            ("angle", angle.is_some()),
            ("bT", bT.is_some()),
            ("bR", bR.is_some()),
        ];
        let found: Vec<&str> =
            written.iter().filter(|(_, is_written)| *is_written).map(|(key, _)| *key).collect();
        let found = if found.is_empty() { "no aim".to_owned() } else { found.join(", ") };
        at.report(found, "altitude and angle, or bT and bR");
    }
    let above = at.key("altitude");
    if let (Some(altitude), Some(altitude_m)) = (altitude, &leg.arrive.altitude_m)
        && altitude_m.it <= 0.0
        && !above.has_reported()
    {
        let found = format_args!("{}, inside the planet", altitude.it);
        above.report(found, format_args!("an altitude above 0: {ALLOWED_LENGTH}"));
    }
    match (leg.arrive.revolutions.it, leg.arrive.branch) {
        (0, Some(_)) if !at.key("revolutions").has_reported() => {
            at.key("branch").report("it without revolutions", "revolutions = 1 or more, or no branch");
        }
        (1.., None) => {
            at.report_lack("branch", "branch = \"left\" or \"right\", of two arcs that go around so often");
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests;
