//! Momentum management: what the Sun's place in downlink and dumps follow from, and what they are.

use fmi_export::{Boolean, Choice, Real, RealVector, Variables};
use physics::constants::HALF_TURNS_RAD;
use physics::management::Strategy;
use physics::momentum::Convention;
use physics::plant::LEAST_DUMP_THRESHOLD_N_M_S;

use super::super::setup::GuidanceSetup as Setup;
use super::choices::DumpReinitTo;
use crate::common::choices::{MomentumConvention, PanelTilt};
use crate::common::management::{MomentumStrategy, TargetingVariables};
use crate::common::spacecraft::dump_threshold_n_m_s;

/// One solar panel.
#[derive(Variables)]
pub struct PanelVariables {
    /// Angle between the panel's normal and the Sun direction that is commanded, and that targets count on; its sign is a sense of tilt.
    #[parameter(tunable, unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1], start = setup.spacecraft.panels[index].sun_offset_rad)]
    pub nominal_sun_offset: Real,
    /// Sense of tilt of a positive offset; the paper does not print it.
    #[parameter(start = PanelTilt::for_panel(&setup.spacecraft.panels[index]))]
    pub tilt: Choice<PanelTilt>,
    /// Whether the panel takes part; here in the torque that targets count on.
    #[parameter(start = true)]
    pub enabled: Boolean,
    /// Commanded angle between the panel's normal and the Sun direction.
    #[output(unit = "rad", display = "deg")]
    pub sun_offset: Real,
}

/// System momentum.
#[derive(Variables)]
pub struct MomentumVariables {
    /// What sunlight is used for during downlinks, in Operational: the Sun's place is chosen where the scenario downlink begins
    /// without an antenna's azimuth, or a window of the orbit phase does, and held; in science of the orbit phase too with
    /// guided.scienceUnload. The scenario counts on a downlink of
    /// guided.downlinkEnd - guided.downlinkStart, and predictive on the orbit phase after it: a downlink every
    /// guided.downlinkEvery orbits, science by guided.scienceRule between. Forecasts fly the present orbit in two-body motion, Sun
    /// and Earth on theirs about the Sun, and count on direct sunlight alone.
    #[parameter(start = MomentumStrategy(Strategy::DumpsOnly))]
    pub strategy: Choice<MomentumStrategy>,
    #[group(name = "")]
    pub targeting: TargetingVariables,
    /// What momentum.body means. As inertial total it is turned to EME2000 by estimate.q, or by the commanded attitude where
    /// that is not connected.
    #[parameter(start = MomentumConvention(Convention::Inertial))]
    pub convention: Choice<MomentumConvention>,
    /// System momentum in the body frame.
    #[input(unit = "N.m.s", min = -1e12, max = 1e12, start = [0.0; 3])]
    #[annotation(limited_by = "dump.threshold[i]")]
    pub body: RealVector<3>,
    /// Whether the Sun's place that brings the momentum to the target of the present downlink, or of science with
    /// guided.scienceUnload, is not admissible, so that it comes as near as one that is can bring it.
    #[output]
    pub target_clamped: Boolean,
}

/// Thruster dumps.
#[derive(Variables)]
pub struct DumpVariables {
    /// Magnitude of a body component of momentum, from the bias of the file's wheels, that triggers a dump, here a request of one;
    /// a very large value means never.
    #[parameter(tunable, unit = "N.m.s", min = LEAST_DUMP_THRESHOLD_N_M_S, start = dump_threshold_n_m_s(&setup.spacecraft))]
    pub threshold: RealVector<3>,
    /// Where a component goes that exceeded its threshold; the others stay.
    #[parameter(start = DumpReinitTo::Target)]
    pub reinit_to: Choice<DumpReinitTo>,
    /// Fraction of the threshold, of opposite sign, after a dump: 1 is paper 000's; 0 dumps to zero.
    #[parameter(tunable, unit = "1", min = 0.0, max = 1.0, start = 0.9)]
    pub reinit_fraction: Real,
    /// Whether a dump is requested: from the sample at which a component of momentum.body is first beyond its threshold to the
    /// next one, a second later. A component asks again after it came back; longer communication steps miss requests.
    #[output]
    pub request: Boolean,
    /// Momentum in the body frame that the last request asks for; 0 before any.
    #[output(discrete, unit = "N.m.s")]
    pub target: RealVector<3>,
}
