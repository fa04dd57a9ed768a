//! The units a heliotorque variable may carry: one table for the derive, the builder and the validator.

use crate::{BaseUnit, DisplayUnit, Unit};

/// One row of the unit table.
#[derive(Clone, Copy, Debug)]
pub struct KnownUnit {
    /// Name as used in `unit="…"`.
    pub name: &'static str,
    /// Exponents of kg, m, s, A, K, mol, cd, rad.
    pub exponents: [i32; 8],
    /// Display units as (name, factor), value_display = factor * value.
    pub display: &'static [(&'static str, f64)],
}

/// Every unit that a variable may name. All are coherent SI, so factor 1 and offset 0.
pub const UNITS: &[KnownUnit] = &[
    row("1", [0, 0, 0, 0, 0, 0, 0, 0], &[("%", 100.0)]),
    row("kg", [1, 0, 0, 0, 0, 0, 0, 0], &[]),
    row("kg.m", [1, 1, 0, 0, 0, 0, 0, 0], &[("g.cm", 1e5)]),
    row("kg/m3", [1, -3, 0, 0, 0, 0, 0, 0], &[]),
    row("kg/mol", [1, 0, 0, 0, 0, -1, 0, 0], &[("g/mol", 1e3)]),
    row("kg.m2", [1, 2, 0, 0, 0, 0, 0, 0], &[]),
    row(
        "m",
        [0, 1, 0, 0, 0, 0, 0, 0],
        &[("km", 1e-3), ("cm", 1e2), ("mm", 1e3), ("AU", 1.0 / 149_597_870_700.0)],
    ),
    row("m2", [0, 2, 0, 0, 0, 0, 0, 0], &[]),
    row("m3", [0, 3, 0, 0, 0, 0, 0, 0], &[]),
    row("m/s", [0, 1, -1, 0, 0, 0, 0, 0], &[("km/s", 1e-3), ("mm/s", 1e3)]),
    row("m/s2", [0, 1, -2, 0, 0, 0, 0, 0], &[("nm/s2", 1e9)]),
    row("m3/s2", [0, 3, -2, 0, 0, 0, 0, 0], &[("km3/s2", 1e-9)]),
    row(
        "s",
        [0, 0, 1, 0, 0, 0, 0, 0],
        &[
            ("ms", 1e3),
            ("min", 1.0 / 60.0),
            ("h", 1.0 / 3600.0),
            ("d", 1.0 / 86_400.0),
            ("a", 1.0 / 31_557_600.0),
        ],
    ),
    row("rad", [0, 0, 0, 0, 0, 0, 0, 1], &[("deg", 180.0 / core::f64::consts::PI)]),
    row(
        "rad/s",
        [0, 0, -1, 0, 0, 0, 0, 1],
        &[("deg/s", 180.0 / core::f64::consts::PI), ("rpm", 30.0 / core::f64::consts::PI)],
    ),
    row("rad/s2", [0, 0, -2, 0, 0, 0, 0, 1], &[("deg/s2", 180.0 / core::f64::consts::PI)]),
    row("Hz", [0, 0, -1, 0, 0, 0, 0, 0], &[]),
    row("N", [1, 1, -2, 0, 0, 0, 0, 0], &[("uN", 1e6), ("mN", 1e3)]),
    row("N.s", [1, 1, -1, 0, 0, 0, 0, 0], &[]),
    row("N.m", [1, 2, -2, 0, 0, 0, 0, 0], &[("uN.m", 1e6), ("mN.m", 1e3)]),
    row("N.m.s", [1, 2, -1, 0, 0, 0, 0, 0], &[]),
    row("Pa", [1, -1, -2, 0, 0, 0, 0, 0], &[("uPa", 1e6), ("bar", 1e-5)]),
    row("W", [1, 2, -3, 0, 0, 0, 0, 0], &[]),
    row("W/m2", [1, 0, -3, 0, 0, 0, 0, 0], &[]),
    row("W/(m2.K)", [1, 0, -3, 0, -1, 0, 0, 0], &[]),
    row("J/K", [1, 2, -2, 0, -1, 0, 0, 0], &[]),
    row("A.m2", [0, 2, 0, 1, 0, 0, 0, 0], &[]),
    row("T", [1, 0, -2, -1, 0, 0, 0, 0], &[("nT", 1e9)]),
    row("K", [0, 0, 0, 0, 1, 0, 0, 0], &[]),
];

const fn row(name: &'static str, exponents: [i32; 8], display: &'static [(&'static str, f64)]) -> KnownUnit {
    KnownUnit { name, exponents, display }
}

/// The row of `name`, if the table has it.
pub fn find(name: &str) -> Option<&'static KnownUnit> {
    UNITS.iter().find(|unit| unit.name == name)
}

impl KnownUnit {
    /// Whether `display` is one of this unit's display units.
    pub fn has_display(&self, display: &str) -> bool {
        self.display.iter().any(|(name, _)| *name == display)
    }

    /// The XML element for this row.
    pub fn to_unit(&self) -> Unit {
        let [kg, m, s, a, k, mol, cd, rad] = self.exponents;
        Unit {
            name: self.name.to_owned(),
            base: Some(BaseUnit { kg, m, s, a, k, mol, cd, rad, factor: 1.0, offset: 0.0 }),
            display_units: self
                .display
                .iter()
                .map(|&(name, factor)| DisplayUnit { name: name.to_owned(), factor, offset: 0.0 })
                .collect(),
        }
    }
}
