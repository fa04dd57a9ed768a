//! Results of the fit: on the screen, and as a table `[set]`.

use std::fmt::Write;

use crate::{
    refit::{Direction, Fitted, Requested},
    text_table::headed,
};
use fmi::csv::Real;

/// Results of the fit.
pub(super) struct Found<'a> {
    pub mission: String,
    pub telemetry: String,
    pub requested: &'a Requested<'a>,
    pub fitted: &'a Fitted,
}

impl Found<'_> {
    /// Root mean square of the residuals, in N m s.
    fn rms_n_m_s(&self) -> f64 {
        let rows = self.fitted.residuals_n_m_s.len().max(1) as f64;
        let sum: f64 = self.fitted.residuals_n_m_s.iter().map(nalgebra::Vector3::norm_squared).sum();
        (sum / (3.0 * rows)).sqrt()
    }

    /// Everything.
    pub(super) fn text(&self) -> String {
        [self.values(), self.directions(), self.residuals()].join("\n\n")
    }

    fn values(&self) -> String {
        let mut table = headed(" | prior | deviation | found | deviation");
        let names =
            ["centre of mass X [mm]", "centre of mass Y [mm]", "centre of mass Z [mm]", "solar.scale"];
        let (prior, prior_deviations) =
            (self.requested.prior.values(), self.requested.deviations.of_parameters());
        let (found, deviations) = (self.fitted.parameters.values(), self.fitted.deviations());
        for at in 0..4 {
            let (factor, digits) = if at < 3 { (1e3, 4) } else { (1.0, 6) };
            let cell = |value: f64| format!("{:.digits$}", factor * value);
            table.add_row([
                names[at].to_owned(),
                cell(prior[at]),
                cell(prior_deviations[at]),
                cell(found[at]),
                cell(deviations[at]),
            ]);
        }
        let (rows, arcs) = (self.fitted.residuals_n_m_s.len(), self.fitted.arcs.len());
        format!(
            "{}: fitted to {}, {rows} rows in {arcs} {} between dumps, by {} flights\n{table}",
            self.mission,
            self.telemetry,
            if arcs == 1 { "arc" } else { "arcs" },
            self.fitted.flights
        )
    }

    fn directions(&self) -> String {
        let mut table =
            headed("X | Y | Z | scale | sigma | sigma [mm] | sigma [% of scale] | determined").narrow();
        let prior_deviations = self.requested.deviations.of_parameters();
        for it in &self.fitted.directions {
            let sigma = it.vector.component_mul(&prior_deviations) * it.sigma;
            let parts = it.vector.as_slice().iter().map(|part| format!("{part:.4}"));
            table.add_row(parts.chain([
                terminal::short(rounded(it.sigma)),
                format!("{:.4}", 1e3 * sigma.xyz().norm()),
                format!("{:.4}", 100.0 * sigma.w.abs()),
                if it.observable { "yes".to_owned() } else { "no".to_owned() },
            ]));
        }
        let mut text = format!("Principal directions, in units of the priors' deviations\n{table}");
        for it in self.fitted.undetermined() {
            let _ = write!(text, "\nNot determined, so kept at the mission's values: {}.", self.named(it));
        }
        text
    }

    /// A direction in words.
    fn named(&self, direction: &Direction) -> String {
        if direction.vector.w.abs() < NO_SCALE {
            let [x, y, z] = [0, 1, 2].map(|at| direction.vector[at]);
            return format!("the centre of mass along ({x:.3}, {y:.3}, {z:.3}) of the body frame");
        }
        let moved = direction.vector.component_mul(&self.requested.deviations.of_parameters());
        let [x, y, z] = [0, 1, 2].map(|at| 1e3 * 0.01 * moved[at] / moved.w);
        format!("solar.scale with the centre of mass: ({x:.3}, {y:.3}, {z:.3}) mm undo each 1 % more of it")
    }

    fn residuals(&self) -> String {
        let (chi_square, freedom) = (self.fitted.chi_square, self.fitted.degrees_of_freedom as f64);
        format!(
            "chi square {chi_square:.1} for {freedom} degrees of freedom; residuals {} N.m.s rms, --noise {} N.m.s",
            terminal::short(rounded(self.rms_n_m_s())),
            terminal::short(self.requested.deviations.noise_n_m_s)
        )
    }

    /// Warning about residuals that do not fit the noise; `lines` are those of the rows in the telemetry.
    pub(super) fn warning(&self) -> Option<String> {
        if self.fitted.is_overcautious() {
            return Some(
                "warning: less than the noise is left: --noise is too high, or rows are smoothed; the deviations are wider than the \
                 history's"
                    .to_owned(),
            );
        }
        let (row, residual_n_m_s) = self.fitted.worst_row();
        (!self.fitted.is_trusted()).then(|| {
            format!(
                "warning: more than noise is left, chi square {} a degree of freedom, most of it in {}:{}, {} N.m.s: a dump without \
                 dump.count, another attitude, a spacecraft that is not the mission's, or a --noise that is too low; values and \
                 deviations are not to be trusted (trusted = false), and `plan` refuses them",
                terminal::short(rounded(self.fitted.chi_square / self.fitted.degrees_of_freedom.max(1) as f64)),
                self.telemetry,
                self.requested.telemetry.lines.get(row).copied().unwrap_or_default(),
                terminal::short(rounded(residual_n_m_s)),
            )
        })
    }

    /// The table that a mission takes.
    pub(super) fn toml(&self) -> String {
        let [x, y, z] = self.fitted.parameters.center_of_mass_body_m.into();
        let deviations = self.fitted.deviations();
        let mut text = format!(
            "# {} fitted to {} by `heliotorque refit`: for the table [set] of a mission.\n",
            self.mission, self.telemetry
        );
        let _ = writeln!(
            text,
            "# trusted = {}: chi square {:.1} for {} degrees of freedom",
            self.fitted.is_trusted(),
            self.fitted.chi_square,
            self.fitted.degrees_of_freedom
        );
        for it in self.fitted.undetermined() {
            let _ = writeln!(text, "# Not determined, so kept at the mission's values: {}.", self.named(it));
        }
        let [dx, dy, dz, dscale] = deviations.map(|it| Real(rounded(it)));
        let _ = write!(
            text,
            "[set]\n# +- {dx}, {dy}, {dz} m\n\"spacecraft.centerOfMass\" = [{}, {}, {}]\n# +- {dscale}\n\"solar.scale\" = {}\n",
            Float(x),
            Float(y),
            Float(z),
            Float(self.fitted.parameters.solar_scale)
        );
        text
    }
}

/// Parts of a direction in `solar.scale` below which it is one of the centre of mass alone.
const NO_SCALE: f64 = 1e-3;

/// Four significant digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// A number of TOML that is no integer.
struct Float(f64);

impl std::fmt::Display for Float {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", self.0 + 0.0)
    }
}
