//! Start values that a setup gives to parameters and inputs: found by name, converted, checked, set.
//!
//! A setup may serve several models of a library. A start value without a model is for each of them that has the
//! variable; it is an error if none has it. Later wins: the declared start value, a vector under its bare name, one of
//! its elements, the same two for this model alone. What is fixed goes before all these, and is a local constant.

use std::cell::OnceCell;
use std::collections::BTreeSet;

use model_description::{
    Causality, Description, ScalarVariable, Variability, VariableKind, names,
    value::{self, AngleMisfit, Misfit, Value},
};

use crate::model::{SetupValue, StartValue};
use crate::variables::Values;

impl SetupValue {
    fn shown(&self) -> String {
        match self {
            Self::Number(number) => format!("{number:?}"),
            Self::Integer(number) => number.to_string(),
            Self::Boolean(truth) => truth.to_string(),
            Self::Text(text) => format!("{text:?}"),
            Self::Refused { found, .. } => found.clone(),
            Self::List(items) => match items.iter().map(Self::length).collect::<Option<BTreeSet<_>>>() {
                Some(lengths) if lengths.len() == 1 => {
                    let columns = lengths.first().copied().unwrap_or_default();
                    format!("{} lists of length {columns}", items.len())
                }
                _ => format!("a list of length {}", items.len()),
            },
        }
    }

    fn length(&self) -> Option<usize> {
        if let Self::List(items) = self { Some(items.len()) } else { None }
    }
}

/// Most problems that are listed: each costs a search for the name that was meant.
const MOST_PROBLEMS: usize = 100;

/// The models that a setup text serves.
pub(crate) struct Readers<'a> {
    /// The model whose description is made.
    pub own: &'static str,
    pub file: &'a str,
    others: Vec<(OtherReader<'a>, OnceCell<Option<Reader>>)>,
}

/// Another model that takes the text.
pub(crate) struct Reader {
    pub model: &'static str,
    pub names: BTreeSet<String>,
}

/// Another model of the library, which reads the text anew; `None` where it does not take it.
pub(crate) type OtherReader<'a> = &'a dyn Fn() -> Option<Reader>;

impl<'a> Readers<'a> {
    pub(crate) fn new(own: &'static str, file: &'a str, others: &[OtherReader<'a>]) -> Self {
        Self { own, file, others: others.iter().map(|read| (*read, OnceCell::new())).collect() }
    }

    /// Models that read the text when they are asked for: only a name that is not the model's own needs them.
    fn others(&self) -> impl DoubleEndedIterator<Item = &Reader> {
        self.others.iter().filter_map(|(read, reader)| reader.get_or_init(read).as_ref())
    }

    fn models(&self) -> Vec<&'static str> {
        core::iter::once(self.own).chain(self.others().map(|other| other.model)).collect()
    }
}

/// The names that a start value may have: parameters and inputs, and their vectors' bare names.
pub(crate) fn settable_names(variables: &[ScalarVariable]) -> BTreeSet<String> {
    let settable = variables.iter().filter(|variable| is_settable(variable));
    settable.flat_map(|variable| [variable.name.clone(), bare(&variable.name).to_owned()]).collect()
}

fn is_settable(variable: &ScalarVariable) -> bool {
    matches!(variable.causality, Causality::Parameter | Causality::Input)
}

fn bare(name: &str) -> &str {
    match name.strip_suffix(']').and_then(|name| name.rfind('[')) {
        Some(at) => &name[..at],
        None => name,
    }
}

/// Puts the start values into the description and the table of values, and gives the places of what is fixed; the error is one
/// line a problem.
pub(crate) fn apply(
    given: &[StartValue],
    readers: &Readers<'_>,
    description: &mut Description,
    start: &mut Values,
) -> Result<BTreeSet<usize>, String> {
    let mut problems: Vec<(Option<usize>, String)> = Vec::new();
    let mut assigned: Vec<((bool, bool, bool), usize, Value)> = Vec::new();
    let mut unchecked = 0;
    for entry in given {
        if problems.len() == MOST_PROBLEMS {
            unchecked += 1;
            continue;
        }
        match targets(entry, readers, description) {
            Ok(targets) => {
                let is_element = description.variables.iter().any(|variable| variable.name == entry.name);
                let rank = (entry.is_fixed, entry.model.is_some(), is_element);
                assigned.extend(targets.into_iter().map(|(index, value)| (rank, index, value)));
            }
            Err(misfit) => {
                let line = entry.line.map(|line| format!(":{line}")).unwrap_or_default();
                problems.push((entry.line, format!("{}{line}: {}: {misfit}", readers.file, entry.key)));
            }
        }
    }
    if !problems.is_empty() {
        problems.sort_by_key(|(line, _)| *line);
        let mut lines: Vec<String> = problems.into_iter().map(|(_, problem)| problem).collect();
        if unchecked > 0 {
            lines.push(format!("{}: {unchecked} more start values, not checked yet", readers.file));
        }
        return Err(lines.join("\n"));
    }
    assigned.sort_by_key(|(rank, ..)| *rank);
    let mut fixed = BTreeSet::new();
    for ((is_fixed, ..), index, value) in assigned {
        let position = position_in_table(&description.variables, index);
        if let Some(variable) = description.variables.get_mut(index) {
            value::set_start(variable, &value);
            start.give(position, value);
            if is_fixed {
                variable.causality = Causality::Local;
                variable.variability = Variability::Constant;
                variable.initial = None;
                fixed.insert(index);
            }
        }
    }
    Ok(fixed)
}

/// How many variables of the same base type are declared before this one.
fn position_in_table(variables: &[ScalarVariable], index: usize) -> usize {
    let base = variables.get(index).map(|variable| variable.kind.base_type());
    variables.iter().take(index).filter(|variable| Some(variable.kind.base_type()) == base).count()
}

/// The variables, by position, that an entry sets, with their values; none if it is for other models.
fn targets(
    entry: &StartValue,
    readers: &Readers<'_>,
    description: &Description,
) -> Result<Vec<(usize, Value)>, Misfit> {
    if let Some(model) = &entry.model
        && model != readers.own
    {
        let models = readers.models();
        if !models.contains(&model.as_str()) {
            let found = format!("the unknown model {model:?}{}", names::hint(model, models.iter().copied()));
            let allowed = format!(
                "{}, which read this file; the name of a variable stands in quotes as a whole",
                models.join(", ")
            );
            return Err(Misfit::new(found, allowed));
        }
        let other = readers.others().find(|other| other.model == *model);
        return match other {
            Some(other) if !other.names.contains(&entry.name) => {
                Err(unknown(&entry.name, &[model.as_str()], other.names.iter().map(String::as_str)))
            }
            _ => Ok(Vec::new()),
        };
    }
    let own = |index: &usize| description.variables.get(*index);
    let scalar = description.variables.iter().position(|variable| variable.name == entry.name);
    let elements = match scalar {
        Some(index) => vec![index],
        None => names::elements(&description.variables, &entry.name),
    };
    let is_for_others =
        || entry.model.is_none() && readers.others().rev().any(|other| other.names.contains(&entry.name));
    let Some(first) = elements.first().and_then(own) else {
        if is_for_others() {
            return Ok(Vec::new());
        }
        let mut known = settable_names(&description.variables);
        let mut models = vec![readers.own];
        if entry.model.is_none() {
            models = readers.models();
            known.extend(readers.others().flat_map(|other| other.names.iter().cloned()));
        }
        return Err(unknown(&entry.name, &models, known.iter().map(String::as_str)));
    };
    if !is_settable(first) {
        // Another model may take what this one gives.
        if is_for_others() {
            return Ok(Vec::new());
        }
        let found = format!("the {} {}", first.causality, entry.name);
        return Err(Misfit::new(found, "a parameter or an input"));
    }
    let given = shaped(&entry.name, &entry.value);
    let by_name = |name: &str| given.iter().find(|(element, _)| element == name).map(|(_, given)| *given);
    let variables: Vec<_> = elements.iter().filter_map(|index| Some((*index, own(index)?))).collect();
    let shape = || Misfit::new(entry.value.shown(), shape_of(&entry.name, &variables));
    let is_matrix = variables.iter().any(|(_, variable)| names::is_of_matrix(&variable.name));
    // One value is that of every element of a vector.
    let is_one = scalar.is_some() || !(is_matrix || matches!(entry.value, SetupValue::List(_)));
    if !is_one && given.len() != variables.len() {
        return Err(shape());
    }
    let value_of = |(index, variable): &(usize, &ScalarVariable)| {
        let given = if is_one { &entry.value } else { by_name(&variable.name).ok_or_else(shape)? };
        Ok((*index, converted(description, variable, given)?))
    };
    variables.iter().map(value_of).collect()
}

/// The elements that a list gives, by name.
fn shaped<'g>(name: &str, given: &'g SetupValue) -> Vec<(String, &'g SetupValue)> {
    let SetupValue::List(items) = given else { return Vec::new() };
    let row = |(r, row): (usize, &'g SetupValue)| -> Vec<(String, &'g SetupValue)> {
        match row {
            SetupValue::List(cells) => {
                let cells = (1..).zip(cells);
                cells.map(|(c, cell): (usize, _)| (format!("{name}[{r},{c}]"), cell)).collect()
            }
            scalar => vec![(format!("{name}[{r}]"), scalar)],
        }
    };
    (1..).zip(items).flat_map(row).collect()
}

fn shape_of(name: &str, variables: &[(usize, &ScalarVariable)]) -> String {
    let last = variables.last().map(|(_, variable)| variable.name.as_str()).unwrap_or_default();
    let indices = last.strip_prefix(name).unwrap_or_default().trim_matches(['[', ']']);
    match indices.split_once(',') {
        Some((rows, columns)) => format!("{rows} lists of length {columns}"),
        None => format!("a list of length {indices}"),
    }
}

/// The value in the variable's own unit and base type, if the variable admits it.
fn converted(
    description: &Description,
    variable: &ScalarVariable,
    given: &SetupValue,
) -> Result<Value, Misfit> {
    let misfit = || Misfit::new(given.shown(), value::allowed(description, variable));
    let value = match (&variable.kind, given) {
        (_, SetupValue::Refused { found, allowed }) => {
            return Err(Misfit::new(found.clone(), allowed.clone()));
        }
        (VariableKind::Real { .. }, SetupValue::Number(number)) => Value::Real(*number),
        (VariableKind::Real { .. }, SetupValue::Integer(number)) => Value::Real(*number as f64),
        (VariableKind::Integer { .. } | VariableKind::Enumeration { .. }, SetupValue::Integer(number)) => {
            Value::Integer(i32::try_from(*number).map_err(|_| misfit())?)
        }
        (VariableKind::Boolean { .. }, SetupValue::Boolean(truth)) => Value::Boolean(*truth),
        (VariableKind::String { .. }, SetupValue::Text(text)) => Value::Text(text.clone()),
        (VariableKind::Real { .. } | VariableKind::Enumeration { .. }, SetupValue::Text(text)) => {
            value::read(description, variable, text)?
        }
        _ => return Err(misfit()),
    };
    if let Some(misfit) = value::angle_misfit(description, variable, &value, given.shown().trim_matches('"'))
    {
        let AngleMisfit { found, meant, allowed } = misfit;
        let meant = meant.map(|meant| format!(" (did you mean {meant:?}?)")).unwrap_or_default();
        return Err(Misfit::new(format!("{found}{meant}"), allowed));
    }
    value::check(description, variable, &value)
        .map_err(|refused| Misfit { found: given.shown(), ..refused })?;
    Ok(value)
}

fn unknown<'n>(name: &str, models: &[&str], known: impl Iterator<Item = &'n str>) -> Misfit {
    let found = format!("the unknown name {name:?}{}", names::hint(name, known));
    Misfit::new(found, format!("a parameter or an input of {}", models.join(" or ")))
}
