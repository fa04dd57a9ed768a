//! Task of a flyby by the plan file, the mission and its flight.

use crate::{
    Failure,
    flyby::{
        BPlaneAimpoint, FlybyTask, ForceModel, Sensitivity,
        aimpoint::{b_of_periapsis_m, periapsis_of_b_m},
    },
    momentum::{simulated::SimulatedFlight, torque::SunlitSpacecraft},
    plans::flights::SimulatedMission,
};
use inputs::{
    leg::FlybyAimpoint,
    plan::{PlanFile, keys::Flyby},
};

/// Encounter as the files give it before the first flight.
pub(super) struct Aim {
    pub force_model: ForceModel,
    /// Time of a fixed arrival, in s.
    pub arrival_s: Option<f64>,
}

impl Aim {
    /// Refuses a planet that is not the mission's, and a date that it has not.
    pub(super) fn new(file: &PlanFile, flyby: &Flyby, mission: &SimulatedMission) -> Result<Self, Failure> {
        let force_model = ForceModel::new(&mission.values(), mission.start_s)
            .map_err(|error| format!("{}: {error}", mission.mission.file.display()))?;
        let name = force_model.body.data().name;
        if !name.eq_ignore_ascii_case(&flyby.body.it) {
            let (found, allowed) = (&flyby.body.it, name.to_lowercase());
            let what = format!("found {found:?}, allowed: {allowed:?}, the mission's encounter.body");
            return Err(file.problem(&flyby.body, &what).into());
        }
        let arrival_s = flyby.time.as_ref().map(|at| mission.time_in_file_s(file, at, at.it)).transpose()?;
        Ok(Self { force_model, arrival_s })
    }
}

/// Task by the flight of the mission as it is.
pub(super) fn flyby_task(
    file: &PlanFile,
    (flyby, Aim { force_model, arrival_s }): (&Flyby, Aim),
    (mission, sunlit): (&SimulatedMission, &SunlitSpacecraft),
    simulated: &SimulatedFlight,
) -> Result<FlybyTask, Failure> {
    let values = mission.values();
    let shown = mission.mission.file.display();
    let first =
        Sensitivity::new(simulated, &force_model, sunlit).map_err(|error| format!("{shown}: {error}"))?;
    let radius_m = values.real("planet.radius");
    let excess_m_s = first.encounter.plane.excess_speed_m_s;
    let gm_m3_s2 = force_model.gm_m3_s2;
    let b_m = match flyby.aimpoint().map(|at| at.it) {
        None => [first.encounter.plane.b_t_m, first.encounter.plane.b_r_m],
        Some(FlybyAimpoint::Plane { b_t_m, b_r_m }) => [b_t_m, b_r_m],
        Some(FlybyAimpoint::Altitude { altitude_m, angle_rad }) => {
            // From the osculation on tides change B: by as much as in the flight of the mission as it is.
            let simulated_m = first.encounter.plane.b_t_m.hypot(first.encounter.plane.b_r_m);
            let [aimed_m, passed_m] = [radius_m + altitude_m, first.encounter.closest.position_m.norm()]
                .map(|radius_m| b_of_periapsis_m(radius_m, gm_m3_s2, excess_m_s));
            let b_m = simulated_m + aimed_m - passed_m;
            [b_m * angle_rad.cos(), b_m * angle_rad.sin()]
        }
    };
    let periapsis_m = periapsis_of_b_m(b_m[0].hypot(b_m[1]), gm_m3_s2, excess_m_s);
    if let Some(at) = flyby.aimpoint().filter(|_| periapsis_m < radius_m) {
        let what = format!(
            "found B of {:.1} and {:.1} km along T and R, whose periapsis lies {:.1} km inside of {}, allowed: from {:.1} km on",
            b_m[0] / 1e3,
            b_m[1] / 1e3,
            (radius_m - periapsis_m) / 1e3,
            force_model.body.data().name,
            b_of_periapsis_m(radius_m, gm_m3_s2, excess_m_s) / 1e3,
        );
        return Err(file.problem(&at, &what).into());
    }
    let aimpoint = BPlaneAimpoint { b_m, arrival_s };
    Ok(FlybyTask { force_model, aimpoint, tolerance_m: flyby.tolerance_m, radius_m, first })
}
