//! The command line's flags and their help.

use std::{ffi::OsString, path::PathBuf};

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::{
    patience::Patience,
    values::{duration, span},
};

const PACK_EXAMPLE: &str = "\
Example:
  heliotorque check my.toml                                  what is wrong with it, by line
  heliotorque pack --spacecraft my.toml --name MyCraft       writes MyCraft.fmu";

const RUN_EXAMPLE: &str = "\
Example:
  heliotorque run dist/MomentumPlant.fmu --stop 10d --record 'momentum.body*' --plot momentum.svg
  heliotorque run dist/MessengerLoop.ssp --stop 1d --record plant.attitude.q --output loop.csv
  heliotorque new mission mission.toml && heliotorque run mission.toml";

const WIRE_EXAMPLE: &str = "\
Example:
  heliotorque wire guidance=dist/Guidance.fmu plant=MyCraft.fmu > loop.ssp
  heliotorque run loop.ssp --stop 1d --set plant.attitude.source=commanded";

const COMPLETIONS_EXAMPLE: &str = "\
Example:
  heliotorque completions bash > ~/.local/share/bash-completion/completions/heliotorque
  heliotorque completions zsh > ~/.zfunc/_heliotorque        with fpath+=~/.zfunc before compinit in ~/.zshrc
  heliotorque completions fish > ~/.config/fish/completions/heliotorque.fish";

/// Spacecraft disturbance torque and momentum as FMUs: show, check and simulate them, pack your own.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Show what an FMU is, what it takes and gives, and what its sunshade and wheels come to; or what a system joins
    Info(Info),
    /// Check an FMU, a system, or a spacecraft before it is packed: what is wrong, what it comes to, what looks odd
    Check(Check),
    /// Run an FMU, a system of FMUs (SSP) or a mission from start to stop
    #[command(after_help = RUN_EXAMPLE)]
    Run(Run),
    /// Connect FMUs by the names and units of their variables: a system (SSP) that any tool for SSP runs
    #[command(after_help = WIRE_EXAMPLE)]
    Wire(Wire),
    /// Write a commented file that works unchanged: spacecraft, spinner, mission or timeline
    New(crate::new::New),
    /// Draw a spacecraft's file: front, side, top and perspective, with axes, Sun, names, centre of mass, panel axes
    Draw(crate::draw::options::Draw),
    /// Map the torque of sunlight over the Sun's azimuth and elevation: where it vanishes, what a degree is worth, what
    /// downlinks can undo
    Map(crate::map::options::Map),
    /// Make an FMU of your own spacecraft; nothing is compiled
    #[command(after_help = PACK_EXAMPLE)]
    Pack(Pack),
    /// Fit the positions of an FMU's flight: an ephemeris that spacecraft carry, with its error
    Ephemeris(crate::ephemeris::options::Ephemeris),
    /// Print the JSON Schema of a file, for editors that complete and check TOML
    Schema(Schema),
    /// Run a study of the papers, or list them
    Study(Study),
    /// Find an optimal plan
    #[command(subcommand)]
    Plan(Plan),
    /// Print what a shell needs to complete commands and options
    #[command(after_help = COMPLETIONS_EXAMPLE)]
    Completions(Completions),
    /// Print the manual's page of the program or of a command
    Man(Manual),
    /// Runs one probe of `check` in a process of its own
    #[command(hide = true, name = "probe-in-child")]
    Probe(Probe),
    /// Runs an FMU for `run` in a process of its own
    #[command(hide = true)]
    RunInChild(RunInChild),
    /// Carries out a command that loads a library in a process of its own
    #[command(hide = true)]
    InChild(InChild),
    /// Puts the FMU of a mission's files together for `run`
    #[command(hide = true)]
    Assemble(Assemble),
}

/// `heliotorque in-child`.
#[derive(Debug, Args)]
pub struct InChild {
    /// Columns of the terminal that shows the output
    #[arg(long)]
    pub output_columns: Option<u16>,
    /// Columns of the terminal that shows notes
    #[arg(long)]
    pub note_columns: Option<u16>,
    /// The command
    #[arg(last = true)]
    pub arguments: Vec<OsString>,
}

/// `heliotorque assemble`.
#[derive(Debug, Args)]
pub struct Assemble {
    /// The mission
    pub mission: PathBuf,
    /// The FMU whose library reads its files
    #[arg(long)]
    pub template: Option<PathBuf>,
    /// An empty folder, which becomes the FMU's
    #[arg(long)]
    pub into: PathBuf,
}

/// `heliotorque info`.
#[derive(Debug, Args)]
pub struct Info {
    /// The FMU, an .fmu file or the folder it was unpacked into; or a system, an .ssp file
    pub fmu: PathBuf,
    /// List the variables too
    #[arg(long)]
    pub variables: bool,
    /// Show only these variables and the options they take: names, vectors, patterns with *
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Show what the FMU computes from its parameters: the sunshade's torque coefficients, torque and force by source at
    /// the start, what the wheels guarantee
    #[arg(long, conflicts_with_all = ["variables", "only"])]
    pub coefficients: bool,
    /// Set a parameter before --coefficients; repeatable, written as for `run`: sunshade.shape=cylinder,
    /// 'spacecraft.centerOfMass[3]=-2.54cm'
    #[arg(long, value_name = "NAME=VALUE", requires = "coefficients")]
    pub set: Vec<String>,
    /// How long --coefficients waits
    #[command(flatten)]
    pub patience: Patience,
}

/// `heliotorque check`.
#[derive(Debug, Args)]
pub struct Check {
    /// The FMU, an .fmu file or the folder it was unpacked into; a system, an .ssp file; a spacecraft, a mission, a timeline or
    /// an ephemeris, a .toml file
    pub subject: PathBuf,
    /// For a spacecraft or a mission only: the FMU whose library shall read it, as for `pack`; otherwise the installed
    /// program's own, or dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// For an FMU only: check what can be read, without running it
    #[arg(long = "static")]
    pub is_static: bool,
    /// For an FMU only: run the probes whose name contains this text
    #[arg(long, value_name = "TEXT", conflicts_with = "is_static")]
    pub only: Option<String>,
    /// Longest time that the whole of it may take, in s or with a unit; what it does not come to then is skipped
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true, default_value = "2min")]
    pub timeout: f64,
    /// Show every check, not only the findings
    #[arg(long, short)]
    pub verbose: bool,
}

/// `heliotorque schema`.
#[derive(Debug, Args)]
pub struct Schema {
    /// Of which kind of file: spacecraft; spinner, which SpinPlant is packed with; mission, which `run` flies; timeline, which `pack --timeline` takes; or ephemeris, which `pack --ephemeris` takes
    #[arg(value_enum, default_value_t, hide_possible_values = true)]
    pub kind: SchemaKind,
}

/// `heliotorque completions`.
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    pub shell: Shell,
}

/// `heliotorque man`.
#[derive(Debug, Args)]
pub struct Manual {
    /// The command whose page it is, plan-spin for one below another; otherwise the program's
    pub command: Option<String>,
    /// Write every page into this folder instead: heliotorque.1, heliotorque-run.1, ...
    #[arg(long, value_name = "FOLDER", conflicts_with = "command")]
    pub output: Option<PathBuf>,
}

/// A kind of file that has a schema.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum SchemaKind {
    /// A spacecraft.
    #[default]
    Spacecraft,
    /// A spin-stabilised spacecraft.
    Spinner,
    /// A flight.
    Mission,
    /// Commands over time.
    Timeline,
    /// Positions over time.
    Ephemeris,
}

/// `heliotorque probe-in-child`.
#[derive(Debug, Args)]
pub struct Probe {
    /// The FMU
    pub fmu: PathBuf,
    /// The probe
    pub name: String,
}

/// `heliotorque run-in-child`.
#[derive(Debug, Args)]
pub struct RunInChild {
    /// The folder that the FMU was unpacked into
    #[arg(long)]
    pub unpacked_in: PathBuf,
    /// What the parent read from the standard input
    #[arg(long)]
    pub input_copy: Option<PathBuf>,
    /// What the parent was given
    #[command(flatten)]
    pub run: Run,
}

/// `heliotorque run`.
#[derive(Clone, Debug, Default, Args)]
pub struct Run {
    /// The FMU, an .fmu file or the folder it was unpacked into; a system, an .ssp file, whose variables are named
    /// component.variable; or a mission, a .toml file (see `heliotorque new mission`), whose values the options replace
    pub fmu: PathBuf,
    /// Start time, in s or with a unit (s, min, h, d); otherwise the FMU's default
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    pub start: Option<f64>,
    /// Stop time, in s or with a unit: 90d; otherwise the FMU's default
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    pub stop: Option<f64>,
    /// Communication step, in s or with a unit: 10min; otherwise the FMU's default
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// Set a parameter, input or start value; repeatable. Takes units ('spacecraft.centerOfMass[3]=-2.54cm'),
    /// names of options (attitude.source=guided), whole vectors (dump.threshold=4,4,4), dates for epochs
    /// ('start.epoch=2011-04-06T00:00:00 UTC')
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
    /// Inputs over time, a CSV file: time,<input>,... with one row per time in s. Between rows continuous inputs are
    /// interpolated linearly and discrete ones held; two rows at one time make a jump; - is the standard input
    #[arg(long, value_name = "CSV")]
    pub input: Option<PathBuf>,
    /// Hand the slopes of the input table to the FMU too, so that inputs do not jump from step to step
    #[arg(long, requires = "input")]
    pub slopes: bool,
    /// Record these variables: names, vectors, patterns with * such as 'plate*.force', which take outputs only; otherwise
    /// every output
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub record: Vec<String>,
    /// Record the step nearest to each multiple of this time, in s or with a unit, and the last one; otherwise every step
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Write what is recorded as CSV; - is the standard output. Until the run is complete the file is <CSV>.part; it
    /// stays if the FMU fails, crashes or hangs
    #[arg(long, value_name = "CSV")]
    pub output: Option<PathBuf>,
    /// Draw what was recorded as SVG; - is the standard output
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
    /// For a mission with a spacecraft only: the FMU whose library shall fly it, as for `pack`; otherwise the installed
    /// program's own, or dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Longest time an FMI call may take, in s or with a unit; otherwise without bound
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub timeout: Option<f64>,
    /// Show the FMU's log
    #[arg(long)]
    pub log: bool,
    /// Show no progress bar and no summary
    #[arg(long, short)]
    pub quiet: bool,
}

impl Run {
    /// Of a file, without any option.
    pub fn of(fmu: PathBuf, template: Option<PathBuf>) -> Self {
        Self { fmu, template, ..Self::default() }
    }
}

/// `--master`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum MasterKind {
    /// All components take the values of the step's beginning
    #[value(name = "jacobi")]
    Jacobi,
    /// Each component takes what those before it gave at the step's end
    #[value(name = "gaussSeidel")]
    GaussSeidel,
}

/// `--first-exchange`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum FirstExchangeKind {
    /// The outputs at the start
    Initial,
    /// Zero, as for FMPy
    Zeros,
}

/// `heliotorque wire`.
#[derive(Debug, Args)]
pub struct Wire {
    /// The FMUs, in the order in which they step: A.fmu is component a, or name=A.fmu
    #[arg(required = true, num_args = 1.., value_name = "FMU")]
    pub fmus: Vec<String>,
    /// List these outputs too, for tools that show only connectors: component.variable, vectors, patterns with *
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub outputs: Vec<String>,
    /// Make these connectors of the system too, by names such as attitude_q_1: outputs, open inputs, parameters. FMPy sets connected
    /// inputs to 0 where it is given nothing; libcosim refuses systems with such connectors
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub export: Vec<String>,
    /// Leave enumerations open, for tools that cannot connect them, and say what each stands at
    #[arg(long)]
    pub without_enumerations: bool,
    /// Give a parameter of a component a value, in a parameter set of the component; repeatable, written as for `run`:
    /// plant.dump.threshold=4,4,4
    #[arg(long, value_name = "COMPONENT.NAME=VALUE")]
    pub set: Vec<String>,
    /// Name of the system; otherwise the file's
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Stop time of the default experiment, in s or with a unit: 1d; otherwise the earliest of the FMUs
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    pub stop: Option<f64>,
    /// Communication step of the default experiment, in s or with a unit; otherwise the smallest of the FMUs
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// The SSP to write; otherwise, and for -, the standard output, where that is no terminal
    #[arg(long, short, value_name = "SSP")]
    pub output: Option<PathBuf>,
    /// Say nothing of what was connected and left open
    #[arg(long, short)]
    pub quiet: bool,
}

/// `heliotorque pack`.
#[derive(Debug, Args)]
pub struct Pack {
    /// The spacecraft, a TOML file (see `heliotorque schema` and `heliotorque check`); otherwise the one compiled into
    /// the library
    #[arg(long, value_name = "TOML")]
    pub spacecraft: Option<PathBuf>,
    /// Commands over time, a TOML file (see `heliotorque schema timeline`), for models that take one; the GUID stays
    #[arg(long, value_name = "TOML")]
    pub timeline: Option<PathBuf>,
    /// Positions of Sun, Earth and planets over time, a TOML file (see `heliotorque ephemeris`), for models that take one;
    /// read where ephemeris.source is chebyshev or coarse; the GUID stays
    #[arg(long, value_name = "TOML")]
    pub ephemeris: Option<PathBuf>,
    /// Take spacecraft, model, timeline, ephemeris, start values and times of a mission, a TOML file; other options win
    #[arg(long, value_name = "TOML")]
    pub mission: Option<PathBuf>,
    /// Add outputs of every plate: plate[k].temperature and plate[k].force[i], as with `per_plate_outputs = true` in the
    /// spacecraft's file; for models that have them: MomentumPlant, DisturbanceTorque
    #[arg(long)]
    pub per_plate: bool,
    /// Give a parameter or input another start value, in the `[start]` of the packed file; repeatable, written as for
    /// `run`: attitude.source=commanded, dump.threshold=4,4,4
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Make a parameter or input a local constant of this FMU, in the `[fixed]` of the packed file; repeatable, written as for
    /// --set. Dependencies are those of that choice: attitude.source=controlled
    #[arg(long, value_name = "NAME=VALUE")]
    pub fix: Vec<String>,
    /// Name of the new FMU, a C identifier; otherwise the model's
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Take libraries and licences from this FMU; otherwise the installed program's own, or dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Take this shared library, just built, instead of a template's
    #[arg(long, value_name = "FILE", conflicts_with = "template", requires = "model")]
    pub library: Option<PathBuf>,
    /// The model: MomentumPlant, ...; otherwise the template's or MomentumPlant, where it takes the file, or the one that does:
    /// SpinPlant for a spinner's
    #[arg(long, value_name = "MODEL")]
    pub model: Option<String>,
    /// The FMU to write; otherwise its name with .fmu, in this folder; - is the standard output
    #[arg(long, short, value_name = "FMU")]
    pub output: Option<PathBuf>,
    /// How long it waits
    #[command(flatten)]
    pub patience: Patience,
}

/// `heliotorque plan`.
#[derive(Debug, Subcommand)]
pub enum Plan {
    /// The train of thruster pulses that turns a spinner with the least nutation
    #[command(mut_args = |argument| if argument.is_positional() { argument } else { argument.allow_hyphen_values(true) })]
    Spin(SpinPlan),
}

/// `heliotorque plan spin`.
#[derive(Clone, Debug, Args)]
pub struct SpinPlan {
    /// What is planned
    #[command(flatten)]
    pub options: planner::spin::Options,
    /// How long the FMU is waited for
    #[command(flatten)]
    pub patience: Patience,
}

/// `heliotorque study`.
#[derive(Debug, Args)]
pub struct Study {
    /// The study, or `list`
    pub name: String,
    /// Folder with the FMUs; otherwise the installed program's, or dist
    #[arg(long, value_name = "FOLDER")]
    pub dist: Option<PathBuf>,
    /// Folder for CSV files and pictures; otherwise <study> in the folder of --dist, for an installed program in this one
    #[arg(long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Run only the cases whose label contains this text
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
    /// Angle of the slews of control/slew, in deg or rad: 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    pub angle: Option<f64>,
    /// Communication step of control/*, in s or with a unit: 20ms; otherwise 0.5 s for slews and 1 s for the loop with
    /// Guidance
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// Show no progress
    #[arg(long, short)]
    pub quiet: bool,
    /// How long an FMU is waited for
    #[command(flatten)]
    pub patience: Patience,
}

/// A turn with its unit, in rad; none and more than half a turn are refused.
fn angle(text: &str) -> Result<f64, String> {
    match crate::draw::options::angle(text)? {
        angle_rad if angle_rad != 0.0 && angle_rad.abs() < core::f64::consts::PI => Ok(angle_rad),
        _ => Err("allowed is more than 0 and less than 180 deg either way".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_well_formed() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }
}
