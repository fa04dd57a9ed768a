//! Conditions of the call table that the variables of an FMU meet.

use model_description::{BaseType, Description, call_table::Condition};

/// The conditions that restrict which variables may be set or read; of others it is the values' worth that they restrict.
const RESTRICTING: [Condition; 4] = [
    Condition::SettableBeforeInitialization,
    Condition::OutputOrInitialUnknown,
    Condition::SettableInInitialization,
    Condition::InputOrTunable,
];

/// Conditions that a variable meets, one bit each.
pub(crate) type Conditions = u8;

/// The bit of a condition; 0 of one that any variable meets.
pub(crate) fn bit(condition: Condition) -> Conditions {
    RESTRICTING.iter().position(|it| *it == condition).map_or(0, |place| 1 << place)
}

/// For every value reference, by base type: which of the table's conditions it meets.
pub(crate) struct AccessTable([Table; 4]);

/// One base type: rows sorted by reference; where the references are dense, a place for each from the first one on.
#[derive(Default)]
struct Table {
    rows: Vec<(u32, Conditions)>,
    first: u32,
    dense: Vec<Option<Conditions>>,
}

/// Places that a dense table may have for each row.
const PLACES_PER_ROW: usize = 4;

impl Table {
    fn new(rows: Vec<(u32, Conditions)>) -> Self {
        let (Some((first, _)), Some((last, _))) = (rows.first().copied(), rows.last().copied()) else {
            return Self::default();
        };
        let places = (last - first) as usize + 1;
        let mut dense = Vec::new();
        if places <= PLACES_PER_ROW * rows.len() {
            dense.resize(places, None);
            for (reference, conditions) in &rows {
                dense[(reference - first) as usize] = Some(*conditions);
            }
        }
        Self { rows, first, dense }
    }

    fn met(&self, reference: u32) -> Option<Conditions> {
        if self.dense.is_empty() {
            return self.rows.binary_search_by_key(&reference, |row| row.0).ok().map(|at| self.rows[at].1);
        }
        self.dense.get(reference.checked_sub(self.first)? as usize).copied().flatten()
    }
}

impl AccessTable {
    pub(crate) fn new(description: &Description) -> Self {
        let mut initial_unknown = vec![false; description.variables.len() + 1];
        for unknown in &description.structure.initial_unknowns {
            if let Some(flag) = initial_unknown.get_mut(unknown.index as usize) {
                *flag = true;
            }
        }
        let mut tables: [Vec<(u32, Conditions)>; 4] = Default::default();
        for (position, variable) in description.variables.iter().enumerate() {
            let listed = initial_unknown[position + 1];
            let met = RESTRICTING
                .into_iter()
                .filter(|condition| condition.admits(variable, listed))
                .fold(0, |met, condition| met | bit(condition));
            tables[variable.kind.base_type() as usize].push((variable.value_reference, met));
        }
        for table in &mut tables {
            // Aliases share a reference: what one of them may, all may.
            table.sort_unstable_by_key(|row| row.0);
            table.dedup_by(|next, kept| {
                let alias = next.0 == kept.0;
                if alias {
                    kept.1 |= next.1;
                }
                alias
            });
        }
        Self(tables.map(Table::new))
    }

    pub(crate) fn met(&self, base: BaseType, reference: u32) -> Option<Conditions> {
        self.0[base as usize].met(reference)
    }
}
