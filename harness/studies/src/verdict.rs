//! Verdicts of comparisons with the paper.

/// The comparison holds.
pub(crate) const AGREES: &str = "agrees";
/// It does not.
pub(crate) const OFF: &str = "off";

/// `AGREES` or `OFF`.
pub(crate) fn verdict(holds: bool) -> &'static str {
    verdict_text(holds, AGREES)
}

/// `text`, which stands for a comparison that holds, or `OFF`.
pub(crate) fn verdict_text(holds: bool, text: &str) -> &str {
    if holds { text } else { OFF }
}

/// `AGREES`, or that it differs from what a paper says in words.
pub(crate) fn agrees(holds: bool) -> &'static str {
    if holds { AGREES } else { "differs" }
}

/// A row of a comparison: `what` is the quantity and the paper's value with a bar between them.
pub(crate) fn compared(what: &str, ours: String, verdict: &str) -> Vec<String> {
    what.split('|').map(|text| text.trim().to_owned()).chain([ours, verdict.to_owned()]).collect()
}

/// A row as by [`compared`] of a number that rounds to the paper's: ours, the paper's, a unit of its last digit.
pub(crate) fn rounded(what: &str, shown: String, [ours, paper, digit]: [f64; 3]) -> Vec<String> {
    compared(what, shown, verdict(rounds(ours, paper, digit)))
}

/// Whether `ours` is `paper` to half a unit of its last digit.
pub(crate) fn rounds(ours: f64, paper: f64, digit: f64) -> bool {
    (ours - paper).abs() <= 0.5 * digit * (1.0 + 1e-9)
}

#[cfg(test)]
mod tests {
    //! A verdict can turn either way.
    use super::*;

    #[test]
    fn a_number_agrees_to_half_its_last_digit() {
        assert!(rounds(0.01764, 0.0176, 1e-4) && rounds(0.01765, 0.0176, 1e-4));
        assert!(!rounds(0.017_651, 0.0176, 1e-4) && !rounds(f64::NAN, 0.0176, 1e-4));
        assert_eq!((verdict(true), verdict(false), verdict_text(false, "as printed")), (AGREES, OFF, OFF));
    }
}
