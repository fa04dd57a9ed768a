//! Flow of propellant that is linear in time: q(t) = flow + slope t.

/// Mass that flows out in `elapsed_s`, in kg, at a flow in kg/s with its slope in kg/s2.
pub(super) fn flowed_kg([flow, slope]: [f64; 2], elapsed_s: f64) -> f64 {
    (flow + 0.5 * slope * elapsed_s) * elapsed_s
}

/// In how many seconds `left_kg` flow out; infinite where they never do.
pub(super) fn lasts_s([flow, slope]: [f64; 2], left_kg: f64) -> f64 {
    let left_kg = left_kg.max(0.0);
    // Of flow t + slope t^2 / 2 = left, in the form without cancellation.
    let root = flow * flow + 2.0 * slope * left_kg;
    if flow <= 0.0 && slope <= 0.0 || root < 0.0 {
        return f64::INFINITY;
    }
    if left_kg == 0.0 { 0.0 } else { 2.0 * left_kg / (flow + root.sqrt()) }
}

#[cfg(test)]
mod tests {
    //! What is left flows out in the time that is said, and never where the flow ends before.
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn what_is_left_flows_out_in_that_time() {
        for flow in [[2e-3, 0.0], [0.0, 1e-4], [2e-3, 1e-5], [2e-3, -1e-7]] {
            for left_kg in [0.0, 1e-9, 0.3, 15.0] {
                assert_relative_eq!(flowed_kg(flow, lasts_s(flow, left_kg)), left_kg, max_relative = 1e-14);
            }
        }
        assert_eq!(lasts_s([0.0; 2], 1.0), f64::INFINITY);
        assert_eq!(lasts_s([2e-3, -1e-3], 1.0), f64::INFINITY);
    }
}
