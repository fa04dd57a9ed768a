//! `cargo xtask bench --against FOLDER`: the figures of this checkout and of another one, measured in turns, with the medians of their
//! ratios.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::bench::median;
use crate::shell::{Outcome, cargo, output, root};

/// Turns in which both checkouts run the parts.
const TURNS: usize = 5;

/// Figures of one row, a turn each, of this checkout and of the other one, with their unit.
#[derive(Default)]
struct Row {
    values: [Vec<f64>; 2],
    unit: String,
}

/// Runs these parts of `bench` in this checkout and in the one at `folder`, in turns, and prints `bench <name> <now> <unit> <ratio>`.
pub(crate) fn against(folder: &str, parts: &[String]) -> Outcome {
    let checkouts = [root(), PathBuf::from(folder)];
    let mut rows = BTreeMap::new();
    for turn in 0..TURNS {
        // The first of a turn is the second of the next one, as the clock of a processor changes.
        for which in [turn % 2, 1 - turn % 2] {
            let mut bench = cargo("xtask bench");
            bench.args(parts).current_dir(&checkouts[which]).env_remove("CARGO_MANIFEST_DIR");
            if which == 1 {
                bench.env_remove("CARGO_TARGET_DIR");
            }
            read(&output(&mut bench)?, which, &mut rows);
        }
    }
    for (name, row) in rows {
        match ratio(&row.values) {
            Some(ratio) => {
                println!("bench {name} {:.4} {} {ratio:.3}", median(row.values[0].clone()), row.unit)
            }
            None => println!("bench {name} in one checkout alone"),
        }
    }
    Ok(())
}

/// Adds the figures that a run of `bench` printed.
fn read(printed: &str, which: usize, rows: &mut BTreeMap<String, Row>) {
    for line in printed.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let ["bench", name, value, unit @ ..] = words.as_slice() else { continue };
        let Ok(value) = value.parse() else { continue };
        let row = rows.entry((*name).to_owned()).or_default();
        row.values[which].push(value);
        row.unit = unit.join(" ");
    }
}

/// The median over the turns of now over then; `None` where one of both has no such row.
fn ratio([now, then]: &[Vec<f64>; 2]) -> Option<f64> {
    let ratios: Vec<f64> = now.iter().zip(then).map(|(now, then)| now / then).collect();
    (!ratios.is_empty()).then(|| median(ratios))
}

#[cfg(test)]
mod tests {
    //! Lines that are read, and their ratio.
    use super::*;

    #[test]
    fn the_ratio_is_the_median_over_turns() {
        let mut rows = BTreeMap::new();
        for (now, then) in [("2.0", "1.0"), ("3.0", "2.0"), ("9.0", "1.0")] {
            read(&format!("noise\nbench a_row {now} us a step\nbench new 1 s\n"), 0, &mut rows);
            read(&format!("bench a_row {then} us a step\nbench wrong x s\n"), 1, &mut rows);
        }
        assert_eq!((ratio(&rows["a_row"].values), rows["a_row"].unit.as_str()), (Some(2.0), "us a step"));
        assert_eq!(ratio(&rows["new"].values), None);
        assert!(!rows.contains_key("wrong"));
    }
}
