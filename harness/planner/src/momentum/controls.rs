//! Controls of a window: array offset, windmill angle, place of the Sun, alternation.

/// Number of controls of a window.
pub(crate) const CONTROLS: usize = 7;

/// Controls that a plan chooses in a window, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Offset of the arrays from the Sun, in rad.
    Offset,
    /// Windmill angle, in rad.
    Windmill,
    /// Azimuth of the Sun, in rad.
    Azimuth,
    /// Elevation of the Sun, in rad.
    Elevation,
    /// Share of the window in the alternate attitude.
    Alternate,
    /// Azimuth of the Sun in the alternate attitude, in rad, where it has its own.
    AlternateAzimuth,
    /// Elevation of the Sun in the alternate attitude, in rad, where it has its own.
    AlternateElevation,
}

/// Controls of the arrays.
pub(crate) const ARRAYS: [Control; 2] = [Control::Offset, Control::Windmill];
/// Controls of the place of the Sun.
pub(crate) const PLACE: [Control; 2] = [Control::Azimuth, Control::Elevation];
/// Controls of its place in the alternate attitude.
pub(crate) const ALTERNATE_PLACE: [Control; 2] = [Control::AlternateAzimuth, Control::AlternateElevation];

/// All controls, in their order.
pub(crate) const ALL: [Control; CONTROLS] = [
    Control::Offset,
    Control::Windmill,
    Control::Azimuth,
    Control::Elevation,
    Control::Alternate,
    Control::AlternateAzimuth,
    Control::AlternateElevation,
];

/// Settings of arrays and attitude in a window.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Controls(pub [f64; CONTROLS]);

impl Controls {
    /// One of them.
    pub fn get(&self, control: Control) -> f64 {
        self.0[control as usize]
    }

    /// Several of them.
    pub fn each<const N: usize>(&self, controls: [Control; N]) -> [f64; N] {
        controls.map(|control| self.get(control))
    }

    /// The same with another value of one.
    #[must_use]
    pub fn with(mut self, control: Control, value: f64) -> Self {
        self.0[control as usize] = value;
        self
    }

    /// The same with the Sun at this azimuth and elevation, in rad.
    #[must_use]
    pub fn with_place(self, [azimuth_rad, elevation_rad]: [f64; 2]) -> Self {
        self.with(Control::Azimuth, azimuth_rad).with(Control::Elevation, elevation_rad)
    }

    /// The same with the Sun where the alternate attitude has it.
    #[must_use]
    pub fn alternate(self) -> Self {
        self.with_place(self.each(ALTERNATE_PLACE))
    }
}
