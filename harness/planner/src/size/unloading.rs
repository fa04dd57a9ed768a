//! Unloadings one time after another: wheels, impulse, propellant, and how long thrusters fire.

use nalgebra::Vector3;
use physics::{propulsion::ThrusterSelection, spacecraft::Thruster};

use super::{
    momentum::Histories,
    needs::{Demands, Wheels},
    sized::YEAR_S,
};

/// Unloadings every so long.
pub(super) struct Unloadings {
    /// Wheels between them.
    pub wheels: Wheels,
    /// Figures of the first year, and of the last of a mission of several; none of flights that are shorter than the time between them.
    pub years: Vec<YearOfUnloading>,
    /// The longest of them; `None` without thrusters that dump.
    pub longest: Option<Firing>,
}

/// A year of unloadings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct YearOfUnloading {
    /// Sum of the magnitudes, in N m s.
    pub impulse_n_m_s: f64,
    pub propellant_kg: f64,
}

/// Thrusters as they fire for one unloading.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Firing {
    /// Time of the thruster that fires longest at full thrust.
    pub time_s: f64,
    pub propellant_kg: f64,
    /// Electric energy, in J; `None` where one has no power.
    pub energy_j: Option<f64>,
}

impl Unloadings {
    /// Unloadings of these flights, by thrusters if they dump.
    pub(super) fn new(
        demands: &Demands<'_>,
        flights: &[Histories],
        every_s: f64,
        dumping: Option<&ThrusterSelection>,
    ) -> Self {
        let thrusters = &demands.sized.spacecraft.thrusters;
        let firing = |impulse: &Vector3<f64>| dumping.map(|it| Firing::new(thrusters, it, &-impulse));
        let mut longest: Option<Firing> = None;
        let mut years = Vec::new();
        let unloaded: Option<Vec<_>> = flights.iter().map(|flight| flight.unloaded_n_m_s(every_s)).collect();
        for (gathered_n_m_s, time_s) in unloaded.unwrap_or_default() {
            let per_year = YEAR_S / time_s;
            let fired: Vec<Firing> = gathered_n_m_s.iter().filter_map(firing).collect();
            longest = fired.iter().copied().chain(longest).max_by(|a, b| a.time_s.total_cmp(&b.time_s));
            years.push(YearOfUnloading {
                impulse_n_m_s: per_year * gathered_n_m_s.iter().map(Vector3::norm).sum::<f64>(),
                propellant_kg: per_year * fired.iter().map(|it| it.propellant_kg).sum::<f64>(),
            });
        }
        Self { wheels: demands.wheels(flights, every_s), years, longest }
    }

    /// Propellant of `years` between the first and the last in proportion, in kg.
    pub(super) fn propellant_kg(&self, years: f64) -> f64 {
        let first_kg = self.years.first().map_or(0.0, |year| year.propellant_kg);
        years * 0.5 * (first_kg + self.years.last().map_or(first_kg, |year| year.propellant_kg))
    }
}

impl Firing {
    /// For an impulse about the centre of mass, in N m s, body frame.
    fn new(thrusters: &[Thruster], selection: &ThrusterSelection, impulse_n_m_s: &Vector3<f64>) -> Self {
        let mut firing = Self { energy_j: Some(0.0), ..Self::default() };
        for (thruster, on_s) in thrusters.iter().zip(selection.on_times_s(impulse_n_m_s)) {
            firing.time_s = firing.time_s.max(on_s);
            firing.propellant_kg += thruster.flow_kg_s * on_s;
            if on_s > 0.0 {
                firing.energy_j =
                    firing.energy_j.zip(thruster.power_w).map(|(sum, power_w)| sum + power_w * on_s);
            }
        }
        firing
    }
}
