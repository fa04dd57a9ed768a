//! Each variable by itself: role, start value, limits, declared type, derivative.

use std::collections::BTreeSet;

use super::{Check, ElementLocation, Limits, declared_type, derivative_of, some_of};
use crate::finding::Code;
use crate::lexical::double;
use crate::rules;
use crate::{Causality, EnumerationItem, ScalarVariable, SimpleTypeKind, Variability, VariableKind};

impl Check<'_> {
    pub(super) fn variables(&mut self) {
        let all = self.description;
        self.require(!all.variables.is_empty(), Code::NoVariables, ElementLocation::Variables, || {
            "has no variables; the schema requires at least one".to_owned()
        });
        let states: BTreeSet<u32> = all.variables.iter().filter_map(derivative_of).collect();
        let mut independent = None;
        for (index, variable) in all.variables.iter().enumerate() {
            let place = ElementLocation::Variable(index);
            self.role(place, variable);
            self.declared_type(place, variable);
            self.kind(place, variable);
            let is_state = u32::try_from(index + 1).is_ok_and(|index| states.contains(&index));
            self.model_exchange_only(place, variable, is_state);
            self.derivative(place, index, variable);
            if variable.causality == Causality::Independent {
                if let Some(first) = independent {
                    let message = format!("is independent, and so is `{first}`; allowed is one");
                    self.add(Code::SeveralIndependent, place, message);
                }
                independent.get_or_insert(variable.name.as_str());
            }
        }
    }

    fn role(&mut self, place: ElementLocation, variable: &ScalarVariable) {
        let ScalarVariable { causality, variability, initial, .. } = *variable;
        let is_real = matches!(variable.kind, VariableKind::Real { .. });
        let may_be_continuous = is_real || variability != Variability::Continuous;
        self.require(may_be_continuous, Code::ContinuousNotReal, place, || {
            let kind = variable.kind.name();
            format!(
                "is {kind} with variability continuous (the default); only Real variables may be continuous"
            )
        });
        let Some(rule) = rules::initial(causality, variability) else {
            // Already reported for Integers and the like that leave out their variability.
            return self.require(!may_be_continuous, Code::CausalityVariability, place, || {
                let allowed = rules::listed(rules::legal_variabilities(causality).map(Variability::as_str));
                format!(
                    "has causality {causality} with variability {variability}; allowed with {causality}: {allowed}"
                )
            });
        };
        if let Some(bad) = initial.filter(|initial| !rule.allowed.contains(initial)) {
            if !rule.allowed.is_empty() {
                let allowed = rules::listed(rule.allowed.iter().map(|initial| initial.as_str()));
                let message = format!("has initial {bad}; allowed with {causality} {variability}: {allowed}");
                return self.add(Code::InitialNotAllowed, place, message);
            }
            let message = format!("has initial {bad}; with causality {causality} it must be left out");
            self.add(Code::InitialForbidden, place, message);
        }
        let effective = rules::effective(causality, variability, initial);
        let why = || effective.map_or_else(|| format!("causality {causality}"), |it| format!("initial {it}"));
        let (is_required, has_start) = (rules::start_required(variable), rules::has_start(variable));
        self.require(!is_required || has_start, Code::StartMissing, place, || {
            format!("has no start; {} requires one", why())
        });
        self.require(is_required || !has_start, Code::StartForbidden, place, || {
            format!("has a start; {} must not have one", why())
        });
    }

    fn declared_type(&mut self, place: ElementLocation, variable: &ScalarVariable) {
        let Some(name) = declared_type(&variable.kind) else { return };
        let Some(kind) = self.declared(variable) else {
            let defined = some_of(self.types.keys().copied());
            let message = format!("declaredType `{name}` is not in TypeDefinitions; defined are {defined}");
            self.add(Code::DeclaredTypeUndefined, place, message);
            return;
        };
        let (type_name, own) = (kind.name(), variable.kind.name());
        self.require(type_name == own, Code::DeclaredTypeKind, place, || {
            format!("is {own}, its declaredType `{name}` is {type_name}; allowed is a type of {own}")
        });
    }

    fn kind(&mut self, place: ElementLocation, variable: &ScalarVariable) {
        let checked = rules::start_required(variable);
        let real = |min: Option<i32>, max: Option<i32>| (min.map(f64::from), max.map(f64::from));
        match (&variable.kind, self.declared(variable)) {
            (VariableKind::Real { start, attributes, .. }, declared) => {
                let inherited = match declared {
                    Some(SimpleTypeKind::Real { attributes: inherited }) => Some(inherited),
                    _ => None,
                };
                self.real_attributes(place, attributes, inherited);
                if let Some(inherited) = inherited {
                    let own = (attributes.min, attributes.max);
                    self.beyond_type(place, own, (inherited.min, inherited.max));
                }
                if let Some(start) = start.filter(|_| checked) {
                    let min = attributes.min.or(inherited.and_then(|from| from.min));
                    let max = attributes.max.or(inherited.and_then(|from| from.max));
                    self.real_start(place, start, (min, max));
                }
            }
            (VariableKind::Integer { start, min, max, .. }, declared) => {
                let inherited = match declared {
                    Some(SimpleTypeKind::Integer { min, max, .. }) => real(*min, *max),
                    _ => (None, None),
                };
                self.integer(place, start.filter(|_| checked), real(*min, *max), inherited);
            }
            (VariableKind::Enumeration { start, min, max, .. }, declared) => {
                let start = start.filter(|_| checked);
                let items = match declared {
                    Some(SimpleTypeKind::Enumeration { items, .. }) => items.as_slice(),
                    _ => &[],
                };
                if let Some(start) = start
                    && !items.is_empty()
                    && !items.iter().any(|item| item.value == start)
                {
                    let message = format!("start {start} is no item; allowed are {}", item_list(items));
                    self.add(Code::StartNotAnItem, place, message);
                } else {
                    self.integer(place, start, real(*min, *max), (None, None));
                }
            }
            (VariableKind::Boolean { .. } | VariableKind::String { .. }, _) => {}
        }
    }

    fn integer(&mut self, place: ElementLocation, start: Option<i32>, own: Limits, inherited: Limits) {
        let limits = (own.0.or(inherited.0), own.1.or(inherited.1));
        if own != (None, None) {
            self.limits(place, limits);
        }
        self.beyond_type(place, own, inherited);
        if let Some(start) = start {
            self.range(place, f64::from(start), limits);
        }
    }

    fn real_start(&mut self, place: ElementLocation, start: f64, (min, max): Limits) {
        // Without a limit the largest finite number is the limit (2.2.3).
        let infinite_is_within = start == max.unwrap_or(f64::MAX) || start == min.unwrap_or(f64::MIN);
        if start.is_nan() || (start.is_infinite() && !infinite_is_within) {
            let message = format!(
                "start is {}; allowed is a finite number, or the value of an infinite min or max",
                double(start)
            );
            self.add(Code::StartNotFinite, place, message);
            return;
        }
        self.range(place, start, (min, max));
    }

    fn range(&mut self, place: ElementLocation, start: f64, (min, max): Limits) {
        let reversed = matches!((min, max), (Some(min), Some(max)) if min > max);
        if !reversed && (min.is_some_and(|min| start < min) || max.is_some_and(|max| start > max)) {
            let text = |limit: Option<f64>| limit.map_or("unlimited".to_owned(), double);
            let message =
                format!("start {} is out of range; allowed is {} to {}", double(start), text(min), text(max));
            self.add(Code::StartOutOfRange, place, message);
        }
    }

    fn beyond_type(&mut self, place: ElementLocation, own: Limits, inherited: Limits) {
        let below = matches!((own.0, inherited.0), (Some(own), Some(from)) if own < from);
        let above = matches!((own.1, inherited.1), (Some(own), Some(from)) if own > from);
        if below || above {
            let text = |limit: Option<f64>| limit.map_or("unlimited".to_owned(), double);
            let message = format!(
                "min {} and max {} reach beyond those of the declared type, {} to {}",
                text(own.0),
                text(own.1),
                text(inherited.0),
                text(inherited.1)
            );
            self.add(Code::LimitsBeyondType, place, message);
        }
    }

    fn model_exchange_only(&mut self, place: ElementLocation, variable: &ScalarVariable, is_state: bool) {
        let has_model_exchange = self.description.model_exchange.is_some();
        if let VariableKind::Real { reinit: Some(_), .. } = variable.kind
            && !(has_model_exchange && is_state)
        {
            let message = if has_model_exchange {
                "has reinit but is no continuous state; allowed on states only"
            } else {
                "has reinit in an FMU without model exchange; it must be left out"
            };
            self.add(Code::Reinit, place, message.to_owned());
        }
        let may_be_set = has_model_exchange && variable.causality == Causality::Input;
        let is_fitting = may_be_set || variable.can_handle_multiple_set_per_time_instant.is_none();
        self.require(is_fitting, Code::MultipleSet, place, || {
            "has canHandleMultipleSetPerTimeInstant; allowed on inputs of a model-exchange FMU only"
                .to_owned()
        });
    }

    fn derivative(&mut self, place: ElementLocation, index: usize, variable: &ScalarVariable) {
        let Some(target) = derivative_of(variable) else { return };
        let count = self.description.variables.len();
        let Some(state) = self.variable(target).filter(|_| target as usize != index + 1) else {
            let message =
                format!("derivative is {target}; allowed is the index of another variable, 1 to {count}");
            self.add(Code::DerivativeIndex, place, message);
            return;
        };
        let real = matches!(state.kind, VariableKind::Real { .. });
        if !real || state.variability != Variability::Continuous {
            let message = format!(
                "is the derivative of `{}`, a {} {}; allowed is that of a continuous Real",
                state.name,
                state.variability,
                state.kind.name()
            );
            self.add(Code::DerivativeKind, place, message);
        }
    }
}

fn item_list(items: &[EnumerationItem]) -> String {
    let shown: Vec<_> = items.iter().map(|item| format!("{} ({})", item.value, item.name)).collect();
    some_of(shown.iter().map(String::as_str))
}
