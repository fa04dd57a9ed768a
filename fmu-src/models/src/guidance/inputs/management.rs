//! From parameters and inputs to who puts the Sun in its place and asks for dumps.

use fmi_export::Failure;
use nalgebra::Vector3;
use physics::guidance::constraints::keep_in::KeepIn;
use physics::management::{SampledManager, Strategy};
use physics::momentum::{DumpPolicy, Reinitialise};
use physics::plant::SunlitConfiguration;
use physics::spacecraft::MassProperties;

use super::Fixed;
use crate::common::management::{ManagedSpacecraft, check_strategy_has_antenna};
use crate::common::spacecraft::bias_body_n_m_s;
use crate::guidance::setup::Read;
use crate::guidance::variables::choices::DumpReinitTo;

/// Whether a strategy chooses the Sun's place.
pub(crate) fn is_managed(read: Read<'_>) -> bool {
    read.choice(read.variables.momentum.strategy).0 != Strategy::DumpsOnly
}

/// Manager that selects the Sun's direction where this momentum begins a downlink.
///
/// # Errors
/// A strategy without a downlink.
pub(crate) fn manager<'a>(
    read: Read<'a>,
    fixed: &'a Fixed,
    keep_in: &KeepIn,
) -> Result<SampledManager<'a>, Failure> {
    let v = read.variables;
    let spacecraft = &read.setup.spacecraft;
    let sunshade = read.choice(v.sunshade_shape).0;
    let strategy = read.choice(v.momentum.strategy).0;
    v.guided.check_unload(read.values, strategy != Strategy::DumpsOnly)?;
    check_strategy_has_antenna(strategy, &read.setup.antennas.all)?;
    let [start_s, end_s] = [v.guided.downlink_start, v.guided.downlink_end].map(|time| read.real(time));
    if strategy != Strategy::DumpsOnly && start_s >= end_s {
        return Err(Failure::new(format!(
            "momentum.strategy, guided.downlinkStart, guided.downlinkEnd: found a strategy for downlinks from {start_s:?} s to \
             {end_s:?} s, allowed: dumpsOnly, or an end after the start"
        )));
    }
    Ok(SampledManager {
        manager: v.momentum.targeting.manager(
            read.values,
            strategy,
            ManagedSpacecraft {
                spacecraft,
                sunshade,
                antennas: &read.setup.antennas.all,
                sun_limits_rad: [keep_in.azimuth_rad, keep_in.elevation_rad],
                bias_body_n_m_s: bias_body_n_m_s(spacecraft),
            },
        ),
        default_downlink: &read.setup.antennas.default_downlink,
        spacecraft: SunlitConfiguration {
            solar: &fixed.solar,
            panels: &spacecraft.panels,
            settings: &fixed.panels,
            current_mass_panels_stowed: MassProperties {
                center_of_mass_body_m: read.vector(v.spacecraft_center_of_mass),
                ..spacecraft.mass_properties
            },
            // The panels are held at their offsets, whenever and however far from the Sun.
            time_s: 0.0,
            sun_distance_m: 0.0,
        },
        light: v.solar.read(read.values),
        convention: read.choice(v.momentum.convention).0,
        policy: policy(read),
        momentum_body_n_m_s: Vector3::from([0.0; 3]),
    })
}

/// When a dump is requested, and to which momentum.
pub(crate) fn policy(read: Read<'_>) -> DumpPolicy {
    let v = read.variables;
    DumpPolicy {
        bias_body_n_m_s: bias_body_n_m_s(&read.setup.spacecraft),
        threshold_body_n_m_s: read.vector(v.dump.threshold),
        reinitialise: match read.choice(v.dump.reinit_to) {
            DumpReinitTo::Target => Reinitialise::Target {
                momentum_body_n_m_s: v.momentum.targeting.target_body_n_m_s(read.values),
            },
            DumpReinitTo::Opposite => Reinitialise::Opposite { fraction: read.real(v.dump.reinit_fraction) },
        },
    }
}
