//! The variables of `AllTypes`: every base type in every causality, and every legal role.

use fmi_export::{Boolean, Choice, Enumeration, Integer, Real, RealMatrix, RealVector, Text, Variables};

use super::setup::Setup;

/// A colour; 3 is no item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum Colour {
    /// Not chosen yet.
    None = 0,
    /// Like blood.
    Red = 1,
    /// Like grass.
    Green = 2,
    /// Like the sky.
    Blue = 4,
}

/// The variables of [`super::AllTypes`].
#[derive(Variables)]
#[variables(setup = Setup)]
#[allow(missing_docs, reason = "the groups document themselves")]
pub struct AllTypesVariables {
    #[group]
    pub parameter: ParameterVariables,
    #[group]
    pub tunable: TunableVariables,
    #[group]
    pub input: InputVariables,
    #[group]
    pub output: OutputVariables,
    #[group]
    pub echo: EchoVariables,
    #[group]
    pub role: RoleVariables,
    #[group(count = setup.channel.len())]
    pub channel: Vec<ChannelVariables>,
    #[group]
    pub end: EndVariables,
}

/// Fixed parameters.
#[derive(Variables)]
#[variables(setup = Setup)]
pub struct ParameterVariables {
    /// A fixed Real.
    #[parameter(unit = "m", display = "km", start = 1.5)]
    pub real: Real,
    /// A fixed Integer.
    #[parameter(start = -7, min = -1000, max = 1000)]
    pub integer: Integer,
    /// A fixed Boolean.
    #[parameter(start = true)]
    pub boolean: Boolean,
    /// A fixed String; its start value comes from the setup.
    #[parameter(start = &setup.label)]
    pub text: Text,
    /// A fixed Enumeration.
    #[parameter(start = Colour::Blue)]
    pub choice: Choice<Colour>,
    /// A fixed vector.
    #[parameter(unit = "m", start = [1.0, 2.0, 3.0])]
    pub vector: RealVector<3>,
    /// A fixed matrix.
    #[parameter(unit = "kg.m2", start = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])]
    pub matrix: RealMatrix<2, 3>,
}

/// Tunable parameters.
#[derive(Variables)]
pub struct TunableVariables {
    /// A tunable Real.
    #[parameter(tunable, unit = "kg", min = 0.0, max = 10.0, nominal = 2.0, start = 2.5)]
    pub real: Real,
    /// A tunable Integer.
    #[parameter(tunable, start = 8, min = -10, max = 10)]
    pub integer: Integer,
    /// A tunable Boolean.
    #[parameter(tunable, start = false)]
    pub boolean: Boolean,
    /// A tunable String.
    #[parameter(tunable, start = "naïve café")]
    pub text: Text,
    /// A tunable Enumeration.
    #[parameter(tunable, start = Colour::Green)]
    pub choice: Choice<Colour>,
    /// A tunable vector.
    #[parameter(tunable, unit = "N.m", start = [0.1, 0.2, 0.3])]
    pub vector: RealVector<3>,
    /// A tunable matrix.
    #[parameter(tunable, unit = "1", start = [[0.5; 3]; 2])]
    pub matrix: RealMatrix<2, 3>,
}

/// Inputs.
#[derive(Variables)]
pub struct InputVariables {
    /// Goes to `output.real`, and its time integral to `output.integral`.
    #[input(unit = "m/s", min = -1e6, max = 1e6, start = 0.0)]
    pub real: Real,
    /// Goes to `output.discreteReal`.
    #[input(discrete, unit = "1", start = 0.25)]
    pub discrete_real: Real,
    /// Goes to `output.integer`; below 0 it draws a warning.
    #[input(min = -1000, max = 1000, start = 1)]
    pub integer: Integer,
    /// Goes to `output.boolean`; its rising edge is reported as an event.
    #[input(start = false)]
    pub boolean: Boolean,
    /// Goes to `output.text`.
    #[input(start = "")]
    pub text: Text,
    /// Goes to `output.choice`.
    #[input(start = Colour::Red)]
    pub choice: Choice<Colour>,
    /// Goes to `output.vector`.
    #[input(unit = "N", start = [0.0; 3])]
    pub vector: RealVector<3>,
    /// Goes to `output.matrix`.
    #[input(unit = "rad", display = "deg", start = [[0.0; 3]; 2])]
    pub matrix: RealMatrix<2, 3>,
}

/// Outputs that repeat the inputs.
#[derive(Variables)]
pub struct OutputVariables {
    /// `input.real` at the communication point.
    #[output(unit = "m/s", nominal = 10.0)]
    pub real: Real,
    /// `input.discreteReal`.
    #[output(discrete, unit = "1")]
    pub discrete_real: Real,
    /// `input.integer`.
    #[output]
    pub integer: Integer,
    /// `input.boolean`.
    #[output]
    pub boolean: Boolean,
    /// `input.text`.
    #[output]
    pub text: Text,
    /// `input.choice`.
    #[output]
    pub choice: Choice<Colour>,
    /// `input.vector` at the communication point.
    #[output(unit = "N")]
    pub vector: RealVector<3>,
    /// `input.matrix` at the communication point.
    #[output(unit = "rad", display = "deg")]
    pub matrix: RealMatrix<2, 3>,
    /// Time integral of `input.real` since the start of the experiment.
    #[output(unit = "m")]
    pub integral: Real,
}

/// Outputs that repeat the tunable parameters.
#[derive(Variables)]
pub struct EchoVariables {
    /// `tunable.real`.
    #[output(discrete, unit = "kg")]
    pub real: Real,
    /// `tunable.integer`.
    #[output]
    pub integer: Integer,
    /// `tunable.boolean`.
    #[output]
    pub boolean: Boolean,
    /// `tunable.text`.
    #[output]
    pub text: Text,
    /// `tunable.choice`.
    #[output]
    pub choice: Choice<Colour>,
    /// `tunable.vector`.
    #[output(discrete, unit = "N.m")]
    pub vector: RealVector<3>,
    /// `tunable.matrix`.
    #[output(discrete, unit = "1")]
    pub matrix: RealMatrix<2, 3>,
}

/// The roles that the other groups leave out; what is not calculated keeps its start value.
#[derive(Variables)]
pub struct RoleVariables {
    /// Twice `parameter.real`.
    #[calculated_parameter(unit = "m")]
    pub calculated_fixed: Real,
    /// Twice `tunable.real`.
    #[calculated_parameter(tunable, unit = "kg")]
    pub calculated_tunable: Real,
    /// Thrice `parameter.real`, with a guess.
    #[calculated_parameter(initial = approx, unit = "m", start = 4.0)]
    pub calculated_approx: Real,
    /// A constant output.
    #[output(constant, unit = "1", start = 42.0)]
    pub output_constant: Real,
    /// An output that is exact at the start and counts steps from there.
    #[output(initial = exact, start = 100)]
    pub output_exact: Integer,
    /// An output with a guess: time since the start of the experiment.
    #[output(initial = approx, unit = "s", start = 0.5)]
    pub output_approx: Real,
    /// A constant local.
    #[local(constant, start = "constant")]
    pub local_constant: Text,
    /// A fixed local: `parameter.integer` + 1.
    #[local(fixed)]
    pub local_fixed: Integer,
    /// A tunable local: not `tunable.boolean`.
    #[local(tunable)]
    pub local_tunable: Boolean,
    /// A discrete local: steps so far.
    #[local(discrete)]
    pub local_discrete: Integer,
    /// A continuous local: half of `output.real`.
    #[local(unit = "m/s")]
    pub local_continuous: Real,
    /// A continuous local that is exact at the start and stays there.
    #[local(initial = exact, unit = "1", start = 9.0)]
    pub local_exact: Real,
}

/// One channel of the setup.
#[derive(Variables)]
#[variables(setup = Setup)]
pub struct ChannelVariables {
    /// Number of the channel.
    #[parameter(start = i32::try_from(index).unwrap_or(i32::MAX).saturating_add(1))]
    pub number: Integer,
    /// Output over input; any finite number, so that their product need not be one.
    #[parameter(tunable, unit = "1", min = f64::MIN, max = f64::MAX, start = setup.channel[index].gain)]
    pub gain: Real,
    /// Input of the channel.
    #[input(unit = "m", min = f64::MIN, max = f64::MAX, start = 1.0)]
    pub input: Real,
    /// Gain times input, at the communication point.
    #[output(unit = "m")]
    pub output: Real,
}

/// The model ends by itself.
#[derive(Variables)]
pub struct EndVariables {
    /// A step beyond this time ends there, and the simulation with it.
    #[parameter(tunable, unit = "s", start = 1e6)]
    pub time: Real,
}
