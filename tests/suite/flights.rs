//! Ways to fly a model that exercise all of it: inputs that change, derivatives, requests, tunables, odd steps.

use client::InProcess;

use crate::support::Base::{Boolean, Integer};
use crate::support::{Dice, Names, names, ok, silent};

/// How a model is flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Style {
    /// MomentumPlant by its own guidance; nothing is set during the flight.
    Guided,
    /// MomentumPlant by commanded attitudes and rates, external torques with slopes, dump requests, shifting mass.
    Commanded,
    /// MomentumPlant by its own guidance with planet light and recoil on an orbit they move, through eclipses.
    Lit,
    /// SpinPlant nutating, with its damper, through its own burn; nothing is set during the flight.
    Burning,
    /// SpinPlant with pulses, held thrusters and torques from outside.
    Fired,
    /// DisturbanceTorque with Sun, planet, panels and mass placed anew, with slopes, in and out of eclipses.
    Placed,
}

impl Style {
    pub const ALL: [Self; 6] =
        [Self::Guided, Self::Commanded, Self::Lit, Self::Burning, Self::Fired, Self::Placed];

    /// The model that flies so.
    pub fn model(self) -> &'static str {
        match self {
            Self::Guided | Self::Commanded | Self::Lit => "MomentumPlant",
            Self::Burning | Self::Fired => "SpinPlant",
            Self::Placed => "DisturbanceTorque",
        }
    }

    /// Lengths of steps, in s: no multiples of one another.
    fn steps_s(self) -> [f64; 4] {
        match self {
            Self::Guided | Self::Commanded | Self::Lit => [60.0, 600.0, 97.3, 1_200.0],
            Self::Burning | Self::Fired => [0.5, 0.1, 1.3, 7.0],
            Self::Placed => [60.0, 1.0, 7.3, 0.02],
        }
    }

    /// Sets what is set before initialization.
    pub fn prepare(self, instance: &mut InProcess, names: &Names) {
        match self {
            Self::Guided | Self::Commanded => {
                ok(instance.set_real(&names.vector::<3>("dump.threshold"), &[1.0; 3]));
                let source = names.of(Integer, "attitude.source");
                ok(instance.set_integer(&[source], &[if self == Self::Guided { 1 } else { 2 }]));
            }
            Self::Lit => {
                let on = |name: &str| names.of(Boolean, name);
                ok(instance.set_boolean(&[on("planetLight.enabled"), on("thermal.enabled")], &[1, 1]));
                let choices = ["orbit.dynamics", "ephemeris.source", "orbit.frame"];
                ok(instance.set_integer(&choices.map(|name| names.of(Integer, name)), &[2, 2, 1]));
                ok(instance.set_real(&names.vector::<3>("dump.threshold"), &[0.5; 3]));
                ok(instance.set_real(&[names.real("ephemeris.trueAnomaly")], &[1.7]));
            }
            Self::Burning | Self::Fired => {
                let reals = [names.real("start.nutation"), names.real("damper.timeConstant")];
                ok(instance.set_real(&reals, &[0.01, 2_000.0]));
                // 4 leaves the thrusters to the master.
                let plan = if self == Self::Burning { 1 } else { 4 };
                ok(instance.set_integer(&[names.of(Integer, "burn.plan")], &[plan]));
            }
            Self::Placed => {}
        }
    }

    fn set_inputs(self, instance: &mut InProcess, names: &Names, step_number: u64, dice: &mut Dice) {
        // Held for six steps, so that a state saved in between must know of it.
        let held = i32::from(Dice(1_000_000 + step_number / 6).below(2) == 0);
        if matches!(self, Self::Commanded | Self::Fired) {
            let torque = names.vector::<3>("torque.applied");
            match dice.below(4) {
                0 => ok(instance.set_real(&torque, &[1e-5 * (dice.unit() - 0.5), 1e-6, -2e-6])),
                1 => ok(instance.set_input_derivatives(&torque, &[1; 3], &[1e-9, -2e-9, 3e-10])),
                _ => {}
            }
        }
        match self {
            Self::Guided | Self::Lit | Self::Burning => {}
            Self::Commanded => {
                if dice.below(3) == 0 {
                    let sine = dice.unit().sin();
                    let q = [0.1 * sine, 0.2 * sine, 0.3, (0.91 - 0.05 * sine * sine).sqrt()];
                    ok(instance.set_real(&names.vector::<4>("command.q"), &q));
                    ok(instance
                        .set_real(&names.vector::<3>("command.rate"), &[1e-4 * dice.unit(), -1e-5, 2e-5]));
                }
                let request = names.of(Boolean, "dump.request");
                ok(instance.set_boolean(&[request], &[held]));
                if dice.below(40) == 0 {
                    let center = names.vector::<3>("spacecraft.centerOfMass");
                    ok(instance.set_real(&center, &[0.0, 0.01 * dice.unit(), -0.02]));
                }
            }
            Self::Fired => {
                let pulse = [names.real("thruster[8].onDelay"), names.real("thruster[8].onTime")];
                let on_s = if dice.below(3) == 0 { 0.032 } else { 0.0 };
                ok(instance.set_real(&pulse, &[0.02 * dice.unit(), on_s]));
                let fire = names.of(Boolean, "thruster[1].fire");
                ok(instance.set_boolean(&[fire], &[held]));
            }
            Self::Placed => {
                let planet = names.vector::<3>("planet.positionBody");
                match dice.below(4) {
                    0 => ok(instance.set_real(&planet, &behind_or_aside(dice))),
                    1 => ok(instance.set_input_derivatives(&planet, &[1; 3], &[500.0, -30.0, 800.0])),
                    2 => {
                        let sun =
                            [0, 1, 2].map(|i| 1e10 * (dice.unit() - 0.5) - if i == 1 { 6e10 } else { 0.0 });
                        ok(instance.set_real(&names.vector::<3>("sun.positionBody"), &sun));
                    }
                    _ => {}
                }
                if dice.below(3) == 0 {
                    let angles = [names.real("panel[1].angle"), names.real("panel[2].angle")];
                    ok(instance.set_real(&angles, &[dice.unit() - 0.5, 3.0 * dice.unit()]));
                    ok(instance.set_real(
                        &names.vector::<3>("spacecraft.centerOfMass"),
                        &[0.01, 0.02 * dice.unit(), 0.0],
                    ));
                }
            }
        }
    }
}

/// Where the planet is, in m: before the Sun half of the time.
fn behind_or_aside(dice: &mut Dice) -> [f64; 3] {
    let aside_m = if dice.below(2) == 0 { 2e6 } else { 5e6 };
    [aside_m * dice.unit(), -3e6 - 1e6 * dice.unit(), aside_m * dice.unit()]
}

/// An instance in flight with the input sequence of its style, which depends on the step number alone.
pub struct Flight {
    pub instance: InProcess,
    pub names: Names,
    pub style: Style,
    pub step_number: u64,
    pub time_s: f64,
}

impl Flight {
    /// At the start.
    pub fn new(style: Style) -> Self {
        let (names, mut instance) = (names(style.model()), silent(style.model()));
        style.prepare(&mut instance, &names);
        ok(instance.start(0.0, None));
        Self { instance, names, style, step_number: 0, time_s: 0.0 }
    }

    /// Sets what the style sets before this step, then makes it.
    pub fn step(&mut self) {
        let mut dice = Dice(self.step_number);
        let steps_s = self.style.steps_s();
        let step_s = steps_s[dice.below(steps_s.len())];
        self.style.set_inputs(&mut self.instance, &self.names, self.step_number, &mut dice);
        ok(self.instance.do_step(self.time_s, step_s));
        self.time_s += step_s;
        self.step_number += 1;
    }

    /// The state's bytes.
    pub fn bytes(&mut self) -> Vec<u8> {
        let (status, bytes) = self.instance.state_bytes();
        ok(status);
        bytes
    }
}
