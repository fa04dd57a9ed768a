//! What a plan with a flyby comes to: reach, velocity changes that would do the same, manoeuvres compared, dispersed flights.

mod campaign;
mod compared;
mod picture;
mod report;
mod update;

use ::files::Scratch;
use nalgebra::Vector2;
use planner::{
    flyby::{Sensitivity, sensitivity::DesiredDeltaV},
    momentum::{
        attainable::{Reachable, reachable},
        plan::MomentumPlan,
    },
};

pub(super) use self::update::updated;
use self::{campaign::Campaign, compared::Compared};
use super::{aimed::Aimed, file::PlanFile, planned::Planned};
use crate::plan::flights::{Failure, SimulatedMission};

/// Between the times of desired velocity changes, in s.
const DESIRED_S: f64 = 86_400.0;
/// Reach counts as so much larger: it is that of a linear model.
const BEYOND: f64 = 1.02;

/// Names of files that only plans with a flyby have.
pub(super) const NAMES: [&str; 2] = ["desired.csv", "sensitivity.csv"];

/// What a plan with a flyby comes to.
pub(super) struct Flyby {
    /// Where it can be moved to.
    pub reach: Reachable,
    /// Least changes of velocity that would do the same, at times in s of the flight.
    pub desired: Vec<(f64, DesiredDeltaV)>,
    /// Of the plan's flight; `None` where there is no plan.
    pub after: Option<Sensitivity>,
    pub compared: Option<Compared>,
    pub campaign: Option<Campaign>,
}

/// Whether a correction is within what can be reached.
fn holds(polygon_m: &[[f64; 2]], correction_m: Vector2<f64>) -> bool {
    let pairs = polygon_m.iter().zip(polygon_m.iter().cycle().skip(1));
    let is_left = |(from, to): (&[f64; 2], &[f64; 2])| {
        let (from, to) = (Vector2::from(*from) * BEYOND, Vector2::from(*to) * BEYOND);
        (to - from).perp(&(correction_m - from)) >= 0.0
    };
    polygon_m.len() > 2 && pairs.into_iter().all(is_left)
}

impl Flyby {
    /// What can be known before the plan.
    pub(super) fn before(planned: &Planned<'_>, aimed: &Aimed) -> Result<Self, Failure> {
        let mut simulates = planned;
        let reach = reachable(&planned.task, &planned.sunlit, &planned.simulated, &mut simulates);
        let miss = aimed.first_miss();
        let from_s = planned.task.layout.frozen_until_s.max(planned.mission.start_s);
        let epoch_s = aimed.first.encounter.epoch_s;
        let days = (0..).map(|day| from_s + f64::from(day) * DESIRED_S).take_while(|at_s| *at_s < epoch_s);
        let desired = days.filter_map(|at_s| {
            let found = match aimed.aim.arrival_s {
                None => aimed.first.desired(at_s, [miss.x, miss.y]),
                Some(_) => aimed.first.desired_in_time(at_s, [miss.x, miss.y], miss.z),
            };
            Some((at_s, found?))
        });
        Ok(Self {
            reach: reach.map_err(|error| error.to_string())?,
            desired: desired.collect(),
            after: None,
            compared: None,
            campaign: None,
        })
    }

    /// Whether no choice of arrays and attitudes reaches the aim.
    pub(super) fn is_out_of_reach(&self, aimed: &Aimed) -> bool {
        !holds(&self.reach.polygon_m, -aimed.first_miss().xy())
    }

    /// What the plan's flight came to, beside manoeuvres and dispersed flights.
    pub(super) fn complete(
        &mut self,
        file: &PlanFile,
        planned: &Planned<'_>,
        aimed: &Aimed,
        found: &MomentumPlan,
    ) -> Result<(), Failure> {
        let mut flight = found.flight.clone();
        let after = aimed.judge(&mut flight, &planned.sunlit)?;
        self.compared = match &file.compare {
            Some(at) => Some(Compared::of(file, &at.it, (planned, aimed), &after)?),
            None => None,
        };
        if let Some(at) = &file.monte_carlo {
            let folder = Scratch::new()?;
            for (name, text) in planned.write_into(folder.path(), (&found.windows, &found.dumps), None)? {
                std::fs::write(folder.path().join(name), text)?;
            }
            let template = planned.options.template.as_deref();
            let mission = SimulatedMission::open(&folder.path().join("mission.toml"), template, &[])?;
            let covariance = file.update.as_ref().and_then(|it| it.it.covariance);
            let arrival_s = after.encounter.time_s;
            self.campaign = Some(Campaign::simulate(&mission, (at.it, covariance), (aimed, arrival_s), planned)?);
        }
        self.after = Some(after);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_correction_counts_within_the_polygon_and_a_little_beyond() {
        let square = [[-1e5, -1e4], [1e5, -1e4], [1e5, 2e4], [-1e5, 2e4]];
        for (correction, is) in [([9e4, 0.0], true), ([1.01e5, 0.0], true), ([1.1e5, 0.0], false), ([0.0, -2e4], false)] {
            assert_eq!(holds(&square, Vector2::from(correction)), is, "{correction:?}");
        }
        assert!(!holds(&[], Vector2::zeros()) && !holds(&square[..2], Vector2::zeros()));
    }
}
