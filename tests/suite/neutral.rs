//! Crates that take any FMU name no variable of a shipped one: what they need of a variable stands in its annotation.

use std::collections::BTreeSet;
use std::path::Path;

use syn::visit::{self, Visit};

use crate::sources::{is_for_tests, rust_files, workspace};
use crate::support::{SHIPPED, description};

/// Crates of the harness before `packing`, and the two after it that read tables and descriptions alone.
const NEUTRAL: &[&str] =
    &["files", "terminal", "fmi", "systems", "drawing", "isolation", "tables", "campaign"];

/// Names of several segments, as `wheel.speed` for `wheel[k].speed`: one segment alone is a word of the language.
fn shipped_names() -> BTreeSet<String> {
    let all = SHIPPED.iter().flat_map(|model| description(model).variables);
    all.map(|variable| bare(&variable.name)).filter(|name| name.contains('.')).collect()
}

/// A name without indices.
fn bare(name: &str) -> String {
    let mut depth = 0;
    let outside = name.chars().filter(|letter| {
        depth += i32::from(*letter == '[');
        let is_outside = depth == 0;
        depth -= i32::from(*letter == ']');
        is_outside
    });
    outside.collect()
}

/// Texts of a file's code, tests and comments apart.
#[derive(Default)]
struct Texts(Vec<String>);

impl<'ast> Visit<'ast> for Texts {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let attributes = match item {
            syn::Item::Fn(it) => &it.attrs,
            syn::Item::Mod(it) => &it.attrs,
            _ => return visit::visit_item(self, item),
        };
        if !is_for_tests(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}

    fn visit_lit_str(&mut self, text: &'ast syn::LitStr) {
        self.0.push(text.value());
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.0.push(call.tokens.to_string());
    }
}

/// The names among `known` that a text has as words.
fn named<'a>(text: &str, known: &'a BTreeSet<String>) -> Vec<&'a str> {
    let text = bare(text);
    let is_in_name = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == '.';
    let words = text.split(|letter| !is_in_name(letter)).map(|word| word.trim_matches('.'));
    words.filter_map(|word| known.get(word)).map(String::as_str).collect()
}

fn names_in(file: &Path, known: &BTreeSet<String>) -> Vec<String> {
    let syntax = syn::parse_file(&std::fs::read_to_string(file).unwrap()).unwrap();
    let mut texts = Texts::default();
    texts.visit_file(&syntax);
    texts.0.iter().flat_map(|text| named(text, known)).map(str::to_owned).collect()
}

#[test]
fn crates_for_any_fmu_name_no_variable_of_a_shipped_one() {
    let known = shipped_names();
    assert!(known.contains("wheel.capacity") && known.contains("start.epoch"));
    assert_eq!(named("of \"wheel[*].capacity\", beside", &known), ["wheel.capacity"]);
    let mut found = Vec::new();
    for folder in NEUTRAL {
        let sources = workspace().join("harness").join(folder).join("src");
        for file in rust_files(&sources).iter().filter(|file| !file.ends_with("tests.rs")) {
            let names = names_in(file, &known);
            if !names.is_empty() {
                found.push(format!("{}: {}", file.display(), names.join(", ")));
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}
