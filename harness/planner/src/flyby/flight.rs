//! Force model of a flight between planets, and its recorded path from row to row.

use nalgebra::Vector3;
use physics::{
    bodies::{Body, BodyData},
    environment::{
        CartesianState,
        ephemeris::Ephemeris,
        orbit::{Attractor, BodyEphemeris, GravityModel, NBodyGravity, NBodySettings},
    },
};

use crate::momentum::{
    plant::StartValues,
    simulated::{FlightRow, Motion, SimulatedFlight},
};

/// Planets that can attract beside the Sun.
const PLANETS: [Body; 5] = [Body::Mercury, Body::Venus, Body::Earth, Body::Mars, Body::Jupiter];
/// How paths are propagated here: steps in s, and the last term of their position, in m.
const CELL_S: f64 = 86_400.0;
const TOLERANCE_M: f64 = 1e-3;

/// Bodies that attract a spacecraft between planets, and the planet of its encounter.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceModel {
    /// The planet of the encounter.
    pub body: Body,
    /// Its gravitational parameter, in m3/s2.
    pub gm_m3_s2: f64,
    /// Planets that attract, that of the encounter among them.
    pub attracting: Vec<Body>,
    /// Whether the Moon attracts.
    pub moon: bool,
    /// Whether the Sun's relativity acts.
    pub relativity: bool,
    /// Difference between s past J2000 TDB and the time of the flight.
    pub epoch_minus_time_s: f64,
    /// How long before closest approach the hyperbola osculates that B is of, in s.
    pub lead_s: f64,
}

impl ForceModel {
    /// By the values of a MomentumPlant at the start of a flight, which begins at `start_s`.
    ///
    /// # Errors
    /// No nBody, no encounter, or one with a body that no ephemeris here places.
    pub fn new(values: &StartValues<'_>, start_s: f64) -> Result<Self, String> {
        let dynamics = values.item("orbit.dynamics").unwrap_or("none");
        if dynamics != "nBody" {
            return Err(format!(
                "orbit.dynamics: found {dynamics}, allowed: nBody, of a flight to an encounter"
            ));
        }
        let named = |name: &str| {
            PLANETS.into_iter().find(|body| values.item(name).is_some_and(|it| is_called(*body, it)))
        };
        let body = named("encounter.body").ok_or_else(|| {
            let found = values.item("encounter.body").unwrap_or("none");
            format!(
                "encounter.body: found {found}, allowed: {}",
                PLANETS.map(|body| body.data().name).join(", ")
            )
        })?;
        let center = named("orbit.center");
        let attracts = |body: &Body| {
            let name = format!("orbit.attraction.{}", body.data().name.to_lowercase());
            values.is_true(&name) || Some(*body) == center
        };
        // The encounter attracts where it is switched off among the planets too.
        let attracting = PLANETS.into_iter().filter(|it| *it == body || attracts(it)).collect();
        Ok(Self {
            body,
            gm_m3_s2: values.real("planet.gravitationalParameter"),
            attracting,
            moon: values.is_true("orbit.attraction.moon"),
            relativity: values.is_true("orbit.relativity"),
            epoch_minus_time_s: values.real("start.epoch") - start_s,
            lead_s: values.real("encounter.leadTime"),
        })
    }

    /// Gravity of all of it, positions counting from `center`.
    pub(super) fn gravity(&self, center: Body) -> NBodyGravity {
        let settings = NBodySettings { changes_center: true, cell_s: CELL_S, tolerance_m: TOLERANCE_M };
        let data = |body: Body| match body == self.body {
            true => BodyData { gm_m3_s2: self.gm_m3_s2, ..*body.data() },
            false => *body.data(),
        };
        let bodies = [Body::Sun].into_iter().chain(self.attracting.iter().copied()).chain([center]);
        let rows = bodies.map(|body| Attractor::point_mass(&data(body)));
        let rows = rows.chain(self.moon.then_some(Attractor::MOON));
        NBodyGravity::new(settings, GravityModel::new(center, rows, self.relativity))
    }

    /// Returns the positions of the planets by VSOP87.
    pub(super) fn planets(&self) -> Planets {
        Planets { ephemeris: Ephemeris::default(), epoch_minus_time_s: self.epoch_minus_time_s }
    }
}

/// Whether an option's item names a body.
fn is_called(body: Body, item: &str) -> bool {
    body.data().name.eq_ignore_ascii_case(item)
}

/// The planets of VSOP87 by the clock of a flight.
pub(super) struct Planets {
    ephemeris: Ephemeris,
    epoch_minus_time_s: f64,
}

impl BodyEphemeris for Planets {
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState {
        self.ephemeris.state(body, at_s + self.epoch_minus_time_s)
    }

    fn smooth_until_s(&self, at_s: f64) -> f64 {
        Ephemeris::smooth_until_s(at_s + self.epoch_minus_time_s) - self.epoch_minus_time_s
    }

    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64> {
        self.ephemeris.moon_from_earth(at_s + self.epoch_minus_time_s).position_m
    }
}

/// A row with its motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathRow<'a> {
    pub row: &'a FlightRow,
    pub motion: &'a Motion,
}

/// The recorded path of a flight.
#[derive(Clone, Debug)]
pub(super) struct Path<'a> {
    pub rows: Vec<PathRow<'a>>,
}

impl<'a> Path<'a> {
    /// # Errors
    /// Fewer than two rows, or rows without motion.
    pub(super) fn new(flight: &'a SimulatedFlight) -> Result<Self, String> {
        let with_motion = |row: &'a FlightRow| Some(PathRow { row, motion: row.motion.as_ref()? });
        let rows: Option<Vec<_>> = flight.rows.iter().map(with_motion).collect();
        let rows = rows.filter(|rows| rows.len() > 1);
        let rows =
            rows.ok_or("the flight: found no motion, allowed: two rows with velocity, encounter and mass")?;
        Ok(Self { rows })
    }

    /// The span of its rows, in s.
    pub(super) fn span_s(&self) -> [f64; 2] {
        let time_s = |row: Option<&PathRow<'_>>| row.map_or(f64::NAN, |it| it.row.time_s);
        [time_s(self.rows.first()), time_s(self.rows.last())]
    }

    /// The last row at or before a time; the first one before all.
    pub(super) fn index_before(&self, time_s: f64) -> usize {
        self.rows.partition_point(|it| it.row.time_s <= time_s).saturating_sub(1)
    }

    /// The row nearest to a time.
    pub(super) fn nearest(&self, time_s: f64) -> PathRow<'a> {
        let before = self.index_before(time_s);
        let after = (before + 1).min(self.rows.len() - 1);
        let off_s = |index: usize| (self.rows[index].row.time_s - time_s).abs();
        self.rows[if off_s(after) < off_s(before) { after } else { before }]
    }

    /// Motion at a time, beyond the rows as the first or the last two continue.
    pub(super) fn at(&self, time_s: f64) -> Motion {
        let before = self.index_before(time_s).min(self.rows.len() - 2);
        let [from, to] = [self.rows[before], self.rows[before + 1]];
        let span_s = to.row.time_s - from.row.time_s;
        from.motion.toward(to.motion, (time_s - from.row.time_s) / span_s, span_s)
    }
}

/// The planets of VSOP87, that of the encounter where the flight reports it.
pub(super) struct Recorded<'a> {
    pub path: &'a Path<'a>,
    pub body: Body,
    pub planets: Planets,
}

impl BodyEphemeris for Recorded<'_> {
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState {
        if body == self.body {
            self.path.at(at_s).body_from_sun
        } else {
            self.planets.heliocentric(body, at_s)
        }
    }

    fn smooth_until_s(&self, at_s: f64) -> f64 {
        self.planets.smooth_until_s(at_s)
    }

    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64> {
        self.planets.moon_from_earth_m(at_s)
    }
}
