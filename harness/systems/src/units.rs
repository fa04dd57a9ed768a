//! Units by their base units: whether two measure the same, and the conversion between them.

use model_description::{BaseUnit, Unit};

use crate::structure::Linear;

/// The base units of a unit by its name, from the first list that has it.
pub(crate) fn base(name: &str, lists: &[&[Unit]]) -> Option<BaseUnit> {
    lists.iter().flat_map(|list| list.iter()).find(|unit| unit.name == name).and_then(|unit| unit.base)
}

/// Whether both are of one dimension.
pub(crate) fn is_same_dimension(one: &BaseUnit, other: &BaseUnit) -> bool {
    one.exponents() == other.exponents()
}

/// From a number in one unit to the number in another of the same dimension: both are `factor x + offset` in base units.
pub(crate) fn conversion(from: &BaseUnit, to: &BaseUnit) -> Linear {
    Linear { factor: from.factor / to.factor, offset: (from.offset - to.offset) / to.factor }
}

impl Linear {
    /// Changes nothing.
    pub const IDENTITY: Self = Self { factor: 1.0, offset: 0.0 };

    /// The value.
    pub fn apply(self, value: f64) -> f64 {
        self.factor * value + self.offset
    }

    /// Returns the inverse transformation.
    pub fn inverse(self) -> Self {
        Self { factor: 1.0 / self.factor, offset: -self.offset / self.factor }
    }

    /// First this, then another.
    pub fn then(self, next: Self) -> Self {
        Self { factor: next.factor * self.factor, offset: next.apply(self.offset) }
    }
}

/// A unit for people: nothing is `no unit`.
pub(crate) fn shown(unit: Option<&str>) -> String {
    unit.map_or_else(|| "no unit".to_owned(), |unit| format!("unit {unit:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_and_fahrenheit_are_converted() {
        let degree = BaseUnit { rad: 1, factor: core::f64::consts::PI / 180.0, ..BaseUnit::default() };
        let radian = BaseUnit { rad: 1, ..BaseUnit::default() };
        assert!((conversion(&degree, &radian).apply(180.0) - core::f64::consts::PI).abs() < 1e-15);
        // Water boils at 212 F, 373.15 K, 100 C.
        let fahrenheit =
            BaseUnit { k: 1, factor: 5.0 / 9.0, offset: 459.67 * 5.0 / 9.0, ..BaseUnit::default() };
        let celsius = BaseUnit { k: 1, offset: 273.15, ..BaseUnit::default() };
        let (there, back) = (conversion(&fahrenheit, &celsius), conversion(&celsius, &fahrenheit));
        assert!((there.apply(212.0) - 100.0).abs() < 1e-12);
        assert!((there.then(back).apply(50.0) - 50.0).abs() < 1e-12);
        assert!(is_same_dimension(&fahrenheit, &celsius) && !is_same_dimension(&celsius, &radian));
    }
}
