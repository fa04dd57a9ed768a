//! `DisturbanceTorque`: geometry in, force and torque of light, heat and gravity gradient by source out, without
//! memory, with exact partial derivatives; to embed in somebody else's dynamics.

mod dependencies;
mod inputs;
mod outputs;
mod setup;
mod state;
mod variables;

use std::sync::Arc;

use fmi_export::{
    About, DeferredOutputs, Dependencies, Differentiable, Extensions, Failure, Knowns, Manual, Model,
    OutputGroups, Real, SetupError, StartValue, Step, StepEnd, Values, knowns,
};
use physics::numerics::scalar::Dual64;
use physics::plant::{BySource, Parameters, Positions, TUNABLE_COUNT, Workspaces};
use serde::{Deserialize, Serialize};

use crate::common::start_values::of_spacecraft;
use inputs::Prepared;
use outputs::DisturbanceOutputs;
use setup::Plan;
pub use setup::{DisturbanceSetup, DisturbanceTorque};
use state::Materials;
use variables::DisturbanceVariables;

/// Inputs of the last step; the rest is cache.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct DisturbanceState {
    positions: Positions<f64>,
    /// Factor of force and torque of direct sunlight, a tunable parameter.
    solar_scale: f64,
    /// Tunable parameters of the laws.
    tunable: [f64; TUNABLE_COUNT],
    /// Materials of the surfaces.
    materials: Materials,
    /// Whether the warning was given which inputs are not set yet.
    has_warned_unset: bool,
    #[serde(skip)]
    prepared: Option<Arc<Prepared>>,
    #[serde(skip)]
    workspaces: Workspaces<f64>,
    /// Found in the last step, from which outputs are written.
    #[serde(skip)]
    found: Option<BySource<f64>>,
}

impl Model for DisturbanceTorque {
    const NAME: &'static str = "DisturbanceTorque";
    const STATE_VERSION: u32 = 5;
    const SETUP_FILE: Option<&'static str> = Some("spacecraft.toml");
    const DEFAULT_SETUP: &'static str = include_str!("../../../resources/messenger-thermal.toml");
    const REFERENCE_INPUTS: &'static str = include_str!("../../../resources/reference/DisturbanceTorque.csv");
    const MANUAL: Manual = crate::manuals::DISTURBANCE_TORQUE;
    const EXTENSIONS: Extensions<Self> = Extensions::none().differentiable().deferred_outputs();

    type Setup = DisturbanceSetup;
    type Variables = DisturbanceVariables;
    type State = DisturbanceState;

    fn parse_setup(file: &str, text: &str) -> Result<DisturbanceSetup, SetupError> {
        DisturbanceSetup::from_toml(file, text)
    }

    fn start_values(setup: &DisturbanceSetup) -> Vec<StartValue> {
        of_spacecraft(&setup.spacecraft, Self::NAME, None)
    }

    fn about(setup: &DisturbanceSetup) -> About {
        About {
            description: format!(
                "{}: force and torque of sunlight, reflected and infrared planet light, the spacecraft's own heat, air, \
                 magnetic field and gravity gradient, by source, from where Sun and planet are; with exact partial \
                 derivatives",
                setup.spacecraft.name
            ),
            start_time_s: 0.0,
            stop_time_s: 43_200.0,
            step_size_s: 60.0,
            tolerance: 1e-4,
            ..crate::common::about()
        }
    }

    fn dependencies(setup: &DisturbanceSetup, variables: &DisturbanceVariables) -> Dependencies {
        dependencies::table(setup, variables)
    }

    fn initialize(
        context: &Plan<'_>,
        values: &mut Values,
        start_time_s: f64,
    ) -> Result<DisturbanceState, Failure> {
        inputs::check_effects(context, values)?;
        let prepared = Arc::new(Prepared::new(context, values)?);
        let mut state = DisturbanceState {
            positions: prepared.inputs.map(|input| values.real(*input)),
            solar_scale: prepared.parameters.solar_scale,
            tunable: context.variables.laws.tunable().map(|it| values.real(it)),
            materials: Materials::of_file(&context.setup.optics),
            has_warned_unset: false,
            prepared: Some(prepared.clone()),
            workspaces: Workspaces::default(),
            found: None,
        };
        state.materials.read(context, values)?;
        update(&mut state, &prepared)?;
        Self::write_outputs(context, values, &mut state, OutputGroups::ALL, start_time_s)?;
        Ok(state)
    }

    fn step(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut DisturbanceState,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        let known = state.prepared.take();
        if known.is_none() || step.parameters_changed {
            state.solar_scale = values.real(context.variables.solar.scale);
            state.tunable = context.variables.laws.tunable().map(|it| values.real(it));
            state.materials.read(context, values)?;
        }
        let prepared = known.map_or_else(|| Prepared::new(context, values).map(Arc::new), Ok)?;
        state.positions.update(&prepared.inputs, |position, input| {
            *position = step.inputs.real(values, *input, step.end_s);
        });
        if !state.has_warned_unset {
            let unset = prepared.unset(&state.positions);
            state.has_warned_unset = !unset.is_empty();
            if state.has_warned_unset {
                context.log.warning(&format!(
                    "inputs that are all zero count as not set yet: {}; without a Sun nothing acts, without a planet none of its light \
                     and gravity does (planet.present = false: there is none)",
                    unset.join(", ")
                ));
            }
        }
        let outcome = update(state, &prepared);
        state.prepared = Some(prepared);
        outcome.map(|()| StepEnd::at(step.end_s))
    }

    fn check_state(setup: &DisturbanceSetup, state: &DisturbanceState) -> Result<(), Failure> {
        let (found, allowed) = (state.positions.panel_angles_rad.len(), setup.spacecraft.panels.len());
        if found != allowed {
            return Err(Failure::new(format!(
                "the saved state has {found} panel angles, allowed: {allowed}"
            )));
        }
        state.materials.check(&setup.optics)
    }
}

impl Differentiable for DisturbanceTorque {
    fn jacobian_vector_product(
        context: &Plan<'_>,
        values: &Values,
        state: &DisturbanceState,
        unknowns: &[Real],
        seeds: &[(Real, f64)],
        products: &mut [f64],
    ) -> Result<(), Failure> {
        let variables = context.variables;
        if seeds.iter().any(|(at, _)| !inputs::is_known(variables, values, *at)) {
            return Err(Failure::new(
                "directional derivatives are known with respect to the inputs, and in Initialization Mode to the Real \
                 parameters, only",
            ));
        }
        let prepared = match &state.prepared {
            Some(prepared) => prepared.clone(),
            None => Arc::new(Prepared::new(context, values)?),
        };
        let along =
            |known: Real| -> f64 { seeds.iter().filter(|(at, _)| *at == known).map(|(_, seed)| seed).sum() };
        let mut positions = state.positions.map(|position| Dual64::new(*position, 0.0));
        positions.update(&prepared.inputs, |position, input| position.eps = along(*input));
        let seeded = |parameter| Dual64::new(values.real(parameter), along(parameter));
        let mut parameters = variables.parameters(values, seeded);
        // Of the step that the outputs are of.
        parameters.solar_scale.re = state.solar_scale;
        for (seeded, value) in parameters.laws.tunable_mut().zip(state.tunable) {
            seeded.re = value;
        }
        let materials = state.materials.seeded(context, values, along)?;
        let mut workspaces = Workspaces::<Dual64>::default();
        let found = prepared.evaluate(&parameters, &materials, &positions, &mut workspaces)?;
        let outputs = DisturbanceOutputs { variables, found: &found, workspace: &workspaces.light };
        for (unknown, product) in unknowns.iter().zip(products) {
            *product = outputs
                .value(*unknown)
                .ok_or_else(|| Failure::new("directional derivatives are known of the outputs only"))?
                .eps;
        }
        Ok(())
    }
}

impl DeferredOutputs for DisturbanceTorque {
    /// The outputs in groups: totals, sources, faces.
    fn output_groups(v: &DisturbanceVariables) -> Vec<Knowns> {
        let totals = knowns![v.torque.total, v.force.total, v.sun.lit_fraction];
        vec![totals, knowns![&v.torque.by_source, &v.force.by_source], knowns![&v.plate]]
    }

    fn write_outputs(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut DisturbanceState,
        groups: OutputGroups,
        _time_s: f64,
    ) -> Result<(), Failure> {
        let DisturbanceState { found, workspaces, .. } = state;
        let found = found.as_ref().ok_or_else(|| Failure::new("nothing was evaluated since the restore"))?;
        DisturbanceOutputs { variables: context.variables, found, workspace: &workspaces.light }
            .write(values, groups);
        Ok(())
    }
}

/// Evaluates at the state's inputs.
fn update(state: &mut DisturbanceState, prepared: &Prepared) -> Result<(), Failure> {
    let mut parameters = Parameters { solar_scale: state.solar_scale, ..prepared.parameters };
    for (parameter, value) in parameters.laws.tunable_mut().zip(state.tunable) {
        *parameter = value;
    }
    let materials = state.materials.prepared();
    let found = prepared.evaluate(&parameters, materials, &state.positions, &mut state.workspaces)?;
    if !found.loads.total().is_finite() {
        return Err(Failure::new(
            "force or torque is no number at these inputs; see sun.positionBody, planet.positionBody, spacecraft.centerOfMass, solar.flux, solar.scale and \
             spacecraft.inertia, allowed: values a spacecraft can have",
        ));
    }
    state.found = Some(found);
    Ok(())
}
