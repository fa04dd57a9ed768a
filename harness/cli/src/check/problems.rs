//! The problems that a message tells, counted.

/// How many problems of a file a message tells, the unlisted ones among them: `1 problem`, `3 problems`.
pub fn problem_count(message: &str, file: &str) -> String {
    let of_line = |line: &str| -> usize {
        let unlisted = line.strip_prefix(file).and_then(|rest| {
            let rest = rest.strip_prefix(": ")?;
            rest.strip_suffix(" more problems").or_else(|| rest.strip_suffix(" more problem"))
        });
        unlisted.and_then(|count| count.parse().ok()).unwrap_or(1)
    };
    let count = message.lines().filter(|line| line.starts_with(file)).map(of_line).sum::<usize>().max(1);
    format!("{count} problem{}", if count == 1 { "" } else { "s" })
}
