//! A small rigid body, turned by a torque from outside and lit by a Sun that stands still: the other half of a loop with
//! `DisturbanceTorque`.

mod motion;

use fmi_export::{
    About, Context, Dependencies, Failure, Model, RealVector, SetupError, Step, StepEnd, Values, Variables,
    knowns,
};

use motion::{Attitude, Motion, to_body};

/// A rigid body.
pub struct RigidBody;

/// The variables of [`RigidBody`].
#[derive(Variables)]
#[allow(missing_docs, reason = "the groups document themselves")]
pub struct RigidBodyVariables {
    /// Principal moments of inertia.
    #[parameter(unit = "kg.m2", min = 1e-3, start = [300.0, 400.0, 500.0])]
    pub inertia: RealVector<3>,
    #[group]
    pub start: StartVariables,
    #[group]
    pub sun: BodyVariables,
    #[group]
    pub planet: PlanetVariables,
    #[group]
    pub torque: TorqueVariables,
    #[group]
    pub attitude: AttitudeVariables,
}

/// Initial conditions of the motion.
#[derive(Variables)]
pub struct StartVariables {
    /// Attitude at the start: quaternion from EME2000 to body, scalar last.
    #[parameter(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// Rate at the start, body axes.
    #[parameter(unit = "rad/s", display = "deg/s", start = [1e-4, 3e-4, 2e-4])]
    pub rate: RealVector<3>,
}

/// The Sun.
#[derive(Variables)]
pub struct BodyVariables {
    /// Position of the Sun from the body, EME2000.
    #[parameter(unit = "m", start = [1e10, -5.5e10, 5e9])]
    pub position: RealVector<3>,
    /// Position of the Sun from the body, body axes.
    #[output(unit = "m")]
    pub position_body: RealVector<3>,
}

/// The planet.
#[derive(Variables)]
pub struct PlanetVariables {
    /// Position of the planet from the body, EME2000.
    #[parameter(unit = "m", start = [2e6, 3e6, 9e6])]
    pub position: RealVector<3>,
    /// Position of the planet from the body, body axes.
    #[output(unit = "m")]
    pub position_body: RealVector<3>,
}

/// Torque on the body.
#[derive(Variables)]
pub struct TorqueVariables {
    /// Torque in body axes, held over a step.
    #[input(unit = "N.m", start = [0.0; 3])]
    pub total: RealVector<3>,
}

/// The motion.
#[derive(Variables)]
pub struct AttitudeVariables {
    /// Attitude: quaternion from EME2000 to body, scalar last.
    #[output(unit = "1")]
    pub q: RealVector<4>,
    /// Rate, body axes.
    #[output(unit = "rad/s")]
    pub rate: RealVector<3>,
}

impl Model for RigidBody {
    const NAME: &'static str = "RigidBody";
    const STATE_VERSION: u32 = 1;

    type Setup = ();
    type Variables = RigidBodyVariables;
    type State = Motion;

    fn parse_setup(_file: &str, _text: &str) -> Result<(), SetupError> {
        Ok(())
    }

    fn about(_setup: &()) -> About {
        About {
            description: "A small rigid body in the light of a Sun that stands still.".to_owned(),
            stop_time_s: 43_200.0,
            step_size_s: 10.0,
            tolerance: 1e-9,
            ..About::default()
        }
    }

    fn initialize(
        context: &Context<'_, Self>,
        values: &mut Values,
        start_time_s: f64,
    ) -> Result<Motion, Failure> {
        let v = context.variables;
        let q = values.vector(v.start.q);
        let norm = q.iter().map(|part| part * part).sum::<f64>().sqrt();
        if norm < 0.5 {
            return Err(Failure::new(format!("`start.q` has length {norm}, allowed: 1")));
        }
        let attitude = Attitude { q: q.map(|part| part / norm), rate_rad_s: values.vector(v.start.rate) };
        write(v, values, attitude);
        Ok(Motion::new(start_time_s, attitude, values.vector(v.torque.total)))
    }

    fn step(
        context: &Context<'_, Self>,
        values: &mut Values,
        state: &mut Motion,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        let v = context.variables;
        let inertia_kg_m2 = values.vector(v.inertia);
        state.set_torque(inertia_kg_m2, step.start_s, values.vector(v.torque.total));
        let attitude = state.advance(inertia_kg_m2, step.end_s);
        write(v, values, attitude);
        Ok(StepEnd::at(step.end_s))
    }

    fn dependencies(_setup: &(), v: &RigidBodyVariables) -> Dependencies {
        let mut table = Dependencies::new();
        table.output(v.attitude.q, knowns![], v.start.q);
        table.output(v.attitude.rate, knowns![], v.start.rate);
        table.output(v.sun.position_body, knowns![], knowns![v.start.q, v.sun.position]);
        table.output(v.planet.position_body, knowns![], knowns![v.start.q, v.planet.position]);
        table
    }
}

fn write(v: &RigidBodyVariables, values: &mut Values, attitude: Attitude) {
    values.set_vector(v.attitude.q, attitude.q);
    values.set_vector(v.attitude.rate, attitude.rate_rad_s);
    let (sun, planet) = (values.vector(v.sun.position), values.vector(v.planet.position));
    values.set_vector(v.sun.position_body, to_body(attitude.q, sun));
    values.set_vector(v.planet.position_body, to_body(attitude.q, planet));
}
