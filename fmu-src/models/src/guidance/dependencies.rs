//! What each output depends on.

use fmi_export::{Dependencies, Knowns, knowns};

use super::variables::GuidanceVariables;

/// One row an unknown.
pub fn table(v: &GuidanceVariables) -> Dependencies {
    let mut table = Dependencies::new();
    let nothing = &knowns![];
    let (command, places, modes) = (&command(v), &places(v), &modes(v));
    let parameters = &parameters(v);
    let all = &knowns![command, places, modes];
    let start = &knowns![all, parameters];
    table.output(v.epoch, nothing, v.start.epoch);
    for output in [
        knowns![v.command.kind, v.command.q, v.command.rate, v.command.error, v.mode.active],
        knowns![v.sun.azimuth, v.sun.elevation, v.mdis.angle, v.mdis.in_range],
        knowns![v.antenna.select, v.antenna.azimuth, v.earth.sun_separation, v.link.available],
        knowns![v.target.reachable, v.geometry.degenerate, v.scan.active],
        knowns![v.constraint.sun_keep_in, v.constraint.hot_pole, v.constraint.clamped],
    ] {
        table.output(output, all, start);
    }
    table
}

/// The command inputs.
fn command(v: &GuidanceVariables) -> Knowns {
    let aimpoint = |it: &super::variables::commands::AimpointVariables| {
        knowns![
            it.option,
            it.vector,
            it.position,
            it.right_ascension,
            it.declination,
            it.latitude,
            it.longitude,
            it.height,
            it.azimuth,
            it.elevation,
            it.body,
        ]
    };
    let (boresight, body_roll, external_roll) = (&v.boresight, &v.body_roll, &v.external_roll);
    let (limb, scan) = (&v.limb, &v.scan);
    knowns![
        v.pointing.scenario,
        boresight.option,
        boresight.vector,
        boresight.azimuth,
        boresight.elevation,
        boresight.angle,
        boresight.instrument,
        aimpoint(&v.aimpoint),
        aimpoint(&v.second_aimpoint),
        body_roll.option,
        body_roll.vector,
        body_roll.azimuth,
        body_roll.elevation,
        external_roll.option,
        external_roll.vector,
        external_roll.right_ascension,
        external_roll.declination,
        limb.azimuth,
        limb.reference,
        limb.height,
        limb.height_rate,
        scan.frame,
        scan.reference,
        scan.rate,
        scan.speed,
        scan.duration,
        scan.pause,
        scan.segments_x,
        scan.segments_y,
        scan.segments_z,
        scan.reverse_x,
        scan.reverse_y,
        scan.reverse_z,
    ]
}

/// Where everything is.
fn places(v: &GuidanceVariables) -> Knowns {
    knowns![v.position, v.velocity, v.sun.position, v.sun.velocity, v.earth.position, v.earth.velocity,]
}

/// What decides the mode.
fn modes(v: &GuidanceVariables) -> Knowns {
    knowns![v.mode.request, v.estimate.q, v.estimate.valid, v.sun.sensed, v.sun.sensed_valid]
}

/// With what a scan frame goes.
fn scans(it: &super::variables::commands::ScanCompatibilityVariables) -> Knowns {
    knowns![it.direction, it.local_direction, it.point, it.planet_point]
}

/// Parameters.
fn parameters(v: &GuidanceVariables) -> Knowns {
    let (planet, ephemeris, guided) = (&v.planet, &v.ephemeris, &v.guided);
    knowns![
        v.start.epoch,
        v.start.q,
        v.target.planet,
        planet.radii,
        planet.pole_right_ascension,
        planet.pole_declination,
        planet.prime_meridian,
        planet.rotation_rate,
        planet.gravitational_parameter,
        ephemeris.source,
        ephemeris.semi_major_axis,
        ephemeris.eccentricity,
        ephemeris.inclination,
        ephemeris.ascending_node,
        ephemeris.periapsis_argument,
        ephemeris.true_anomaly,
        v.subsolar.method,
        v.keep_in.axis,
        v.keep_in.method,
        v.mdis.minimum,
        v.mdis.maximum,
        guided.science_rule,
        guided.science_gain,
        guided.downlink_start,
        guided.downlink_end,
        guided.downlink_every,
        guided.slew_rate,
        v.scan_compatibility.iter().map(scans).collect::<Knowns>(),
    ]
}
