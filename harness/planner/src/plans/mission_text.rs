//! The text of a planned mission, with other values, for another folder.

use std::path::{Component, Path, PathBuf};

use toml_edit::{DocumentMut, Item, Table, value};

use crate::Failure;

/// Keys that name files which a mission reads.
const FILES: [&str; 5] = ["fmu", "spacecraft", "timeline", "ephemeris", "inputs"];

/// The mission's text, its files named from `folder`.
///
/// # Errors
/// A mission that cannot be read again.
pub(super) fn moved(file: &Path, folder: &Path) -> Result<DocumentMut, Failure> {
    let mut document: DocumentMut = files::read_text(file)?.parse()?;
    let home = file.parent().unwrap_or(Path::new(""));
    for key in FILES {
        let path = document.get(key).and_then(Item::as_str).map(|path| home.join(path));
        if let Some(path) = path {
            document[key] = value(relative(folder, &path).to_string_lossy().replace('\\', "/"));
        }
    }
    Ok(document)
}

/// Puts a value into `[set]`, in the place of those of single elements, which would count behind it.
pub(super) fn set(document: &mut DocumentMut, name: &str, item: Item) {
    let table = document.entry("set").or_insert(Item::Table(Table::new()));
    let Some(table) = table.as_table_like_mut() else { return };
    let is_element = |key: &str| key.strip_prefix(name).is_some_and(|rest| rest.starts_with('['));
    let elements: Vec<String> =
        table.iter().map(|(key, _)| key.to_owned()).filter(|key| is_element(key)).collect();
    for key in elements {
        table.remove(&key);
    }
    table.insert(name, item);
}

/// A number, or a list of several.
pub(super) fn numbers(values: &[f64]) -> Item {
    match values {
        [number] => value(*number),
        _ => value(values.iter().copied().collect::<toml_edit::Array>()),
    }
}

/// A path from a folder.
fn relative(folder: &Path, path: &Path) -> PathBuf {
    let whole = |path: &Path| std::fs::canonicalize(path).ok();
    let (Some(from), Some(to)) = (whole(folder), whole(path)) else { return path.to_owned() };
    let (from, to): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (from.components().collect(), to.components().collect());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    // On another drive.
    if shared == 0 {
        return to.iter().collect();
    }
    let up = from[shared..].iter().map(|_| Component::ParentDir);
    up.chain(to[shared..].iter().copied()).collect()
}
