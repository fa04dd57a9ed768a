//! Dependencies of the outputs, by groups. A sample decides the mode, then whether there is an attitude, then which: all that is
//! judged with an attitude depends on all inputs.

use fmi_export::{Dependencies, Section, knowns};

use super::setup::GuidanceSetup;
use super::variables::GuidanceVariables;

/// Rows by groups of outputs.
pub(super) fn table(_setup: &GuidanceSetup, v: &GuidanceVariables) -> Dependencies {
    let mut table = Dependencies::new();
    table.output(knowns![v.epoch, v.timeline_until], knowns![], v.start.epoch);
    table.output(&v.panel, knowns![], &v.panel);
    table.output(&v.dump, v.momentum.body, knowns![&v.momentum, &v.dump]);

    let positions = knowns![v.position, v.velocity, &v.sun, &v.earth];
    let mode = &knowns![v.mode.request, &v.estimate, positions];
    let body = knowns![&v.start, &v.target, &v.planet, &v.ephemeris];
    let zones = knowns![&v.keep_in, &v.safe_hold, &v.hot_pole, &v.monitor];
    let judged = &knowns![body, zones];
    table.output(knowns![v.mode.active, v.mode.reason, v.ephemeris.valid, v.ephemeris.active], mode, judged);
    let measured = knowns![mode, v.pointing_scenario, v.accelerometer_delta_v];
    table.output(knowns![&v.thrust, &v.burn], measured, knowns![judged, &v.burn]);

    let all = &v.section();
    let command = knowns![&v.command, v.sun.azimuth, v.sun.elevation, v.earth.sun_separation];
    let status = knowns![v.geometry_degenerate, v.target.reachable, &v.constraint, v.scan.active];
    let devices = knowns![&v.gimbal, &v.antenna, &v.link, &v.downlink, v.momentum.target_clamped];
    table.output(knowns![command, status, devices], all, all);
    table
}
