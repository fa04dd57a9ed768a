//! Masters with a fixed communication step: Jacobi and Gauss-Seidel, and how their first exchange begins.

use fmi::{Error, Instance, InstanceOptions, LogMessage, Status, Times, Value, record_instance};

use crate::{
    exchange::{Ports, Signals, ports},
    system::System,
};

/// In which order components step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Master {
    /// All components take the values of the step's beginning.
    #[default]
    Jacobi,
    /// One component after another, in the system's order: each takes what those before it gave at the step's end.
    GaussSeidel,
}

/// Values of connected outputs in the first step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FirstExchange {
    /// The outputs at the start, exchanged in initialization mode until they stay.
    #[default]
    Initial,
    /// Zero, as for FMPy: none is read before the first step.
    Zeros,
}

/// The most exchanges in initialization mode: a loop without a fixed point ends there.
const MAX_SWEEPS: usize = 20;

/// How a step ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stepped {
    /// At its end.
    Whole,
    /// A component ended by itself at this time, in s.
    Ended(f64),
}

/// The instances of a system's components and the values between them.
pub(crate) struct Running {
    instances: Vec<Instance>,
    ports: Vec<Ports>,
    signals: Signals,
    master: Master,
}

impl Running {
    /// Instantiates and initializes all components.
    pub(crate) fn start(
        system: &System,
        (master, first): (Master, FirstExchange),
        times: &Times,
        (options, tolerance): (&InstanceOptions, Option<f64>),
        sets: &[(usize, String, Value)],
    ) -> Result<Self, Error> {
        let (ports, signals) = ports(system);
        let mut instances = Vec::with_capacity(system.parts().len());
        for (number, part) in system.parts().iter().enumerate() {
            record_instance(number);
            instances.push(Instance::new(&part.fmu, &part.name, options)?);
        }
        let mut running = Self { instances, ports, signals, master };
        for (number, part) in system.parts().iter().enumerate() {
            let own = sets.iter().filter(|(of, ..)| *of == number).map(|(_, name, value)| (name, value));
            let given = part.parameters.iter().map(|(name, value)| (name, value));
            record_instance(number);
            let instance = &mut running.instances[number];
            let default = part.fmu.description().default_experiment;
            let tolerance = tolerance.or_else(|| default.and_then(|it| it.tolerance));
            instance.setup_experiment(tolerance, times.start_s, Some(times.stop_s))?;
            fmi::initialize(instance, given.chain(own))?;
        }
        if first == FirstExchange::Initial {
            running.exchange_until_unchanged()?;
        }
        for (number, instance) in running.instances.iter_mut().enumerate() {
            record_instance(number);
            instance.exit_initialization_mode()?;
        }
        if first != FirstExchange::Zeros {
            running.get_all()?;
        }
        Ok(running)
    }

    /// Exchanges outputs in initialization mode, component after component, until none changes.
    fn exchange_until_unchanged(&mut self) -> Result<(), Error> {
        self.get_all()?;
        for _ in 0..MAX_SWEEPS {
            let before = self.signals.bits();
            for (number, (instance, ports)) in self.instances.iter_mut().zip(&mut self.ports).enumerate() {
                record_instance(number);
                ports.set(instance, &self.signals)?;
                ports.get(instance, &mut self.signals)?;
            }
            if self.signals.bits() == before {
                break;
            }
        }
        Ok(())
    }

    fn get_all(&mut self) -> Result<(), Error> {
        get_all(&mut self.instances, &self.ports, &mut self.signals)
    }

    /// The instances, in the system's order.
    pub(crate) fn instances(&mut self) -> &mut [Instance] {
        &mut self.instances
    }

    /// One communication step of all components.
    pub(crate) fn step(&mut self, time_s: f64, step_s: f64) -> Result<Stepped, Error> {
        let Self { instances, ports, signals, .. } = self;
        match self.master {
            Master::Jacobi => {
                for (number, (instance, ports)) in instances.iter_mut().zip(ports.iter_mut()).enumerate() {
                    record_instance(number);
                    ports.set(instance, signals)?;
                }
                for (number, instance) in instances.iter_mut().enumerate() {
                    record_instance(number);
                    if let Some(ended_s) = do_step(instance, time_s, step_s)? {
                        return Ok(Stepped::Ended(ended_s));
                    }
                }
                get_all(instances, ports, signals)?;
            }
            Master::GaussSeidel => {
                for (number, (instance, ports)) in instances.iter_mut().zip(ports.iter_mut()).enumerate() {
                    record_instance(number);
                    ports.set(instance, signals)?;
                    if let Some(ended_s) = do_step(instance, time_s, step_s)? {
                        return Ok(Stepped::Ended(ended_s));
                    }
                    ports.get(instance, signals)?;
                }
            }
        }
        Ok(Stepped::Whole)
    }

    /// Terminates all components.
    pub(crate) fn terminate(&mut self) -> Result<(), Error> {
        self.instances.iter_mut().enumerate().try_for_each(|(number, instance)| {
            record_instance(number);
            instance.terminate()
        })
    }

    /// Returns the messages of the instances' logs, one component after another, each with its component's name.
    pub(crate) fn messages(&self) -> Vec<LogMessage> {
        let named = |instance: &Instance| {
            let name = instance.name().to_owned();
            instance.messages().into_iter().map(move |mut message| {
                message.text = format!("{name}: {}", message.text);
                message
            })
        };
        self.instances.iter().flat_map(named).collect()
    }
}

fn get_all(instances: &mut [Instance], ports: &[Ports], signals: &mut Signals) -> Result<(), Error> {
    instances.iter_mut().zip(ports).enumerate().try_for_each(|(number, (instance, ports))| {
        record_instance(number);
        ports.get(instance, signals)
    })
}

/// Steps an instance; the time in s at which it ended by itself, if it did.
fn do_step(instance: &mut Instance, time_s: f64, step_s: f64) -> Result<Option<f64>, Error> {
    let Err(error) = instance.do_step(time_s, step_s, true) else { return Ok(None) };
    if error.status() == Some(Status::Discard) && instance.terminated().unwrap_or(false) {
        return Ok(Some(instance.last_successful_time().unwrap_or(time_s)));
    }
    Err(error)
}
