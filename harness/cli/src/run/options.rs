//! Options of `heliotorque run`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use inputs::values::{Instant, duration, instant, number, span};
use systems::{FirstExchange, Master};

/// Shown with the help.
const EXAMPLE: &str = "\
Example:
  heliotorque run dist/MomentumPlant.fmu --stop 10d --record 'momentum.body*' --output momentum.csv --output momentum.svg
  heliotorque run dist/MessengerLoop.ssp --stop 1d --record plant.attitude.q --output loop.csv
  heliotorque new mission mission.toml && heliotorque run mission.toml";

/// `heliotorque run`.
#[derive(Clone, Debug, Default, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Run {
    /// The FMU, an .fmu file or the folder it was unpacked into; a system, an .ssp file, whose variables are named
    /// component.variable; or a mission, a .toml file (see `heliotorque new mission`), whose values the options replace
    pub fmu: PathBuf,
    /// Start time, in s or with a unit (s, min, h, d, a); otherwise the FMU's default
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    pub start: Option<f64>,
    /// Stop time, in s or with a unit: 90d; or a date ('2011-04-16T00:00:00 UTC'), which start.epoch is counted to; otherwise the
    /// FMU's default
    #[arg(long, value_name = "TIME", value_parser = instant, allow_hyphen_values = true)]
    pub stop: Option<Instant>,
    /// Communication step, in s or with a unit: 10min; otherwise the FMU's default
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// Set a parameter, input or start value; repeatable. Takes units ('spacecraft.centerOfMass[3]=-2.54cm'),
    /// names of options (attitude.source=guided), whole vectors (dump.threshold=4,4,4; one value is that of every element), dates for epochs
    /// and times ('start.epoch=2011-04-06T00:00:00 UTC', burn.start, guided.downlinkStart)
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// For a system: jacobi, all components take the outputs of the step's beginning; or gaussSeidel, one after another,
    /// each takes what those before it gave at the step's end; otherwise jacobi
    #[arg(long, value_enum, hide_possible_values = true)]
    pub master: Option<MasterKind>,
    /// For a system: what connected outputs count as in the first step, initial (what they are) or zeros (0, as for FMPy);
    /// otherwise initial
    #[arg(long, value_enum, value_name = "VALUES", hide_possible_values = true)]
    pub first_exchange: Option<FirstExchangeKind>,
    /// Inputs over time, a CSV file: time,<input>,... with one row per time in s. Between rows attitudes turn, by their rate
    /// where it stands beside, angles take the nearest turn, positions follow their velocities, other continuous inputs are
    /// linear and discrete ones held; two rows at one time make a jump; - is the standard input
    #[arg(long, value_name = "CSV")]
    pub input: Option<PathBuf>,
    /// Hand the slopes of the input table to the FMU too, so that inputs do not jump from step to step
    #[arg(long, requires = "input")]
    pub slopes: bool,
    /// Record these variables: names, vectors, patterns with * such as 'plate*.force', which take outputs only; otherwise
    /// every output
    #[arg(long, value_name = "NAMES")]
    pub record: Vec<String>,
    /// Record the step nearest to each multiple of this time, in s or with a unit, and the last one; otherwise every step
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Write what is recorded, by the file's ending: .csv, the table; .svg, a picture; repeatable; - is CSV on the standard output.
    /// Until the run is complete the table is <CSV>.part; it stays if the FMU fails, crashes or hangs. Beside it stands
    /// <CSV>.toml: units, epoch, FMU, GUID, values, versions
    #[arg(long, short, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// For a mission with a spacecraft only: the FMU whose library shall simulate it, as for `pack`; otherwise the installed
    /// program's own, or dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Longest time an FMI call may take, in s or with a unit; otherwise without bound
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub timeout: Option<f64>,
    /// Tolerance that the FMU is given for its solver; otherwise that of its default experiment
    #[arg(long, value_name = "NUMBER", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// Write every FMI call with its times and its status to this file, a line each, also the one that never returns
    #[arg(long, value_name = "FILE")]
    pub log_calls: Option<PathBuf>,
    /// Show the FMU's log
    #[arg(long)]
    pub log: bool,
    /// Show no progress bar and no summary
    #[arg(long, short)]
    pub quiet: bool,
}

impl Run {
    /// The request without the command line.
    pub(crate) fn request(&self) -> campaign::run::Run {
        let it = self.clone();
        campaign::run::Run {
            fmu: it.fmu,
            origin: None,
            start: it.start,
            stop: it.stop,
            step: it.step,
            set: it.set,
            master: it.master.map(MasterKind::master),
            first_exchange: it.first_exchange.map(FirstExchangeKind::exchange),
            input: it.input,
            slopes: it.slopes,
            record: it.record,
            every: it.every,
            output: it.output,
            template: it.template,
            timeout: it.timeout,
            tolerance: it.tolerance,
            log_calls: it.log_calls,
            log: it.log,
            quiet: it.quiet,
        }
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    number(text, |tolerance| tolerance > 0.0, "a number above 0: 1e-8")
}

/// `--master`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum MasterKind {
    /// All components take the values of the step's beginning
    #[value(name = "jacobi")]
    Jacobi,
    /// Each component takes what those before it gave at the step's end
    #[value(name = "gaussSeidel")]
    GaussSeidel,
}

impl MasterKind {
    fn master(self) -> Master {
        match self {
            Self::Jacobi => Master::Jacobi,
            Self::GaussSeidel => Master::GaussSeidel,
        }
    }
}

/// `--first-exchange`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum FirstExchangeKind {
    /// The outputs at the start
    Initial,
    /// Zero, as for FMPy
    Zeros,
}

impl FirstExchangeKind {
    fn exchange(self) -> FirstExchange {
        match self {
            Self::Initial => FirstExchange::Initial,
            Self::Zeros => FirstExchange::Zeros,
        }
    }
}
