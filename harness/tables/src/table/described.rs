//! A table over time as a recording with a description, which pictures of `run` are drawn by.

use fmi::reference::Cell;
use fmi::{Column, Recording};
use model_description::{
    Annotation, Description, DisplayUnit, EnumerationItem, RealAttributes, ScalarVariable, SimpleType,
    SimpleTypeKind, Unit, VariableKind,
};

use super::{
    reading::Table,
    sidecar::{Quantity, Sidecar},
};

/// A recording and what its variables are.
#[derive(Clone, Debug)]
pub struct Described {
    /// Description of the columns, in their order.
    pub description: Description,
    /// The columns.
    pub recording: Recording,
}

impl Described {
    /// Describes a table by its sidecar; a column of texts has no numbers.
    pub fn new(table: &Table, sidecar: &Sidecar) -> Self {
        let file = || table.path.display().to_string();
        let mut description =
            Description { model_name: sidecar.title.clone().unwrap_or_else(file), ..Description::default() };
        let mut recording = Recording { times_s: table.keys.clone(), ..Recording::default() };
        for (name, cells) in table.names.iter().zip(&table.columns) {
            let quantity = sidecar.columns.get(name);
            let kind = quantity.map_or_else(VariableKind::default, |it| kind(&mut description, name, it));
            description.variables.push(ScalarVariable {
                name: name.clone(),
                description: quantity.and_then(|it| it.description.clone()),
                kind,
                annotation: quantity
                    .and_then(|it| it.role)
                    .map(|role| Box::new(Annotation { role: Some(role), ..Annotation::default() })),
                ..ScalarVariable::default()
            });
            recording.names.push(name.clone());
            recording.units.push(sidecar.unit(name).unwrap_or_default().to_owned());
            recording.columns.push(column(cells, quantity));
        }
        Self { description, recording }
    }
}

/// The type of a variable; its units and items are added to the description.
fn kind(description: &mut Description, name: &str, quantity: &Quantity) -> VariableKind {
    if !quantity.items.is_empty() {
        let item = |(name, value): &(String, i32)| EnumerationItem {
            name: name.clone(),
            value: *value,
            description: None,
        };
        let items = quantity.items.iter().map(item).collect();
        description.types.push(SimpleType {
            name: name.to_owned(),
            kind: SimpleTypeKind::Enumeration { quantity: None, items },
            ..SimpleType::default()
        });
        return VariableKind::Enumeration {
            declared_type: name.to_owned(),
            quantity: None,
            min: None,
            max: None,
            start: None,
        };
    }
    let unit = quantity.unit.clone().unwrap_or_default();
    if let Some((name, factor, offset)) = &quantity.display {
        let display = DisplayUnit { name: name.clone(), factor: *factor, offset: *offset };
        match description.units.iter_mut().find(|known| known.name == unit) {
            Some(known) if known.display_units.iter().any(|known| known.name == *name) => {}
            Some(known) => known.display_units.push(display),
            None => description.units.push(Unit {
                name: unit.clone(),
                display_units: vec![display],
                ..Unit::default()
            }),
        }
    }
    let attributes = RealAttributes {
        unit: Some(unit).filter(|unit| !unit.is_empty()),
        display_unit: quantity.display.as_ref().map(|(name, _, _)| name.clone()),
        ..RealAttributes::default()
    };
    VariableKind::Real { declared_type: None, attributes, start: None, derivative: None, reinit: None }
}

/// Whole numbers of no unit in the recording of an FMU are counts, flags and items, which hold until the next.
fn column(cells: &[Cell], quantity: Option<&Quantity>) -> Column {
    let numbers = cells.iter().map(|cell| match cell {
        Cell::Real(value) => Some(*value),
        // A missing number interrupts the line.
        Cell::Exact(text) => text.is_empty().then_some(f64::NAN),
    });
    let Some(numbers) = numbers.collect::<Option<Vec<f64>>>() else {
        return Column::Text(cells.iter().map(Cell::to_string).collect());
    };
    let is_count = |value: &f64| value.fract() == 0.0 && f64::from(*value as i32) == *value;
    if quantity.is_some_and(|it| it.unit.is_none()) && numbers.iter().all(is_count) {
        return Column::Integer(numbers.into_iter().map(|value| value as i32).collect());
    }
    Column::Real(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_have_the_types_and_units_of_the_run() {
        let cells = |texts: [&str; 2]| texts.map(Cell::of_text).to_vec();
        let names = ["angle", "mode", "count", "word", "unknown"];
        let table = Table {
            key: "time".to_owned(),
            keys: vec![0.0, 1.0],
            names: names.map(str::to_owned).to_vec(),
            columns: vec![
                cells(["0.5", ""]),
                cells(["1", "4"]),
                cells(["0", "2"]),
                cells(["a", "2"]),
                cells(["0", "2"]),
            ],
            ..Table::default()
        };
        let display = Some(("deg".to_owned(), 57.0, 0.0));
        let angle = Quantity { unit: Some("rad".to_owned()), display, ..Quantity::default() };
        let mode = Quantity { items: vec![("safe".to_owned(), 4)], ..Quantity::default() };
        let known =
            [("angle", angle), ("mode", mode), ("count", Quantity::default()), ("word", Quantity::default())];
        let columns = known.map(|(name, quantity)| (name.to_owned(), quantity)).into();
        let described = Described::new(&table, &Sidecar { columns, ..Sidecar::default() });
        let variables = &described.description.variables;
        assert_eq!(fmi::display_unit(&described.description, &variables[0]), Some(("deg", 57.0, 0.0)));
        let items = model_description::value::items(&described.description, &variables[1]);
        assert_eq!((items[0].name.as_str(), items[0].value), ("safe", 4));
        let [
            Column::Real(angle),
            Column::Integer(mode),
            Column::Integer(count),
            Column::Text(_),
            Column::Real(_),
        ] = &described.recording.columns[..]
        else {
            panic!("{:?}", described.recording.columns)
        };
        assert!(angle[0] == 0.5 && angle[1].is_nan() && mode == &[1, 4] && count == &[0, 2]);
    }
}
