//! Sizes that recorded variables are small against: below a part of them is the rounding of a calculation.

use std::collections::BTreeMap;

use fmi::{Column, Recording};
use inputs::variables::vector;
use model_description::{Description, VariableKind, value};

/// Part of a quantity's scale below which is the rounding of its calculation.
pub(super) const ROUNDING: f64 = 1e-12;
/// The unit of ratios.
const RATIO: &str = "1";

/// Name of the group of a variable: the elements of a vector, or the same quantity of everything that is counted.
pub(super) fn group(name: &str) -> String {
    match (vector(name), name.rsplit_once('[')) {
        (Some(vector), _) => vector.to_owned(),
        (None, Some((counted, rest))) => {
            let (_, quantity) = rest.split_once(']').unwrap_or(("", rest));
            format!("{counted}{quantity}")
        }
        (None, None) => name.to_owned(),
    }
}

/// The largest sizes in a recording by group; groups that share a name and a unit, as all of `torque.*` do, are one.
pub(super) struct Scales {
    /// The one unit of all Reals below a name, such as `torque`; `None` where they have several or none.
    units: BTreeMap<String, Option<String>>,
    sizes: BTreeMap<String, f64>,
}

impl Scales {
    /// Gathers the sizes in a recording.
    pub(super) fn new(described: &Description, recording: &Recording) -> Self {
        let mut scales = Self { units: BTreeMap::new(), sizes: BTreeMap::new() };
        let reals = described.variables.iter().filter(|it| matches!(it.kind, VariableKind::Real { .. }));
        for variable in reals {
            let unit = value::unit(described, variable).filter(|unit| *unit != RATIO).map(str::to_owned);
            if let Some((parent, _)) = group(&variable.name).rsplit_once('.') {
                let known = scales.units.entry(parent.to_owned()).or_insert_with(|| unit.clone());
                if *known != unit {
                    *known = None;
                }
            }
        }
        let columns = recording.names.iter().zip(&recording.columns);
        for (name, column) in columns.filter(|(_, column)| matches!(column, Column::Real(_))) {
            let finite = column.numbers().into_iter().filter(|value| value.is_finite());
            let size = finite.fold(0.0, |size: f64, value| size.max(value.abs()));
            let known = scales.sizes.entry(scales.key(name)).or_default();
            *known = known.max(size);
        }
        scales
    }

    /// The largest size of a variable and of all that it is small against.
    pub(super) fn size(&self, name: &str) -> f64 {
        self.sizes.get(&self.key(name)).copied().unwrap_or_default()
    }

    fn key(&self, name: &str) -> String {
        let group = group(name);
        let shared = group.rsplit_once('.').map(|(parent, _)| parent);
        let shared = shared.filter(|parent| matches!(self.units.get(*parent), Some(Some(_))));
        shared.map(str::to_owned).unwrap_or(group)
    }
}
