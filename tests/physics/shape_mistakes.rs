//! Mistakes in a shape are refused with their line, key, what was found and what is allowed.

use physics::spacecraft::Spacecraft;

use super::shapes::HEAD;

/// Surfaces, then, indented, what is reported of them: the line behind the head of the file, key, finding and remedy.
const MISTAKES: &str = include_str!("shape_mistakes.txt");

#[test]
fn what_is_no_shape_is_refused_by_its_place() {
    let head = HEAD.lines().count();
    for mistake in MISTAKES.trim_end().split("\n\n") {
        let (findings, surfaces): (Vec<&str>, Vec<&str>) =
            mistake.lines().partition(|line| line.starts_with("    +"));
        let text = format!("{HEAD}{}\n", surfaces.join("\n"));
        let found = Spacecraft::from_toml("a.toml", &text).unwrap_err().to_string();
        let expected = findings.iter().map(|findings| {
            let (line, rest) = findings.trim_start_matches("    +").split_once(':').unwrap();
            format!("a.toml:{}:{rest}", head + line.parse::<usize>().unwrap())
        });
        assert_eq!(found, expected.collect::<Vec<_>>().join("\n"), "{mistake}");
    }
}
