//! Origin of a table, as TOML beside it: the simulation, its values, and the columns.

use std::path::PathBuf;

use fmi::{Times, Value};
use inputs::{epoch, variables};
use model_description::{Description, value};
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table};

use super::display_form::find;

/// The first line.
pub(super) const HEAD: &str =
    "# The table beside this file, as `heliotorque run` wrote it: values and columns in SI.\n";

/// The key of an FMU's epoch at the start.
pub const EPOCH_KEY: &str = "epoch_s_past_j2000_tdb";

/// Origin of a table.
pub struct Origin<'a> {
    /// The FMU, system or mission, as it was named.
    pub file: PathBuf,
    /// Its FMUs: what their variables begin with, and their descriptions.
    pub fmus: Vec<(String, &'a Description)>,
    /// All variables.
    pub described: &'a Description,
    /// Start, stop and step.
    pub times: Times,
    /// Values set before the run.
    pub sets: &'a [(String, Value)],
    /// The file of inputs over time.
    pub input: Option<PathBuf>,
}

impl Origin<'_> {
    /// The file of a table with these columns.
    pub fn to_toml(&self, columns: &[String]) -> String {
        let mut document = DocumentMut::new();
        let mut set = |key: &str, item: Item| drop(document.insert(key, item));
        let program = concat!("heliotorque", " ", env!("CARGO_PKG_VERSION"));
        set("program", toml_edit::value(program));
        set("simulated", toml_edit::value(self.file.display().to_string()));
        if let Some(input) = &self.input {
            set("input", toml_edit::value(input.display().to_string()));
        }
        set_times(&mut document, self.times);
        let mut set = |key: &str, item: Item| drop(document.insert(key, item));
        set(
            "fmus",
            Item::ArrayOfTables(self.fmus.iter().map(|fmu| self.fmu(fmu)).collect::<ArrayOfTables>()),
        );
        let mut values = Table::new();
        for (name, value) in self.sets {
            values.insert(name, toml_edit::value(self.value(name, value)));
        }
        set("values", Item::Table(values));
        let mut table = Table::new();
        table.insert("time", toml_edit::value(InlineTable::from_iter([("unit", "s")])));
        for name in columns {
            table.insert(name, toml_edit::value(self.column(name)));
        }
        set("columns", Item::Table(table));
        format!("{HEAD}{document}")
    }

    fn fmu(&self, (prefix, description): &(String, &Description)) -> Table {
        let mut table = Table::new();
        if let Some(component) = prefix.strip_suffix('.') {
            table.insert("component", toml_edit::value(component));
        }
        set_identity(&mut table, description);
        let start = epoch::starts(description).next();
        let start = start.map(|it| format!("{prefix}{}", it.name));
        if let Some(epoch_s) = start.and_then(|name| variables::real(self.described, self.sets, &name)) {
            // Of the start.
            if let Some(date) = epoch::date(epoch_s) {
                table.insert("epoch", toml_edit::value(date));
            }
            table.insert(EPOCH_KEY, toml_edit::value(epoch_s));
        }
        table
    }

    fn value(&self, name: &str, given: &Value) -> toml_edit::Value {
        match given {
            Value::Real(number) => (*number).into(),
            Value::Integer(number) => {
                let items = find(self.described, name).map_or(&[][..], |it| value::items(self.described, it));
                let item = items.iter().find(|item| item.value == *number);
                item.map_or_else(|| i64::from(*number).into(), |item| item.name.as_str().into())
            }
            Value::Boolean(truth) => (*truth).into(),
            Value::Text(text) => text.as_str().into(),
        }
    }

    fn column(&self, name: &str) -> InlineTable {
        let mut column = InlineTable::new();
        let Some(variable) = find(self.described, name) else { return column };
        if let Some(unit) = fmi::unit(self.described, variable) {
            column.insert("unit", unit.into());
        }
        if let Some((name, factor, offset)) = fmi::display_unit(self.described, variable) {
            let mut display = InlineTable::from_iter([("unit", toml_edit::Value::from(name))]);
            display.insert("factor", factor.into());
            if offset != 0.0 {
                display.insert("offset", offset.into());
            }
            column.insert("display", display.into());
        }
        let items = value::items(self.described, variable);
        if !items.is_empty() {
            let items: InlineTable =
                items.iter().map(|item| (item.name.as_str(), i64::from(item.value))).collect();
            column.insert("items", items.into());
        }
        if let Some(role) = variable.role() {
            column.insert("role", role.as_str().into());
        }
        if let Some(description) = &variable.description {
            column.insert("description", description.as_str().into());
        }
        column
    }
}

/// Writes start, stop and step.
pub fn set_times(table: &mut Table, Times { start_s, stop_s, step_s }: Times) {
    for (key, time_s) in [("start_s", start_s), ("stop_s", stop_s), ("step_s", step_s)] {
        table.insert(key, toml_edit::value(time_s));
    }
}

/// Writes the name, version and origin of an FMU.
pub fn set_identity(table: &mut Table, description: &Description) {
    let Description { model_name, guid, version, generation_tool, .. } = description;
    for (key, text) in [
        ("name", Some(model_name)),
        ("guid", Some(guid)),
        ("version", version.as_ref()),
        ("made_by", generation_tool.as_ref()),
    ] {
        text.iter().for_each(|text| drop(table.insert(key, toml_edit::value(text.as_str()))));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANT: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Plant" guid="{plant}" version="2">
  <CoSimulation modelIdentifier="Plant"/>
  <UnitDefinitions><Unit name="N.m.s"><DisplayUnit name="mN.m.s" factor="1000"/></Unit><Unit name="s"/></UnitDefinitions>
  <TypeDefinitions><SimpleType name="Mode"><Enumeration><Item name="nadir" value="1"/><Item name="safe" value="4"/></Enumeration></SimpleType></TypeDefinitions>
  <ModelVariables>
    <ScalarVariable name="start.epoch" valueReference="0" causality="parameter" variability="fixed"><Real unit="s" start="0"/><Annotations><Tool name="io.github.heliotorque"><Variable role="epoch"/></Tool></Annotations></ScalarVariable>
    <ScalarVariable name="momentum[2]" valueReference="1" causality="output" description="System &quot;momentum&quot;."><Real unit="N.m.s" displayUnit="mN.m.s"/></ScalarVariable>
    <ScalarVariable name="mode" valueReference="2" causality="output" variability="discrete"><Enumeration declaredType="Mode"/></ScalarVariable>
    <ScalarVariable name="mode.start" valueReference="3" causality="parameter" variability="fixed"><Enumeration declaredType="Mode" start="1"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>"#;

    #[test]
    fn units_epoch_values_and_versions_can_be_read_back() {
        let described = model_description::parse(PLANT.as_bytes()).unwrap().description;
        let sets = [
            ("mode.start".to_owned(), Value::Integer(4)),
            ("start.epoch".to_owned(), Value::Real(292_248_000.0)),
        ];
        let origin = Origin {
            file: PathBuf::from("m.toml"),
            fmus: vec![(String::new(), &described)],
            described: &described,
            times: Times::new(0.0, 60.0, 10.0).unwrap(),
            sets: &sets,
            input: None,
        };
        let text = origin.to_toml(&["momentum[2]", "mode", "start.epoch"].map(str::to_owned));
        assert!(text.starts_with(HEAD));
        let read: toml::Table = text.parse().unwrap();
        assert_eq!(read["step_s"].as_float(), Some(10.0));
        let fmu = &read["fmus"][0];
        assert_eq!((fmu["guid"].as_str(), fmu["version"].as_str()), (Some("{plant}"), Some("2")));
        assert!(fmu["epoch"].as_str().unwrap().starts_with("2009-04-05T23:58:53.81"), "66.184 s before TDB");
        assert_eq!(read["values"]["mode.start"].as_str(), Some("safe"));
        assert_eq!(read["columns"]["time"]["unit"].as_str(), Some("s"));
        let column = &read["columns"]["momentum[2]"];
        assert_eq!(column["unit"].as_str(), Some("N.m.s"));
        let display = &column["display"];
        assert_eq!((display["unit"].as_str(), display["factor"].as_float()), (Some("mN.m.s"), Some(1000.0)));
        assert_eq!(column["description"].as_str(), Some("System \"momentum\"."));
        assert_eq!(read["columns"]["start.epoch"]["role"].as_str(), Some("epoch"));
        assert_eq!(read["columns"]["mode"]["items"]["safe"].as_integer(), Some(4));
    }
}
