//! The faults of the corpus, as `faults.txt` lists them.

/// A fault: a file name without extension, and what is replaced by what.
pub(crate) struct Fault {
    pub name: &'static str,
    pub edits: Vec<(String, String)>,
}

/// Every fault, in the order of the codes.
pub(crate) fn faults() -> Vec<Fault> {
    let text = |line: &str| line.replace("\\n", "\n");
    let fault = |block: &'static str| {
        let (name, edits) = block.split_once('\n').unwrap();
        let lines: Vec<&str> = edits.lines().filter(|line| !line.is_empty()).collect();
        let edits = lines.chunks(2).map(|pair| match pair {
            [from, to] => (text(&from[2..]), text(to.strip_prefix("+ ").unwrap_or_default())),
            _ => panic!("{name}: a line without its other"),
        });
        Fault { name, edits: edits.collect() }
    };
    include_str!("faults.txt").split("\n## ").skip(1).map(fault).collect()
}
