//! Forces and torques on the spacecraft by source, and on its faces one by one.

use fmi_export::variables::{Causality, RealSpec, Role, Variability};
use fmi_export::{Declare, DeclareError, Knowns, Real, RealVector, Section, Variables};
use nalgebra::Vector3;
use physics::loads::{Effect, EffectRow, Loads};
use physics::numerics::scalar::Scalar;

use super::spacecraft::ReportedFace;

/// One output of a quantity for each row of the table of effects that has it, body frame.
pub struct BySource(Vec<(Effect, RealVector<3>)>);

/// A quantity that effects have.
pub struct Quantity {
    unit: &'static str,
    display_unit: Option<&'static str>,
    has: fn(Effect) -> bool,
    nominal: fn(&EffectRow) -> f64,
}

/// Torque about the centre of mass.
pub(crate) const TORQUE: Quantity = Quantity {
    unit: "N.m",
    display_unit: Some("uN.m"),
    has: Effect::is_disturbance,
    nominal: EffectRow::usual_torque_n_m,
};

/// Torque about the centre of mass of a spacecraft whose parts move.
pub(crate) const TORQUE_IN_FLIGHT: Quantity =
    Quantity { has: |effect| effect.is_disturbance() || effect.is_by_moving_parts(), ..TORQUE };

/// Force.
pub(crate) const FORCE: Quantity = Quantity {
    unit: "N",
    display_unit: Some("uN"),
    has: |effect| effect.is_disturbance() && effect.row().exerts_force,
    nominal: EffectRow::usual_force_n,
};

/// Change of the momentum by an effect since the last dump, by momentum.convention. All of them add up to the change of the
/// momentum, but for thrusters in use.
pub(crate) const MOMENTUM: Quantity = Quantity {
    unit: "N.m.s",
    display_unit: None,
    has: |effect| effect.row().momentum_apart,
    nominal: |row| row.usual_momentum_n_m_s,
};

impl Variables<Quantity> for BySource {
    fn declare(scope: &mut Declare, quantity: &Quantity, _index: usize) -> Result<Self, DeclareError> {
        let rows = Effect::ALL.into_iter().filter(|effect| (quantity.has)(*effect));
        let declared = rows.map(|effect| {
            let row = effect.row();
            let spec = RealSpec {
                name: row.name,
                description: row.about,
                role: Role {
                    causality: Causality::Output,
                    variability: Variability::Continuous,
                    initial: None,
                },
                unit: quantity.unit,
                display_unit: quantity.display_unit,
                min: None,
                max: None,
                nominal: Some((quantity.nominal)(row)),
            };
            Ok((effect, scope.real_vector(&spec, None)?))
        });
        declared.collect::<Result<_, _>>().map(Self)
    }
}

impl Section for BySource {
    fn section(&self) -> Knowns {
        self.0.iter().map(|(_, output)| *output).collect()
    }
}

impl BySource {
    /// The effects that have an output, with it.
    pub fn iter(&self) -> impl Iterator<Item = (Effect, RealVector<3>)> + '_ {
        self.0.iter().copied()
    }

    /// The output of an effect.
    pub fn output(&self, effect: Effect) -> Option<RealVector<3>> {
        self.iter().find_map(|(known, output)| (known == effect).then_some(output))
    }
}

/// The outputs of torque and force by source, with what `loads` gives for them.
pub(crate) fn vectors<'v, T: Scalar>(
    torque: &'v BySource,
    force: &'v BySource,
    loads: &'v Loads<T>,
) -> impl Iterator<Item = (RealVector<3>, Vector3<T>)> + 'v {
    let torques = torque.iter().map(|(effect, output)| (output, loads[effect].torque_body_n_m));
    torques.chain(force.iter().map(|(effect, output)| (output, loads[effect].force_body_n)))
}

/// One face of a plate or panel, in the file's order: plates, sunshade, panels, the rear after the front. There if the
/// FMU was packed with per-plate outputs.
#[derive(Variables)]
#[variables(setup = Vec<ReportedFace>, label = setup[index].name)]
pub struct PlateVariables {
    /// Temperature.
    #[output(unit = "K", nominal = 300.0)]
    pub temperature: Real,
    /// Force of sunlight and of whatever else acts of planet light and recoil, body frame; all add up to force.total but for
    /// what is applied, and for sunlight on a cylindrical shade, which is round there and of flat strips here.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub force: RealVector<3>,
}
