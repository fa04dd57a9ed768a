//! Options of `heliotorque ephemeris`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use inputs::{
    epoch::{DAY_S, date_option},
    values::{positive, span},
};
use planner::ephemeris::{EphemerisRequest, OnboardTarget};

use super::kernel_options::KernelOptions;
use crate::patience::Reader;

/// Shown with the help.
const EXAMPLE: &str = "\
Example:
  heliotorque ephemeris --start '2011-04-06 UTC' --stop '2011-07-06 UTC'       Sun and Earth from Mercury, to 100 m
  heliotorque ephemeris --start '2011-04-06 UTC' --stop '2011-07-06 UTC' --bodies sun,earth,spacecraft \\
      --tolerance 10 --coarse --coarse-until '2015-04-30 UTC' --output messenger-ephemeris.toml
  heliotorque check messenger-ephemeris.toml                                   bodies, spans and errors
  heliotorque pack --template dist/Guidance.fmu --ephemeris messenger-ephemeris.toml \\
      --set ephemeris.source=chebyshev --set 'start.epoch=2011-04-06 UTC'      uses it, from within its span";

/// `heliotorque ephemeris`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Ephemeris {
    #[command(flatten)]
    pub kernels: KernelOptions,
    /// First epoch, a date: '2011-04-06T00:00:00 UTC'
    #[arg(long, value_name = "DATE")]
    pub start: String,
    /// Last epoch, likewise
    #[arg(long, value_name = "DATE")]
    pub stop: String,
    /// What is fitted: sun, mercury, venus, earth, mars, jupiter, spacecraft, and with --kernel moon
    #[arg(
        long,
        value_enum,
        value_name = "BODIES",
        value_delimiter = ',',
        default_values_t = [BodyKind::Sun, BodyKind::Earth],
        hide_possible_values = true
    )]
    pub bodies: Vec<BodyKind>,
    /// Greatest error of position, in m or with a unit: the degree, and without --segment the length of the segments, follow from it
    #[arg(long, value_name = "M", value_parser = tolerance, default_value = "100", conflicts_with = "degree")]
    pub tolerance: f64,
    /// Length of the segments, in s or with a unit: 4d; otherwise as --tolerance asks, 8d with --degree
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub segment: Option<f64>,
    /// Degree of the polynomials, 1 to 24; the error is reported, and may be any
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=24))]
    pub degree: Option<u8>,
    /// Add the coarse models: polynomials of fourth degree of Keplerian elements, of the planet, the Earth, and of the
    /// spacecraft if it is among the bodies
    #[arg(long)]
    pub coarse: bool,
    /// Last epoch of the coarse models, a date; otherwise --stop
    #[arg(long, value_name = "DATE", requires = "coarse")]
    pub coarse_until: Option<String>,
    /// Set a parameter of the FMU before it is simulated; repeatable, written as for `run`: orbit.center=venus
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// The file to write; otherwise ephemeris.toml, in this folder; - is the standard output
    #[arg(long, short, value_name = "TOML")]
    pub output: Option<PathBuf>,
    /// Show no progress and no report
    #[arg(long, short)]
    pub quiet: bool,
    /// The library that reads the file
    #[command(flatten)]
    pub reader: Reader,
}

/// `--bodies`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BodyKind {
    /// The Sun
    #[value(alias = "10")]
    Sun,
    /// Mercury
    #[value(alias = "199")]
    Mercury,
    /// Venus
    #[value(alias = "299")]
    Venus,
    /// The Earth
    #[value(alias = "399")]
    Earth,
    /// The Moon
    #[value(alias = "301")]
    Moon,
    /// Mars
    #[value(alias = "499")]
    Mars,
    /// Jupiter
    #[value(alias = "599")]
    Jupiter,
    /// The spacecraft
    Spacecraft,
}

/// Longest span, in years: what is fitted is in memory whole.
const MAX_YEARS: f64 = 100.0;

fn check_span(option: &str, written: &str, span_s: f64) -> Result<(), String> {
    let years = span_s / (365.25 * DAY_S);
    let is_allowed = years <= MAX_YEARS;
    is_allowed.then_some(()).ok_or_else(|| {
        format!("{option}: found {written:?}, {years:.0} years after --start, allowed: up to {MAX_YEARS}")
    })
}

impl Ephemeris {
    /// The FMU that is simulated.
    pub(crate) fn simulated(&self) -> PathBuf {
        self.reader.or_shipped()
    }

    /// The files it reads.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        if self.kernels.is_given() {
            return self.kernels.kernel.clone();
        }
        vec![self.simulated()]
    }

    /// The request without the command line.
    ///
    /// # Errors
    /// Dates that are none or out of order.
    pub(crate) fn request(&self) -> Result<EphemerisRequest, String> {
        let span_s = self.span_s()?;
        let coarse_until_s = self.coarse.then(|| self.coarse_until_s(span_s[1])).transpose()?;
        let kernels = &self.kernels;
        Ok(EphemerisRequest {
            fmu: self.simulated(),
            set: self.set.clone(),
            kernels: kernels.kernel.clone(),
            center: kernels.center,
            spacecraft: kernels.spacecraft,
            targets: self.targets(),
            span_s,
            coarse_until_s,
            segment_s: self.segment,
            degree: self.degree.map(usize::from),
            tolerance_m: self.tolerance,
            is_quiet: self.quiet,
        })
    }

    /// First and last epoch, in s past J2000 TDB.
    fn span_s(&self) -> Result<[f64; 2], String> {
        let start_s = date_option("--start", &self.start)?;
        let stop_s = date_option("--stop", &self.stop)?;
        if stop_s <= start_s {
            return Err(format!(
                "--stop: found {:?}, allowed: a date after --start, {:?}",
                self.stop, self.start
            ));
        }
        check_span("--stop", &self.stop, stop_s - start_s)?;
        Ok([start_s, stop_s])
    }

    /// Last epoch of the coarse models.
    fn coarse_until_s(&self, stop_s: f64) -> Result<f64, String> {
        let Some(written) = &self.coarse_until else { return Ok(stop_s) };
        let until_s = date_option("--coarse-until", written)?;
        if until_s < stop_s {
            return Err(format!(
                "--coarse-until: found {written:?}, allowed: a date not before --stop, {:?}",
                self.stop
            ));
        }
        check_span("--coarse-until", written, until_s - date_option("--start", &self.start)?)?;
        Ok(until_s)
    }

    /// Bodies that are fitted, each once.
    fn targets(&self) -> Vec<OnboardTarget> {
        let mut targets = Vec::new();
        for kind in &self.bodies {
            let target = match kind {
                BodyKind::Sun => OnboardTarget::Sun,
                BodyKind::Mercury => OnboardTarget::Mercury,
                BodyKind::Venus => OnboardTarget::Venus,
                BodyKind::Earth => OnboardTarget::Earth,
                BodyKind::Moon => OnboardTarget::Moon,
                BodyKind::Mars => OnboardTarget::Mars,
                BodyKind::Jupiter => OnboardTarget::Jupiter,
                BodyKind::Spacecraft => OnboardTarget::Spacecraft,
            };
            if !targets.contains(&target) {
                targets.push(target);
            }
        }
        targets
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    positive(text, "m")
}
