//! Sources of loads: their list, from which the struct of the sources, that of their states and all loops over them are made.
//!
//! Calls are static; the table's order of rows, not the order here, is that of summation.

pub(super) mod air;
pub(super) mod applied;
pub(super) mod by_source;
pub(super) mod gravity_gradient;
pub(super) mod source;
pub(super) mod sunlight;
pub(super) mod thrusters;

mod magnetic;

use serde::{Deserialize, Serialize};

use self::air::AerodynamicSolver;
use self::source::{Results, Source, check_writers};
use self::sunlight::radiation_solver::RadiationSolver;
use crate::loads::{Effect, Linear, Loads};
use crate::numerics::Span;
use crate::plant::instant::conditions::Conditions;
use crate::plant::instant::kinematics::Kinematics;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::spacecraft::{Material, Spacecraft};

/// Dipoles by the rows in the magnetic field, [`Effect::FIELD`], with their rates, body frame, in A m2 and A m2/s.
pub(crate) type Dipoles = [Option<Linear>; Effect::IN_FIELD];

macro_rules! sources {
    ($configuration:ident, $($name:ident: $source:ty = $settings:expr,)+) => {
        /// Sources of loads with their models and caches, which are not saved.
        #[derive(Clone, Debug, Default)]
        pub struct Sources {
            $(pub(crate) $name: $source,)+
            face_temperatures_k: Vec<f64>,
        }

        /// Saved states of the sources.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct SourceStates {
            $(pub(crate) $name: <$source as Source>::State,)+
        }

        const _: () = check_writers(&[$((stringify!($name), <$source as Source>::ROWS)),+]);

        impl Sources {
            /// Writes the loads of the sources that act.
            pub(crate) fn write_loads(&mut self, states: &SourceStates, at: &Conditions<'_>, loads: &mut Loads) {
                let $configuration = at.kinematics.configuration;
                let mut results = Results { loads, face_temperatures_k: &mut self.face_temperatures_k };
                $(if $configuration.effects.has_any(<$source as Source>::ROWS) {
                    let settings = $settings;
                    self.$name.load(settings, &states.$name, at, &mut results);
                    let [row, ..] = <$source as Source>::ROWS else { unreachable!() };
                    if row.is_in_field() && at.instant.planet_body_m.is_some() {
                        let [dipole_body_a_m2, _] = <$source as Source>::dipole(settings, &states.$name, at.instant.time_s);
                        let field_body_t = at.instant.to_body * at.air_and_field.field_inertial_t;
                        results.loads[*row].torque_body_n_m = magnetic::torque_n_m(&dipole_body_a_m2, &field_body_t);
                    }
                })+
            }

            /// Applies the events that are due at the start of a span and makes the states of the sources that act known from there on;
            /// returns up to when, at most to the span's end.
            ///
            /// # Errors
            /// What ends a flight.
            pub(crate) fn extend(
                &mut self,
                states: &mut SourceStates,
                path: &mut Kinematics<'_>,
                span: Span,
            ) -> Result<f64, PlantError> {
                let mut until_s = span.end_s;
                $(if path.configuration.effects.has_any(<$source as Source>::ROWS) {
                    <$source as Source>::apply_events(&mut states.$name, span.start_s);
                    until_s = until_s.min(self.$name.extend(&mut states.$name, path, span)?);
                    until_s = until_s.min(<$source as Source>::next_event_s(&states.$name, span.start_s));
                })+
                Ok(until_s)
            }

            /// Units of work of one evaluation of all that act.
            pub(crate) fn load_units(&self, configuration: &Configuration) -> u32 {
                let mut units = 0;
                $(if configuration.effects.has_any(<$source as Source>::ROWS) {
                    units += self.$name.load_units();
                })+
                units
            }

            /// Sets the material with this index; allocates nothing.
            pub(crate) fn set_material(&mut self, index: usize, material: &Material) {
                $(self.$name.set_material(index, material);)+
            }
        }

        impl SourceStates {
            /// Becomes another one; allocates nothing where it held as much before.
            pub(crate) fn copy_from(&mut self, other: &Self) {
                $(self.$name.clone_from(&other.$name);)+
            }

            /// Discards what was computed beyond `time_s`.
            pub(crate) fn cut(&mut self, time_s: f64) {
                $(<$source as Source>::cut(&mut self.$name, time_s);)+
            }

            /// Whether a simulation of this spacecraft can produce them.
            pub(crate) fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
                $(<$source as Source>::is_valid(&self.$name, spacecraft))&&+
            }

            /// Names a part that was not computed at `time_s`, if any.
            pub(crate) fn first_uncovered(&self, time_s: f64) -> Option<&'static str> {
                None$(.or_else(|| <$source as Source>::first_uncovered(&self.$name, time_s)))+
            }

            /// Dipoles of the sources that act, at `time_s`.
            pub(crate) fn dipoles(&self, $configuration: &Configuration, time_s: f64) -> Dipoles {
                let mut dipoles = Dipoles::default();
                $(if let [row, ..] = <$source as Source>::ROWS
                    && let Some(place) = Effect::FIELD.iter().position(|it| it == row)
                    && $configuration.effects.has(*row)
                {
                    dipoles[place] = Some(<$source as Source>::dipole($settings, &self.$name, time_s));
                })+
                dipoles
            }
        }
    };
}

impl Sources {
    /// Sources with these solvers of light and air, where they act.
    pub fn new(light: Option<RadiationSolver>, air: Option<AerodynamicSolver>) -> Self {
        let faces = light.as_ref().map_or(0, |solver| solver.model.face_count());
        Self { sunlight: light, air, face_temperatures_k: Vec::with_capacity(faces), ..Self::default() }
    }
}

// Each with its settings in a configuration.
sources! {
    configuration,
    sunlight: Option<RadiationSolver> = configuration,
    gravity_gradient: gravity_gradient::GravityGradient = &configuration.laws,
    air: Option<AerodynamicSolver> = configuration,
    magnetic: magnetic::ResidualDipole = &configuration.laws,
    applied: applied::Applied = &(),
    thrusters: thrusters::OwnThrusters = &(),
}
