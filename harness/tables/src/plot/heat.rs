//! The mean of a column in cells of two others.

use drawing::{PlaneChart, PlanePanel, Shading};

use super::{
    cells::edges,
    runs::{rows, together},
};
use crate::table::{Sidecar, Table};

/// Rows that a cell has on average.
const ROWS_OF_CELL: f64 = 8.0;

/// The picture.
///
/// # Errors
/// A name that is no column or several, and columns without numbers in one row.
pub fn chart(table: &Table, sidecar: &Sidecar, names: &[String; 3]) -> Result<PlaneChart, String> {
    let [x_name, y_name, name] = [table.one(&names[0])?, table.one(&names[1])?, table.one(&names[2])?];
    let [x, y, values] = together(table, [&x_name, &y_name, &name])?;
    let side = (values.len() as f64 / ROWS_OF_CELL).sqrt().round() as usize;
    let [x_edges, y_edges] = [&x, &y].map(|all| {
        let mut sorted = all.clone();
        sorted.sort_by(f64::total_cmp);
        edges(&sorted, side)
    });
    let means = means([&x, &y], &values, [&x_edges, &y_edges]);
    let cells: Vec<(Vec<(f64, f64)>, f64)> = means
        .iter()
        .map(|(column, row, mean)| {
            let ([left, right], [low, high]) =
                ([x_edges[*column], x_edges[column + 1]], [y_edges[*row], y_edges[row + 1]]);
            (vec![(left, low), (right, low), (right, high), (left, high)], *mean)
        })
        .collect();
    let of_cells = |limit: f64, of: fn(f64, f64) -> f64| means.iter().map(|it| it.2).fold(limit, of);
    let (least, greatest) = (of_cells(f64::INFINITY, f64::min), of_cells(f64::NEG_INFINITY, f64::max));
    let [(x_middle, half_width), (y_middle, half_height)] = [&x_edges, &y_edges].map(|edges| {
        let (first, last) = (edges[0], edges[edges.len() - 1]);
        (0.5 * (first + last), 0.5 * (last - first))
    });
    let panel = PlanePanel {
        cells,
        centre: (x_middle, y_middle),
        half_width,
        half_height: Some(half_height),
        ..PlanePanel::default()
    };
    Ok(PlaneChart {
        title: format!("mean of {}, {} {}", sidecar.labelled(&name), values.len(), rows(table)),
        x_label: sidecar.labelled(&x_name),
        y_label: sidecar.labelled(&y_name),
        panels: vec![panel],
        shading: Some(Shading { least, greatest, unit: sidecar.unit(&name).unwrap_or_default().to_owned() }),
    })
}

/// Column, row and mean of each cell that holds something.
fn means([x, y]: [&[f64]; 2], values: &[f64], [x_edges, y_edges]: [&[f64]; 2]) -> Vec<(usize, usize, f64)> {
    let cell = |edges: &[f64], value: f64| {
        edges.partition_point(|edge| *edge <= value).saturating_sub(1).min(edges.len() - 2)
    };
    let (columns, rows) = (x_edges.len() - 1, y_edges.len() - 1);
    let mut sums = vec![(0.0_f64, 0_u32); columns * rows];
    for ((x, y), value) in x.iter().zip(y).zip(values) {
        let sum = &mut sums[cell(y_edges, *y) * columns + cell(x_edges, *x)];
        *sum = (sum.0 + value, sum.1 + 1);
    }
    let filled = sums.into_iter().enumerate().filter(|(_, (_, count))| *count > 0);
    filled.map(|(at, (sum, count))| (at % columns, at / columns, sum / f64::from(count))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_has_the_mean_of_its_rows() {
        let (x, y) = ([0.0, 0.4, 1.0, 2.0, 2.0], [0.0, 0.0, 0.0, 0.0, 5.0]);
        let found = means([&x, &y], &[1.0, 2.0, 4.0, 8.0, 16.0], [&[0.0, 1.0, 2.0], &[0.0, 2.5, 5.0]]);
        assert_eq!(found, [(0, 0, 1.5), (1, 0, 6.0), (1, 1, 16.0)]);
    }
}
