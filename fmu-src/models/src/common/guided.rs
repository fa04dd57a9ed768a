//! Variables of guided flight, and their start values by a spacecraft's file.

use fmi_export::{Boolean, Choice, Context, Elements, Failure, Integer, Model, Real, Values, Variables};
use physics::attitude::SunAngles;
use physics::bodies::Body;
use physics::environment::orbit;
use physics::guidance::constraints::keep_in::KeepIn;
use physics::guidance::downlink::sun_direction::SunRequest;
use physics::guidance::pointing::boresight::Gimbal;
use physics::guidance::{self, Guided, Schedule};
use physics::spacecraft::{Spacecraft, TimeAfterPeriapsis};

use super::center::CenterBody;
use super::choices::{DownlinkReference, GuidedPhase, ScienceRule};
use super::pointing::{AttitudeDefaults, NamedAttitudeVariables, RuleContext};
use super::value_reader::ValueReader;

/// Reason why no instrument turns.
pub(crate) const NO_GIMBAL: &str = "no instrument of the spacecraft has a gimbal ([[instruments]] gimbal)";

/// Latest begin and end of a downlink, in s.
const LATEST_WINDOW_S: f64 = 1e9;

/// Start values of guided flight by a spacecraft's file; without windows in it there is no downlink.
#[derive(Clone, Copy, Debug, Default)]
pub struct GuidedDefaults {
    /// Begin after periapsis, in s.
    pub start_s: f64,
    /// End after periapsis, in s.
    pub end_s: f64,
    /// A downlink after every how many periapses.
    pub every: i32,
    /// Begin and end as fractions of the period, where the file gives them so.
    pub period_shares: [Option<f64>; 2],
    /// Whether the spacecraft has antennas, and its file has it about the Sun.
    pub antennas_and_cruise: [bool; 2],
    /// How it stands while it observes.
    pub attitude: AttitudeDefaults,
}

impl GuidedDefaults {
    /// The start values by a file; fractions of the period become times in the orbit about `center` with its start values.
    pub fn new(spacecraft: &Spacecraft, center: &CenterBody) -> Self {
        let antennas_and_cruise = [!spacecraft.antennas.is_empty(), center.data.body == Body::Sun];
        let attitude = AttitudeDefaults::new(spacecraft);
        let Some(windows) = &spacecraft.downlinks else {
            return Self { antennas_and_cruise, attitude, ..Self::default() };
        };
        let axis_m = center.elements().semi_major_axis_m;
        let period_s = orbit::period_s(center.data.gm_m3_s2, axis_m);
        let times = [windows.start, windows.stop];
        let [start_s, end_s] = times.map(|time| time.in_orbit_s(period_s).min(LATEST_WINDOW_S));
        Self {
            start_s,
            end_s,
            every: i32::try_from(windows.every).unwrap_or(i32::MAX),
            period_shares: times.map(TimeAfterPeriapsis::period_share),
            antennas_and_cruise,
            attitude,
        }
    }

    /// The phase about a body.
    pub fn phase(&self, is_about_sun: bool) -> GuidedPhase {
        let [has_antennas, _] = self.antennas_and_cruise;
        if has_antennas && is_about_sun && self.attitude.pointing.is_none() {
            GuidedPhase::Cruise
        } else {
            GuidedPhase::Orbit
        }
    }
}

/// Science and downlink in turn.
#[derive(Variables)]
#[variables(setup = GuidedDefaults)]
pub struct GuidedVariables {
    /// What guided flight does: science and downlink in turn, or downlink throughout. By default cruise about the Sun where the file
    /// has antennas and no [pointing].
    #[parameter(start = setup.phase(setup.antennas_and_cruise[1]))]
    pub phase: Choice<GuidedPhase>,
    /// How the spacecraft stands while it observes. By default as [pointing] in its file says; without that nadir, or about a planet
    /// yawSteering where the file has no keep-in zone and all panels turn about one axis more than 5 deg off X and off Z. lvlh to
    /// aligned keep the Sun in the zone of keepIn.enabled, as commands do. The rate is the derivative of the attitude by the gravity
    /// of the flight (in Guidance by that of the planet's point mass), without other forces.
    #[parameter(start = setup.attitude.rule(setup.antennas_and_cruise[1]))]
    pub science_rule: Choice<ScienceRule>,
    #[group(name = "", setup = &setup.attitude)]
    pub named: NamedAttitudeVariables,
    /// Whether science off-points to unload momentum by sunlight (paper 001, MDIS pointing): the Sun's place in the keep-in zone is
    /// chosen where science begins, or the flight or the scenario in it, for the momentum target of momentum.strategy at its end, and
    /// held until the next downlink. The body turns about the Sun line until nadir lies in the plane that the instrument on the
    /// gimbal sweeps, which is turned back to it; beyond its range (here the file's, in Guidance gimbal.minimum to gimbal.maximum) the
    /// nearest bound comes nearest to nadir. guided.scienceRule does not count then. Without a downlink to come, or a place, the Sun stands on -Y.
    /// Predictive targets are forecast with it there through coming science; with momentum.convention = inertial science aims at
    /// momentum.target. Needs a momentum.strategy other than dumpsOnly, and an instrument with a gimbal.
    #[parameter(start = false)]
    pub science_unload: Boolean,
    /// Sun elevation per (Sun-nadir angle - 90 deg) under the scaled rule; 0.25 is fitted to paper 000's Table 2.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = 0.25)]
    pub science_gain: Real,
    /// Begin of downlink after periapsis, or after the start. By a file whose [downlinks] gives it as a share of the period the one
    /// of the present orbit counts unless this is set.
    #[parameter(unit = "s", display = "h", min = 0.0, max = LATEST_WINDOW_S, start = setup.start_s)]
    pub downlink_start: Real,
    /// End of downlink after periapsis, or after the start; likewise.
    #[parameter(unit = "s", display = "h", min = 0.0, max = LATEST_WINDOW_S, start = setup.end_s)]
    pub downlink_end: Real,
    /// A downlink after every how many periapses; 0 = never. With guided.downlinkReference = start there is one window all the same.
    #[parameter(min = 0, max = 1_000, start = setup.every)]
    pub downlink_every: Integer,
    /// From where downlinks are counted.
    #[parameter(start = DownlinkReference::Periapsis)]
    pub downlink_reference: Choice<DownlinkReference>,
    /// Greatest rate of the turn between science and downlink attitudes, and into each command of the timeline from where the body
    /// stands; 0 = at once, as in paper 000. A turn about one axis, or, where that would take the Sun out of the keep-in zone and
    /// both ends keep it inside, within the zone.
    #[parameter(unit = "rad/s", display = "deg/s", min = 0.0, max = 10.0, start = setup.attitude.slew_rate_rad_s())]
    pub slew_rate: Real,
}

impl GuidedVariables {
    /// The law with begin and end of its windows as fractions of the period, where the file gives them so and nobody set them.
    fn by_shares(&self, read: ValueReader<'_, impl Model>, defaults: &GuidedDefaults, law: Guided) -> Guided {
        let [start, end] = defaults.period_shares;
        if (start, end) == (None, None) {
            return law;
        }
        let given = read.given(&[self.downlink_start.into(), self.downlink_end.into()]);
        let period_shares = [
            start.filter(|_| !given.has(self.downlink_start)),
            end.filter(|_| !given.has(self.downlink_end)),
        ];
        let schedule = Schedule { period_shares, ..law.schedule };
        Guided { schedule: schedule.in_orbit(schedule.period_s), ..law }
    }

    /// The law by fractions of the period, in the phase and by the rule that act: where nobody gave them, those about the Sun or about a
    /// planet.
    ///
    /// # Errors
    /// A named attitude that the spacecraft does not have there.
    pub fn in_phase(
        &self,
        read: ValueReader<'_, impl Model>,
        defaults: &GuidedDefaults,
        law: Guided,
        about: &RuleContext<'_>,
    ) -> Result<Guided, Failure> {
        let law = self.by_shares(read, defaults, law);
        let throughout = self.phase(read, defaults.phase(about.is_about_sun)) == GuidedPhase::Cruise;
        let rule = self.rule(read, defaults.attitude.rule(about.is_about_sun));
        let named = if law.science.unloads() { None } else { self.named.read(read.values, rule, about)? };
        let schedule = Schedule { throughout, ..law.schedule };
        Ok(Guided { schedule, science: named.unwrap_or(law.science), ..law })
    }

    /// The rule that acts: the given one, else `own`.
    fn rule(&self, read: ValueReader<'_, impl Model>, own: ScienceRule) -> ScienceRule {
        let group = [self.science_rule.into(), self.science_gain.into(), self.slew_rate.into()];
        read.given(&group).choice_or(self.science_rule, own)
    }

    /// Writes phase and rule as they act.
    pub fn resolve_start<M: Model>(
        &self,
        context: &Context<'_, M>,
        values: &mut Values,
        defaults: &GuidedDefaults,
        is_about_sun: bool,
    ) {
        let read = ValueReader::new(context, values);
        let phase = self.phase(read, defaults.phase(is_about_sun));
        let rule = self.rule(read, defaults.attitude.rule(is_about_sun));
        values.set_choice(self.phase, phase);
        values.set_choice(self.science_rule, rule);
    }

    /// The phase that acts: the given one, else `own`.
    fn phase(&self, read: ValueReader<'_, impl Model>, own: GuidedPhase) -> GuidedPhase {
        let [start, end] = [self.downlink_start, self.downlink_end].map(Elements::from);
        let windows =
            [self.phase.into(), self.downlink_reference.into(), self.downlink_every.into(), start, end];
        read.given(&windows).choice_or(self.phase, own)
    }

    /// Refuses science that unloads without a strategy that chooses the Sun's place.
    ///
    /// # Errors
    /// Science that unloads while nothing manages the momentum.
    pub fn check_unload(&self, values: &Values, managed: bool) -> Result<(), Failure> {
        if values.boolean(self.science_unload) && !managed {
            return Err(Failure::new(
                "guided.scienceUnload: found true with momentum.strategy dumpsOnly, allowed: false, or reactive or predictive, which \
                 choose the Sun's place",
            ));
        }
        Ok(())
    }

    /// The guidance law of an orbit with this periapsis and period, in s, or of one window after the start, all in s past J2000
    /// TDB. Science pitches, and turns go, within the zone `keep_in`; the instrument on the `gimbal` keeps nadir where it unloads.
    ///
    /// # Errors
    /// A downlink that ends before it begins, science that unloads without a gimbal.
    pub fn read(
        &self,
        values: &Values,
        [periapsis_s, period_s, start_epoch_s]: [f64; 3],
        keep_in: KeepIn,
        gimbal: Option<Gimbal>,
    ) -> Result<Guided, Failure> {
        let [start_s, end_s] = [self.downlink_start, self.downlink_end].map(|time| values.real(time));
        let once = matches!(values.choice(self.downlink_reference), DownlinkReference::Start);
        if (values.integer(self.downlink_every) != 0 || once) && start_s > end_s {
            return Err(Failure::new(format!(
                "guided.downlinkStart, guided.downlinkEnd: found {start_s:?} s and {end_s:?} s, allowed: a start not \
                 after the end; guided.downlinkEvery = 0 for no downlink"
            )));
        }
        Ok(Guided {
            schedule: Schedule {
                periapsis_s: if once { start_epoch_s } else { periapsis_s },
                period_s: if once { f64::INFINITY } else { period_s },
                downlink_start_s: start_s,
                downlink_end_s: end_s,
                period_shares: [None; 2],
                every: values.integer(self.downlink_every).unsigned_abs(),
                once,
                throughout: false,
            },
            science: match values.choice(self.science_rule) {
                _ if values.boolean(self.science_unload) => {
                    let gimbal = gimbal.ok_or_else(|| {
                        Failure::new(format!("guided.scienceUnload: found true, allowed: false; {NO_GIMBAL}"))
                    })?;
                    guidance::ScienceRule::Unloading { sun: SunAngles::default(), gimbal }
                }
                ScienceRule::Scaled => guidance::ScienceRule::Scaled { gain: values.real(self.science_gain) },
                ScienceRule::FixedToSunLine => guidance::ScienceRule::PlanetOrbit,
                // Named attitudes are read with what they need ([`Self::in_phase`]).
                _ => guidance::ScienceRule::Nadir,
            },
            elevation_limit_rad: keep_in.elevation_rad,
            slew_rate_rad_s: values.real(self.slew_rate),
            keep_in: Some(keep_in),
            sun_direction: None,
            requested: SunRequest::default(),
            managed: false,
        })
    }
}
