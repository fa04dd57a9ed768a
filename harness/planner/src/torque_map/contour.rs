//! Lines on which a function on a grid of cells changes its sign (marching squares), chained from cell to cell.

use std::collections::HashMap;

use super::grid::cell;

/// An edge of the grid: its first node, and whether it runs along a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Edge {
    /// Column of the first node.
    pub column: usize,
    /// Row of the first node.
    pub row: usize,
    /// Otherwise along a column.
    pub is_along_row: bool,
}

impl Edge {
    /// Its other node.
    pub fn end(&self) -> [usize; 2] {
        let along = usize::from(self.is_along_row);
        [self.column + along, self.row + 1 - along]
    }
}

/// The lines between nodes below 0 and the others, as edges in their order; a closed line ends on its first edge.
///
/// `value` is of a node; `counts` says whether the line may cross an edge.
pub fn lines(
    steps: [usize; 2],
    value: impl Fn(usize, usize) -> f64,
    mut counts: impl FnMut(Edge) -> bool,
) -> Vec<Vec<Edge>> {
    let mut links: HashMap<Edge, Vec<Edge>> = HashMap::new();
    let mut known: HashMap<Edge, bool> = HashMap::new();
    let mut order = Vec::new();
    for row in 0..steps[1] {
        for column in 0..steps[0] {
            for [a, b] in crossed(column, row, &value) {
                if ![a, b].into_iter().all(|edge| *known.entry(edge).or_insert_with(|| counts(edge))) {
                    continue;
                }
                for (from, to) in [(a, b), (b, a)] {
                    let of = links.entry(from).or_default();
                    if of.is_empty() {
                        order.push(from);
                    }
                    of.push(to);
                }
            }
        }
    }
    chained(&order, links)
}

/// The pieces of the line in a cell, each from edge to edge.
fn crossed(column: usize, row: usize, value: &impl Fn(usize, usize) -> f64) -> Vec<[Edge; 2]> {
    let corners = cell(column, row).map(|(column, row)| value(column, row));
    let below = corners.map(|corner| corner < 0.0);
    // Counter-clockwise from the row below, each between this corner and the next.
    let edges = [
        Edge { column, row, is_along_row: true },
        Edge { column: column + 1, row, is_along_row: false },
        Edge { column, row: row + 1, is_along_row: true },
        Edge { column, row, is_along_row: false },
    ];
    let cut: Vec<usize> = (0..4).filter(|k| below[*k] != below[(k + 1) % 4]).collect();
    match cut[..] {
        [a, b] => vec![[edges[a], edges[b]]],
        // A saddle: the middle says which corners belong together.
        [_, _, _, _] => {
            let middle_below = corners.iter().sum::<f64>() < 0.0;
            if middle_below == below[0] {
                vec![[edges[0], edges[1]], [edges[2], edges[3]]]
            } else {
                vec![[edges[3], edges[0]], [edges[1], edges[2]]]
            }
        }
        _ => Vec::new(),
    }
}

/// Lines that end first, then closed ones, so that none is cut in two.
fn chained(order: &[Edge], mut links: HashMap<Edge, Vec<Edge>>) -> Vec<Vec<Edge>> {
    let mut lines = Vec::new();
    for ends_only in [true, false] {
        for &start in order {
            if links.get(&start).is_none_or(|of| of.is_empty() || (ends_only && of.len() != 1)) {
                continue;
            }
            let mut line = vec![start];
            let mut at = start;
            while let Some(next) = links.get_mut(&at).and_then(Vec::pop) {
                if let Some(back) = links.get_mut(&next)
                    && let Some(position) = back.iter().position(|edge| *edge == at)
                {
                    back.swap_remove(position);
                }
                line.push(next);
                at = next;
            }
            lines.push(line);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    //! A circle is one closed line, a straight line one open one, two circles are two.
    use super::*;

    fn at(column: usize, row: usize) -> [f64; 2] {
        [column as f64 / 10.0 - 2.0, row as f64 / 10.0 - 2.0]
    }

    #[test]
    fn a_circle_is_closed_and_as_long_as_it_should_be() {
        let value = |column: usize, row: usize| {
            let [x, y] = at(column, row);
            x * x + y * y - 1.7
        };
        let found = lines([40, 40], value, |_| true);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].first(), found[0].last());
        let place = |edge: &Edge| {
            let (a, [column, row]) = ([edge.column, edge.row], edge.end());
            let part = value(a[0], a[1]) / (value(a[0], a[1]) - value(column, row));
            let (from, to) = (at(a[0], a[1]), at(column, row));
            [0, 1].map(|k| from[k] + part * (to[k] - from[k]))
        };
        let places: Vec<[f64; 2]> = found[0].iter().map(place).collect();
        let length: f64 =
            places.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum();
        assert!((length / (core::f64::consts::TAU * 1.7_f64.sqrt()) - 1.0).abs() < 2e-3, "{length}");
    }

    #[test]
    fn open_and_several_lines_are_kept_whole() {
        let across =
            lines([40, 40], |column, row| at(column, row)[0] + 0.3 * at(column, row)[1] - 0.01, |_| true);
        assert_eq!(across.len(), 1);
        assert_ne!(across[0].first(), across[0].last());
        let two = |column: usize, row: usize| {
            let [x, y] = at(column, row);
            (x.abs() - 1.0).hypot(y) - 0.63
        };
        assert_eq!(lines([40, 40], two, |_| true).len(), 2);
        assert!(lines([40, 40], |_, _| 0.0, |_| true).is_empty());
        assert!(lines([40, 40], two, |_| false).is_empty());
    }
}
