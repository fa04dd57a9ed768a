//! `initial` and `start` by causality and variability (2.2.7, tables of pages 48 and 49).

use crate::{Causality, Initial, ScalarVariable, Variability, value};

/// Values of `initial` for one pair of causality and variability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InitialRule {
    /// Meaning of an absent `initial`; `None` where the attribute must be absent.
    pub default: Option<Initial>,
    /// Values that may be written; empty where the attribute must be absent.
    pub allowed: &'static [Initial],
}

/// One legal pair of causality and variability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InitialRow {
    /// Causality.
    pub causality: Causality,
    /// Variability.
    pub variability: Variability,
    /// Values of `initial` of this pair.
    pub rule: InitialRule,
}

/// Whether a start value must or must not stand in the XML.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartRule {
    /// Must be given.
    Required,
    /// Must not be given.
    Forbidden,
}

/// Every legal pair; a pair that is not here is forbidden.
pub const INITIAL_TABLE: &[InitialRow] = {
    use Causality as C;
    use Variability as V;
    &[
        row(C::Parameter, V::Fixed, EXACT),
        row(C::Parameter, V::Tunable, EXACT),
        row(C::CalculatedParameter, V::Fixed, CALCULATED_OR_APPROX),
        row(C::CalculatedParameter, V::Tunable, CALCULATED_OR_APPROX),
        row(C::Input, V::Discrete, ABSENT),
        row(C::Input, V::Continuous, ABSENT),
        row(C::Output, V::Constant, EXACT),
        row(C::Output, V::Discrete, ANY),
        row(C::Output, V::Continuous, ANY),
        row(C::Local, V::Constant, EXACT),
        row(C::Local, V::Fixed, CALCULATED_OR_APPROX),
        row(C::Local, V::Tunable, CALCULATED_OR_APPROX),
        row(C::Local, V::Discrete, ANY),
        row(C::Local, V::Continuous, ANY),
        row(C::Independent, V::Continuous, ABSENT),
    ]
};

const EXACT: InitialRule = InitialRule { default: Some(Initial::Exact), allowed: &[Initial::Exact] };
const CALCULATED_OR_APPROX: InitialRule =
    InitialRule { default: Some(Initial::Calculated), allowed: &[Initial::Approx, Initial::Calculated] };
const ANY: InitialRule = InitialRule {
    default: Some(Initial::Calculated),
    allowed: &[Initial::Exact, Initial::Approx, Initial::Calculated],
};
const ABSENT: InitialRule = InitialRule { default: None, allowed: &[] };

const fn row(causality: Causality, variability: Variability, rule: InitialRule) -> InitialRow {
    InitialRow { causality, variability, rule }
}

/// The rule for a pair, or `None` where the standard forbids the pair.
pub fn initial(causality: Causality, variability: Variability) -> Option<InitialRule> {
    INITIAL_TABLE
        .iter()
        .find(|row| row.causality == causality && row.variability == variability)
        .map(|row| row.rule)
}

/// The variabilities a causality may have.
pub fn legal_variabilities(causality: Causality) -> impl Iterator<Item = Variability> {
    INITIAL_TABLE.iter().filter(move |row| row.causality == causality).map(|row| row.variability)
}

/// The `initial` that holds: the written one, else the table's default; `None` for inputs, the independent
/// variable and forbidden pairs.
pub fn effective(
    causality: Causality,
    variability: Variability,
    written: Option<Initial>,
) -> Option<Initial> {
    let rule = initial(causality, variability)?;
    rule.default.map(|default| written.unwrap_or(default))
}

/// [`effective`] of a variable.
pub fn effective_initial(variable: &ScalarVariable) -> Option<Initial> {
    effective(variable.causality, variable.variability, variable.initial)
}

/// The rule for `start`: required with exact, approx and inputs, forbidden with calculated and independent.
/// `effective` is the result of [`effective`]; a forbidden pair counts as forbidden.
pub fn start(causality: Causality, effective: Option<Initial>) -> StartRule {
    match (causality, effective) {
        (Causality::Input, _) | (_, Some(Initial::Exact | Initial::Approx)) => StartRule::Required,
        _ => StartRule::Forbidden,
    }
}

/// Whether the variable must carry a start value; where it need not, it must not.
pub fn start_required(variable: &ScalarVariable) -> bool {
    start(variable.causality, effective_initial(variable)) == StartRule::Required
}

/// Whether the variable carries a start value.
pub fn has_start(variable: &ScalarVariable) -> bool {
    value::start(variable).is_some()
}

/// Part of a declaration that does not fit the standard's tables, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RoleFault {
    /// Causality, variability and initial do not fit each other or the type.
    Role(String),
    /// There is no start value, and there must be one.
    StartMissing(&'static str),
    /// There is a start value, and there must be none.
    StartForbidden(&'static str),
}

/// Checks the causality, variability, initial and start value of a declaration; only a Real may be continuous.
pub fn check_role(
    causality: Causality,
    variability: Variability,
    written: Option<Initial>,
    is_real: bool,
    has_start: bool,
) -> Result<(), RoleFault> {
    if variability == Variability::Continuous && !is_real {
        return Err(RoleFault::Role("only a Real can be continuous".to_owned()));
    }
    let Some(rule) = initial(causality, variability) else {
        let allowed = listed(legal_variabilities(causality).map(Variability::as_str));
        return Err(RoleFault::Role(format!("{causality} cannot be {variability}; allowed: {allowed}")));
    };
    if let Some(written) = written.filter(|written| !rule.allowed.contains(written)) {
        let allowed = listed(rule.allowed.iter().map(|initial| initial.as_str()));
        return Err(RoleFault::Role(format!(
            "{variability} {causality} cannot have initial {written}; allowed: {allowed}"
        )));
    }
    match start(causality, effective(causality, variability, written)) {
        StartRule::Required if !has_start => Err(RoleFault::StartMissing("needs a start value")),
        StartRule::Forbidden if has_start => {
            Err(RoleFault::StartForbidden("is calculated and cannot have a start value"))
        }
        _ => Ok(()),
    }
}

/// Words with commas between, or `none`.
pub fn listed<'a>(words: impl Iterator<Item = &'a str>) -> String {
    let words: Vec<_> = words.collect();
    if words.is_empty() { "none".to_owned() } else { words.join(", ") }
}
