//! A leg, from its file: what stands there, in SI, by the line that it stands in.

use std::path::{Path, PathBuf};

use model_description::quantity::is_beyond_turn;
use nalgebra::Vector3;
use physics::{environment::dates, toml::Place};

use crate::{
    kind::FileKind,
    leg::{
        aimpoint::FlybyAimpoint,
        description::{ArcBranch, ArriveDescription, LegDescription},
    },
    reading::{self, ALLOWED_LENGTH, At, Builder, Written},
    values::Instant,
};

const ALLOWED_SPEED: &str = "a number of m/s or one with a unit: \"38.2 km/s\"";
const ALLOWED_ANGLE: &str = "an angle from -360 to 360 deg with its unit: \"30 deg\"";
const MAX_REVOLUTIONS: u32 = 100;

/// A leg file.
#[derive(Clone, Debug)]
pub struct LegFile {
    /// The file.
    pub file: PathBuf,
    /// Its mission.
    pub mission: At<PathBuf>,
    /// Date of the departure, in s past J2000 TDB, and as it is written.
    pub depart: Option<At<(f64, String)>>,
    /// From the Sun, EME2000.
    pub position_m: At<Vector3<f64>>,
    /// Velocity before the departure, EME2000.
    pub velocity_before_m_s: Option<Vector3<f64>>,
    /// The planet's name in variables of the FMU.
    pub body: At<&'static str>,
    /// Date or time of the closest approach.
    pub arrive: At<Instant>,
    /// Aimpoint of the encounter.
    pub aimpoint: At<FlybyAimpoint>,
    /// With their branch where there are any.
    pub revolutions: At<Option<(u32, ArcBranch)>>,
}

impl LegFile {
    /// Reads a leg.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, String> {
        reading::read(FileKind::Leg, file, |builder, it: LegDescription| builder.leg(file, &it))
    }

    /// A problem at a place of the file.
    pub fn problem<T>(&self, at: &At<T>, what: &str) -> String {
        at.problem(&self.file, what)
    }

    /// An error of its mission, which stands in a file of its own with the start of the leg.
    pub fn in_mission(&self, error: &str, begun: &Path) -> String {
        let [begun, own] = [begun, &self.mission.it].map(|path| path.display().to_string());
        self.problem(&self.mission, &error.replace(&begun, &own))
    }
}

impl Builder<'_> {
    fn leg(&mut self, file: &Path, description: &LegDescription) -> LegFile {
        let root = self.root.clone();
        let [mission, depart, arrive] = ["mission", "depart", "arrive"].map(|key| root.key(key));
        let LegDescription { depart: from, arrive: to, .. } = description;
        let path = self.path(&mission, &description.mission, Path::is_file);
        let at = depart.key("at");
        let departure = from.at.as_ref().and_then(|written| self.date(&at, written));
        let position = depart.key("position");
        let position_m = self.vector(&position, &from.position, ("m", ALLOWED_LENGTH));
        let velocity = depart.key("velocity");
        let velocity_before_m_s =
            from.velocity.as_ref().map(|written| self.vector(&velocity, written, ("m/s", ALLOWED_SPEED)));
        let [body, arrive_at, revolutions] = ["body", "at", "revolutions"].map(|key| arrive.key(key));
        let arrival = self.instant(&arrive_at, &to.at).unwrap_or(Instant::Time(0.0));
        let (aimpoint_key, aimpoint) = self.aimpoint(&arrive, to);
        let turns = self.revolutions(&arrive, to);
        LegFile {
            file: file.to_owned(),
            mission: self.at(&mission, path),
            depart: departure.map(|date| self.at(&at, date)),
            position_m: self.at(&position, position_m),
            velocity_before_m_s,
            body: self.at(&body, to.body.word()),
            arrive: self.at(&arrive_at, arrival),
            aimpoint: self.at(&aimpoint_key, aimpoint),
            revolutions: self.at(&revolutions, turns),
        }
    }

    fn required(&mut self, place: &Place<'_>, written: &Written, (unit, allowed): (&str, &str)) -> f64 {
        self.read(place, Some(written), |written| written.quantity(unit), allowed).unwrap_or(0.0)
    }

    fn vector(
        &mut self,
        place: &Place<'_>,
        written: &Written,
        (unit, allowed): (&str, &str),
    ) -> Vector3<f64> {
        let vector = |written: &Written| {
            let Written::List(items) = written else { return None };
            let parts = items.iter().map(|item| item.quantity(unit)).collect::<Option<Vec<f64>>>()?;
            let vector = <[f64; 3]>::try_from(parts).ok().map(Vector3::from);
            vector.filter(|vector| vector.norm() > 0.0)
        };
        let allowed = format_args!("a list of three, not all 0, each {allowed}");
        self.read(place, Some(written), vector, allowed).unwrap_or_else(Vector3::x)
    }

    fn date(&mut self, place: &Place<'_>, written: &Written) -> Option<(f64, String)> {
        let date = |written: &Written| {
            let text = written.date()?;
            Some((dates::epoch_s(text).ok()?, text.to_owned()))
        };
        self.read(place, Some(written), date, dates::ALLOWED_DATE)
    }

    /// With the key that it stands in.
    fn aimpoint<'p>(&mut self, arrive: &Place<'p>, to: &ArriveDescription) -> (Place<'p>, FlybyAimpoint) {
        let [altitude, angle, b_t, b_r] = ["altitude", "angle", "bT", "bR"].map(|key| arrive.key(key));
        match (to.altitude.as_deref(), to.angle.as_deref(), to.b_t.as_deref(), to.b_r.as_deref()) {
            (Some(above), Some(toward), None, None) => {
                let altitude_m = self.required(&altitude, above, ("m", ALLOWED_LENGTH));
                if altitude_m <= 0.0 && !altitude.has_reported() {
                    let found = format!("{above}, inside the planet");
                    let allowed = format_args!("an altitude above 0: {ALLOWED_LENGTH}");
                    altitude.report(found, allowed);
                }
                let within = |written: &Written| written.angle_rad().filter(|it| !is_beyond_turn(*it));
                let angle_rad = self.read(&angle, Some(toward), within, ALLOWED_ANGLE).unwrap_or(0.0);
                (altitude, FlybyAimpoint::Altitude { altitude_m, angle_rad })
            }
            (None, None, Some(along_t), Some(along_r)) => {
                let b_t_m = self.required(&b_t, along_t, ("m", ALLOWED_LENGTH));
                let b_r_m = self.required(&b_r, along_r, ("m", ALLOWED_LENGTH));
                (b_t, FlybyAimpoint::Plane { b_t_m, b_r_m })
            }
            (above, toward, along_t, along_r) => {
                let keys = [("altitude", above), ("angle", toward), ("bT", along_t), ("bR", along_r)];
                let found: Vec<&str> =
                    keys.iter().filter(|(_, it)| it.is_some()).map(|(key, _)| *key).collect();
                let found = if found.is_empty() { "no aim".to_owned() } else { found.join(", ") };
                arrive.report(found, "altitude and angle, or bT and bR");
                (arrive.clone(), FlybyAimpoint::Plane { b_t_m: 0.0, b_r_m: 0.0 })
            }
        }
    }

    fn revolutions(&mut self, arrive: &Place<'_>, to: &ArriveDescription) -> Option<(u32, ArcBranch)> {
        let [key, branch] = ["revolutions", "branch"].map(|key| arrive.key(key));
        let number = |written: &Written| {
            let Written::Integer(number) = written else { return None };
            u32::try_from(*number).ok().filter(|it| *it <= MAX_REVOLUTIONS)
        };
        let allowed = format_args!("a whole number from 0 to {MAX_REVOLUTIONS}");
        let number = match to.revolutions.as_deref() {
            None => 0,
            written => self.read(&key, written, number, allowed)?,
        };
        match (number, to.branch) {
            (0, None) => None,
            (0, Some(_)) => {
                branch.report("it without revolutions", "revolutions = 1 or more, or no branch");
                None
            }
            (number, Some(branch)) => Some((number, branch)),
            (_, None) => {
                let allowed = "branch = \"left\" or \"right\", of two arcs that go around so often";
                arrive.report_lack("branch", allowed);
                None
            }
        }
    }
}

#[cfg(test)]
mod tests;
