//! Units, types and log categories.

use super::{Check, ElementLocation, Limits, some_of};
use crate::finding::Code;
use crate::lexical::double;
use crate::{RealAttributes, SimpleTypeKind};

impl Check<'_> {
    pub(super) fn units(&mut self) {
        let units = &self.description.units;
        self.unique(Code::DuplicateUnit, units.iter().map(|unit| unit.name.as_str()), ElementLocation::Unit);
        for (index, unit) in units.iter().enumerate() {
            let displays = unit.display_units.iter().map(|display| display.name.as_str());
            self.unique(Code::DuplicateDisplayUnit, displays, |_| ElementLocation::Unit(index));
            let base = unit.base.iter().map(|base| ("BaseUnit".to_owned(), base.factor, base.offset));
            let displays = unit.display_units.iter();
            let displays = displays.map(|d| (format!("display unit `{}`", d.name), d.factor, d.offset));
            for (what, factor, offset) in base.chain(displays) {
                let is_usable = factor != 0.0 && factor.is_finite() && offset.is_finite();
                self.require(is_usable, Code::UnitConversion, ElementLocation::Unit(index), || {
                    let (factor, offset) = (double(factor), double(offset));
                    format!(
                        "{what} has factor {factor} and offset {offset}; allowed are a finite factor other than 0 and a finite \
                         offset"
                    )
                });
            }
        }
    }

    pub(super) fn types(&mut self) {
        let types = &self.description.types;
        self.unique(
            Code::DuplicateType,
            types.iter().map(|known| known.name.as_str()),
            ElementLocation::Type,
        );
        for (index, known) in types.iter().enumerate() {
            let place = ElementLocation::Type(index);
            match &known.kind {
                SimpleTypeKind::Real { attributes } => {
                    self.real_attributes(place, attributes, None);
                }
                SimpleTypeKind::Integer { min, max, .. } => {
                    self.limits(place, (min.map(f64::from), max.map(f64::from)));
                }
                SimpleTypeKind::Boolean | SimpleTypeKind::String => {}
                SimpleTypeKind::Enumeration { items, .. } => {
                    self.require(!items.is_empty(), Code::EnumerationEmpty, place, || {
                        "the enumeration has no items; at least one is required".to_owned()
                    });
                    self.unique(Code::DuplicateItem, items.iter().map(|item| item.name.as_str()), |_| place);
                    let mut values: Vec<i32> = items.iter().map(|item| item.value).collect();
                    values.sort_unstable();
                    for pair in values.windows(2).filter(|pair| pair[0] == pair[1]) {
                        let message = format!("the value {} belongs to two items; allowed is one", pair[0]);
                        self.add(Code::DuplicateItem, place, message);
                    }
                }
            }
        }
    }

    pub(super) fn categories(&mut self) {
        let names = self.description.log_categories.iter().map(|category| category.name.as_str());
        self.unique(Code::DuplicateCategory, names, ElementLocation::Category);
    }

    /// Attributes shared by Real types and variables; `inherited` are those of the variable's declared type.
    pub(super) fn real_attributes(
        &mut self,
        place: ElementLocation,
        attributes: &RealAttributes,
        inherited: Option<&RealAttributes>,
    ) {
        let unit = attributes.unit.as_deref().or(inherited.and_then(|from| from.unit.as_deref()));
        if let Some(name) = attributes.unit.as_deref().filter(|name| !self.units.contains_key(name)) {
            let defined = some_of(self.units.keys().copied());
            let message = format!("unit `{name}` is not in UnitDefinitions; defined are {defined}");
            self.add(Code::UndefinedUnit, place, message);
        }
        if let Some(display) = attributes.display_unit.as_deref() {
            self.display_unit(place, display, unit);
        }
        for (name, limit) in [("min", attributes.min), ("max", attributes.max)] {
            self.require(!limit.is_some_and(f64::is_nan), Code::LimitNotANumber, place, || {
                format!("{name} is NaN; allowed is a number")
            });
        }
        let inherited_limits = inherited.map_or((None, None), |from| (from.min, from.max));
        if attributes.min.is_some() || attributes.max.is_some() {
            let max = attributes.max.or(inherited_limits.1);
            self.limits(place, (attributes.min.or(inherited_limits.0), max));
        }
        if let Some(nominal) = attributes.nominal.filter(|value| !(value.is_finite() && *value > 0.0)) {
            let message = format!("nominal is {}; allowed is a finite number above 0", double(nominal));
            self.add(Code::Nominal, place, message);
        }
    }

    fn display_unit(&mut self, place: ElementLocation, display: &str, unit: Option<&str>) {
        let Some(name) = unit else {
            let message = format!("displayUnit `{display}` is given without a unit; a unit is required");
            self.add(Code::DisplayUnitWithoutUnit, place, message);
            return;
        };
        // An undefined unit is reported where it is named.
        let Some(unit) = self.units.get(name) else { return };
        // A unit may display as itself without an entry of its own.
        if display != name && !unit.display_units.iter().any(|known| known.name == display) {
            let defined = some_of(unit.display_units.iter().map(|known| known.name.as_str()));
            let message =
                format!("displayUnit `{display}` is not defined for unit `{name}`; defined are {defined}");
            self.add(Code::UndefinedDisplayUnit, place, message);
        }
    }

    pub(super) fn limits(&mut self, place: ElementLocation, (min, max): Limits) {
        let (Some(min), Some(max)) = (min, max) else { return };
        let is_reversed = min > max;
        self.require(!is_reversed, Code::MinAboveMax, place, || {
            format!("min {} is above max {}; allowed is at most max", double(min), double(max))
        });
    }
}
