//! Reading and checking the spinner's file; every refusal names file, key, what was found and what is allowed.

use nalgebra::Vector3;
use serde::Deserialize;

use super::{
    Group, L1Orbit, Limits, MOST_THRUSTERS, MassProperties, Spinner, SpinnerError, StarTracker, SunSensor,
    Thruster,
};

/// Standard gravity, in m/s2 (3rd CGPM 1901): specific impulse in seconds times this is exhaust speed.
const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    mass_properties: MassProperties,
    damper: DamperEntry,
    thrusters: ThrustersEntry,
    thruster: Vec<ThrusterEntry>,
    #[serde(default)]
    group: Vec<GroupEntry>,
    star_tracker: StarTracker,
    sun_sensor: SunSensor,
    limits: Limits,
    l1_orbit: L1Orbit,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DamperEntry {
    time_constant_s: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ThrustersEntry {
    resolution_s: f64,
    specific_impulse_s: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ThrusterEntry {
    name: String,
    force_n: f64,
    position_m: [f64; 3],
    direction: [f64; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GroupEntry {
    name: String,
    thrusters: Vec<String>,
    opposite: Option<String>,
}

pub(super) fn parse(file: &str, text: &str) -> Result<Spinner, SpinnerError> {
    let raw: File = toml::from_str(text).map_err(|error| SpinnerError::Syntax {
        file: file.to_owned(),
        message: error.to_string().trim_end().to_owned(),
    })?;
    Check { file }.spinner(raw)
}

struct Check<'a> {
    file: &'a str,
}

impl Check<'_> {
    fn refuse(&self, key: &str, found: impl ToString, allowed: &str) -> SpinnerError {
        SpinnerError::Value {
            file: self.file.to_owned(),
            key: key.to_owned(),
            found: found.to_string(),
            allowed: allowed.to_owned(),
        }
    }

    fn positive(&self, key: &str, value: f64) -> Result<(), SpinnerError> {
        if value.is_finite() && value > 0.0 {
            return Ok(());
        }
        Err(self.refuse(key, value, "a positive number"))
    }

    fn not_negative(&self, key: &str, value: f64) -> Result<(), SpinnerError> {
        if value.is_finite() && value >= 0.0 {
            return Ok(());
        }
        Err(self.refuse(key, value, "0 or a positive number"))
    }

    fn finite(&self, key: &str, values: &[f64]) -> Result<(), SpinnerError> {
        match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(self.refuse(key, value, "finite numbers")),
            None => Ok(()),
        }
    }

    fn spinner(&self, raw: File) -> Result<Spinner, SpinnerError> {
        self.mass_properties(&raw.mass_properties)?;
        self.not_negative("damper.time_constant_s", raw.damper.time_constant_s)?;
        self.positive("thrusters.resolution_s", raw.thrusters.resolution_s)?;
        self.positive("thrusters.specific_impulse_s", raw.thrusters.specific_impulse_s)?;
        let exhaust_m_s = raw.thrusters.specific_impulse_s * STANDARD_GRAVITY_M_S2;
        let thrusters = self.thrusters(raw.thruster, exhaust_m_s)?;
        let groups = self.groups(raw.group, &thrusters)?;
        self.sensors(&raw.star_tracker, &raw.sun_sensor)?;
        self.limits(&raw.limits)?;
        self.orbit(&raw.l1_orbit)?;
        Ok(Spinner {
            name: raw.name,
            mass_properties: raw.mass_properties,
            damper_time_constant_s: raw.damper.time_constant_s,
            resolution_s: raw.thrusters.resolution_s,
            thrusters,
            groups,
            star_tracker: raw.star_tracker,
            sun_sensor: raw.sun_sensor,
            limits: raw.limits,
            l1_orbit: raw.l1_orbit,
        })
    }

    fn mass_properties(&self, mass: &MassProperties) -> Result<(), SpinnerError> {
        let count = mass.propellant_kg.len();
        let rising = mass.propellant_kg.windows(2).all(|pair| pair[0] < pair[1]);
        if count < 2 || !rising || mass.propellant_kg.iter().any(|x| !(x.is_finite() && *x >= 0.0)) {
            let found = format!("{:?}", mass.propellant_kg);
            return Err(self.refuse(
                "mass_properties.propellant_kg",
                found,
                "two or more rising numbers from 0 on",
            ));
        }
        for (key, values) in [
            ("mass_properties.spin_inertia_kg_m2", &mass.spin_inertia_kg_m2),
            ("mass_properties.inertia_ratio", &mass.inertia_ratio),
        ] {
            if values.len() != count || values.iter().any(|x| !(x.is_finite() && *x > 0.0)) {
                let allowed = format!("{count} positive numbers, one for each propellant_kg");
                return Err(self.refuse(key, format!("{values:?}"), &allowed));
            }
        }
        self.positive("mass_properties.dry_mass_kg", mass.dry_mass_kg)?;
        self.positive("mass_properties.transverse_quotient", mass.transverse_quotient)?;
        let most = mass.propellant_kg.last().copied().unwrap_or(0.0);
        if !(mass.initial_propellant_kg >= 0.0 && mass.initial_propellant_kg <= most) {
            let allowed = format!("0 to {most}, the last propellant_kg");
            return Err(self.refuse(
                "mass_properties.initial_propellant_kg",
                mass.initial_propellant_kg,
                &allowed,
            ));
        }
        for &propellant in &mass.propellant_kg {
            if let Err(error) = mass.inertia(propellant) {
                let key = format!("mass_properties at {propellant} kg");
                return Err(self.refuse(&key, error, "moments of inertia that a body can have"));
            }
        }
        Ok(())
    }

    fn thrusters(
        &self,
        entries: Vec<ThrusterEntry>,
        exhaust_m_s: f64,
    ) -> Result<Vec<Thruster>, SpinnerError> {
        if entries.is_empty() || entries.len() > MOST_THRUSTERS {
            let allowed = format!("1 to {MOST_THRUSTERS} of them");
            return Err(self.refuse("thruster", format!("a list of {}", entries.len()), &allowed));
        }
        let mut thrusters: Vec<Thruster> = Vec::with_capacity(entries.len());
        for (i, entry) in entries.into_iter().enumerate() {
            let key = |field: &str| format!("thruster[{}].{field}", i + 1);
            if entry.name.is_empty() || thrusters.iter().any(|t| t.name == entry.name) {
                return Err(self.refuse(&key("name"), format!("\"{}\"", entry.name), "a name of its own"));
            }
            self.positive(&key("force_n"), entry.force_n)?;
            self.finite(&key("position_m"), &entry.position_m)?;
            let direction = Vector3::from(entry.direction);
            let norm = direction.norm();
            if norm.is_nan() || (norm - 1.0).abs() > 1e-3 {
                let found = format!("{:?} of length {norm}", entry.direction);
                return Err(self.refuse(&key("direction"), found, "a unit vector (within 1e-3)"));
            }
            let force_body_n = direction * (entry.force_n / norm);
            thrusters.push(Thruster {
                name: entry.name,
                force_body_n,
                torque_body_n_m: Vector3::from(entry.position_m).cross(&force_body_n),
                flow_kg_s: entry.force_n / exhaust_m_s,
            });
        }
        Ok(thrusters)
    }

    fn groups(&self, entries: Vec<GroupEntry>, thrusters: &[Thruster]) -> Result<Vec<Group>, SpinnerError> {
        let names: Vec<String> = entries.iter().map(|entry| entry.name.clone()).collect();
        let mut groups = Vec::with_capacity(entries.len());
        for (i, entry) in entries.into_iter().enumerate() {
            let key = |field: &str| format!("group[{}].{field}", i + 1);
            let taken = names.iter().take(i).any(|name| *name == entry.name)
                || thrusters.iter().any(|thruster| thruster.name == entry.name);
            if entry.name.is_empty() || taken {
                return Err(self.refuse(&key("name"), format!("\"{}\"", entry.name), "a name of its own"));
            }
            let mut mask = 0_u32;
            for name in &entry.thrusters {
                match thrusters.iter().position(|thruster| thruster.name == *name) {
                    Some(k) => mask |= 1 << k,
                    None => {
                        return Err(self.refuse(
                            &key("thrusters"),
                            format!("\"{name}\""),
                            "names of thrusters",
                        ));
                    }
                }
            }
            if mask == 0 {
                return Err(self.refuse(&key("thrusters"), "an empty list", "at least one name"));
            }
            let opposite = match &entry.opposite {
                None => None,
                Some(name) => match names.iter().position(|other| other == name) {
                    Some(index) => Some(index),
                    None => {
                        return Err(self.refuse(&key("opposite"), format!("\"{name}\""), "name of a group"));
                    }
                },
            };
            groups.push(Group { name: entry.name, mask, opposite });
        }
        Ok(groups)
    }

    fn sensors(&self, tracker: &StarTracker, sun: &SunSensor) -> Result<(), SpinnerError> {
        self.finite("star_tracker.azimuth_deg", &[tracker.azimuth_deg])?;
        if !(tracker.field_of_view_deg > 0.0 && tracker.field_of_view_deg <= 180.0) {
            return Err(self.refuse(
                "star_tracker.field_of_view_deg",
                tracker.field_of_view_deg,
                "above 0, to 180",
            ));
        }
        if tracker.every == 0 || tracker.pickets == 0 || !tracker.pickets.is_multiple_of(4) {
            let found = format!("{} pickets, every {}th", tracker.pickets, tracker.every);
            return Err(self.refuse("star_tracker", found, "pickets a multiple of 4, every at least 1"));
        }
        self.not_negative("star_tracker.noise_deg", tracker.noise_deg)?;
        self.finite("sun_sensor.azimuth_deg", &[sun.azimuth_deg])?;
        self.not_negative("sun_sensor.noise_deg", sun.noise_deg)?;
        if sun.sectors == 0 {
            return Err(self.refuse("sun_sensor.sectors", 0, "at least 1"));
        }
        Ok(())
    }

    fn limits(&self, limits: &Limits) -> Result<(), SpinnerError> {
        for (key, value) in [
            ("limits.sun_angle_deg", limits.sun_angle_deg),
            ("limits.earth_angle_deg", limits.earth_angle_deg),
            ("limits.spin_rate_rpm", limits.spin_rate_rpm),
            ("limits.spin_rate_tolerance_rpm", limits.spin_rate_tolerance_rpm),
            ("limits.period_variation_s", limits.period_variation_s),
        ] {
            self.positive(key, value)?;
        }
        Ok(())
    }

    fn orbit(&self, orbit: &L1Orbit) -> Result<(), SpinnerError> {
        self.finite("l1_orbit.line_rate_deg_day", &[orbit.line_rate_deg_day])?;
        self.positive("l1_orbit.sun_earth_distance_m", orbit.sun_earth_distance_m)?;
        self.positive("l1_orbit.earth_l1_distance_m", orbit.earth_l1_distance_m)?;
        self.finite("l1_orbit.amplitude_m", &orbit.amplitude_m)?;
        if orbit.amplitude_m[0].abs() >= orbit.earth_l1_distance_m {
            let found = format!("{:?}", orbit.amplitude_m);
            return Err(self.refuse("l1_orbit.amplitude_m", found, "first below earth_l1_distance_m"));
        }
        self.finite(
            "l1_orbit.*_frequency, obliquity_deg",
            &[orbit.in_plane_frequency, orbit.out_of_plane_frequency, orbit.obliquity_deg],
        )
    }
}
