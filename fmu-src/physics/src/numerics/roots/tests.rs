//! A bracketed root is found to the last bits, and a missing bracket is named.

use super::*;

#[test]
fn known_roots_to_the_last_bits() {
    // cos x = x (Dottie number), x^3 = 2, ln x = -40: published or closed form.
    let dottie = bracketed(0.0, 1.0, |x| x.cos() - x).unwrap();
    assert!((dottie - 0.739_085_133_215_160_6).abs() < 4e-16);
    let cube = bracketed(0.0, 1000.0, |x| x * x * x - 2.0).unwrap();
    assert!((cube - 2.0_f64.cbrt()).abs() < 1e-15);
    let tiny = bracketed(1e-30, 1.0, |x: f64| x.ln() + 40.0).unwrap();
    assert!((tiny / (-40.0_f64).exp() - 1.0).abs() < 1e-14);
}

#[test]
fn few_evaluations_even_at_a_triple_root() {
    let mut evaluations = 0;
    let root = bracketed(0.0, 10.0, |x| {
        evaluations += 1;
        (x - 3.3).powi(3)
    })
    .unwrap();
    assert!((root - 3.3).abs() <= 1e-15, "{root}");
    assert!(evaluations < 70, "{evaluations}");
    let mut evaluations = 0;
    bracketed(0.0, 10.0, |x: f64| {
        evaluations += 1;
        x.exp() - 9.0
    })
    .unwrap();
    assert!(evaluations < 18, "{evaluations}");
}

#[test]
fn a_step_is_located() {
    let root = bracketed(0.0, 1.0, |x| if x < 0.123_456 { -1.0 } else { 1.0 }).unwrap();
    assert!((root - 0.123_456).abs() < 1e-15);
}

#[test]
fn bad_brackets_have_no_root() {
    assert_eq!(bracketed(1.0, 2.0, |x| x), None);
    assert_eq!(bracketed(-1.0, 2.0, |_| f64::NAN), None);
    assert_eq!(bracketed(-1.0, f64::INFINITY, |x| x.min(1.0)), None);
}

#[test]
fn zeros_on_piece_borders_count_once_and_touches_never() {
    // Degree 3 in Bernstein form: u (1 - u) (1 - 2u) has zeros at 0, 1/2 and 1, the middle one on the first split.
    let zeros = [0.0, 1.0 / 3.0, -1.0 / 3.0, 0.0];
    assert_eq!(bernstein_sign_changes(&zeros, 0.0, 1.0).iter().collect::<Vec<_>>(), [0.5, 1.0]);
    assert_eq!(bernstein_sign_changes(&zeros, 0.0, 0.75).iter().collect::<Vec<_>>(), [0.5]);
    // 96 (u - 1/4) (u - 1/2) (u - 3/4) is split exactly at its middle root.
    let three = bernstein_sign_changes(&[-9.0, 13.0, -13.0, 9.0], 0.0, 1.0);
    let three: Vec<f64> = three.iter().collect();
    assert_eq!(three.len(), 3);
    assert!((three[0] - 0.25).abs() < 1e-15 && three[1] == 0.5 && (three[2] - 0.75).abs() < 1e-15);
    // (u - 1/2)^2 touches on the split.
    assert!(bernstein_sign_changes(&[0.25, -0.25, 0.25], 0.0, 1.0).is_empty());
    assert!(bernstein_sign_changes(&[0.0; 4], 0.0, 1.0).is_empty());
    assert!(bernstein_sign_changes(&[f64::NAN, 1.0], 0.0, 1.0).is_empty());
}
