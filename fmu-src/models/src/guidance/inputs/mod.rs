//! From parameters to what holds for a whole flight and to the settings of a sample.

pub(super) mod management;
pub(super) mod reader;

use fmi_export::{Failure, Values};
use nalgebra::Vector3;
use physics::bodies::{Body, BodyData};
use physics::enumeration::Enumerated;
use physics::environment::bodies_from_center::BodiesFromCenter;
use physics::environment::orientation::Orientation;
use physics::guidance::TargetPlanet;
use physics::guidance::burn::delta_v::BurnSettings;
use physics::guidance::burn::nominal_thrust::NominalThrust;
use physics::guidance::burn::velocity_path::VelocityPath;
use physics::guidance::constraints::constrained::Constraints;
use physics::guidance::constraints::hot_pole::HotPole;
use physics::guidance::constraints::keep_in::KeepIn;
use physics::guidance::downlink::sun_direction::LinkLimits;
use physics::guidance::modes::monitor::Monitor;
use physics::guidance::modes::sample_inputs::GuidanceSettings;
use physics::guidance::modes::transitions::ModeSettings;
use physics::guidance::pointing::boresight::Gimbal;
use physics::guidance::pointing::command::{BoresightOption, PointingCommand, Scenario};
use physics::guidance::pointing::scan::ScanCompatibility;
use physics::guidance::scenario::GuidanceHardware;
use physics::plant::{PanelSetting, Ramp};
use physics::radiation::SolarModel;

use super::setup::{Plan, Read};
use super::variables::celestial_bodies::PlanetVariables;
use super::variables::choices::EphemerisSource;
use crate::common::choices::PlanetOrientation;
use crate::common::downlink::ZERO_KEEP_IN_AXIS;
use crate::common::ephemeris::{self, NamedEpoch};
use crate::common::guided::NO_GIMBAL;
use crate::common::management::{NO_ANTENNA, check_windows_have_antenna};
use crate::common::numbers::Numbers;
use crate::common::pointing::RuleContext;

/// Settings that parameters fix for a whole flight.
#[derive(Clone, Debug)]
pub struct Fixed {
    planet: TargetPlanet,
    source: EphemerisSource,
    bodies: BodiesFromCenter,
    /// The panels as they are commanded; tunable, and set anew with every step.
    pub panels: Vec<PanelSetting>,
    /// The spacecraft in sunlight; its materials are tunable.
    pub solar: SolarModel,
    /// The burn of the scenario burn by the parameters.
    pub burn: BurnSettings,
}

impl Fixed {
    /// The settings of the step before, else those of the parameters, with the tunable parameters of planet, materials and panels as
    /// they are set now; allocates nothing where there was a step.
    ///
    /// # Errors
    /// Names parameters whose values are refused.
    pub fn current(kept: Option<Self>, read: Read<'_>) -> Result<Self, Failure> {
        let mut fixed = kept.map_or_else(|| Self::read(read), Ok)?;
        let v = read.variables;
        for found in v.optics.materials(read, &read.setup.optics) {
            let (index, material) = found?;
            fixed.solar.set_material(index, &material);
        }
        if let Orientation::Iau { ut1_minus_utc_s } = &mut fixed.planet.orientation {
            *ut1_minus_utc_s = read.real(v.earth.ut1_offset);
        }
        fixed.panels.clear();
        fixed.panels.extend(v.panel.iter().map(|panel| match read.boolean(panel.enabled) {
            true => PanelSetting::SunOffset {
                offset: Ramp::held(read.real(panel.nominal_sun_offset)),
                tilt: read.choice(panel.tilt).sign().into(),
            },
            false => PanelSetting::Disabled,
        }));
        Ok(fixed)
    }

    fn read(read: Read<'_>) -> Result<Self, Failure> {
        let v = read.variables;
        let target = Target::read(read);
        let (body, planet) = (target.data.body, target.planet(read)?);
        let epoch_s = read.real(v.start.epoch);
        let source = read.choice(v.ephemeris.source);
        if source != EphemerisSource::Inputs {
            ephemeris::check_start(epoch_s)?;
        }
        let precise = ephemeris::precise(read.setup.ephemeris.as_ref());
        if let Some(carried) = precise.filter(|_| source == EphemerisSource::Chebyshev) {
            NamedEpoch { name: "start.epoch", epoch_s }.check_onboard(carried, body)?;
        }
        let (target, has_table) = (read.setup.bodies.body(body), precise.is_some());
        let ellipse = match source {
            EphemerisSource::Kepler => Some(v.ephemeris.ellipse.planet(read, &target, epoch_s)?),
            EphemerisSource::Vsop87 if body == Body::Custom => Some(ephemeris::custom(&target, "vsop87")?),
            EphemerisSource::Chebyshev if body == Body::Custom && !has_table => {
                Some(ephemeris::custom(&target, "chebyshev")?)
            }
            _ => None,
        };
        let bodies =
            BodiesFromCenter { center: body, ellipse, custom: read.setup.bodies.body(Body::Custom).motion };
        Ok(Self {
            planet,
            source,
            bodies,
            panels: Vec::with_capacity(v.panel.len()),
            solar: {
                let shape = read.choice(v.sunshade_shape).0;
                read.setup.shapes.solar(shape, &read.setup.spacecraft.name)?.clone()
            },
            burn: burn(read)?,
        })
    }
}

/// The target planet as its parameters act.
struct Target {
    data: BodyData,
    radii_m: Vector3<f64>,
    orientation: PlanetOrientation,
}

/// Pole, rotation and gravity.
fn planet(v: &PlanetVariables) -> Numbers<BodyData, 5> {
    let [a, b, c, d] = v.rotation.numbers();
    Numbers([a, b, c, d, (v.gravitational_parameter, |it| &mut it.gm_m3_s2)])
}

impl Target {
    /// Reads the parameters `planet.*`; those not given are the body's own.
    fn read(read: Read<'_>) -> Self {
        let v = &read.variables.planet;
        let own = read.setup.bodies.body(read.choice(read.variables.target.planet).0);
        let [a, b, c, d, e] = planet(v).group();
        let given = read.given(&[v.radii.into(), a, b, c, d, e, v.rotation.orientation.into()]);
        let radius_m = |i| given.real_or(v.radii.element(i), own.radii_m[i]);
        Self {
            radii_m: Vector3::from([0, 1, 2].map(radius_m)),
            orientation: given.choice_or(v.rotation.orientation, PlanetOrientation::for_body(own.data.body)),
            data: planet(v).read_or(given, &own.data),
        }
    }

    /// As pointing takes it.
    ///
    /// # Errors
    /// The Earth's orientation requested of another body.
    fn planet(&self, read: Read<'_>) -> Result<TargetPlanet, Failure> {
        let ut1_minus_utc_s = read.real(read.variables.earth.ut1_offset);
        Ok(TargetPlanet {
            radii_m: self.radii_m,
            orientation: self.orientation.about(&self.data, ut1_minus_utc_s)?,
            gm_m3_s2: self.data.gm_m3_s2,
        })
    }
}

/// Writes the parameters that follow `target.planet` as they act.
pub(super) fn resolve_start(context: &Plan<'_>, values: &mut Values) {
    let (v, ellipse) = (&context.variables.planet, &context.variables.ephemeris.ellipse);
    let read = Read::new(context, values);
    let Target { data, radii_m, orientation } = Target::read(read);
    let elements = ellipse.read(read, &context.setup.bodies.body(data.body));
    ellipse.write(values, &elements);
    values.set_vector(v.radii, radii_m.into());
    planet(v).write(values, data);
    values.set_choice(v.rotation.orientation, orientation);
    context.variables.guided.resolve_start(context, values, &context.setup.guided, data.body == Body::Sun);
}

/// The burn by its parameters and the spacecraft's thrusters.
fn burn(read: Read<'_>) -> Result<BurnSettings, Failure> {
    let v = &read.variables.burn;
    let real = |handle| read.real(handle);
    let delta_v_m_s = read.vector(v.delta_v);
    let rows = read.values.matrix(v.profile);
    let path = VelocityPath::of_burn(
        delta_v_m_s,
        [0, 1, 2].map(|power| Vector3::from(rows.map(|component| component[power]))),
    );
    let thrusters = read.choice(v.thrusters).0;
    let direction_body = read.vector(v.thrust_direction);
    let nominal = NominalThrust::new(&read.setup.spacecraft, thrusters, direction_body);
    let given_m_s2 = Some(real(v.acceleration)).filter(|it| *it > 0.0);
    Ok(BurnSettings {
        path: path.map_err(|error| Failure::new(format!("burn.profile: {error} of burn.deltaV")))?,
        thrusters,
        start_s: real(v.start),
        awaits_attitude: false,
        look_ahead_s: real(v.look_ahead),
        gain: real(v.gain),
        predictive: read.boolean(v.predictive),
        reactive: read.boolean(v.reactive),
        nominal: NominalThrust {
            acceleration_m_s2: given_m_s2.unwrap_or(nominal.acceleration_m_s2),
            ..nominal
        },
        timeout_s: real(v.timeout),
        wait_s: real(v.timeout),
    })
}

/// Gimbal of the spacecraft with the angles of the parameters; `None` without one.
///
/// # Errors
/// A minimum above the maximum, or angles without a gimbal.
fn gimbal(read: Read<'_>) -> Result<Option<Gimbal>, Failure> {
    let v = &read.variables.gimbal;
    let [minimum_rad, maximum_rad] = [v.minimum, v.maximum].map(|handle| read.real(handle));
    let refused = |allowed: &str| {
        Err(Failure::new(format!(
            "gimbal.minimum, gimbal.maximum: found {minimum_rad:?} and {maximum_rad:?} rad, allowed: {allowed}"
        )))
    };
    if minimum_rad > maximum_rad {
        return refused("a minimum not above the maximum");
    }
    let gimbal = Gimbal::from_instruments(&read.setup.spacecraft.instruments);
    let gimbal = gimbal.map(|gimbal| Gimbal { minimum_rad, maximum_rad, ..gimbal });
    if gimbal.is_none() && [minimum_rad, maximum_rad] != [0.0; 2] {
        return refused(&format!("0 and 0; {NO_GIMBAL}"));
    }
    Ok(gimbal)
}

/// Parameters, as a sample uses them. The timeline may override the keep-in zone.
pub(super) fn settings<'a>(read: Read<'a>, fixed: &Fixed) -> Result<GuidanceSettings<'a>, Failure> {
    let v = read.variables;
    let real = |handle| read.real(handle);
    let method = read.choice(v.keep_in.method).0;
    let axis_body = read.vector(v.keep_in.axis);
    if axis_body == Vector3::from([0.0; 3]) {
        return Err(Failure::new(ZERO_KEEP_IN_AXIS));
    }
    let gimbal = gimbal(read)?;
    let zone = |azimuth, elevation| KeepIn {
        axis_body,
        azimuth_rad: real(azimuth),
        elevation_rad: real(elevation),
        method,
        distance_m: f64::INFINITY,
    };
    let hot_pole = read.boolean(v.hot_pole.enabled).then(|| HotPole {
        altitude_m: real(v.hot_pole.altitude),
        angle_rad: real(v.hot_pole.angle),
        cone_rad: real(v.hot_pole.cone),
    });
    let distance_m = real(v.keep_in.distance);
    let keep_in = KeepIn { distance_m, ..zone(v.keep_in.azimuth, v.keep_in.elevation) };
    let beam = read.given(&[v.link.beam.into()]);
    Ok(GuidanceSettings {
        hardware: GuidanceHardware {
            instruments: &read.setup.spacecraft.instruments,
            gimbal,
            antennas: &read.setup.antennas.all,
            default_downlink: &read.setup.antennas.default_downlink,
            subsolar: read.choice(v.subsolar_method).0,
            scans: scans(read),
        },
        modes: ModeSettings {
            operational: Constraints {
                keep_in: read.boolean(v.keep_in.enabled).then_some(keep_in),
                hot_pole,
            },
            safe_hold: Constraints {
                keep_in: Some(zone(v.safe_hold.azimuth, v.safe_hold.elevation)),
                hot_pole,
            },
            watches_hot_pole: true,
            monitor: read.boolean(v.monitor.enabled).then(|| Monitor {
                margin_rad: real(v.monitor.margin),
                persistence_s: real(v.monitor.persistence),
            }),
            ephemeris_check: Some(Monitor {
                margin_rad: real(v.ephemeris.tolerance),
                persistence_s: real(v.ephemeris.persistence),
            }),
            boresight_body: axis_body,
            earth_acquisition_rate_rad_s: real(v.earth_acquisition_rate),
            sun_search_rate_rad_s: real(v.sun_search.rate),
            sun_search_duration_s: real(v.sun_search.duration),
        },
        keep_in,
        link: LinkLimits {
            sun_separation_rad: real(v.link.sun_exclusion),
            coverage_rad: beam.has(v.link.beam).then(|| real(v.link.beam)),
        },
        orbit_phase: {
            let law =
                v.guided.read(read.values, [0.0, f64::INFINITY, real(v.start.epoch)], keep_in, gimbal)?;
            // Every sample brings the zone of its mode.
            let about = RuleContext {
                is_about_sun: fixed.bodies.center == Body::Sun,
                panels: &read.setup.spacecraft.panels,
                zone: None,
            };
            v.guided.in_phase(read, &read.setup.guided, law, &about)?
        },
        burn: fixed.burn,
    })
}

/// Refuses what needs a device that the spacecraft has not.
///
/// # Errors
/// A gimbal that no instrument has, a downlink without an antenna.
pub(super) fn check_devices(
    command: &PointingCommand,
    settings: &GuidanceSettings<'_>,
) -> Result<(), Failure> {
    let hardware = &settings.hardware;
    let lacks = |variable: &str, item: &str, allowed: &str, lack: &str| {
        Err(Failure::new(format!("{variable}: found {item}, allowed: {allowed}; {lack}")))
    };
    let Some(scenario) = command.scenario else { return Ok(()) };
    let option = command.boresight.option.filter(|_| scenario == Scenario::Generic);
    if hardware.gimbal.is_none() {
        if matches!(scenario, Scenario::Gimbal | Scenario::DoubleTarget) {
            return lacks("pointing.scenario", scenario.name(), "a scenario that needs no gimbal", NO_GIMBAL);
        }
        if let Some(option @ BoresightOption::Gimbal) = option {
            return lacks("boresight.option", option.name(), "vector, azEl or phasedArray", NO_GIMBAL);
        }
    }
    let allowed = "a scenario without a downlink";
    match scenario {
        Scenario::Downlink if hardware.antennas.is_empty() => {
            return lacks("pointing.scenario", scenario.name(), allowed, NO_ANTENNA);
        }
        Scenario::OrbitPhase => {
            check_windows_have_antenna(&settings.orbit_phase.schedule, hardware.antennas)?
        }
        _ => {}
    }
    let option =
        command.boresight.option.filter(|_| matches!(scenario, Scenario::Generic | Scenario::Downlink));
    if let Some(option @ BoresightOption::PhasedArray) = option
        && !hardware.antennas.has_fan()
    {
        let lack = "no antenna of the spacecraft is steered in the XY plane ([[antennas]] azimuth_deg)";
        return lacks("boresight.option", option.name(), "another option, or none in a downlink", lack);
    }
    Ok(())
}

/// Scan frames allowed for each kind of aimpoint.
fn scans(read: Read<'_>) -> ScanCompatibility {
    let mut scans = ScanCompatibility::default();
    for (allowed, frame) in scans.allowed.iter_mut().zip(&read.variables.scan_compatibility) {
        let kinds = [frame.direction, frame.local_direction, frame.point, frame.planet_point];
        *allowed = kinds.map(|kind| read.boolean(kind));
    }
    scans
}
