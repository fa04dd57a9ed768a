//! The spinner, from its file; every problem is reported by file, line, key, what was found and what is
//! allowed.

use nalgebra::Vector3;
use serde::Serialize;

use super::description::{GroupEntry, SpinnerDescription, ThrusterEntry};
use super::hardware::{Group, Limits, MassTable, PulseExecution, StarTracker, SunSensor};
use crate::constants::STANDARD_GRAVITY_M_S2;
use crate::spacecraft::{MOST_THRUSTERS, StartEntry, Thrust, Thruster, ValveTiming, start_entries};
use crate::spin::geometry::L1Orbit;
use crate::toml::{Checker, Document, FileError, Pickets, Place, Written, nearest};

/// The whole setup, validated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spinner {
    /// Name.
    pub name: String,
    /// Mass properties.
    pub mass_properties: MassTable,
    /// 1/e time of the nutation angle, in s; 0 without a damper.
    pub damper_time_constant_s: f64,
    /// Smallest step of pulse width, in s.
    pub resolution_s: f64,
    /// Thrusters.
    pub thrusters: Vec<Thruster>,
    /// Named groups.
    pub groups: Vec<Group>,
    /// Star tracker.
    pub star_tracker: StarTracker,
    /// Sun sensor.
    pub sun_sensor: SunSensor,
    /// Limits.
    pub limits: Limits,
    /// Orbit.
    pub l1_orbit: L1Orbit,
    /// Start values of the model's variables, handed on as they were written.
    #[serde(skip)]
    pub start: Vec<StartEntry>,
}

impl Spinner {
    /// Reads a spinner from TOML text; `file` only names it in errors.
    ///
    /// # Errors
    ///
    /// Text that is not TOML, or all unknown, missing and ill-typed keys and all values no spinner can have, each with
    /// line, key, what was found and what is allowed.
    pub fn parse(file: &str, text: &str) -> Result<Self, FileError> {
        let document = Document::parse(file, text)?;
        let (raw, check) = Checker::read(&document)?;
        let spinner = spinner(&Place::root(&check), raw);
        check.finish(spinner)
    }

    /// Thrust of the thrusters of `mask` together.
    pub fn thrust(&self, mask: u32) -> Thrust {
        let mut sum =
            Thrust { force_body_n: Vector3::zeros(), torque_body_n_m: Vector3::zeros(), flow_kg_s: 0.0 };
        for (k, thruster) in self.thrusters.iter().enumerate() {
            if mask >> k & 1 == 1 {
                sum.force_body_n += thruster.force_body_n;
                sum.torque_body_n_m += thruster.torque_body_n_m;
                sum.flow_kg_s += thruster.flow_kg_s;
            }
        }
        sum
    }

    /// Returns the execution of pulses, thruster by thruster.
    pub fn execution(&self) -> [PulseExecution; MOST_THRUSTERS] {
        let execution = |it: &Thruster| PulseExecution { valve: it.valve, scatter: it.scatter };
        core::array::from_fn(|k| self.thrusters.get(k).map(execution).unwrap_or_default())
    }

    /// Index of the first thruster that tilts the momentum and leaves the spin, pushing across the spin axis if any does, and
    /// of the one that pushes the other way half a turn later, if there is one. Without any, of the first that tilts it at all.
    pub fn steering_pair(&self) -> Option<(usize, Option<usize>)> {
        const NEGLIGIBLE: f64 = 1e-6;
        let across = |k: usize| self.thrusters[k].torque_body_n_m.xy();
        let along = |k: usize| self.thrusters[k].torque_body_n_m.z.abs();
        let mut tilting = (0..self.thrusters.len()).filter(|k| across(*k).norm() > 0.0);
        let mut steering = tilting.clone().filter(|k| along(*k) <= NEGLIGIBLE * across(*k).norm());
        let is_radial = |k: &usize| {
            let force = &self.thrusters[*k].force_body_n;
            force.z.abs() <= NEGLIGIBLE * force.norm()
        };
        let radial = steering.clone().find(is_radial);
        let first = radial.or_else(|| steering.next()).or_else(|| tilting.next())?;
        let opposite = (0..self.thrusters.len()).find(|k| {
            (across(*k) + across(first)).norm() <= NEGLIGIBLE * across(first).norm()
                && along(*k) <= along(first).max(NEGLIGIBLE * across(first).norm())
        });
        Some((first, opposite))
    }

    /// The group or single thruster called `name`: its mask and that of its opposite.
    pub fn named(&self, name: &str) -> Option<(u32, Option<u32>)> {
        if let Some(group) = self.groups.iter().find(|group| group.name == name) {
            return Some((group.mask, group.opposite.and_then(|o| self.groups.get(o)).map(|g| g.mask)));
        }
        self.thrusters.iter().position(|thruster| thruster.name == name).map(|k| (1 << k, None))
    }
}

fn spinner(root: &Place<'_>, raw: SpinnerDescription) -> Spinner {
    let mass_properties = raw.mass_properties.value();
    check_mass(&root.key("mass_properties"), &mass_properties);
    let exhaust_m_s = raw.thrusters.specific_impulse_s.0 * STANDARD_GRAVITY_M_S2;
    let thrusters = thrusters(&root.key("thruster"), &raw.thruster, exhaust_m_s);
    let groups = groups(root, raw.group.as_deref().unwrap_or_default(), &thrusters);
    let star_tracker = raw.star_tracker.unwrap_or_default().value();
    let place = root.key("star_tracker").key("pickets");
    if !star_tracker.pickets.is_multiple_of(4) && !place.has_reported() {
        place.report(star_tracker.pickets, Pickets::ALLOWED);
    }
    let l1_orbit = raw.l1_orbit.unwrap_or_default().value();
    let along_m = l1_orbit.amplitude_m[0];
    if along_m.abs() >= l1_orbit.earth_l1_distance_m {
        let place = root.key("l1_orbit").key("amplitude_m").item(0);
        place.report_across(along_m, "less than earth_l1_distance_m");
    }
    Spinner {
        name: raw.name,
        mass_properties,
        damper_time_constant_s: raw.damper.map_or(0.0, |damper| damper.time_constant_s.0),
        resolution_s: raw.thrusters.resolution_s.0,
        thrusters,
        groups,
        star_tracker,
        sun_sensor: raw.sun_sensor.unwrap_or_default().value(),
        limits: raw.limits,
        l1_orbit,
        start: start_entries(root, raw.start.as_ref(), raw.fixed.as_ref()),
    }
}

/// Reports mass properties that no body has.
fn check_mass(at: &Place<'_>, mass: &MassTable) {
    let count = mass.propellant_kg.len();
    if count < 2 || mass.propellant_kg.windows(2).any(|pair| pair[0] >= pair[1]) {
        let found = format!("{:?}", mass.propellant_kg);
        at.key("propellant_kg").report(found, "two or more rising numbers");
    }
    let lengths = [
        ("spin_inertia_kg_m2", mass.spin_inertia_kg_m2.len()),
        ("inertia_ratio", mass.inertia_ratio.len()),
        ("products_of_inertia_kg_m2", mass.products_of_inertia_kg_m2.as_ref().map_or(count, Vec::len)),
    ];
    for (key, length) in lengths.into_iter().filter(|(_, length)| *length != count) {
        let allowed = format!("{count} of them, one for each of propellant_kg");
        at.key(key).report_across(format_args!("a list of {length}"), allowed);
    }
    let (initial_kg, most_kg) = (mass.initial_propellant_kg, mass.most_propellant_kg());
    if !(0.0..=most_kg).contains(&initial_kg) {
        let allowed = format!("a number from 0 to {most_kg}, the last of propellant_kg");
        at.key("initial_propellant_kg").report_across(initial_kg, allowed);
    }
    let mut whole = lengths.iter().map(|(key, _)| *key).chain(["propellant_kg", "transverse_quotient"]);
    if whole.any(|key| at.key(key).has_reported()) {
        return;
    }
    for (i, &propellant_kg) in mass.propellant_kg.iter().enumerate() {
        if let Err(error) = mass.inertia(propellant_kg) {
            let place = at.key("inertia_ratio").item(i);
            let ratio = mass.inertia_ratio.get(i).copied().unwrap_or(f64::NAN);
            let allowed = "a ratio that a body can have: at most 2, less with products of inertia";
            place.report_across(format!("{ratio}, by which {error}"), allowed);
        }
    }
}

fn thrusters(list: &Place<'_>, entries: &[ThrusterEntry], exhaust_m_s: f64) -> Vec<Thruster> {
    if entries.is_empty() {
        list.report("an empty list", format_args!("1 to {MOST_THRUSTERS} of them"));
    }
    let mut thrusters: Vec<Thruster> = Vec::with_capacity(entries.len());
    for (at, entry) in list.items(entries) {
        let other = thrusters.iter().position(|thruster| thruster.name == entry.name);
        own_name(&at, &entry.name, other.map(|other| list.item(other)));
        // Not the unit vector: scaled once, the force has the bits that GUIDs were made of.
        let direction = Vector3::from(entry.direction.0);
        let force_body_n = direction * (entry.force_n.0 / direction.norm());
        let position_body_m = entry.position_body_m();
        thrusters.push(Thruster {
            name: entry.name.clone(),
            force_body_n,
            position_body_m,
            torque_body_n_m: position_body_m.cross(&force_body_n),
            flow_kg_s: entry.force_n.0 / exhaust_m_s,
            valve: ValveTiming {
                min_on_s: entry.min_on_time_s(),
                rise_s: entry.rise_time_s(),
                tail_off_s: entry.tail_off_time_s(),
            },
            scatter: entry.scatter(),
            attitude_control: true,
            ..Thruster::default()
        });
    }
    thrusters
}

fn groups(root: &Place<'_>, entries: &[GroupEntry], thrusters: &[Thruster]) -> Vec<Group> {
    let [list, thruster_list] = ["group", "thruster"].map(|key| root.key(key));
    let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
    let thruster_names: Vec<&str> = thrusters.iter().map(|thruster| thruster.name.as_str()).collect();
    let mut groups = Vec::with_capacity(entries.len());
    for (i, (at, entry)) in list.items(entries).enumerate() {
        let name = entry.name.as_str();
        let group = names.iter().take(i).position(|other| *other == name).map(|other| list.item(other));
        let thruster = thruster_names.iter().position(|other| *other == name);
        own_name(&at, name, group.or(thruster.map(|other| thruster_list.item(other))));
        let place = at.key("thrusters");
        if entry.thrusters.is_empty() {
            place.report("an empty list", "at least one name of a thruster");
        }
        let mut mask = 0_u32;
        for (at, name) in place.items(&entry.thrusters) {
            let known = known(&thruster_list, &at, name, &thruster_names);
            mask |= known.filter(|k| *k < MOST_THRUSTERS).map_or(0, |k| 1 << k);
        }
        let opposite = entry.opposite.as_deref();
        let opposite = opposite.and_then(|other| known(&list, &at.key("opposite"), other, &names));
        groups.push(Group { name: entry.name.clone(), mask, opposite });
    }
    groups
}

/// Reports a name that is empty or that `other` has too.
fn own_name(at: &Place<'_>, name: &str, other: Option<Place<'_>>) {
    let too = other.map(|other| format!(", which is the name of {other} too"));
    if too.is_some() || name.is_empty() {
        let found = format!("{name:?}{}", too.unwrap_or_default());
        at.key("name").report(found, "a name of its own");
    }
}

/// Index of a name in `list`; reports one that is not there.
fn known(list: &Place<'_>, at: &Place<'_>, name: &str, names: &[&str]) -> Option<usize> {
    let index = names.iter().position(|known| *known == name);
    if index.is_none() && !list.has_stand_in() {
        let meant = nearest(name, names).map(|meant| format!(" (did you mean {meant:?}?)"));
        let found = format!("the unknown name {name:?}{}", meant.unwrap_or_default());
        let allowed = format_args!("a name under [[{list}]]: {}", names.join(", "));
        at.report(found, allowed);
    }
    index
}
