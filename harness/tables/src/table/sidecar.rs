//! Sidecar of a table, `NAME.csv.toml`: units, items and epoch of a run, units and sampling of a campaign.

use std::{collections::BTreeMap, io::ErrorKind, path::Path};

use model_description::VariableRole;

use crate::output::EPOCH_KEY;

/// Metadata of a table's columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sidecar {
    /// Name of the simulation, for people.
    pub title: Option<String>,
    /// Epoch of time 0, in s past J2000 TDB.
    pub zero_epoch_s: Option<f64>,
    /// Metadata of each column.
    pub columns: BTreeMap<String, Quantity>,
    /// How a campaign draws its values.
    pub sampling: Option<String>,
    /// Varied columns.
    pub varied: Vec<String>,
}

/// Quantity of a column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quantity {
    /// Its unit.
    pub unit: Option<String>,
    /// The unit that people read: name, factor, offset.
    pub display: Option<(String, f64, f64)>,
    /// Items of an Enumeration.
    pub items: Vec<(String, i32)>,
    /// In words.
    pub description: Option<String>,
    /// Role by the FMU's annotation.
    pub role: Option<VariableRole>,
}

impl Sidecar {
    /// Reads the sidecar of a table; one without a sidecar has no metadata.
    ///
    /// # Errors
    /// A file beside it that cannot be read, or is no TOML.
    pub fn beside(table: &Path) -> Result<Self, String> {
        let path = files::sidecar_of(table);
        if std::fs::metadata(&path).is_err_and(|error| error.kind() == ErrorKind::NotFound) {
            return Ok(Self::default());
        }
        let text = files::read_text(&path)?;
        let parsed: toml::Table = text.parse().map_err(|error: toml::de::Error| {
            let line = 1 + text[..error.span().map_or(0, |span| span.start)].matches('\n').count();
            format!("{}:{line}: {}", path.display(), error.message())
        })?;
        Ok(Self::from_toml(&parsed))
    }

    /// Keys that are missing leave their fields empty.
    fn from_toml(parsed: &toml::Table) -> Self {
        let table = |key: &str| parsed.get(key).and_then(toml::Value::as_table);
        let text = |key: &str| parsed.get(key).and_then(toml::Value::as_str).map(str::to_owned);
        let fmus = parsed.get("fmus").and_then(toml::Value::as_array).map_or(&[][..], Vec::as_slice);
        let start_s = parsed.get("start_s").and_then(number).unwrap_or(0.0);
        // A campaign has one FMU.
        let all = fmus.iter().chain(parsed.get("fmu"));
        let epochs_s: Vec<f64> = all.filter_map(|fmu| number(fmu.get(EPOCH_KEY)?)).collect();
        // Parts of a system that start at different epochs have no common dates.
        let epoch_s = epochs_s.first().copied().filter(|first| epochs_s.iter().all(|other| other == first));
        let name = match fmus {
            [only] => only.get("name").and_then(toml::Value::as_str).map(str::to_owned),
            _ => None,
        };
        let mut columns = BTreeMap::new();
        for (name, column) in table("columns").into_iter().flatten() {
            columns.insert(name.clone(), quantity(column));
        }
        for (name, unit) in table("units").into_iter().flatten() {
            let known: &mut Quantity = columns.entry(name.clone()).or_default();
            known.unit = unit.as_str().map(str::to_owned);
        }
        Self {
            title: name.or_else(|| text("simulated")),
            zero_epoch_s: epoch_s.map(|epoch_s| epoch_s - start_s),
            columns,
            sampling: text("sampling"),
            varied: table("vary").into_iter().flatten().map(|(name, _)| name.clone()).collect(),
        }
    }

    /// The unit of a column, unless it is none.
    pub fn unit(&self, name: &str) -> Option<&str> {
        self.columns.get(name)?.unit.as_deref().filter(|unit| !unit.is_empty() && *unit != "1")
    }

    /// A name with its unit in brackets.
    pub fn labelled(&self, name: &str) -> String {
        self.unit(name).map_or_else(|| name.to_owned(), |unit| format!("{name} [{unit}]"))
    }
}

fn number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

fn quantity(column: &toml::Value) -> Quantity {
    let text = |key: &str| column.get(key).and_then(toml::Value::as_str).map(str::to_owned);
    let display = column.get("display").and_then(|it| {
        let part = |key: &str, otherwise: f64| it.get(key).map_or(Some(otherwise), number);
        Some((it.get("unit")?.as_str()?.to_owned(), part("factor", 1.0)?, part("offset", 0.0)?))
    });
    let items = column.get("items").and_then(toml::Value::as_table).into_iter().flatten();
    let items = items.filter_map(|(name, value)| Some((name.clone(), value.as_integer()?.try_into().ok()?)));
    let role = text("role").and_then(|role| VariableRole::from_word(&role));
    Quantity { unit: text("unit"), display, items: items.collect(), description: text("description"), role }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_kinds_of_files_are_read() {
        let run = Sidecar::from_toml(
            &r#"
            start_s = 10
            simulated = "mission.toml"
            [[fmus]]
            name = "Plant"
            epoch_s_past_j2000_tdb = 510.5
            [columns]
            time = { unit = "s" }
            lit = { role = "litFraction" }
            angle = { unit = "rad", display = { unit = "deg", factor = 57.0 } }
            mode = { items = { nadir = 1, safe = 4 }, description = "Mode." }
            "#
            .parse()
            .unwrap(),
        );
        assert_eq!((run.title.as_deref(), run.zero_epoch_s), (Some("Plant"), Some(500.5)));
        assert_eq!(run.columns["angle"].display, Some(("deg".to_owned(), 57.0, 0.0)));
        assert_eq!(run.columns["lit"].role, Some(VariableRole::LitFraction));
        assert_eq!(run.columns["mode"].items, [("nadir".to_owned(), 1), ("safe".to_owned(), 4)]);
        assert_eq!(
            (run.labelled("angle"), run.labelled("mode")),
            ("angle [rad]".to_owned(), "mode".to_owned())
        );

        let campaign = "sampling = \"oneAtATime\"\nstart_s = 10\n[fmu]\nepoch_s_past_j2000_tdb = 30\n[units]\nx = \"m\"\ny = \"1\"\n[vary]\nx = { normal = [0, 1] }\n";
        let campaign = Sidecar::from_toml(&campaign.parse().unwrap());
        assert_eq!((campaign.unit("x"), campaign.unit("y")), (Some("m"), None));
        assert_eq!(campaign.zero_epoch_s, Some(20.0));
        assert_eq!(
            (campaign.sampling.as_deref(), &campaign.varied[..]),
            (Some("oneAtATime"), &["x".to_owned()][..])
        );
    }
}
