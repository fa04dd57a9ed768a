//! Cells of an axis: one for each value where there are few, otherwise equally wide ones.

/// Different values that have a cell each at most.
const MAX_VALUES: usize = 40;
/// Cells at least and at most.
const CELLS: [usize; 2] = [4, 80];

/// Edges of cells, `cells` of them where values do not repeat, that hold these sorted values; two edges at least.
pub fn edges(sorted: &[f64], cells: usize) -> Vec<f64> {
    let mut different = sorted.to_vec();
    different.dedup();
    let (Some(&first), Some(&last)) = (different.first(), different.last()) else { return vec![0.0, 1.0] };
    let repeats = different.len() <= MAX_VALUES && 2 * different.len() <= sorted.len();
    if repeats || first == last {
        return about(&different);
    }
    let cells = cells.clamp(CELLS[0], CELLS[1]);
    let mut edges: Vec<f64> =
        (0..cells).map(|cell| first + (last - first) * cell as f64 / cells as f64).collect();
    edges.push(last);
    edges
}

/// Edges midway between different values, with as much room outside.
fn about(values: &[f64]) -> Vec<f64> {
    let (first, last) = (values[0], values[values.len() - 1]);
    let middles: Vec<f64> = values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    // A single value has room of its own size.
    let half = if first == 0.0 { 0.5 } else { 0.05 * first.abs() };
    let begin = middles.first().map_or(first - half, |middle| 2.0 * first - middle);
    let end = middles.last().map_or(last + half, |middle| 2.0 * last - middle);
    [vec![begin], middles, vec![end]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_repeat_have_a_cell_each() {
        assert_eq!(edges(&[0.0, 0.0, 1.0, 1.0, 3.0, 3.0], 4), [-0.5, 0.5, 2.0, 4.0]);
        assert_eq!(edges(&[0.0], 4), [-0.5, 0.5]);
        assert_eq!(edges(&[-20.0, -20.0], 4), [-21.0, -19.0]);
        assert_eq!(edges(&[0.0, 1.0, 4.0], 1), [0.0, 1.0, 2.0, 3.0, 4.0]);
    }
}
