//! Parameters that are the Keplerian elements of an orbit.

use fmi_export::{Elements, Given, Real, Values};
use physics::environment::orbit::Elements as KeplerElements;

/// Semi-major axis, eccentricity, inclination, ascending node, argument of periapsis, true anomaly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementHandles(pub [Real; 6]);

impl ElementHandles {
    /// They follow the body together.
    pub(crate) fn group(&self) -> [Elements; 6] {
        self.0.map(Elements::from)
    }

    /// Those that are given, else `own`.
    pub(crate) fn read_or(&self, given: Given<'_>, own: &KeplerElements) -> KeplerElements {
        let [semi_major_axis, eccentricity, inclination, node, periapsis_argument, true_anomaly] = self.0;
        KeplerElements {
            semi_major_axis_m: given.real_or(semi_major_axis, own.semi_major_axis_m),
            eccentricity: given.real_or(eccentricity, own.eccentricity),
            inclination_rad: given.real_or(inclination, own.inclination_rad),
            ascending_node_rad: given.real_or(node, own.ascending_node_rad),
            periapsis_argument_rad: given.real_or(periapsis_argument, own.periapsis_argument_rad),
            true_anomaly_rad: given.real_or(true_anomaly, own.true_anomaly_rad),
        }
    }

    /// Writes these elements.
    pub(crate) fn write(&self, values: &mut Values, elements: &KeplerElements) {
        let numbers = [
            elements.semi_major_axis_m,
            elements.eccentricity,
            elements.inclination_rad,
            elements.ascending_node_rad,
            elements.periapsis_argument_rad,
            elements.true_anomaly_rad,
        ];
        for (handle, number) in self.0.into_iter().zip(numbers) {
            values.set_real(handle, number);
        }
    }
}
