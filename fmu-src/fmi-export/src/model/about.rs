//! Facts of a model next to its variables: description, start values by its setup, manual.

/// Facts of a model next to its variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// One or two sentences.
    pub description: String,
    /// Default start, stop and step in s.
    pub start_time_s: f64,
    /// See `start_time_s`.
    pub stop_time_s: f64,
    /// See `start_time_s`.
    pub step_size_s: f64,
    /// Relative tolerance of the results.
    pub tolerance: f64,
    /// Author of the model; empty: not stated.
    pub author: String,
    /// Version of the model; empty: not stated.
    pub version: String,
    /// Holder and year of the copyright; empty: not stated.
    pub copyright: String,
    /// Licence of the model in one line; empty: not stated.
    pub license: String,
    /// The tool that generates the FMU, with its version; empty: this exporter.
    pub tool: String,
    /// The tool that the annotations of variables are for; empty: they are not written.
    pub annotation_tool: String,
}

/// A start value that a setup gives to a variable.
#[derive(Clone, Debug, PartialEq)]
pub struct StartValue {
    /// The key as it stands in the setup, for messages.
    pub key: String,
    /// Line from 1, where it is known.
    pub line: Option<usize>,
    /// The only model that it is for.
    pub model: Option<String>,
    /// Whether the variable is a local constant with this value.
    pub is_fixed: bool,
    /// The variable, or the bare name of a vector or matrix.
    pub name: String,
    /// The value.
    pub value: SetupValue,
}

/// A value as a setup gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum SetupValue {
    /// A number, in the variable's unit.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// True or false.
    Boolean(bool),
    /// A text: a number with its unit, the name of an item, or a String.
    Text(String),
    /// The elements of a vector, or the rows of a matrix.
    List(Vec<Self>),
    /// A value that the setup's reader could not read.
    Refused {
        /// The value found.
        found: String,
        /// The values allowed.
        allowed: String,
    },
}

/// The beginning of a model's manual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Manual {
    /// Purpose of the model, in HTML.
    pub about: &'static str,
    /// A first example in Python, of the FMU `{fmu}`.
    pub example: &'static str,
    /// The same for a loop around the FMU.
    pub closed_loop: &'static str,
    /// Frames and units, in HTML with a drawing.
    pub frames: &'static str,
    /// By what the model computes, in blocks between empty lines: a quantity or the name of a source, then lines with paper
    /// and equation, method or title.
    pub sources: &'static str,
    /// Blocks that several models have: one without lines in `sources` has those that it has here.
    pub shared_sources: &'static str,
}

impl Manual {
    /// Manual of a model that has none.
    pub const NONE: Self =
        Self { about: "", example: "", closed_loop: "", frames: "", sources: "", shared_sources: "" };

    /// Returns each quantity or source that is named, with its paper, method or title.
    pub fn sources(&self) -> impl Iterator<Item = (&'static str, String)> {
        let shared = self.shared_sources;
        blocks(self.sources).map(move |(what, by)| {
            let is_shared = |(known, _): &(&str, String)| by.is_empty() && *known == what;
            blocks(shared).find(is_shared).unwrap_or((what, by))
        })
    }
}

/// First line and joined rest of every block of a text.
fn blocks(text: &'static str) -> impl Iterator<Item = (&'static str, String)> {
    text.split("\n\n").filter_map(|block| {
        let mut lines = block.lines().map(str::trim);
        Some((lines.next()?, lines.collect::<Vec<_>>().join(" ")))
    })
}
