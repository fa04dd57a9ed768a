//! Imports run one way: modules of the crate in the order of [`ORDER`], and no file uses one that uses it. A type's
//! methods stand in the file of the type.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

const ORDER: &[&str] = &[
    "constants",
    "enumeration",
    "math",
    "refusal",
    "numerics",
    "bodies",
    "attitude",
    "toml",
    "spacecraft",
    "propulsion",
    "environment",
    "loads",
    "radiation",
    "aerodynamics",
    "guidance",
    "momentum",
    "plant",
    "management",
    "spin",
    "plausibility",
];

/// Files that may use one another in a circle: none.
const EXCEPTIONS: &[&str] = &[];

/// The place of a file: `["spin", "plant"]` for `spin/plant/mod.rs` or `spin/plant.rs`.
type Module = Vec<String>;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Every file of the crate but its tests, with its code: no comments, no unit tests.
fn modules() -> BTreeMap<Module, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fmu-src/physics/src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let mut found = BTreeMap::new();
    for file in files {
        let inside = file.strip_prefix(&root).unwrap().with_extension("");
        let mut module: Module = inside.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
        if module.last().is_some_and(|last| last == "mod") {
            module.pop();
        }
        let is_test = module.iter().any(|part| part == "tests" || part.ends_with("_tests"));
        if module != ["lib"] && !is_test {
            found.insert(module, code(&fs::read_to_string(&file).unwrap()));
        }
    }
    found
}

fn code(text: &str) -> String {
    let text = text.split("\n#[cfg(test)]\nmod tests {").next().unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).map(|line| format!("{line}\n")).collect()
}

/// The paths of a `use` tree, with groups taken apart.
fn expanded(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((head, group)) = tree.split_once('{') else { return vec![tree.to_owned()] };
    let group = group.strip_suffix('}').unwrap_or(group);
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                items.push(&group[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    items.push(&group[start..]);
    let items = items.into_iter().filter(|item| !item.trim().is_empty());
    items.flat_map(expanded).map(|item| format!("{head}{item}")).collect()
}

/// Every path in `use` declarations, and every other one that begins with `crate`, `super` or a child's name.
fn paths(text: &str, children: &BTreeSet<&str>) -> Vec<String> {
    let (mut found, mut rest, mut other) = (Vec::new(), text, String::new());
    while let Some(at) = rest.find("use ") {
        let is_word = rest[..at].chars().next_back().is_none_or(char::is_whitespace);
        let end = rest[at..].find(';').map_or(rest.len(), |end| at + end);
        if is_word {
            found.extend(expanded(&rest[at + "use ".len()..end]));
            other.push_str(&rest[..at]);
            rest = &rest[end..];
        } else {
            other.push_str(&rest[..at + 1]);
            rest = &rest[at + 1..];
        }
    }
    other.push_str(rest);
    let in_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = other.split(|c: char| !in_path(c)).filter(|word| word.contains("::"));
    found.extend(words.map(|word| word.trim_end_matches(':').to_owned()).filter(|word| {
        let first = word.split("::").next().unwrap_or_default();
        ["crate", "super"].contains(&first) || children.contains(first)
    }));
    found
}

/// The file a path leads to, seen from `from`.
fn target(path: &str, from: &Module, known: &BTreeMap<Module, String>) -> Option<Module> {
    let parts: Vec<&str> = path.split("::").map(str::trim).collect();
    let mut module = from.clone();
    let mut rest = &parts[..];
    match parts.first().copied() {
        Some("crate") => (module, rest) = (Module::new(), &parts[1..]),
        Some("self") => rest = &parts[1..],
        _ => {
            while rest.first() == Some(&"super") {
                module.pop();
                rest = &rest[1..];
            }
        }
    }
    for part in rest {
        module.push((*part).to_owned());
        if !known.contains_key(&module) {
            module.pop();
            break;
        }
    }
    (module != *from && known.contains_key(&module)).then_some(module)
}

/// The files that each file uses.
fn uses() -> BTreeMap<Module, BTreeSet<Module>> {
    let known = modules();
    let children = |of: &Module| -> BTreeSet<&str> {
        known
            .keys()
            .filter(|m| m.len() == of.len() + 1 && m.starts_with(of))
            .map(|m| &**m.last().unwrap())
            .collect()
    };
    known
        .iter()
        .map(|(module, text)| {
            let paths = paths(text, &children(module));
            (module.clone(), paths.iter().filter_map(|path| target(path, module, &known)).collect())
        })
        .collect()
}

#[test]
fn a_module_uses_only_earlier_ones() {
    let rank = |module: &Module| {
        ORDER
            .iter()
            .position(|known| *known == module[0])
            .unwrap_or_else(|| panic!("{module:?} is in no listed module"))
    };
    let mut seen = 0;
    for (module, used) in uses() {
        for other in used {
            assert!(rank(&other) <= rank(&module), "{module:?} uses {other:?}, which comes later");
            seen += 1;
        }
    }
    assert!(seen > 300, "the scan found hardly any use: {seen}");
}

#[test]
fn no_file_uses_one_that_uses_it() {
    let uses = uses();
    let mut in_circles = Vec::new();
    for (module, first) in &uses {
        let mut reached = first.clone();
        let mut ahead: Vec<Module> = first.iter().cloned().collect();
        while let Some(next) = ahead.pop() {
            ahead.extend(uses[&next].iter().filter(|other| reached.insert((*other).clone())).cloned());
        }
        if reached.contains(module) {
            in_circles.push(module.join("::"));
        }
    }
    assert_eq!(in_circles, EXCEPTIONS, "files that use one another in a circle");
}

/// Types with methods of their own in a text: `impl<T> Name<T> {`, not `impl Trait for Name {`.
fn types_with_methods(text: &str) -> Vec<&str> {
    let heads = text.lines().enumerate().filter(|(_, line)| line.trim_start().starts_with("impl"));
    let start_of = |number: usize| text.lines().take(number).map(|line| line.len() + 1).sum::<usize>();
    let head = |(number, _)| text[start_of(number)..].split('{').next().unwrap_or_default().trim_start();
    heads.map(head).filter(|head| !head.contains(" for ")).filter_map(named).collect()
}

/// The type of an `impl`'s head, without its parameters; `None` where a macro names it.
fn named(head: &str) -> Option<&str> {
    let mut rest = head.strip_prefix("impl")?;
    if rest.starts_with('<') {
        let mut depth = 0;
        let end = rest.char_indices().find(|&(at, c)| {
            depth += i32::from(c == '<') - i32::from(c == '>' && !rest[..at].ends_with('-'));
            depth == 0
        });
        rest = &rest[end?.0 + 1..];
    }
    let name = rest.trim_start().split(|c: char| !c.is_alphanumeric() && c != '_').next()?;
    (!name.is_empty()).then_some(name)
}

/// Types whose methods stand in another file than the type itself.
fn apart(text: &str) -> Vec<&str> {
    let declares = |name: &str| {
        let mut words =
            text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
        let mut before = "";
        words.any(|word| {
            let found = word == name && ["struct", "enum", "union", "trait", "type"].contains(&before);
            before = word;
            found
        })
    };
    types_with_methods(text).into_iter().filter(|name| !declares(name)).collect()
}

#[test]
fn methods_stand_in_the_file_of_their_type() {
    let modules = modules();
    let found: Vec<String> = modules
        .iter()
        .flat_map(|(module, text)| {
            apart(text).into_iter().map(|name| format!("{}: {name}", module.join("::")))
        })
        .collect();
    assert_eq!(found, [""; 0], "types with methods in another file than their own");
    let count: usize = modules.values().map(|text| types_with_methods(text).len()).sum();
    assert!(count > 150, "the scan found hardly any methods: {count}");
}

#[test]
fn methods_in_another_file_are_found() {
    let text = "pub struct A<T>(T);\nimpl<T: Fn(f64) -> B> A<T> {}\nimpl<'a, L: Into<Vec<f64>>>\n    B<'a, L>\n{}\n\
                enum Cc { A }\nimpl C {}\nimpl Clone for D {}\nimpl<T> From<T> for E {}\nimpl $type {}\n";
    assert_eq!(types_with_methods(text), ["A", "B", "C"]);
    assert_eq!(apart(text), ["B", "C"]);
}

#[test]
fn grouped_imports_are_taken_apart() {
    let text = code(
        "use crate::{a::{b, c}, d, e::f};\npub use g::h;\n// crate::comment\nlet x = crate::i::j(super::k::L, m::n());\n\
         \n#[cfg(test)]\nmod tests {\n use crate::o; }",
    );
    let found = paths(&text, &BTreeSet::from(["g", "m"]));
    assert_eq!(
        found,
        [
            "crate::a::b",
            "crate::a::c",
            "crate::d",
            "crate::e::f",
            "g::h",
            "crate::i::j",
            "super::k::L",
            "m::n"
        ]
    );
}
