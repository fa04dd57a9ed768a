//! Comments and names of production code and of the tools of the tests: doc texts are sentences with subject and verb, or noun phrases
//! that name a thing; identifiers are the field's words.
//!
//! A doc text that reaches the XML, a schema, a guide or a message is public and stands: that of a variable (a field with its role), of an
//! enumeration and its items, of a key of a file, of a row of a macro that hands its comments on.

use std::collections::BTreeSet;
use std::path::Path;

use crate::sources::{rust_files, workspace};

/// The folders that are held to it.
const FOLDERS: &[&str] = &["fmu-src", "harness", "modelDescription", "tests", "xtask"];

/// This file, which holds the words that are sought.
const OWN: &str = "tests/suite/prose.rs";

/// First words of a clause that stands where a noun or a verb should.
const FIRST_WORDS: &[&str] =
    &["What", "Where", "Which", "Who", "Of", "That", "Those", "It", "None", "Nothing"];

const PHRASES: &[&str] = &[
    "nothing is known",
    "is another",
    "are others",
    "all ways",
    "so many",
    "of which",
    "goes by",
    "whoever",
];

/// Identifiers that were replaced, with the folder in which they mean what was renamed: elsewhere some are other things.
const OLD_NAMES: &[(&str, &str)] = &[
    ("mass_at_zero", ""),
    ("fn loaded", "fmu-src/physics/src/spacecraft"),
    ("set_left", ""),
    ("give_at_once", ""),
    ("dump_at_once", ""),
    ("exert", ""),
    ("is_pushed", ""),
    ("fall_m_s2", ""),
    ("farthest_m", ""),
    ("reach_m", "fmu-src/physics/src/environment/orbit"),
    ("first_fall", ""),
    ("EDGE_M", ""),
    ("Reached", "fmu-src/physics/src/environment/orbit"),
    ("Approach", "fmu-src"),
    ("Approaches", "fmu-src"),
    ("came_nearer", ""),
    ("fn follow", "fmu-src/physics/src/attitude"),
    ("follow_panels", ""),
    ("fn stand", "fmu-src/physics/src/attitude"),
    ("fn arrive", ""),
    ("displace", ""),
    ("given_way", ""),
    ("way_rad", ""),
    ("SunPlace", ""),
    ("choose_sun_place", ""),
    ("SunChoice", ""),
    ("ScienceCourse", ""),
    ("CoursePoint", ""),
    ("swing", "fmu-src/physics/src/guidance"),
    ("fn note", "fmu-src/physics/src/management"),
    ("Entered", ""),
    ("Slots", ""),
    ("fork_room", ""),
    ("fn mark", "fmu-src/physics/src/plant"),
    ("go_back", ""),
    ("Shown", "fmu-src"),
    ("shown", "fmu-src/physics/src/plant"),
    ("flyable", ""),
    ("uncovered", ""),
    ("Followed", ""),
    ("say_followed", ""),
    ("left_out", "fmu-src"),
    ("fn leave", "fmu-src/physics/src/plant"),
    ("remember_window", ""),
    ("Effort", ""),
    ("Cost", "fmu-src/physics/src/plant"),
    ("fn of", ""),
];

/// Beginnings of names that were replaced, with the folders in which they are: functions that take nothing away, bounds.
const OLD_BEGINNINGS: &[(&str, &[&str])] = &[
    ("fn take_", &["fmu-src", "modelDescription", "tests"]),
    ("const MOST_", &["harness", "tests", "xtask"]),
    ("const LEAST_", &["harness", "tests", "xtask"]),
];

/// Derives and macros whose comments are public, and roles of variables.
const PUBLIC_DERIVES: &[&str] = &["Args", "Enumeration", "JsonSchema", "Parser", "Subcommand", "ValueEnum"];
const PUBLIC_MACROS: &[&str] = &[
    "choices!",
    "optional_choices!",
    "tables!",
    "ranges!",
    "enumeration!",
    "file_enumerations!",
    "effects!",
    "codes!",
    "functions!",
];
const ROLES: &[&str] = &["#[parameter", "#[calculated_parameter", "#[input", "#[output", "#[local", "#[arg("];

/// A file's lines up to its inline module of tests.
fn production(text: &str) -> Vec<&str> {
    let lines: Vec<&str> = text.lines().collect();
    let is_tests = |pair: &[&str]| {
        pair[0].trim() == "#[cfg(test)]" && pair[1].trim_start().starts_with("mod ") && pair[1].ends_with('{')
    };
    let end = lines.windows(2).position(is_tests).unwrap_or(lines.len());
    lines[..end].to_vec()
}

/// The text of a doc comment's line.
fn doc(line: &str) -> Option<&str> {
    let line = line.trim_start();
    line.strip_prefix("///").or_else(|| line.strip_prefix("//!")).map(str::trim_start)
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// Whether `text` holds the words of `sought` one after another.
fn holds(text: &str, sought: &str) -> bool {
    if !words(sought).all(|word| text.contains(word)) {
        return false;
    }
    let (all, sought): (Vec<&str>, Vec<&str>) = (words(text).collect(), words(sought).collect());
    all.windows(sought.len()).any(|some| some == sought)
}

/// The line at which an item that begins at `start` ends: a closing bracket as far in as its beginning, or its own line.
fn end_of_item(lines: &[&str], start: usize) -> usize {
    let indent = lines[start].len() - lines[start].trim_start().len();
    let opening = lines[start..]
        .iter()
        .position(|line| line.ends_with(['{', ';', ',', '}']))
        .map_or(start, |at| start + at);
    if !lines[opening].ends_with('{') {
        return opening;
    }
    let is_end = |line: &&str| {
        line.len() - line.trim_start().len() == indent && line.trim_start().starts_with(['}', ')'])
    };
    lines[opening + 1..].iter().position(is_end).map_or(lines.len() - 1, |at| opening + 1 + at)
}

/// The line of the brace that closes the last one opened at `start`.
fn end_of_macro(lines: &[&str], start: usize) -> usize {
    let mut depth = 0;
    let is_closed = |line: &&str| {
        depth += line.matches('{').count();
        depth -= line.matches('}').count().min(depth);
        depth == 0
    };
    lines[start..].iter().position(is_closed).map_or(lines.len() - 1, |at| start + at)
}

/// Numbers of the lines whose comments reach the XML, a schema, a guide or a message.
fn public_lines(lines: &[&str]) -> BTreeSet<usize> {
    let mut public = BTreeSet::new();
    let is_attribute_or_doc = |line: &str| line.trim_start().starts_with("#[") || doc(line).is_some();
    for (number, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let is_derive = code.starts_with("#[")
            && code.contains("derive(")
            && PUBLIC_DERIVES.iter().any(|name| holds(code, name));
        let is_macro = PUBLIC_MACROS.iter().any(|name| code.starts_with(name)) && code.ends_with('{');
        let is_role = ROLES.iter().any(|role| code.starts_with(role));
        if !is_derive && !is_macro && !is_role {
            continue;
        }
        let begin =
            (0..number).rev().take_while(|at| is_attribute_or_doc(lines[*at])).last().unwrap_or(number);
        let mut item = number;
        while is_derive && is_attribute_or_doc(lines[item]) {
            item += 1;
        }
        let end = match (is_role, is_macro) {
            (true, _) => number,
            (false, true) => end_of_macro(lines, number),
            (false, false) => end_of_item(lines, item),
        };
        public.extend(begin..=end);
    }
    public
}

/// Faults of a file's text: line from 1, what is wrong.
fn faults(file: &str, text: &str) -> Vec<(usize, String)> {
    let lines = production(text);
    let public = public_lines(&lines);
    let mut found = Vec::new();
    let mut is_within = false;
    for (number, line) in lines.iter().enumerate() {
        let mut fault = |what: String| found.push((number + 1, what));
        if let Some(doc) = doc(line) {
            let first = words(doc).next().filter(|word| doc.starts_with(word)).unwrap_or_default();
            if !public.contains(&number) {
                if !is_within && FIRST_WORDS.contains(&first) {
                    fault(format!("a comment begins with {first}"));
                }
                let lower = doc.to_lowercase();
                PHRASES
                    .iter()
                    .filter(|it| holds(&lower, it))
                    .for_each(|it| fault(format!("a comment says `{it}`")));
            }
        } else {
            let code = line.split("//").next().unwrap_or_default();
            let is_old = |(name, folder): &&(&str, &str)| file.starts_with(folder) && holds(code, name);
            OLD_NAMES.iter().filter(is_old).for_each(|(name, _)| fault(format!("an old name: `{name}`")));
            let begins = |(name, folders): &&(&str, &[&str])| {
                code.contains(name) && folders.iter().any(|folder| file.starts_with(folder))
            };
            OLD_BEGINNINGS
                .iter()
                .filter(begins)
                .for_each(|(name, _)| fault(format!("a name that begins with `{name}`")));
        }
        is_within = doc(line).is_some();
    }
    found
}

/// Whether a file holds tests alone.
fn is_of_tests(file: &str) -> bool {
    let name = file.rsplit('/').next().unwrap_or_default();
    let is_below_tests = file.split('/').skip(1).any(|part| part == "tests");
    is_below_tests || name == "tests.rs" || name.ends_with("_tests.rs") || name.starts_with("test_")
}

fn relative(path: &Path) -> String {
    path.strip_prefix(workspace()).unwrap().to_string_lossy().replace('\\', "/")
}

#[test]
fn comments_and_names_are_plain() {
    let mut found = Vec::new();
    let mut count = 0;
    for path in FOLDERS.iter().flat_map(|folder| rust_files(&workspace().join(folder))) {
        let file = relative(&path);
        if is_of_tests(&file) || file == OWN {
            continue;
        }
        count += 1;
        let faults = faults(&file, &std::fs::read_to_string(&path).unwrap());
        found.extend(faults.into_iter().map(|(line, fault)| format!("{file}:{line}: {fault}")));
    }
    assert!(found.is_empty(), "{} faults:\n{}", found.len(), found.join("\n"));
    assert!(count > 100, "hardly any file was read: {count}");
}

#[test]
fn faults_are_found_where_comments_are_not_public() {
    let text = "//! Where it stands.\n\n/// What turns.\n/// It is another way\nfn of() {\n    self.shown; // Shown\n}\n\n\
                /// Which one.\n#[derive(Clone, Enumeration)]\npub enum E {\n    /// None.\n    A,\n}\n\n\
                struct S {\n    /// What it is.\n    #[output(unit = \"m\")]\n    pub a: Real,\n    /// Of that.\n    b: u8,\n}\n\n\
                choices! {\n    /// Which way.\n    D(E);\n}\n\nfn take_it() {}\nfn offer() {}\n\
                #[cfg(test)]\nmod tests {\n    /// What is tested.\n    fn of() {}\n}\n";
    let found = faults("fmu-src/physics/src/plant/flight.rs", text);
    let expected = [
        (1, "a comment begins with Where"),
        (3, "a comment begins with What"),
        (4, "a comment says `is another`"),
        (5, "an old name: `fn of`"),
        (6, "an old name: `shown`"),
        (20, "a comment begins with Of"),
        (29, "a name that begins with `fn take_`"),
    ];
    assert_eq!(found, expected.map(|(line, what)| (line, what.to_owned())));
    assert_eq!(faults("modelDescription/src/a.rs", "let shown = 1;\n"), []);
}
