//! Reads what is commanded, measured and known of positions at the time of a sample.

use fmi_export::{Failure, InputsOverTime, Real, RealVector};
use nalgebra::Vector3;
use physics::attitude::Attitude;
use physics::bodies::Body;
use physics::environment::CartesianState;
use physics::environment::coarse_ephemeris::CoarseEphemeris;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::onboard::OnboardTarget;
use physics::guidance::EphemerisAtTime;
use physics::guidance::modes::body_positions::BodyPositions;
use physics::guidance::modes::transitions::Sensed;
use physics::guidance::pointing::command::{
    AimpointCommand, AimpointOption, BodyRollCommand, BoresightCommand, ExternalRollCommand, LimbCommand,
    PointingCommand, ScanCommand,
};

use super::Fixed;
use crate::common::ephemeris;
use crate::guidance::setup::Read;
use crate::guidance::variables::choices::EphemerisSource;
use crate::guidance::variables::commands::AimpointVariables;

/// The start value of `estimate.q`.
const NOT_CONNECTED: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// Reads variables at the time of a sample.
#[derive(Clone, Copy)]
pub(crate) struct Reader<'a> {
    read: Read<'a>,
    inputs: InputsOverTime<'a>,
    time_s: f64,
}

impl<'a> Reader<'a> {
    /// At `time_s`, where `inputs` moved since they were set.
    pub(crate) fn new(read: Read<'a>, inputs: InputsOverTime<'a>, time_s: f64) -> Self {
        Self { read, inputs, time_s }
    }

    fn real(&self, handle: Real) -> f64 {
        self.inputs.real(self.read.values, handle, self.time_s)
    }

    pub(crate) fn vector(&self, handle: RealVector<3>) -> Vector3<f64> {
        Vector3::from(self.inputs.vector(self.read.values, handle, self.time_s))
    }

    /// How a vector of inputs moves now, by their derivatives.
    fn rate(&self, handle: RealVector<3>) -> Vector3<f64> {
        Vector3::from([0, 1, 2].map(|i| self.inputs.rate(handle.element(i), self.time_s)))
    }

    /// Pointing command of the inputs.
    pub(crate) fn command(&self) -> PointingCommand {
        let v = self.read.variables;
        let (boresight, body_roll, external_roll) = (&v.boresight, &v.body_roll, &v.external_roll);
        let (limb, scan) = (&v.limb, &v.scan);
        PointingCommand {
            scenario: self.read.choice(v.pointing_scenario).0,
            boresight: BoresightCommand {
                option: self.read.choice(boresight.option).0,
                vector: self.vector(boresight.vector),
                azimuth_rad: self.real(boresight.azimuth),
                elevation_rad: self.real(boresight.elevation),
                angle_rad: self.real(boresight.angle),
                instrument: self.read.count(boresight.instrument),
            },
            aimpoint: self.aimpoint(&v.aimpoint),
            second_aimpoint: self.aimpoint(&v.second_aimpoint),
            body_roll: BodyRollCommand {
                option: self.read.choice(body_roll.option).0,
                vector: self.vector(body_roll.vector),
                azimuth_rad: self.real(body_roll.azimuth),
                elevation_rad: self.real(body_roll.elevation),
            },
            external_roll: ExternalRollCommand {
                option: self.read.choice(external_roll.option).0,
                vector: self.vector(external_roll.vector),
                right_ascension_rad: self.real(external_roll.right_ascension),
                declination_rad: self.real(external_roll.declination),
            },
            limb: LimbCommand {
                azimuth_rad: self.real(limb.azimuth),
                reference: self.read.choice(limb.reference).0,
                height_m: self.real(limb.height),
                height_rate_m_s: self.real(limb.height_rate),
            },
            scan: ScanCommand {
                frame: self.read.choice(scan.frame).0,
                reference: self.read.choice(scan.reference).0,
                rate_rad_s: self.vector(scan.rate).into(),
                speed_m_s: self.vector(scan.speed).into(),
                duration_s: self.vector(scan.duration).into(),
                pause_s: self.vector(scan.pause).into(),
                segments: [scan.segments_x, scan.segments_y, scan.segments_z].map(|it| self.read.count(it)),
                reverse: [scan.reverse_x, scan.reverse_y, scan.reverse_z].map(|it| self.read.boolean(it)),
            },
        }
    }

    /// Positions at `epoch_s`, by every model that a mode may use.
    pub(crate) fn positions(
        &self,
        fixed: &Fixed,
        command: &PointingCommand,
        (ephemeris, coarse): (&mut Ephemeris, &mut CoarseEphemeris),
        epoch_s: f64,
    ) -> BodyPositions {
        let (v, bodies, center) = (self.read.variables, &fixed.bodies, fixed.bodies.center);
        let carried = self.read.setup.ephemeris.as_deref();
        let precise = ephemeris::precise(self.read.setup.ephemeris.as_ref());
        let given = self.state(v.position, v.velocity);
        let is_onboard = fixed.source == EphemerisSource::Chebyshev;
        let coarse = if is_onboard || fixed.source == EphemerisSource::Coarse {
            let mut body = |body| coarse.from_center(carried, body, bodies, epoch_s);
            let sun_and_earth = (body(Body::Sun), body(Body::Earth));
            let spacecraft = carried.and_then(|it| it.coarse_spacecraft(center, epoch_s)).unwrap_or(given);
            let ephemeris_at_time =
                EphemerisAtTime::new(epoch_s, fixed.planet, &spacecraft, &sun_and_earth.0, &sun_and_earth.1);
            connected(ephemeris_at_time, command, center, body)
        } else {
            None
        };
        if fixed.source == EphemerisSource::Coarse {
            return BodyPositions::in_every_mode(coarse);
        }
        let onboard = |target: OnboardTarget| precise.and_then(|it| it.state(target, center, epoch_s));
        let (sun_and_earth, spacecraft) = match precise.filter(|_| is_onboard) {
            Some(carried) => (
                onboard(OnboardTarget::Sun).zip(onboard(OnboardTarget::Earth)),
                match carried.span(OnboardTarget::Spacecraft, center) {
                    Some(_) => onboard(OnboardTarget::Spacecraft),
                    None => Some(given),
                },
            ),
            None if fixed.source == EphemerisSource::Inputs => {
                let sun = self.state(v.sun.position, v.sun.velocity);
                (Some((sun, self.state(v.earth.position, v.earth.velocity))), Some(given))
            }
            None => (Some(bodies.sun_and_earth(ephemeris, epoch_s)), Some(given)),
        };
        let precise = sun_and_earth.zip(spacecraft).and_then(|((sun, earth), spacecraft)| {
            let ephemeris_at_time = EphemerisAtTime::new(epoch_s, fixed.planet, &spacecraft, &sun, &earth);
            let own = |body: Body| onboard(body.into()).filter(|_| is_onboard);
            connected(ephemeris_at_time, command, center, |body| {
                own(body).unwrap_or_else(|| bodies.body(body, ephemeris, epoch_s))
            })
        });
        BodyPositions { precise, coarse, by_mode: is_onboard }
    }

    fn state(&self, position: RealVector<3>, velocity: RealVector<3>) -> CartesianState {
        CartesianState { position_m: self.vector(position), velocity_m_s: self.vector(velocity) }
    }

    /// Whether estimate.q is connected.
    pub(crate) fn has_estimate(&self) -> bool {
        let v = self.read.variables;
        let q = self.inputs.vector(self.read.values, v.estimate.q, self.time_s);
        let given = self.read.given(&[v.estimate.q.into(), v.estimate.valid.into()]);
        q != [0.0; 4] && (q != NOT_CONNECTED || given.has(v.estimate.q))
    }

    /// Mode request, estimate and Sun sensors, and whether there is an estimate to be judged. Where it is not connected, or
    /// nothing is placed yet, the attitude commanded now stands in for it.
    pub(crate) fn sensed(&self, commanded: Attitude, is_placed: bool) -> Result<(Sensed, bool), Failure> {
        let v = self.read.variables;
        let q = self.inputs.vector(self.read.values, v.estimate.q, self.time_s);
        let valid = self.read.boolean(v.estimate.valid);
        let is_estimated = is_placed && (self.has_estimate() || !valid);
        let estimate = if !is_estimated {
            Some(commanded)
        } else if valid {
            let attitude = Attitude::along_quaternion(q);
            Some(attitude.map_err(|error| Failure::new(format!("estimate.q: {error}")))?)
        } else {
            None
        };
        let sensed = Sensed {
            time_s: self.time_s,
            request: self.read.choice(v.mode.request).mode(),
            is_of_timeline: false,
            estimate,
            sun_body: self.read.boolean(v.sun.sensed_valid).then(|| self.vector(v.sun.sensed)),
        };
        Ok((sensed, is_estimated))
    }

    fn aimpoint(&self, aimpoint: &AimpointVariables) -> AimpointCommand {
        AimpointCommand {
            option: self.read.choice(aimpoint.option).0,
            vector: self.vector(aimpoint.vector),
            position_m: self.vector(aimpoint.position),
            velocity_m_s: self.rate(aimpoint.position),
            right_ascension_rad: self.real(aimpoint.right_ascension),
            declination_rad: self.real(aimpoint.declination),
            latitude_rad: self.real(aimpoint.latitude),
            longitude_rad: self.real(aimpoint.longitude),
            height_m: self.real(aimpoint.height),
            azimuth_rad: self.real(aimpoint.azimuth),
            elevation_rad: self.real(aimpoint.elevation),
            body: self.read.choice(aimpoint.body).0,
        }
    }
}

/// The ephemeris with the bodies that a command points at; `None` while position, Sun or Earth is not connected.
fn connected(
    mut ephemeris_at_time: EphemerisAtTime,
    command: &PointingCommand,
    center: Body,
    mut place: impl FnMut(Body) -> CartesianState,
) -> Option<EphemerisAtTime> {
    let aimpoints = [&command.aimpoint, &command.second_aimpoint].into_iter();
    let bodies = aimpoints.filter(|it| it.option == Some(AimpointOption::Body)).filter_map(|it| it.body);
    for body in bodies {
        ephemeris_at_time.place_body(body, &place(body));
    }
    ephemeris_at_time.is_connected(center).then_some(ephemeris_at_time)
}
