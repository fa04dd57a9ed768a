//! Formulas are MathML in the built guide, all of them, and no script sets them.

use std::fs;

use heliotorque_guide::formulas::with_mathml;
use heliotorque_guide::{build, project};

use crate::markdown;

#[test]
fn a_formula_becomes_mathml_with_its_text_around_it() {
    let text = "Before\n\n- item\n\n  $$\n  \\frac{a}{b_1}\n  $$\n\nAfter `$$`\n";
    let written = with_mathml(text).unwrap();
    assert!(written.starts_with("Before\n\n- item\n\n  <div class=\"formula\"><math display=\"block\""));
    assert!(written.ends_with("</math></div>\n\nAfter `$$`\n"), "{written}");
    assert!(written.contains("<mfrac>") && written.contains("<msub>"), "{written}");
}

#[test]
fn mistakes_in_formulas_are_errors() {
    assert!(with_mathml("$$\n\\frac{a}\n$$\n").unwrap_err().contains("\\frac{a}"));
    assert!(with_mathml("$$\n\\nosuchcommand\n$$\n").is_err());
    assert!(with_mathml("$$\na\n").unwrap_err().contains("without a second one"));
}

#[test]
fn every_formula_of_the_guide_is_set() {
    let folder = project().join("target").join("guide-formulas");
    build(&project().join("docs"), &folder).unwrap();
    let source = project().join("docs").join("src");
    let mut formulas = 0;
    for page in markdown::files(&source) {
        let text = fs::read_to_string(&page).unwrap();
        let count = text.lines().filter(|line| line.trim() == "$$").count() / 2;
        let built = folder.join(page.strip_prefix(&source).unwrap()).with_extension("html");
        if count > 0 {
            let html = fs::read_to_string(&built).unwrap();
            assert_eq!(html.matches("<math ").count(), count, "{}", built.display());
            assert!(!html.contains("$$") && !html.contains("merror"), "{}", built.display());
            formulas += count;
        }
    }
    assert!(formulas >= 60, "{formulas}");
}
