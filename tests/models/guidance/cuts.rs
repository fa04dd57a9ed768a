//! How a master cuts its steps, and whether it saves and restores in between, changes no bit of any output.

use models::Guidance;

use super::super::named_model::{NamedModel, assert_cuts_change_nothing};
use super::{PLACED, with};

/// A scan; the monitor at work in Safe Hold; windows of the orbit phase with slews; a burn that times out; downlinks that put
/// the Sun elsewhere, of the scenario and of the orbit phase; science that unloads.
pub(crate) const CUT: [&[(&str, f64)]; 7] = [
    &[
        ("pointing.scenario", 2.0),
        ("aimpoint.option", 7.0),
        ("scan.frame", 2.0),
        ("scan.rate[1]", 1e-3),
        ("scan.rate[3]", -2e-4),
        ("scan.duration[1]", 3.3),
        ("scan.duration[3]", 50.0),
        ("scan.reverse[1]", 1.0),
    ],
    &[
        ("pointing.scenario", 3.0),
        ("monitor.persistence", 7.0),
        ("monitor.margin", 0.0),
        ("estimate.q[1]", 0.6),
        ("estimate.q[4]", 0.8),
        ("sun.sensed[1]", 0.3),
        ("sun.sensed[2]", 1.0),
        ("sun.sensedValid", 1.0),
    ],
    &[
        ("pointing.scenario", 10.0),
        ("guided.downlinkEvery", 1.0),
        ("guided.downlinkStart", 10.0),
        ("guided.slewRate", 1e-3),
    ],
    &[
        ("pointing.scenario", 9.0),
        ("keepIn.enabled", 0.0),
        ("hotPole.enabled", 0.0),
        ("burn.profile[1,1]", 1.0),
        ("burn.profile[2,2]", 1.0),
        ("burn.profile[3,3]", 0.5),
        ("burn.acceleration", 0.01),
        ("burn.start", 3.3),
        ("burn.timeout", 60.7),
        ("accelerometer.deltaV[2]", 0.3),
    ],
    &[
        ("pointing.scenario", 6.0),
        ("keepIn.azimuth", 0.3),
        ("keepIn.elevation", 0.3),
        ("momentum.strategy", 2.0),
        ("momentum.body[1]", 0.3),
        ("momentum.body[3]", -0.4),
        ("dump.threshold[3]", 0.2),
        ("estimate.q[1]", 0.6),
        ("estimate.q[4]", 0.8),
        ("monitor.enabled", 0.0),
    ],
    &[
        ("pointing.scenario", 10.0),
        ("guided.downlinkReference", 2.0),
        ("guided.downlinkStart", 33.3),
        ("guided.downlinkEnd", 9_000.0),
        ("guided.slewRate", 1e-3),
        ("momentum.strategy", 2.0),
        ("momentum.convention", 2.0),
        ("momentum.body[1]", 0.3),
        ("momentum.body[3]", -0.4),
        ("monitor.enabled", 0.0),
    ],
    &[
        ("pointing.scenario", 10.0),
        ("guided.downlinkReference", 2.0),
        ("guided.downlinkStart", 33.3),
        ("guided.downlinkEnd", 90.0),
        ("guided.slewRate", 1e-3),
        ("guided.scienceUnload", 1.0),
        ("momentum.strategy", 2.0),
        ("momentum.body[1]", 1e-4),
        ("momentum.body[3]", -1e-4),
        ("monitor.enabled", 0.0),
    ],
];

#[test]
fn neither_cuts_nor_saving_change_a_bit() {
    let named = NamedModel::<Guidance>::shipped();
    for case in CUT {
        for start_s in [0.0, -800.25, 1e9] {
            let sets = with(&[PLACED, case]);
            let ends_s = [60.0, 61.5, 180.0].map(|length_s| start_s + length_s);
            let initialize = || named.initialize(start_s, &sets).unwrap();
            assert_cuts_change_nothing(initialize, ends_s, &[1.7, 0.1, 0.3, 7.0, 60.0], |_| {});
        }
    }
}
