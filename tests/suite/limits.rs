//! Limits of the production code: lines of a file and of a function, parameters; inside the FMU also names of effects outside their
//! sources, fields that a saved state leaves out.

use std::path::Path;

use syn::visit::{self, Visit};

use crate::sources::{rust_files, workspace};

const MAX_LINES: usize = 400;
const MAX_LINES_OF_A_FUNCTION: usize = 80;
/// Beside the receiver. Inside the FMU clippy bounds them, and a function of the standard may have more.
const MAX_PARAMETERS: usize = 5;

/// Folders of the code inside the FMU.
const CORE: &[&str] = &["fmu-src", "modelDescription"];

/// Folders of the code around it.
const HARNESS: &[&str] = &[
    "harness/files",
    "harness/terminal",
    "harness/fmi",
    "harness/systems",
    "harness/drawing",
    "harness/isolation",
    "harness/packing",
    "harness/inputs",
    "harness/tables",
    "harness/campaign",
    "harness/planner",
    "harness/cli",
    "xtask",
];

/// A line of production code, with its file below the workspace and its number.
struct Line {
    file: String,
    number: usize,
    text: String,
}

impl Line {
    fn place(&self) -> String {
        format!("{}:{}", self.file, self.number)
    }
}

/// The production code of each file below a folder of the workspace, up to an inline module of tests.
fn production(folder: &str) -> Vec<Vec<Line>> {
    let root = workspace();
    let files = rust_files(&root.join(folder)).into_iter().filter(|file| !is_for_tests(file));
    let lines = |file: std::path::PathBuf| {
        let name = file.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
        let text = std::fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let line = |(text, number): (&str, usize)| Line { file: name.clone(), number, text: text.to_owned() };
        code.lines().zip(1..).map(line).collect()
    };
    let found: Vec<Vec<Line>> = files.map(lines).collect();
    assert!(!found.is_empty(), "{folder}");
    found
}

fn is_for_tests(file: &Path) -> bool {
    let name = file.file_stem().unwrap().to_str().unwrap();
    let is_named = name == "tests" || name.ends_with("_tests") || name.starts_with("test_");
    is_named || file.components().any(|part| part.as_os_str() == "tests")
}

/// The functions of a file that rustfmt has set, with the number of their lines: from the head to the line that closes the body.
fn functions(lines: &[Line]) -> Vec<(&Line, usize)> {
    let is_head = |word: &str| {
        ["pub", "pub(crate)", "pub(super)", "const", "unsafe", "extern", "\"C\"", "async"].contains(&word)
            || word.starts_with("pub(in")
    };
    let mut found = Vec::new();
    for (place, line) in lines.iter().enumerate() {
        let code = line.text.trim_start();
        let Some((before, _)) = code.split_once("fn ") else { continue };
        if !before.replace("in ", "in").split_whitespace().all(is_head) {
            continue;
        }
        let indent = &line.text[..line.text.len() - code.len()];
        // A body, a body in one line, or a head without a body.
        let ends = |it: &Line| it.text == format!("{indent}}}") || it.text == format!("{indent};");
        let is_one_line = |it: &Line| it.text.ends_with('}') || it.text.ends_with(';');
        let more = lines[place..].iter().position(ends);
        found.push((line, if is_one_line(line) { 1 } else { 1 + more.unwrap_or_default() }));
    }
    found
}

const CODE: &str = "fn a() {\n    pub(in crate::x) const fn b(\n        c: u8,\n    ) -> u8 {\n        c\n    }\n}\n\nfn d() {}\n";

#[test]
fn functions_are_counted_from_head_to_end() {
    let line = |(text, number): (&str, usize)| Line { file: "x".into(), number, text: text.into() };
    let lines: Vec<Line> = CODE.lines().zip(1..).map(line).collect();
    let counts: Vec<_> = functions(&lines).iter().map(|(line, count)| (line.number, *count)).collect();
    assert_eq!(counts, [(1, 7), (2, 5), (9, 1)]);
}

#[test]
fn files_and_functions_keep_to_their_limits() {
    let mut beyond = Vec::new();
    for file in CORE.iter().chain(HARNESS).flat_map(|folder| production(folder)) {
        if file.len() > MAX_LINES {
            beyond.push(format!("{}: {} lines", file[0].file, file.len()));
        }
        for (line, count) in functions(&file) {
            if count > MAX_LINES_OF_A_FUNCTION {
                beyond.push(format!("{}: a function of {count} lines", line.place()));
            }
        }
    }
    assert!(beyond.is_empty(), "{}", beyond.join("\n"));
}

/// Functions with their numbers of parameters beside the receiver.
#[derive(Default)]
struct Signatures(Vec<(String, usize)>);

impl<'ast> Visit<'ast> for Signatures {
    fn visit_signature(&mut self, signature: &'ast syn::Signature) {
        let typed = signature.inputs.iter().filter(|input| matches!(input, syn::FnArg::Typed(_)));
        self.0.push((signature.ident.to_string(), typed.count()));
        visit::visit_signature(self, signature);
    }
}

fn signatures(code: &str) -> Vec<(String, usize)> {
    let mut found = Signatures::default();
    found.visit_file(&syn::parse_file(code).unwrap());
    found.0
}

#[test]
fn functions_keep_to_their_number_of_parameters() {
    let counted = signatures("fn a(b: (u8, u8), c: fn(u8, u8)) {} impl D { fn e(&mut self, f: u8) {} }");
    assert_eq!(counted, [("a".to_owned(), 2), ("e".to_owned(), 1)]);
    let mut beyond = Vec::new();
    for file in HARNESS.iter().flat_map(|folder| production(folder)) {
        let code: String = file.iter().map(|line| line.text.clone() + "\n").collect();
        let many = signatures(&code).into_iter().filter(|(_, count)| *count > MAX_PARAMETERS);
        beyond.extend(many.map(|(name, count)| format!("{}: {name} has {count} parameters", file[0].file)));
    }
    assert!(beyond.is_empty(), "{}", beyond.join("\n"));
}

/// A source alone names its effects; the table of them stands in `loads`.
#[test]
fn effects_are_named_in_their_sources_alone() {
    let folders = ["fmu-src/physics/src/plant", "fmu-src/models/src"];
    let all = folders.iter().flat_map(|folder| production(folder)).flatten();
    let is_name = |code: &str| {
        code.chars().next().is_some_and(char::is_uppercase)
            && code.chars().nth(1).is_some_and(char::is_lowercase)
    };
    let names = |line: &Line| {
        !line.text.trim_start().starts_with("//") && line.text.split("Effect::").skip(1).any(is_name)
    };
    let outside = all.filter(|line| !line.file.starts_with("fmu-src/physics/src/plant/sources/"));
    let named: Vec<String> = outside.filter(names).map(|line| line.place()).collect();
    assert!(named.is_empty(), "{}", named.join("\n"));
}

/// A flight is saved whole.
#[test]
fn saved_states_leave_no_field_out() {
    let folders = ["fmu-src/physics/src/plant", "fmu-src/physics/src/attitude"];
    let all = folders.iter().flat_map(|folder| production(folder)).flatten();
    let left: Vec<String> =
        all.filter(|line| line.text.contains("serde(skip")).map(|line| line.place()).collect();
    assert!(left.is_empty(), "{}", left.join("\n"));
}
