//! State of the model between steps.

use fmi_export::{Failure, InputsOverTime};
use nalgebra::Vector3;
use physics::environment::coarse_ephemeris::CoarseEphemeris;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::time;
use physics::guidance::burn::delta_v::BurnSettings;
use physics::guidance::downlink::sun_direction::SunRequest;
use physics::guidance::modes::body_positions::BodyPositions;
use physics::guidance::modes::sample_inputs::{GuidanceSettings, SampleInputs, TimedEntries};
use physics::guidance::modes::system::GuidanceState;
use physics::guidance::pointing::command::{PointingCommand, Scenario};
use physics::guidance::scenario::is_rolled_about_boresight;
use physics::guidance::timeline::{TimelineDump, TimelineEntry, begun};
use physics::management::{DumpRequests, SampledManager};
use serde::{Deserialize, Serialize};

use super::inputs::reader::Reader;
use super::inputs::{self, Fixed, management};
use super::setup::{Plan, Read};
use crate::common::downlink::roll_warning;
use crate::common::management::window_warning;

/// State of guidance between steps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    /// Modes, constraints, scans and the command in force.
    pub system: GuidanceState,
    /// Requests of dumps.
    pub dumps: DumpRequests,
    /// The time up to which events of the timeline have come, in s.
    pub events_until_s: f64,
    /// When the timeline's entry begins, on its clock, in s, whose burn the present or last one is; `None`: the parameters'.
    pub burn_entry: Option<f64>,
    /// The communication point reached, in s.
    pub time_s: f64,
    /// Epoch less time, in s.
    pub epoch_minus_time_s: f64,
    /// Whether the warning was given that places are not connected.
    pub warned_unconnected: bool,
    /// Whether the warning was given of a roll axis along the boresight.
    pub warned_roll: bool,
    /// Whether the windows of the orbit phase were checked.
    pub windows_are_checked: bool,
    /// Cache, not state: the same epoch gives the same bits.
    #[serde(skip)]
    pub ephemeris: Ephemeris,
    /// Cache likewise.
    #[serde(skip)]
    pub coarse: CoarseEphemeris,
    /// Cache of what parameters fix.
    #[serde(skip)]
    pub fixed: Option<Fixed>,
}

impl State {
    /// The current burn or the last one, where `parameters` are the parameters'.
    pub(super) fn burn_settings(&self, context: &Plan<'_>, parameters: &BurnSettings) -> BurnSettings {
        let timeline = context.setup.timeline.as_ref();
        let found = timeline.zip(self.burn_entry).and_then(|(timeline, at_s)| {
            let burn = timeline.entry_at(at_s)?.burn?;
            Some(burn.settings(parameters, timeline.clock_minus_time_s(self.epoch_minus_time_s)))
        });
        found.unwrap_or(*parameters)
    }

    /// The momentum that a dump of the timeline leaves, body frame, in N m s, where one has come since the last sample.
    fn scheduled_dump(&mut self, context: &Plan<'_>, time_s: f64) -> Option<Vector3<f64>> {
        let since_s = core::mem::replace(&mut self.events_until_s, time_s);
        let timeline = context.setup.timeline.as_ref()?;
        let (clock_minus_time_s, events) =
            (timeline.clock_minus_time_s(self.epoch_minus_time_s), &timeline.events);
        let [before, now] =
            [since_s, time_s].map(|it| begun(events, clock_minus_time_s, it, |event| event.at_s));
        events.get(before..now)?.iter().rev().find_map(|event| event.dump).map(|dump| match dump {
            TimelineDump::Requested => Vector3::zeros(),
            TimelineDump::To { momentum_body_n_m_s } => momentum_body_n_m_s,
        })
    }

    /// Takes the sample that is due; units of work that it took beside its own.
    pub(super) fn sample(
        &mut self,
        read: Read<'_>,
        fixed: &Fixed,
        settings: &GuidanceSettings<'_>,
        inputs: InputsOverTime<'_>,
    ) -> Result<u32, Failure> {
        let (context, v) = (read.context, read.variables);
        let time_s = self.system.next_sample_s;
        let epoch_s = time::epoch_at_s(time_s, self.epoch_minus_time_s);
        let reader = Reader::new(read, inputs, time_s);
        let entry = context.setup.timeline.as_ref().and_then(|timeline| {
            timeline.slot(time_s, timeline.clock_minus_time_s(self.epoch_minus_time_s)).entry
        });
        let mut settings = *settings;
        let given = reader.command();
        let mut requested_sun = match management::is_managed(read) {
            true => SunRequest::default(),
            false => v.downlink.request(read.values),
        };
        let mut command = given;
        if command.scenario == Some(Scenario::Burn) {
            self.burn_entry = None;
        }
        if let Some(entry) = entry {
            command = command.over(&entry.command);
            requested_sun = entry.downlink.under(requested_sun);
            let operational = &mut settings.modes.operational;
            operational.keep_in = entry.keep_in.applied(&settings.keep_in, operational.keep_in.is_some());
        }
        inputs::check_devices(&command, &settings)?;
        let begun_s = entry.map(|entry| entry.at_s);
        let names_a_scenario = entry.is_some_and(|entry| entry.command.scenario.is_some());
        let mut entries = TimedEntries {
            scan: begun_s.filter(|_| given.scan.frame.is_none()),
            scenario: begun_s.filter(|_| given.scenario.is_none() && names_a_scenario),
            mode: begun_s.filter(|_| read.choice(v.mode.request).mode().is_none()),
            burn_is_over: false,
        };
        if entries.scenario.is_some() && command.scenario == Some(Scenario::Burn) {
            self.burn_entry = begun_s.filter(|_| entry.is_some_and(|entry| entry.burn.is_some()));
        }
        entries.burn_is_over = self.burn_entry.is_some() && self.burn_entry != begun_s;
        settings.burn = self.burn_settings(context, &fixed.burn);
        let command = self.system.continued(&command);
        let positions = reader.positions(fixed, &command, (&mut self.ephemeris, &mut self.coarse), epoch_s);
        self.warn(context, &command, &settings, (&positions, entry));
        let commanded = self.system.command.attitude_at(time_s);
        let (mut sensed, is_estimated) = reader.sensed(commanded, positions.are_known())?;
        if !is_estimated {
            settings.modes.monitor = None;
            settings.modes.ephemeris_check = None;
        }
        sensed.request = sensed.request.or(entry.and_then(|entry| entry.mode));
        sensed.is_of_timeline = entries.mode.is_some();
        let delta_v_body_m_s = reader.vector(v.accelerometer_delta_v);
        let momentum_body_n_m_s = reader.vector(v.momentum.body);
        let scheduled = self.scheduled_dump(context, time_s);
        self.dumps.sample(&management::policy(read), &momentum_body_n_m_s, scheduled);
        let keep_in = settings.modes.operational.keep_in.unwrap_or(settings.keep_in);
        let manager = management::manager(read, fixed, &keep_in)?;
        let manager = SampledManager { momentum_body_n_m_s, ..manager };
        self.check_windows(context, &command, &settings, &positions);
        let sun_is_placed = entry.is_some_and(|entry| entry.downlink.sun.is_some());
        let inputs = SampleInputs {
            command,
            requested_sun,
            sun_is_placed,
            is_commanded: given.scenario.is_some(),
            entries,
            positions,
            sensed,
            delta_v_body_m_s,
        };
        let is_chosen = self.system.sample(&settings, &inputs, |start| manager.choose(start));
        Ok(if is_chosen { manager.work(settings.orbit_phase.science.unloads()) } else { 0 })
    }

    /// Warns, once each, of positions that are not connected and of a roll axis along the boresight.
    fn warn(
        &mut self,
        context: &Plan<'_>,
        command: &PointingCommand,
        settings: &GuidanceSettings<'_>,
        (positions, entry): (&BodyPositions, Option<&TimelineEntry>),
    ) {
        if !positions.are_known() && !self.warned_unconnected {
            self.warned_unconnected = true;
            context.log.warning(
                "position, or with ephemeris.source inputs sun.position or earth.position, is all zero and counts as not \
                 connected yet: the last command stays until then",
            );
        }
        if !self.warned_roll && is_rolled_about_boresight(command, &settings.hardware) {
            self.warned_roll = true;
            let by = match entry {
                Some(entry) => format!("the command in line {} of the timeline", entry.line),
                None => "the command".to_owned(),
            };
            context.log.warning(&roll_warning(&by));
        }
    }

    /// Warns, once, of windows of the orbit phase that give no cycle.
    fn check_windows(
        &mut self,
        context: &Plan<'_>,
        command: &PointingCommand,
        settings: &GuidanceSettings<'_>,
        positions: &BodyPositions,
    ) {
        if command.scenario == Some(Scenario::OrbitPhase)
            && !self.windows_are_checked
            && let Some(windows) = self.system.windows(&settings.orbit_phase, positions)
        {
            self.windows_are_checked = true;
            if let Some(warning) = window_warning(&windows) {
                context.log.warning(&warning);
            }
        }
    }
}
