//! What paper 004 prints in its Tables 7 and 8.

/// One row: solar acceleration in 1e-7 m/s2, the rest in % of it; (greatest, least).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PrintedAccelerations {
    /// Case number.
    pub case: u32,
    /// Mercury's true anomaly at the start, in deg.
    pub true_anomaly_deg: f64,
    /// By effect, in the order of the table: solar, of which it prints the greatest only, albedo, infrared and recoil.
    pub extremes: [(f64, Option<f64>); 4],
}

/// A row of the table. Six arguments, as it is printed.
const fn row(
    case: u32,
    true_anomaly_deg: f64,
    solar: f64,
    albedo: (f64, f64),
    infrared: (f64, f64),
    thermal: (f64, f64),
) -> PrintedAccelerations {
    let [albedo, infrared, thermal] =
        [(albedo.0, Some(albedo.1)), (infrared.0, Some(infrared.1)), (thermal.0, Some(thermal.1))];
    PrintedAccelerations { case, true_anomaly_deg, extremes: [(solar, None), albedo, infrared, thermal] }
}

/// Table 7, the analytical model.
pub(super) const TABLE_7: [PrintedAccelerations; 4] = [
    row(1, 10.0, 8.45, (0.32, 0.02), (6.68, 0.18), (25.60, 23.44)),
    row(2, 98.0, 5.51, (2.37, 0.00), (14.10, 0.01), (23.24, 18.80)),
    row(3, 189.0, 3.71, (0.95, 0.01), (19.24, 0.14), (19.99, 18.81)),
    row(4, 279.0, 6.22, (6.45, 0.00), (26.79, 0.00), (24.05, 17.93)),
];

/// Table 8, the numerical model; the solar column's maximum.
pub(super) const TABLE_8: [PrintedAccelerations; 4] = [
    row(1, 10.0, 8.45, (0.20, 0.00), (3.66, 0.17), (23.78, 23.31)),
    row(2, 98.0, 5.51, (4.40, 0.00), (25.22, 0.02), (20.43, 18.46)),
    row(3, 189.0, 3.72, (0.77, 0.01), (17.56, 0.08), (18.97, 16.89)),
    row(4, 279.0, 6.33, (6.11, 0.00), (25.70, 0.00), (21.33, 17.74)),
];
