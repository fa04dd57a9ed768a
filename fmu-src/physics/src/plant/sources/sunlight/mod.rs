//! Sunlight, planet light and the recoil of heat: slow effects from a segment, sunlight that nothing shadows in closed form.

mod radiation_node;
mod stored_heat;

pub(crate) mod light_and_heat;
pub(crate) mod radiation_segment;
pub(crate) mod radiation_solver;
pub(crate) mod sunlit;

use self::light_and_heat::RadiationBuilder;
use self::radiation_segment::RadiationSegment;
use self::radiation_solver::RadiationSolver;
use self::sunlit::SunlitConfiguration;
use super::source::{Results, Source};
use crate::loads::Effect;
use crate::numerics::Span;
use crate::plant::instant::at_time::Instant;
use crate::plant::instant::conditions::Conditions;
use crate::plant::instant::kinematics::Kinematics;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::radiation::Beam;
use crate::spacecraft::{Material, Spacecraft};

/// Rows of the Sun's light, direct and reflected: no infrared light and no heat enters them.
pub const REFLECTED_LIGHT: [Effect; 2] = [Effect::Solar, Effect::Albedo];

/// Sunlight; with its solver of light and heat, where there is more of them than direct sunlight.
impl Source for Option<RadiationSolver> {
    const ROWS: &'static [Effect] = &[Effect::Solar, Effect::Albedo, Effect::Infrared, Effect::Thermal];
    type Settings = Configuration;
    type State = Option<RadiationSegment>;

    fn load(
        &mut self,
        configuration: &Configuration,
        state: &Option<RadiationSegment>,
        at: &Conditions<'_>,
        Results { loads, face_temperatures_k }: &mut Results<'_>,
    ) {
        let Instant { time_s, sun_distance_m, .. } = *at.instant;
        face_temperatures_k.clear();
        if let Some(segment) = state.as_ref().filter(|_| at.flow.is_some()) {
            let temperatures_k = segment.temperatures_k.iter().map(|series| series.value(time_s)[0]);
            face_temperatures_k.extend(temperatures_k);
        }
        let mut is_shadowed = false;
        if let (Some(segment), Some(solver)) = (state, &*self)
            && configuration.has_light_and_heat()
        {
            is_shadowed = configuration.light_and_heat.shadowing && solver.model.can_shadow();
            segment.write_loads(time_s, loads);
            loads[Effect::Solar] = loads[Effect::Solar].scaled(configuration.light.scale);
        }
        if !is_shadowed {
            let pressure_pa = configuration.light.pressure_pa(sun_distance_m) * at.instant.lit_fraction;
            let beam = Beam { source_body: at.instant.sun_body, pressure_pa };
            let sunlit = SunlitConfiguration {
                solar: at.kinematics.spacecraft.solar,
                panels: at.kinematics.spacecraft.panels,
                settings: &configuration.panels,
                current_mass_panels_stowed: at.kinematics.current_mass_panels_stowed,
                time_s,
                sun_distance_m,
            };
            loads[Effect::Solar] = sunlit.load(&beam, &at.mass.center_of_mass_body_m);
        }
    }

    fn extend(
        &mut self,
        state: &mut Option<RadiationSegment>,
        path: &mut Kinematics<'_>,
        span: Span,
    ) -> Result<f64, PlantError> {
        match self {
            Some(solver) if path.configuration.has_light_and_heat() => {
                RadiationBuilder { solver, path }.extend(state.get_or_insert_default(), span)
            }
            _ => Ok(span.end_s),
        }
    }

    fn cut(state: &mut Option<RadiationSegment>, time_s: f64) {
        if let Some(segment) = state {
            segment.cut(time_s);
        }
    }

    fn is_valid(state: &Option<RadiationSegment>, _: &Spacecraft) -> bool {
        state.as_ref().is_none_or(RadiationSegment::is_valid)
    }

    fn first_uncovered(state: &Option<RadiationSegment>, time_s: f64) -> Option<&'static str> {
        let is_covered = state.as_ref().is_none_or(|it| it.covers(time_s));
        (!is_covered).then_some("light and heat were computed")
    }

    fn set_material(&mut self, index: usize, material: &Material) {
        if let Some(solver) = self {
            solver.model.set_material(index, material);
        }
    }
}
