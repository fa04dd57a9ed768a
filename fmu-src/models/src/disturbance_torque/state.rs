//! Materials of the surfaces: the values that parameters set, and what follows from them.

use fmi_export::{Failure, Real, Values};
use physics::numerics::scalar::Dual64;
use physics::spacecraft::{Material, MaterialValues, NamedMaterial};
use serde::{Deserialize, Serialize};

use super::setup::Plan;
use crate::common::optics::{SettableMaterials, material};

/// The materials with the values they are made of; the latter are state, the former follow.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Materials {
    values: Vec<MaterialValues>,
    #[serde(skip)]
    prepared: Vec<Material>,
}

impl Materials {
    /// The materials of the spacecraft's file.
    pub(super) fn of_file(settable: &SettableMaterials) -> Self {
        let values = settable.all.iter().map(NamedMaterial::values).collect();
        Self { values, prepared: settable.all.iter().map(|it| it.material).collect() }
    }

    /// Takes the parameters; allocates nothing but after a restore.
    ///
    /// # Errors
    /// Names parameters whose values no material has.
    pub(super) fn read(&mut self, context: &Plan<'_>, values: &Values) -> Result<(), Failure> {
        let Self { values: known, prepared } = self;
        let all = &context.setup.optics.all;
        let is_restored = prepared.len() != all.len();
        if is_restored {
            prepared.clear();
            prepared.extend(all.iter().map(|it| it.material));
        }
        let read = |parameter| values.real(parameter);
        let found = context.variables.optics.values(context, values, &context.setup.optics, read);
        for (((found, own), known), prepared) in found.zip(all).zip(known).zip(prepared) {
            if is_restored || *known != found {
                (*prepared, *known) = (material(own, &found)?, found);
            }
        }
        Ok(())
    }

    /// The materials of the last step, changing with these seeds of parameters.
    ///
    /// # Errors
    /// Names parameters whose values no material has.
    pub(super) fn seeded(
        &self,
        context: &Plan<'_>,
        values: &Values,
        seed: impl Fn(Real) -> f64,
    ) -> Result<Vec<Material<Dual64>>, Failure> {
        let (variables, settable) = (&context.variables.optics, &context.setup.optics);
        let made = |found: &mut dyn Iterator<Item = MaterialValues<Dual64>>| {
            found.zip(&settable.all).map(|(found, own)| material(own, &found)).collect()
        };
        if variables.each().all(|parameter| seed(parameter) == 0.0) {
            return made(&mut self.values.iter().map(|it| it.map(Dual64::from_re)));
        }
        // Parameters are seeded before the first step alone, of which their values are.
        let read = |parameter| Dual64::new(values.real(parameter), seed(parameter));
        made(&mut variables.values(context, values, settable, &read))
    }

    /// The materials.
    pub(super) fn prepared(&self) -> &[Material] {
        &self.prepared
    }

    /// Checks numbers that were decoded.
    ///
    /// # Errors
    /// Another number of materials, values that no material has.
    pub(super) fn check(&self, settable: &SettableMaterials) -> Result<(), Failure> {
        let (found, allowed) = (self.values.len(), settable.all.len());
        if found != allowed {
            return Err(Failure::new(format!("the saved state has {found} materials, allowed: {allowed}")));
        }
        self.values.iter().zip(&settable.all).try_for_each(|(values, own)| material(own, values).map(|_| ()))
    }
}
