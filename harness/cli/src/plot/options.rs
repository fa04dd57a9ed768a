//! Options of `heliotorque plot`.

use std::path::PathBuf;

use clap::Args;
use inputs::values;

/// Shown with the help.
const EXAMPLE: &str = "\
A table over time is drawn as `run --output FILE.svg` draws it; several are overlaid, a panel for each variable, a colour for each file. A table of
percentiles over time, as a campaign's, is drawn as medians with bands. Tables of a campaign's runs need one of the options
from --histogram to --tornado. Units, items and dates come from NAME.csv.toml beside the table, where there is one.

Example:
  heliotorque plot run.csv --names momentum.body,dump.count
  heliotorque plot today.csv yesterday.csv --names momentum.body --output both.svg
  heliotorque plot runs.csv --histogram 'momentum.body[1].final'
  heliotorque plot runs.csv --scatter 'spacecraft.centerOfMass[3],momentum.body[1].final'
  heliotorque plot runs-percentiles.csv --names momentum.body";

/// `heliotorque plot`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Plot {
    /// The table, a CSV; several over time are overlaid
    #[arg(required = true, value_name = "CSV")]
    pub files: Vec<PathBuf>,
    /// Of tables over time draw these variables: names, vectors, patterns with *; otherwise all
    #[arg(long, value_name = "NAMES")]
    pub names: Vec<String>,
    /// How often a column takes which values; repeatable, or a pattern, a panel each
    #[arg(long, value_name = "NAME", conflicts_with = "names")]
    pub histogram: Vec<String>,
    /// A column over another, a dot a row, in a colour for each status
    #[arg(long, value_name = "X,Y", value_parser = pair, conflicts_with_all = ["names", "histogram"])]
    pub scatter: Option<[String; 2]>,
    /// The mean of a third column in cells of two others, with a colour bar
    #[arg(
        long,
        value_name = "X,Y,NAME",
        value_parser = triple,
        conflicts_with_all = ["names", "histogram", "scatter"]
    )]
    pub heat: Option<[String; 3]>,
    /// What each varied quantity alone changes of a column, the largest first: runs of a campaign with sampling oneAtATime
    #[arg(long, value_name = "NAME", conflicts_with_all = ["names", "histogram", "scatter", "heat"])]
    pub tornado: Option<String>,
    /// The SVG to write; otherwise the first table's name with .svg, in this folder; - is the standard output
    #[arg(long, short, value_name = "SVG")]
    pub output: Option<PathBuf>,
}

fn pair(text: &str) -> Result<[String; 2], String> {
    names(text).ok_or_else(|| "allowed are two names with a comma between them: X,Y".to_owned())
}

fn triple(text: &str) -> Result<[String; 3], String> {
    names(text).ok_or_else(|| "allowed are three names with commas between them: X,Y,NAME".to_owned())
}

fn names<const N: usize>(text: &str) -> Option<[String; N]> {
    let names = values::names(text);
    names.iter().all(|name| !name.is_empty()).then(|| names.try_into().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_between_commas() {
        assert_eq!(pair("a[1,2], b"), Ok(["a[1,2]", "b"].map(str::to_owned)));
        assert_eq!(triple("a,b[1],c"), Ok(["a", "b[1]", "c"].map(str::to_owned)));
        for bad in ["", "a", "a,", "a,b,c", ",a"] {
            assert!(pair(bad).is_err(), "{bad}");
        }
    }
}
