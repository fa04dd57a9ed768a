//! Inputs and parameters by what they act on.

use fmi_export::{Knowns, knowns};

use super::super::setup::PlantSetup;
use super::super::variables::PlantVariables;
use super::super::variables::body::PanelVariables;
use crate::common::spacecraft::has_both_shapes;

/// Inputs by what they act on. A command or an orbit given by inputs starts anew when any of its inputs changes, so all
/// of them act together; and the flight begins when orbit and Sun are no longer zero.
pub struct Inputs {
    /// Where spacecraft and Sun are.
    pub places: Knowns,
    /// Where the Sun is to stand in a downlink that begins.
    pub management: Knowns,
    /// How the spacecraft is turned: by command, or guided by where Sun, planet and Earth are.
    pub attitude: Knowns,
    pub panels: Knowns,
    /// Panels whose mass moves centre of mass and inertia, and what turns them.
    pub weight: Knowns,
    /// The same, but for the attitude.
    pub weighed_panels: Knowns,
    /// Star tracker and gyros.
    pub sensors: Knowns,
    /// The torque that an internal controller asks of the wheels; none where the wheels cannot be in all directions.
    pub controller: Knowns,
}

impl Inputs {
    /// Of one spacecraft.
    pub fn of(setup: &PlantSetup, v: &PlantVariables) -> Self {
        let places = knowns![v.orbit.position, v.orbit.velocity, v.sun.position];
        let command = knowns![v.command.kind, v.command.q, v.command.rate, v.command.error];
        let panels = v.panel.iter().map(turned_by).collect::<Knowns>();
        // Where another orbit begins with a downlink, panels and momentum tell where the Sun is to stand.
        let management = knowns![v.earth.position, &panels, v.dump.request, v.dump.target];
        let attitude = knowns![&places, command, &management];
        let management = knowns![&places, management];
        let sensors = knowns![v.star_tracker.failed, v.gyro.failed];
        let failed = v.wheel.iter().map(|wheel| wheel.failed).collect::<Knowns>();
        let dump = knowns![v.dump.request, v.dump.target];
        let weighed_panels = panels.clone().only_if(panels_weigh(setup));
        let weight = knowns![&attitude, &weighed_panels].only_if(panels_weigh(setup));
        let controller = knowns![&attitude, &sensors, failed, dump, &weighed_panels].only_if(can_control(v));
        Self { places, management, attitude, panels, weight, weighed_panels, sensors, controller }
    }
}

/// The inputs that turn a panel.
pub fn turned_by(panel: &PanelVariables) -> Knowns {
    knowns![panel.angle, panel.sun_offset_command]
}

/// Whether the wheels' axes, which are parameters, can be such that they span all directions.
pub fn can_control(v: &PlantVariables) -> bool {
    v.wheel.len() >= 3
}

/// Whether panels have a mass, so that centre of mass and inertia follow them.
pub fn panels_weigh(setup: &PlantSetup) -> bool {
    setup.spacecraft.panels.iter().any(|panel| panel.mass.is_some())
}

/// Inputs and parameters by what they act on at the start.
pub struct Start {
    /// Whether the flight begins, or waits for orbit or Sun.
    pub begun: Knowns,
    /// The same without position and velocity.
    pub awaited: Knowns,
    /// Elements of the orbit and their frame, without the pole's right ascension.
    pub elements: Knowns,
    /// The right ascension of the pole turns the orbit about EME2000's Z axis.
    pub turned_about_z: Knowns,
    /// Where Sun and planets are.
    pub ephemeris: Knowns,
    /// Where the Sun is from the spacecraft.
    pub sun: Knowns,
    /// The same along Z of EME2000.
    pub sun_z: Knowns,
    pub attitude: Knowns,
    /// What the orbit phase's own guidance follows.
    pub guidance: Knowns,
    /// What the attitude's rate follows, but for command.rate.
    pub rate: Knowns,
    /// The orbit phase's own guidance, where it sets the start of a controlled flight.
    pub guided: Knowns,
    /// Of each panel.
    pub panels: Vec<Knowns>,
    pub momentum: Knowns,
    /// Momentum of body and wheels of controlled and free flight, without the inertia.
    pub turning: Knowns,
    /// What the choice of the Sun's place follows of the momentum of body and wheels.
    pub chosen_by_momentum: Knowns,
    /// What moves centre of mass and inertia with the panels that have a mass, but for the centre of mass itself.
    pub weight: Knowns,
    /// What the estimated attitude follows besides the true one.
    pub measured_attitude: Knowns,
}

impl Start {
    /// Of one spacecraft.
    pub fn of(setup: &PlantSetup, v: &PlantVariables) -> Self {
        let (orbit, ephemeris, guided, command) = (&v.orbit, &v.ephemeris, &v.guided, &v.command);
        let awaited = knowns![orbit.source, orbit.center, ephemeris.source, v.sun.position];
        let begun = knowns![&awaited, orbit.position, orbit.velocity];
        let shape = knowns![orbit.semi_major_axis, orbit.eccentricity, orbit.true_anomaly];
        let orientation = knowns![
            orbit.frame,
            orbit.inclination,
            orbit.ascending_node,
            orbit.periapsis_argument,
            v.planet.pole_declination,
        ];
        let elements = knowns![shape, orientation];
        let turned_about_z = knowns![v.planet.pole_right_ascension];
        let ephemeris = knowns![v.start.epoch, &ephemeris.ellipse.knowns()];
        let sun_z = knowns![&begun, &elements, &ephemeris];
        let sun = knowns![&sun_z, &turned_about_z];
        let panels = v
            .panel
            .iter()
            .map(|panel| {
                let set = knowns![panel.control, panel.sun_offset, panel.tilt, panel.enabled];
                knowns![set, turned_by(panel)]
            })
            .collect::<Vec<_>>();
        let schedule = knowns![
            guided.downlink_reference,
            guided.downlink_start,
            guided.downlink_end,
            guided.downlink_every,
            guided.slew_rate
        ];
        let law = knowns![guided.science_rule, guided.science_gain, v.keep_in.elevation, v.keep_in.azimuth];
        let guidance = knowns![&sun, law, schedule, v.planet.gravitational_parameter, v.earth.position];
        // A downlink that begins at the start has the Sun where its torque brings the momentum to the target.
        let management = &v.momentum.management;
        let aimed = knowns![
            management.strategy,
            management.aim.target_axes,
            management.aim.targeting,
            management.aim.target.element(0),
            management.aim.target.element(2),
            v.start.momentum.element(0),
            v.start.momentum.element(2),
            v.keep_in.azimuth,
        ];
        let light =
            knowns![v.solar.knowns(), v.spacecraft.center_of_mass, panels.iter().collect::<Knowns>(),];
        let shade = knowns![v.sunshade.shape].only_if(has_both_shapes(&setup.spacecraft));
        let mass = knowns![v.spacecraft.mass].only_if(panels_weigh(setup));
        let guidance = knowns![guidance, aimed, light, shade, mass];
        // A command of zero is none.
        let sources = knowns![v.attitude.source, command.source];
        let rate = knowns![&guidance, &sources, command.kind, command.q, command.error];
        let guided = knowns![&guidance, &sources, v.start.q].only_if(can_control(v));
        let attitude = knowns![&rate, v.start.q];
        let dump = &v.dump;
        let momentum =
            knowns![v.start.momentum, dump.threshold, dump.reinit_to, dump.reinit_fraction, dump.target];
        let wheels = v.wheel.iter().map(|wheel| knowns![wheel.axis, wheel.start_momentum]);
        let weight = knowns![&attitude, panels.iter().collect::<Knowns>(), v.spacecraft.mass]
            .only_if(panels_weigh(setup));
        let center_of_mass = knowns![v.spacecraft.center_of_mass].only_if(panels_weigh(setup));
        let wheels = wheels.collect::<Knowns>();
        let chosen_by_momentum = knowns![v.start.rate, v.spacecraft.inertia, &wheels].only_if(can_control(v));
        let turning =
            knowns![&begun, &guided, v.attitude.source, v.start.rate, wheels, &weight, center_of_mass];
        let tracker = &v.star_tracker;
        let measured_attitude = knowns![
            tracker.noise,
            tracker.failed,
            tracker.period,
            v.gyro.failed,
            v.noise.seed,
            v.control.rate,
        ];
        Self {
            begun,
            awaited,
            elements,
            turned_about_z,
            ephemeris,
            sun,
            guidance: knowns![guidance, sources],
            sun_z,
            attitude,
            rate,
            guided,
            panels,
            momentum,
            turning,
            chosen_by_momentum,
            weight,
            measured_attitude,
        }
    }
}
