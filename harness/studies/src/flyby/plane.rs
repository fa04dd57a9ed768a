//! B-plane of a flyby: what misses cost, what altitude they have, and a picture of them.

use drawing::{PlaneChart, PlanePanel, Series, ellipse};
use nalgebra::{Matrix2, Matrix2x3};
use planner::flyby::{
    Sensitivity,
    aimpoint::{b_of_periapsis_m, periapsis_of_b_m},
    maneuvers,
    miss::MissCost,
};

use super::leg::{Failure, Leg, Met};
use super::mission::{DAY_S, Mission};
use crate::cells::row;
use crate::report::{Outcome, Run};

/// The departure manoeuvre, behind the flyby, in s.
const DEPARTURE_S: f64 = 30.0 * DAY_S;
/// Deviations of the ellipses that are drawn.
pub(super) const SIGMAS: f64 = 3.0;
/// Of a state from orbit determination, along each axis, in m and m/s: assumed.
pub(super) const POSITION_M: f64 = 1e3;
pub(super) const VELOCITY_M_S: f64 = 5e-4;

/// What a flight is aimed at, and what misses come to there.
pub(super) struct Target {
    /// B along T and R, in m.
    pub aimpoint_m: [f64; 2],
    pub cost: MissCost,
    gm_m3_s2: f64,
    radius_m: f64,
    excess_m_s: f64,
    /// Time from the epoch of osculation to closest approach, in h.
    lead_h: f64,
}

impl Target {
    /// Where a flight meets its B-plane.
    pub(super) fn of(leg: &Leg<'_>, met: &Met, mission: &Mission) -> Result<Self, Failure> {
        let encounter = &met.sensitivity.encounter;
        let times_s = [encounter.time_s + DEPARTURE_S, leg.time_s(mission.next_epoch_s())];
        Ok(Self {
            aimpoint_m: [encounter.plane.b_t_m, encounter.plane.b_r_m],
            cost: MissCost::new(&met.sensitivity, &leg.force_model, times_s)?,
            gm_m3_s2: leg.force_model.gm_m3_s2,
            radius_m: leg.radius_m,
            excess_m_s: encounter.plane.excess_speed_m_s,
            lead_h: leg.force_model.lead_s / 3600.0,
        })
    }

    /// By how much the altitude of a miss is above that of the aimpoint, in m, without tides.
    pub(super) fn altitude_offset_m(&self, miss_m: [f64; 2]) -> f64 {
        let periapsis_m =
            |[t_m, r_m]: [f64; 2]| periapsis_of_b_m(t_m.hypot(r_m), self.gm_m3_s2, self.excess_m_s);
        periapsis_m(self.place_m(miss_m)) - periapsis_m(self.aimpoint_m)
    }

    /// Misses of a size whose altitude is off by so much, in m: one either side of the radial through the aimpoint.
    pub(super) fn misses_m(&self, size_m: f64, altitude_offset_m: f64) -> Option<[[f64; 2]; 2]> {
        let aimpoint_m = self.aimpoint_m[0].hypot(self.aimpoint_m[1]);
        let periapsis_m = periapsis_of_b_m(aimpoint_m, self.gm_m3_s2, self.excess_m_s) + altitude_offset_m;
        let b_m = b_of_periapsis_m(periapsis_m, self.gm_m3_s2, self.excess_m_s);
        // Corners of the triangle with these sides.
        let along_m = (b_m * b_m - aimpoint_m * aimpoint_m - size_m * size_m) / (2.0 * aimpoint_m);
        let aside_m = (size_m * size_m - along_m * along_m).sqrt();
        let [cosine, sine] = self.aimpoint_m.map(|part_m| part_m / aimpoint_m);
        let place = |aside_m: f64| [along_m * cosine - aside_m * sine, along_m * sine + aside_m * cosine];
        aside_m.is_finite().then(|| [place(aside_m), place(-aside_m)])
    }

    fn place_m(&self, miss_m: [f64; 2]) -> [f64; 2] {
        [self.aimpoint_m[0] + miss_m[0], self.aimpoint_m[1] + miss_m[1]]
    }

    /// Misses around the aimpoint that cost so much.
    fn contour_m(&self, cost_m_s: f64) -> Vec<[f64; 2]> {
        let unit = ellipse((0.0, 0.0), [1.0; 2], 0.0).into_iter();
        unit.map(|(t, r)| [t, r].map(|part| part * cost_m_s / self.cost.cost_m_s([t, r]))).collect()
    }
}

/// Covariance of B where state vectors have the assumed one at a time.
pub(super) fn covariance_m2(sensitivity: &Sensitivity, time_s: f64) -> Matrix2<f64> {
    let partials = sensitivity.at(time_s);
    let of = |column: usize, deviation: f64| {
        let by: Matrix2x3<f64> = partials.fixed_view::<2, 3>(0, column).into_owned();
        by * by.transpose() * (deviation * deviation)
    };
    of(0, POSITION_M) + of(3, VELOCITY_M_S)
}

/// A named miss, with the covariance of what is known of it.
pub(super) struct Intercept {
    pub label: &'static str,
    pub miss_m: [f64; 2],
    pub covariance_m2: Option<Matrix2<f64>>,
}

/// A reach that is so many times as wide as the rest is left to the second panel.
const WIDER: f64 = 6.0;
/// What sunlight can still reach.
const IN_REACH: &str = "in reach of sunlight";

/// A picture of intercepts about the aimpoint, with the planet and what misses cost.
pub(super) struct Plane<'a> {
    pub target: &'a Target,
    pub title: String,
    pub intercepts: Vec<Intercept>,
    /// Misses at the corners of what sunlight can still reach, where that is sought.
    pub reachable_m: Vec<[f64; 2]>,
    /// Contours, in m/s.
    pub costs_m_s: &'a [f64],
}

/// In km; the picture has T to the right and R down, as seen along the asymptote.
fn shown([t_m, r_m]: [f64; 2]) -> (f64, f64) {
    (t_m / 1e3, -r_m / 1e3)
}

impl Plane<'_> {
    fn series(&self) -> Vec<Series> {
        let target = self.target;
        let at = |miss_m: [f64; 2]| shown(target.place_m(miss_m));
        let radius_km =
            |periapsis_m: f64| b_of_periapsis_m(periapsis_m, target.gm_m3_s2, target.excess_m_s) / 1e3;
        let circle = |radius_km: f64| ellipse((0.0, 0.0), [radius_km; 2], 0.0);
        let dots = self.intercepts.iter().map(|it| Series::dots(it.label, vec![at(it.miss_m)]));
        let mut series = vec![Series::rings("aim", vec![at([0.0; 2])])];
        series.extend(dots);
        series.push(Series::line("impact", circle(radius_km(target.radius_m))));
        let [t_m, r_m] = target.aimpoint_m;
        series.push(Series::dashed("altitude of the aim", circle(t_m.hypot(r_m) / 1e3)));
        for it in &self.intercepts {
            let Some(covariance_m2) = it.covariance_m2 else { continue };
            let (axes_m, angle_rad) = maneuvers::ellipse(&covariance_m2);
            let points = ellipse(at(it.miss_m), axes_m.map(|axis_m| SIGMAS * axis_m / 1e3), -angle_rad);
            series.push(Series::dashed(format!("three deviations, {}", it.label), points));
        }
        if let Some(first) = self.reachable_m.first() {
            let corners = self.reachable_m.iter().chain([first]);
            series.push(Series::line(IN_REACH, corners.map(|miss_m| at(*miss_m)).collect()));
        }
        for cost_m_s in self.costs_m_s {
            let points = target.contour_m(*cost_m_s).into_iter().map(at).collect();
            series.push(Series::line(format!("{cost_m_s} m/s"), points));
        }
        series
    }

    /// Draws it and writes its intercepts and contours.
    pub(super) fn write(&self, run: &mut Run<'_>, name: &str) -> Outcome {
        let series = self.series();
        let aimpoint = shown(self.target.aimpoint_m);
        let about = |points: &[(f64, f64)]| {
            points.iter().map(|(x, y)| (x - aimpoint.0).abs().max((y - aimpoint.1).abs())).fold(0.0, f64::max)
        };
        // Intercepts, ellipses and contours, without circles about the planet.
        let is_near =
            |it: &&Series| !["impact", "altitude of the aim", IN_REACH].contains(&it.label.as_str());
        let close = series.iter().filter(is_near).map(|it| about(&it.points)).fold(1.0, f64::max);
        let reach = series.iter().filter(|it| it.label == IN_REACH).map(|it| about(&it.points));
        let close = reach.filter(|reach| *reach < WIDER * close).fold(close, f64::max);
        let wide = 1.3 * aimpoint.0.hypot(aimpoint.1) + close;
        let panel = |title: &str, centre, half_width| PlanePanel {
            title: title.to_owned(),
            series: series.clone(),
            centre,
            half_width,
            ..PlanePanel::default()
        };
        let lead_h = self.target.lead_h;
        let epoch = format!("{lead_h} h before closest approach");
        run.line(&format!("B is that of the hyperbola osculating {epoch}."));
        let chart = PlaneChart {
            title: self.title.clone(),
            x_label: format!("B.T {epoch} [km]"),
            y_label: "-B.R [km]".to_owned(),
            panels: vec![panel("about the aim", aimpoint, 1.15 * close), panel("Mercury", (0.0, 0.0), wide)],
            shading: None,
        };
        run.picture(&format!("{name}.svg"), &chart)?;
        let target = self.target;
        let cells = |what: &str, miss_m: [f64; 2]| {
            let [t_m, r_m] = target.place_m(miss_m);
            let altitude_m = target.altitude_offset_m(miss_m);
            row![what, t_m, r_m, miss_m, target.cost.cost_m_s(miss_m), altitude_m, lead_h]
        };
        let mut rows = vec![cells("aim", [0.0; 2])];
        rows.extend(self.intercepts.iter().map(|it| cells(it.label, it.miss_m)));
        rows.extend(self.reachable_m.iter().map(|miss_m| cells(IN_REACH, *miss_m)));
        for cost_m_s in self.costs_m_s {
            let label = format!("contour of {cost_m_s} m/s");
            rows.extend(target.contour_m(*cost_m_s).into_iter().map(|miss_m| cells(&label, miss_m)));
        }
        run.csv(
            &format!("{name}.csv"),
            "what | b_t_m | b_r_m | miss_t_m | miss_r_m | cost_m_s | altitude_offset_m | osculation_before_h",
            rows,
        )
    }
}
