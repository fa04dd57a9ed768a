//! Ways to simulate a model that exercise all of it: inputs that change, derivatives, requests, tunables, odd steps.

use client::{InProcess, Names};
use model_description::BaseType;

use crate::support::{RandomNumbers, names, ok, silent};

/// How a model is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scenario {
    /// MomentumPlant by its own guidance; nothing is set during the simulation.
    Guided,
    /// MomentumPlant by commanded attitudes and rates, external torques with slopes, dump requests, shifting mass.
    Commanded,
    /// MomentumPlant by its own guidance with planet light and recoil on an orbit they move, through eclipses.
    Lit,
    /// MomentumPlant by its controller, with commands that change, a wheel that fails, dump requests and torques with slopes.
    Controlled,
    /// MomentumPlant by torques of its wheels and from outside, on a disturbed orbit with planet light and recoil.
    Free,
    /// SpinPlant nutating, with its damper, through its own burn; nothing is set during the simulation.
    Burning,
    /// SpinPlant with pulses, held thrusters and torques from outside.
    Fired,
    /// DisturbanceTorque with Sun, planet, panels and mass placed anew, with slopes, in and out of eclipses.
    Placed,
    /// Guidance with scans over changing scenarios and options, on an orbit with slopes.
    Pointed,
    /// Guidance through its modes, with the monitor, the sensors and a Sun and an Earth from outside.
    Safed,
    /// Guidance through windows of science and downlink with slews.
    Orbiting,
}

impl Scenario {
    pub(crate) const ALL: [Self; 11] = [
        Self::Guided,
        Self::Commanded,
        Self::Lit,
        Self::Controlled,
        Self::Free,
        Self::Burning,
        Self::Fired,
        Self::Placed,
        Self::Pointed,
        Self::Safed,
        Self::Orbiting,
    ];

    /// The model that runs so.
    pub(crate) fn model(self) -> &'static str {
        match self {
            Self::Guided | Self::Commanded | Self::Lit | Self::Controlled | Self::Free => "MomentumPlant",
            Self::Burning | Self::Fired => "SpinPlant",
            Self::Placed => "DisturbanceTorque",
            Self::Pointed | Self::Safed | Self::Orbiting => "Guidance",
        }
    }

    /// Lengths of steps, in s: no multiples of one another.
    pub(crate) fn steps_s(self) -> [f64; 4] {
        match self {
            Self::Guided | Self::Commanded | Self::Lit => [60.0, 600.0, 97.3, 1_200.0],
            Self::Controlled | Self::Free => [0.5, 0.1, 1.3, 0.017],
            Self::Burning | Self::Fired => [0.5, 0.1, 1.3, 7.0],
            Self::Placed => [60.0, 1.0, 7.3, 0.02],
            Self::Pointed | Self::Safed => [1.0, 0.1, 7.0, 0.3],
            Self::Orbiting => [1.0, 0.1, 7.0, 60.0],
        }
    }

    /// Sets what is set before initialization.
    pub(crate) fn prepare(self, instance: &mut InProcess, names: &Names) {
        match self {
            Self::Guided | Self::Commanded => {
                ok(instance.set_real(&names.vector::<3>("dump.threshold"), &[1.0; 3]));
                let source = names.typed(BaseType::Integer, "attitude.source");
                ok(instance.set_integer(&[source], &[if self == Self::Guided { 1 } else { 2 }]));
            }
            Self::Lit => {
                let on = |name: &str| names.typed(BaseType::Boolean, name);
                ok(instance.set_boolean(&[on("planetLight.enabled"), on("thermal.enabled")], &[1, 1]));
                let choices = ["orbit.dynamics", "ephemeris.source", "orbit.frame"];
                ok(instance
                    .set_integer(&choices.map(|name| names.typed(BaseType::Integer, name)), &[2, 2, 1]));
                ok(instance.set_real(&names.vector::<3>("dump.threshold"), &[0.5; 3]));
                ok(instance.set_real(&[names.real("ephemeris.trueAnomaly")], &[1.7]));
            }
            Self::Controlled | Self::Free => {
                let source = if self == Self::Controlled { 3 } else { 4 };
                ok(instance.set_integer(&[names.typed(BaseType::Integer, "attitude.source")], &[source]));
                ok(instance.set_real(&names.vector::<4>("start.q"), &[0.0, 0.0, 0.0, 1.0]));
                ok(instance.set_real(&[names.real("wheel[1].startMomentum")], &[0.7]));
                if self == Self::Free {
                    let on = |name: &str| names.typed(BaseType::Boolean, name);
                    ok(instance.set_boolean(&[on("planetLight.enabled"), on("thermal.enabled")], &[1, 1]));
                    ok(instance.set_integer(&[names.typed(BaseType::Integer, "orbit.dynamics")], &[2]));
                }
            }
            Self::Burning | Self::Fired => {
                let reals = [names.real("start.nutation"), names.real("damper.timeConstant")];
                ok(instance.set_real(&reals, &[0.01, 2_000.0]));
                // 4 leaves the thrusters to the master.
                let plan = if self == Self::Burning { 1 } else { 4 };
                ok(instance.set_integer(&[names.typed(BaseType::Integer, "burn.plan")], &[plan]));
            }
            Self::Placed => {}
            Self::Pointed | Self::Safed | Self::Orbiting => self.prepare_guidance(instance, names),
        }
    }

    fn prepare_guidance(self, instance: &mut InProcess, names: &Names) {
        let choose = |instance: &mut InProcess, chosen: &[(&str, i32)]| {
            for (name, item) in chosen {
                ok(instance.set_integer(&[names.typed(BaseType::Integer, name)], &[*item]));
            }
        };
        let number = |instance: &mut InProcess, name: &str, value: f64| {
            ok(instance.set_real(&[names.real(name)], &[value]));
        };
        match self {
            Self::Pointed => choose(instance, &[("pointing.scenario", 2), ("aimpoint.option", 7)]),
            Self::Safed => {
                choose(instance, &[("pointing.scenario", 3), ("ephemeris.source", 3)]);
                number(instance, "monitor.persistence", 3.0);
                number(instance, "monitor.margin", 0.0);
                number(instance, "sunSearch.duration", 5.0);
                ok(instance.set_real(&names.vector::<3>("sun.position"), &[5e10, 1e10, -4e9]));
                ok(instance.set_real(&names.vector::<3>("earth.position"), &[-1e11, 3e10, 2e9]));
            }
            _ => {
                choose(instance, &[("pointing.scenario", 10), ("guided.downlinkEvery", 1)]);
                number(instance, "guided.downlinkStart", 100.0);
                number(instance, "guided.downlinkEnd", 4_000.0);
                number(instance, "guided.slewRate", 2e-3);
            }
        }
        self.place_spacecraft(instance, names, 0);
    }

    /// On a circle about the planet, the farther the higher the step's number.
    fn place_spacecraft(self, instance: &mut InProcess, names: &Names, step_number: u64) {
        let (sine, cosine) = (step_number as f64 * 2e-3).sin_cos();
        let (radius_m, speed_m_s) = (4e6, 2.3e3);
        let position = names.vector::<3>("position");
        ok(instance.set_real(&position, &[radius_m * cosine, 3e5, radius_m * sine]));
        let velocity = [-speed_m_s * sine, 40.0, speed_m_s * cosine];
        ok(instance.set_real(&names.vector::<3>("velocity"), &velocity));
        if self == Self::Pointed {
            ok(instance.set_input_derivatives(&position, &[1; 3], &velocity));
        }
    }

    fn set_guidance_inputs(
        self,
        instance: &mut InProcess,
        names: &Names,
        step_number: u64,
        random: &mut RandomNumbers,
    ) {
        self.place_spacecraft(instance, names, step_number);
        // Held for twelve steps, so that a scan or a mode lasts.
        let mut held = RandomNumbers(2_000_000 + step_number / 12);
        let mut choose = |name: &str, from: i32, to: i32| {
            let item = from + i32::try_from(held.below((to - from + 1) as usize)).unwrap();
            ok(instance.set_integer(&[names.typed(BaseType::Integer, name)], &[item]));
        };
        match self {
            Self::Pointed => {
                choose("pointing.scenario", 1, 8);
                choose("boresight.option", 1, 4);
                choose("aimpoint.option", 5, 15);
                choose("externalRoll.option", 3, 5);
                choose("scan.frame", 0, 5);
                choose("limb.reference", 0, 2);
                let boresight = names.vector::<3>("boresight.vector");
                ok(instance.set_real(&boresight, &[0.1, random.unit() - 0.5, 1.0]));
                let rate = [1e-3, -2e-3 * random.unit(), 0.0];
                ok(instance.set_real(&names.vector::<3>("scan.rate"), &rate));
                ok(instance.set_real(&names.vector::<3>("scan.speed"), &[100.0, 0.0, -50.0]));
                ok(instance.set_real(&names.vector::<3>("scan.duration"), &[5.0, 3.0, 2.0]));
                ok(instance.set_real(&names.vector::<3>("scan.pause"), &[0.5, 0.0, 1.0]));
                let reals = ["aimpoint.latitude", "aimpoint.longitude", "limb.azimuth", "limb.heightRate"];
                let values = [0.3, random.unit(), 2.0, 10.0];
                ok(instance.set_real(&reals.map(|name| names.real(name)), &values));
            }
            Self::Safed => {
                choose("mode.request", 0, 3);
                let valid = ["estimate.valid", "sun.sensedValid"];
                let flags = [0, 1].map(|_| i32::from(held.below(5) > 0));
                ok(instance.set_boolean(&valid.map(|name| names.typed(BaseType::Boolean, name)), &flags));
                let sine = held.unit().sin();
                let q = [0.1 * sine, 0.2 * sine, 0.3, (0.91 - 0.05 * sine * sine).sqrt()];
                ok(instance.set_real(&names.vector::<4>("estimate.q"), &q));
                let sensed = [random.unit() - 0.5, -1.0, 0.2];
                ok(instance.set_real(&names.vector::<3>("sun.sensed"), &sensed));
                if random.below(20) == 0 {
                    ok(instance.set_real(&[names.real("keepIn.elevation")], &[0.3 * random.unit()]));
                }
            }
            _ => {}
        }
    }

    fn set_inputs(
        self,
        instance: &mut InProcess,
        names: &Names,
        step_number: u64,
        random: &mut RandomNumbers,
    ) {
        // Held for six steps, so that a state saved in between must know of it.
        let held = i32::from(RandomNumbers(1_000_000 + step_number / 6).below(2) == 0);
        if matches!(self, Self::Commanded | Self::Controlled | Self::Free | Self::Fired) {
            let torque = names.vector::<3>("torque.applied");
            match random.below(4) {
                0 => ok(instance.set_real(&torque, &[1e-5 * (random.unit() - 0.5), 1e-6, -2e-6])),
                1 => ok(instance.set_input_derivatives(&torque, &[1; 3], &[1e-9, -2e-9, 3e-10])),
                _ => {}
            }
        }
        match self {
            Self::Guided | Self::Lit | Self::Burning => {}
            Self::Pointed | Self::Safed | Self::Orbiting => {
                self.set_guidance_inputs(instance, names, step_number, random);
            }
            Self::Free => {
                let motors = [1, 2, 3, 4].map(|k| names.real(&format!("wheel[{k}].torqueCommand")));
                ok(instance.set_real(&motors, &[0.01 * (random.unit() - 0.5), 2e-3, -1e-3, 0.0]));
                ok(instance.set_boolean(&[names.typed(BaseType::Boolean, "dump.request")], &[held]));
            }
            Self::Commanded | Self::Controlled => {
                if self == Self::Controlled {
                    let failed = names.typed(BaseType::Boolean, "wheel[2].failed");
                    ok(instance.set_boolean(&[failed], &[held]));
                }
                if random.below(3) == 0 {
                    let sine = random.unit().sin();
                    let q = [0.1 * sine, 0.2 * sine, 0.3, (0.91 - 0.05 * sine * sine).sqrt()];
                    ok(instance.set_real(&names.vector::<4>("command.q"), &q));
                    ok(instance
                        .set_real(&names.vector::<3>("command.rate"), &[1e-4 * random.unit(), -1e-5, 2e-5]));
                }
                let request = names.typed(BaseType::Boolean, "dump.request");
                ok(instance.set_boolean(&[request], &[held]));
                if random.below(40) == 0 {
                    let center = names.vector::<3>("spacecraft.centerOfMass");
                    ok(instance.set_real(&center, &[0.0, 0.01 * random.unit(), -0.02]));
                }
            }
            Self::Fired => {
                let pulse = [names.real("thruster[8].onDelay"), names.real("thruster[8].onTime")];
                let on_s = if random.below(3) == 0 { 0.032 } else { 0.0 };
                ok(instance.set_real(&pulse, &[0.02 * random.unit(), on_s]));
                let fire = names.typed(BaseType::Boolean, "thruster[1].fire");
                ok(instance.set_boolean(&[fire], &[held]));
            }
            Self::Placed => {
                let planet = names.vector::<3>("planet.positionBody");
                match random.below(4) {
                    0 => ok(instance.set_real(&planet, &behind_or_aside(random))),
                    1 => ok(instance.set_input_derivatives(&planet, &[1; 3], &[500.0, -30.0, 800.0])),
                    2 => {
                        let sun =
                            [0, 1, 2].map(|i| 1e10 * (random.unit() - 0.5) - if i == 1 { 6e10 } else { 0.0 });
                        ok(instance.set_real(&names.vector::<3>("sun.positionBody"), &sun));
                    }
                    _ => {}
                }
                if random.below(3) == 0 {
                    let angles = [names.real("panel[1].angle"), names.real("panel[2].angle")];
                    ok(instance.set_real(&angles, &[random.unit() - 0.5, 3.0 * random.unit()]));
                    ok(instance.set_real(
                        &names.vector::<3>("spacecraft.centerOfMass"),
                        &[0.01, 0.02 * random.unit(), 0.0],
                    ));
                }
            }
        }
    }
}

/// Draws the position of the planet, in m: before the Sun half of the time.
fn behind_or_aside(random: &mut RandomNumbers) -> [f64; 3] {
    let aside_m = if random.below(2) == 0 { 2e6 } else { 5e6 };
    [aside_m * random.unit(), -3e6 - 1e6 * random.unit(), aside_m * random.unit()]
}

/// An instance in simulation with the input sequence of its scenario, which depends on the step number alone.
pub(crate) struct Simulation {
    pub instance: InProcess,
    pub names: Names,
    pub scenario: Scenario,
    pub step_number: u64,
    pub time_s: f64,
}

impl Simulation {
    /// At the start.
    pub(crate) fn new(scenario: Scenario) -> Self {
        let (names, mut instance) = (names(scenario.model()), silent(scenario.model()));
        scenario.prepare(&mut instance, &names);
        ok(instance.start(0.0, None));
        Self { instance, names, scenario, step_number: 0, time_s: 0.0 }
    }

    /// Resets the instance and simulates from the start once more.
    pub(crate) fn begin_again(&mut self, steps: u64) {
        ok(self.instance.reset());
        ok(self.instance.set_debug_logging(false, &[]));
        self.scenario.prepare(&mut self.instance, &self.names);
        ok(self.instance.start(0.0, None));
        (self.step_number, self.time_s) = (0, 0.0);
        (0..steps).for_each(|_| self.step());
    }

    /// Sets what the scenario sets before this step, then makes it.
    pub(crate) fn step(&mut self) {
        let mut random = RandomNumbers(self.step_number);
        let steps_s = self.scenario.steps_s();
        let step_s = steps_s[random.below(steps_s.len())];
        self.scenario.set_inputs(&mut self.instance, &self.names, self.step_number, &mut random);
        ok(self.instance.do_step(self.time_s, step_s));
        self.time_s += step_s;
        self.step_number += 1;
    }

    /// The state's bytes.
    pub(crate) fn bytes(&mut self) -> Vec<u8> {
        let (status, bytes) = self.instance.state_bytes();
        ok(status);
        bytes
    }
}
