//! What each output depends on.
//!
//! A sample decides the mode, then whether there is an attitude at all, then which: every output that is judged with an
//! attitude depends on the first two. At the start no scan and no limb has moved yet; their rates move the command's. Nor has a
//! burn been measured; a sample of one reads accelerometers and estimate before it decides the mode.

use fmi_export::{Dependencies, Knowns, knowns};
use nalgebra::Vector3;

use super::setup::GuidanceSetup;
use super::variables::GuidanceVariables;
use super::variables::commands::AimpointVariables;
use crate::common::spacecraft::has_both_shapes;

/// Inputs by what they act on.
struct Inputs {
    /// The mode, where the monitor judges by the places.
    mode: Knowns,
    /// Whether there is an attitude: whether all it needs has a direction.
    existence: Knowns,
    /// The Sun sensors, where there is no attitude.
    sensed: Knowns,
    /// What the attitude is made of, without velocities of Sun and Earth and without what scans and limbs did so far.
    attitude: Knowns,
    /// The instrument that is the boresight.
    instrument: Knowns,
    /// Which instrument lies along the body roll vector -Y.
    instrument_along_roll: Knowns,
    /// The bodies' velocities, by which slews are told from windows, a science rule, and forecasts.
    velocities: Knowns,
    /// What a scan moves, once it has run for a while.
    scanned: Knowns,
    aimpoint: Knowns,
    second_aimpoint: Knowns,
    /// Body and external roll vectors.
    rolls: Knowns,
    /// The velocity that a burn added since the last sample, along the body axes.
    increment: Knowns,
    /// The momentum with which a downlink begins.
    momentum: Knowns,
}

impl Inputs {
    fn of(setup: &GuidanceSetup, v: &GuidanceVariables) -> Self {
        let (boresight, aim) = (&v.boresight, &v.aimpoint);
        let (body_roll, external_roll) = (&v.body_roll, &v.external_roll);
        let (limb, scan) = (&v.limb, &v.scan);
        let places = knowns![v.position, v.sun.position, v.earth.position];
        let sensed = knowns![v.sun.sensed, v.sun.sensed_valid];
        // The Sun sensors judge flown ephemerides, without which Operational ends.
        let mode = knowns![v.mode.request, v.estimate.q, v.estimate.valid, &sensed, places];
        let existence = knowns![
            &mode,
            v.pointing.scenario,
            v.velocity,
            boresight.option,
            boresight.vector,
            directions(aim),
            limb.reference,
        ];
        let rolls = knowns![
            body_roll.option,
            body_roll.vector,
            body_roll.azimuth,
            body_roll.elevation,
            external_roll.option,
            external_roll.vector,
            external_roll.right_ascension,
            external_roll.declination,
        ];
        let aimpoint = aimpoint(aim);
        let attitude = knowns![
            &existence,
            &aimpoint,
            &rolls,
            boresight.azimuth,
            boresight.elevation,
            boresight.angle,
            limb.azimuth,
            limb.height,
        ];
        let segments = knowns![scan.segments_x, scan.segments_y, scan.segments_z];
        let reverse = knowns![scan.reverse_x, scan.reverse_y, scan.reverse_z];
        let pattern = knowns![scan.rate, scan.speed, scan.duration, scan.pause, segments, reverse];
        let instruments = &setup.spacecraft.instruments;
        let instrument = |counts: fn(&Vector3<f64>) -> bool| {
            let any = instruments.iter().any(|instrument| counts(&instrument.boresight_body));
            knowns![boresight.instrument].only_if(any)
        };
        Self {
            mode,
            existence,
            sensed,
            attitude,
            instrument: instrument(|it| it.cross(&Vector3::z()) != Vector3::zeros() || it.z < 0.0),
            instrument_along_roll: instrument(|it| it.cross(&Vector3::y()) == Vector3::zeros()),
            velocities: knowns![v.sun.velocity, v.earth.velocity],
            scanned: knowns![scan.frame, scan.reference, pattern],
            aimpoint,
            second_aimpoint: self::aimpoint(&v.second_aimpoint),
            rolls,
            increment: knowns![v.accelerometer.delta_v],
            momentum: knowns![v.momentum.body],
        }
    }
}

/// Parameters by what they act on at the start.
struct Parameters {
    /// The mode, and where everything is.
    mode: Knowns,
    /// The boresight by its device, the aim by its method.
    device: Knowns,
    /// The law of the orbit phase, and the orbit.
    guided: Knowns,
    /// Whether a burn has a path, and which.
    path: Knowns,
    /// Nominal direction of a burn's thrust.
    thrust_direction: Knowns,
    /// Its nominal acceleration.
    acceleration: Knowns,
    /// Where a downlink puts the Sun, the keep-in zone aside.
    sun_place: Knowns,
}

impl Parameters {
    fn of(setup: &GuidanceSetup, v: &GuidanceVariables) -> Self {
        let [direction_differs, acceleration_differs] = setup.thrust_differs();
        let thrusters = |counts: bool| knowns![v.burn.thrusters].only_if(counts);
        let (planet, ephemeris, guided, monitor) = (&v.planet, &v.ephemeris, &v.guided, &v.monitor);
        let (keep_in, safe_hold, hot_pole) = (&v.keep_in, &v.safe_hold.keep_in, &v.hot_pole);
        let body = knowns![
            v.target.planet,
            planet.radii,
            planet.pole_right_ascension,
            planet.pole_declination,
            planet.prime_meridian,
            planet.rotation_rate,
        ];
        let places = knowns![ephemeris.source, &ephemeris.ellipse.knowns()];
        let zones = knowns![
            keep_in.enabled,
            keep_in.azimuth,
            keep_in.elevation,
            keep_in.axis,
            keep_in.distance,
            safe_hold.azimuth,
            safe_hold.elevation,
            hot_pole.enabled,
            hot_pole.altitude,
            hot_pole.angle,
            hot_pole.cone,
        ];
        let monitor = knowns![
            monitor.enabled,
            monitor.persistence,
            monitor.margin,
            ephemeris.tolerance,
            ephemeris.persistence,
        ];
        let law = knowns![
            guided.science_rule,
            guided.science_gain,
            guided.downlink_start,
            guided.downlink_end,
            guided.downlink_every,
            guided.downlink_reference,
            guided.slew_rate,
            planet.gravitational_parameter,
        ];
        Self {
            mode: knowns![v.start.epoch, body, places, zones, monitor],
            device: knowns![v.mdis.minimum, v.mdis.maximum, v.subsolar.method],
            sun_place: knowns![sun_place(setup, v), &law],
            guided: law,
            path: knowns![v.burn.delta_v, v.burn.profile],
            thrust_direction: knowns![v.burn.thrust_direction, thrusters(direction_differs)],
            acceleration: knowns![v.burn.acceleration, thrusters(acceleration_differs)],
        }
    }
}

/// Where a downlink puts the Sun, its windows aside: strategy, target, what a forecast counts on and is held against, the torque,
/// and the momentum it begins with.
fn sun_place(setup: &GuidanceSetup, v: &GuidanceVariables) -> Knowns {
    let momentum = &v.momentum;
    let panels = v.panel.iter().map(|panel| knowns![panel.nominal_sun_offset, panel.tilt, panel.enabled]);
    knowns![
        momentum.strategy,
        momentum.aim.target_axes,
        momentum.aim.targeting,
        // What the Sun's place brings to a target.
        momentum.aim.target.element(0),
        momentum.aim.target.element(2),
        momentum.aim.horizon,
        v.dump.threshold.element(0),
        v.dump.threshold.element(2),
        v.dump.reinit_to,
        v.dump.reinit_fraction,
        momentum.convention,
        momentum.body,
        v.start.q,
        v.spacecraft.center_of_mass,
        v.solar.knowns(),
        knowns![v.sunshade.shape].only_if(has_both_shapes(&setup.spacecraft)),
        panels.collect::<Knowns>(),
    ]
}

/// One row an unknown.
pub fn table(setup: &GuidanceSetup, v: &GuidanceVariables) -> Dependencies {
    let mut table = Dependencies::new();
    table.output(v.epoch, knowns![], v.start.epoch);
    let (i, p) = (&Inputs::of(setup, v), &Parameters::of(setup, v));
    command(&mut table, v, i, p);
    judgement(&mut table, v, i, p);
    devices(&mut table, v, i, p);
    burn(&mut table, v, i, p);
    momentum(&mut table, v, i, p);
    table
}

/// The command, its mode, and the Sun in its frame.
fn command(table: &mut Dependencies, v: &GuidanceVariables, i: &Inputs, p: &Parameters) {
    let (scan, method) = (&v.scan, v.keep_in.method);
    for output in [knowns![v.mode.active], knowns![v.ephemeris.valid], knowns![v.ephemeris.active]] {
        table.output(output, &i.mode, knowns![&i.mode, &p.mode]);
    }
    let kind = &knowns![&i.existence, &i.sensed];
    for output in [knowns![v.command.kind], knowns![v.command.error]] {
        table.output(output, kind, knowns![kind, &p.mode, &p.path]);
    }
    let attitude = &knowns![&i.attitude, &i.instrument, &i.velocities];
    let later = &knowns![attitude, &i.scanned, v.limb.height_rate, &i.increment, &i.momentum];
    let aimed = &knowns![&p.path, &p.thrust_direction];
    let start = &knowns![attitude, &p.mode, &p.device, &p.guided, method, aimed, &p.sun_place];
    for output in [knowns![v.command.q], knowns![v.sun.azimuth, v.sun.elevation]] {
        table.output(output, later, knowns![start, v.start.q]);
    }
    let beginning =
        knowns![scan.frame, scan.reference, scan.rate, scan.speed, scan.duration, v.limb.height_rate];
    let rate = knowns![start, &i.sensed, beginning, v.earth_acquisition.rate, compatibility(v)];
    table.output(v.command.rate, knowns![later, &i.sensed], rate);
    // The search begins about X.
    table.output(v.command.rate.element(0), knowns![], v.sun_search.rate);
}

/// What is said of the attitude.
fn judgement(table: &mut Dependencies, v: &GuidanceVariables, i: &Inputs, p: &Parameters) {
    let (scan, method) = (&v.scan, v.keep_in.method);
    let scan_frame = &knowns![scan.frame, scan.reference];
    table.output(
        v.scan.active,
        knowns![&i.existence, scan_frame],
        knowns![&i.existence, scan_frame, &p.mode, compatibility(v)],
    );
    table.output(v.earth.sun_separation, &i.existence, knowns![&i.existence, &p.mode, &p.path]);
    let moved = &knowns![&i.scanned, v.limb.height_rate, &i.increment, &i.momentum];
    let aimed = &knowns![&p.path, &p.thrust_direction];
    let in_line = &knowns![&i.attitude, &i.instrument_along_roll, &i.velocities];
    table.output(
        v.geometry.degenerate,
        knowns![in_line, moved],
        knowns![in_line, &p.mode, &p.device, aimed, &p.sun_place],
    );
    let attitude = &knowns![&i.attitude, &i.instrument, &i.velocities];
    let start = &knowns![attitude, &p.mode, &p.device, &p.guided, aimed, &p.sun_place];
    for output in [knowns![v.target.reachable], knowns![v.constraint.sun_keep_in]] {
        table.output(output, knowns![attitude, moved], start);
    }
    table.output(v.constraint.hot_pole, knowns![attitude, moved], knowns![start, method]);
    table.output(
        v.constraint.clamped,
        knowns![attitude, moved, &i.second_aimpoint],
        knowns![start, method, &i.second_aimpoint],
    );
}

/// Camera, antennas and link.
fn devices(table: &mut Dependencies, v: &GuidanceVariables, i: &Inputs, p: &Parameters) {
    let option = v.boresight.option;
    let basic = &knowns![&i.mode, v.pointing.scenario, option, v.velocity];
    let camera = &knowns![basic, v.boresight.angle, &i.instrument, &i.aimpoint, &i.second_aimpoint];
    for output in [knowns![v.mdis.angle], knowns![v.mdis.in_range]] {
        table.output(
            output,
            knowns![camera, &i.scanned],
            knowns![camera, &p.mode, &p.device, v.keep_in.method],
        );
    }
    let antenna = &knowns![basic, v.boresight.azimuth, directions(&v.aimpoint), &i.velocities, &i.momentum];
    for output in [knowns![v.antenna.select], knowns![v.antenna.azimuth]] {
        table.output(output, antenna, knowns![antenna, &p.mode, &p.guided, &p.sun_place, v.keep_in.method]);
    }
    let link = &knowns![antenna, &i.aimpoint, &i.rolls];
    let limits = knowns![v.link.sun_exclusion, v.link.beam, v.keep_in.method, v.subsolar.method];
    table.output(
        v.link.available,
        knowns![link, &i.scanned],
        knowns![link, &p.mode, &p.guided, &p.sun_place, limits],
    );
}

/// What a burn tells the thrusters and what it finds.
fn burn(table: &mut Dependencies, v: &GuidanceVariables, i: &Inputs, p: &Parameters) {
    let (burn, thrust) = (&v.burn, &v.thrust);
    let commanded = &knowns![&i.mode, v.pointing.scenario];
    let under_way = &knowns![commanded, &i.increment];
    table.output(thrust.request, under_way, knowns![commanded, &p.mode, burn.thrusters]);
    let begun = &knowns![commanded, &p.mode, &p.path, &p.thrust_direction, burn.start];
    table.output(thrust.command, under_way, begun);
    table.output(thrust.stop, under_way, knowns![begun, &p.acceleration, burn.timeout]);
    let measured = &knowns![v.pointing.scenario, v.estimate.valid, &i.increment];
    table.output(burn.thrust_estimate, measured, &p.thrust_direction);
    table.output(burn.timed_out, measured, knowns![]);
    let turned = knowns![measured, v.estimate.q, v.position, v.sun.position, v.earth.position];
    for output in [knowns![burn.velocity], knowns![burn.velocity_error]] {
        table.output(output, &turned, knowns![]);
    }
}

/// What is said of targets, what thrusters are asked for, and how panels stand.
fn momentum(table: &mut Dependencies, v: &GuidanceVariables, i: &Inputs, p: &Parameters) {
    let (momentum, dump) = (&v.momentum, &v.dump);
    let begun =
        &knowns![&i.mode, v.pointing.scenario, v.boresight.option, v.velocity, &i.velocities, &i.momentum];
    table.output(momentum.target_clamped, begun, knowns![begun, &p.mode, &p.sun_place]);
    let asked = knowns![&i.momentum, dump.threshold];
    table.output(dump.request, &i.momentum, &asked);
    for axis in 0..3 {
        let policy = knowns![dump.reinit_to, dump.reinit_fraction, momentum.aim.target.element(axis)];
        table.output(dump.target.element(axis), &i.momentum, knowns![&asked, policy]);
    }
    for panel in &v.panel {
        table.output(panel.sun_offset, knowns![], panel.nominal_sun_offset);
    }
}

/// Which scans go with which aimpoints.
fn compatibility(v: &GuidanceVariables) -> Knowns {
    let frames = v.scan_compatibility.iter();
    frames.map(|it| knowns![it.direction, it.local_direction, it.point, it.planet_point]).collect()
}

/// What makes an aimpoint be, or have a direction.
fn directions(aimpoint: &AimpointVariables) -> Knowns {
    knowns![aimpoint.option, aimpoint.vector, aimpoint.position, aimpoint.body]
}

fn aimpoint(aimpoint: &AimpointVariables) -> Knowns {
    knowns![
        directions(aimpoint),
        aimpoint.right_ascension,
        aimpoint.declination,
        aimpoint.latitude,
        aimpoint.longitude,
        aimpoint.height,
        aimpoint.azimuth,
        aimpoint.elevation,
    ]
}
