//! `--per-plate`: the spacecraft's file with the key that requests the outputs of single plates.

use fmi::Binary;
use model_description::Description;
use toml::de::DeTable;

use super::source::description;

/// The key of a spacecraft file that requests them.
const KEY: &str = "per_plate_outputs";

/// The text with the key set to true; whatever else stands in it stays, comments too.
pub(super) fn asking(text: &str) -> Result<String, String> {
    let table = DeTable::parse(text).map_err(|error| error.to_string())?;
    let found = table.get_ref().iter().find(|(key, _)| key.get_ref() == KEY);
    Ok(match found {
        Some((_, value)) => {
            let span = value.span();
            format!("{}true{}", &text[..span.start], &text[span.end..])
        }
        None => {
            // Before the first table's head, or the key would belong to that table.
            let body = text.strip_prefix('\u{feff}').unwrap_or(text);
            format!("{KEY} = true\n{body}")
        }
    })
}

/// The model's description for a spacecraft with these outputs.
///
/// # Errors
/// A model that has none, with the models that do.
pub(super) fn describe(
    binary: &Binary,
    model: &str,
    file: Option<&str>,
    text: &str,
) -> Result<Description, Box<dyn std::error::Error>> {
    // A model that does not know the key reports its own kind of file, which does not explain the option.
    if let Some(description) = described(binary, model, file, text).filter(has_plates) {
        return Ok(description);
    }
    let others: Vec<String> = binary
        .models()?
        .into_iter()
        .filter(|other| {
            let text = binary.describe(&other.model, None, None).ok().map(|it| it.default_setup);
            let asking = text.and_then(|text| asking(&text).ok());
            asking
                .and_then(|text| described(binary, &other.model, None, &text))
                .is_some_and(|it| has_plates(&it))
        })
        .map(|other| other.model)
        .collect();
    let allowed = if others.is_empty() { "none of this library".to_owned() } else { others.join(", ") };
    Err(format!("--per-plate: {model} has no outputs of single plates, allowed: {allowed}").into())
}

fn described(binary: &Binary, model: &str, file: Option<&str>, text: &str) -> Option<Description> {
    description(&binary.describe(model, file, Some(text)).ok()?).ok()
}

fn has_plates(description: &Description) -> bool {
    description.variables.iter().any(|variable| variable.name.starts_with("plate[1]."))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_key_is_added_or_overruled_and_the_rest_stays() {
        let rest = "# mine\nname = \"A\" # per_plate_outputs = false\n[mass]\nper_plate_outputs = false\n";
        assert_eq!(asking(rest).unwrap(), format!("per_plate_outputs = true\n{rest}"));
        let given = "# mine\r\n\"per_plate_outputs\"  =  false  # none\r\n[mass]\r\n";
        assert_eq!(asking(given).unwrap(), "# mine\r\n\"per_plate_outputs\"  =  true  # none\r\n[mass]\r\n");
        assert_eq!(asking("").unwrap(), "per_plate_outputs = true\n");
        assert!(asking("[mass").is_err());
    }

    #[test]
    fn a_byte_order_mark_does_not_end_up_inside() {
        let text = asking("\u{feff}name = \"A\"\n").unwrap();
        assert_eq!(text, "per_plate_outputs = true\nname = \"A\"\n");
        let given = asking("\u{feff}name = \"\u{fc}\"\nper_plate_outputs = false\n").unwrap();
        assert!(given.ends_with("name = \"\u{fc}\"\nper_plate_outputs = true\n"), "{given:?}");
    }
}
