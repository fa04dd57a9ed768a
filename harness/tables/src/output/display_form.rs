//! How people read a recorded variable: display unit, dates beside epochs, names of items, `none` for a time that is none.

use inputs::epoch;
use model_description::{Description, EnumerationItem, ScalarVariable, VariableKind, value};

use super::scales::ROUNDING;

/// Words in the description of a time that may be absent.
const NONE: &str = "; -1 ";
/// The value that says so, in s.
const NONE_S: f64 = -1.0;

/// The unit of angles, whose scale is 1 of it.
pub(super) const ANGLE_UNIT: &str = "rad";

/// The variable of this name.
pub(super) fn find<'a>(description: &'a Description, name: &str) -> Option<&'a ScalarVariable> {
    description.variables.iter().find(|variable| variable.name == name)
}

/// A recorded number's unit and form.
#[derive(Default)]
pub(super) struct DisplayForm<'a> {
    /// The unit it is shown in.
    pub unit: &'a str,
    factor: f64,
    offset: f64,
    may_be_none: bool,
    is_epoch: bool,
    is_angle: bool,
    /// Items of an Enumeration.
    pub items: &'a [EnumerationItem],
}

impl<'a> DisplayForm<'a> {
    /// Returns how the variable of this name is shown.
    pub(super) fn new(description: &'a Description, name: &str) -> Self {
        let Some(variable) = find(description, name) else {
            return Self { unit: "", factor: 1.0, ..Self::default() };
        };
        let own = fmi::unit(description, variable).unwrap_or_default();
        let says_none = variable.description.as_deref().is_some_and(|text| text.contains(NONE));
        let is_time = matches!(variable.kind, VariableKind::Real { .. }) && own == "s";
        let is_epoch = epoch::is_epoch(variable);
        // Seconds stand beside a date.
        let display = fmi::display_unit(description, variable).filter(|_| !is_epoch);
        let (unit, factor, offset) = display.unwrap_or((own, 1.0, 0.0));
        let is_angle = own == ANGLE_UNIT;
        let items = value::items(description, variable);
        Self { unit, factor, offset, may_be_none: is_time && says_none, is_epoch, is_angle, items }
    }

    /// A value in the shown unit, an angle of nothing but rounding as 0; `None` for a time that is none.
    pub(super) fn value(&self, value: f64) -> Option<f64> {
        let value = if self.is_angle && value.abs() < ROUNDING { 0.0 } else { value };
        (!self.may_be_none || value != NONE_S).then_some(self.factor * value + self.offset)
    }

    /// The text of a shown value.
    pub(super) fn text(&self, shown: Option<f64>) -> String {
        let Some(shown) = shown else { return "none".to_owned() };
        if let Some(item) = self.items.iter().find(|item| f64::from(item.value) == shown) {
            return item.name.clone();
        }
        match epoch::date(shown).filter(|_| self.is_epoch) {
            Some(date) => format!("{shown} ({date})"),
            None => terminal::short(shown),
        }
    }
}
