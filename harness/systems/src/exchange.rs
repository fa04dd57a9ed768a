//! Values on their way between components: one buffer of all connected outputs, one of each component's connected inputs.
//!
//! Every component is read and set by one call a base type. Buffers are made once.

use std::ops::Range;

use fmi::{Error, Instance};
use model_description::BaseType;

use crate::{joint::Joint, structure::Linear, system::System};

/// The connected outputs of all components.
#[derive(Debug, Default)]
pub(crate) struct Signals {
    reals: Vec<f64>,
    integers: Vec<i32>,
    booleans: Vec<i32>,
}

/// A connected input.
#[derive(Clone, Copy, Debug)]
struct Link {
    signal: usize,
    linear: Option<Linear>,
}

/// Variables of one base type: references, values, and where the values come from (inputs) or go (outputs).
#[derive(Debug)]
struct Inputs<T> {
    references: Vec<u32>,
    values: Vec<T>,
    links: Vec<Link>,
    is_set: bool,
}

impl<T> Default for Inputs<T> {
    fn default() -> Self {
        Self { references: Vec::new(), values: Vec::new(), links: Vec::new(), is_set: false }
    }
}

impl<T: Copy> Inputs<T> {
    fn add(&mut self, reference: u32, zero: T, link: Link) {
        self.references.push(reference);
        self.values.push(zero);
        self.links.push(link);
    }

    /// Takes the present values; whether one differs from what was set last.
    fn gather(&mut self, value: impl Fn(&Link) -> T, is_same: impl Fn(T, T) -> bool) -> bool {
        let mut changed = !self.is_set;
        for (held, link) in self.values.iter_mut().zip(&self.links) {
            let new = value(link);
            changed |= !is_same(*held, new);
            *held = new;
        }
        self.is_set = true;
        changed && !self.references.is_empty()
    }
}

#[derive(Debug, Default)]
struct Outputs {
    references: Vec<u32>,
    range: Range<usize>,
}

/// The connected variables of one component.
#[derive(Debug, Default)]
pub(crate) struct Ports {
    reals: Inputs<f64>,
    integers: Inputs<i32>,
    booleans: Inputs<i32>,
    outputs: [Outputs; 3],
}

/// The ports of every component, and the signals between them, all zero.
pub(crate) fn ports(system: &System) -> (Vec<Ports>, Signals) {
    let variable =
        |(number, position): (usize, usize)| &system.parts()[number].fmu.description().variables[position];
    let mut ports: Vec<Ports> = system.parts().iter().map(|_| Ports::default()).collect();
    let mut sizes = [0; 3];
    // Every output once, those of a component side by side.
    let mut places: Vec<((usize, usize), usize)> = Vec::new();
    for (number, ports) in ports.iter_mut().enumerate() {
        for (group_number, outputs) in ports.outputs.iter_mut().enumerate() {
            let first = sizes[group_number];
            let here = system.joints().iter().map(|joint| joint.from).filter(|from| from.0 == number);
            for from in here.filter(|from| variable(*from).kind.base_type() as usize == group_number) {
                if !places.iter().any(|(known, _)| *known == from) {
                    places.push((from, sizes[group_number]));
                    outputs.references.push(variable(from).value_reference);
                    sizes[group_number] += 1;
                }
            }
            outputs.range = first..sizes[group_number];
        }
    }
    for Joint { from, to, linear } in system.joints() {
        let Some((_, signal)) = places.iter().find(|(known, _)| known == from) else { continue };
        let link = Link { signal: *signal, linear: *linear };
        let (target, of) = (variable(*to), &mut ports[to.0]);
        match target.kind.base_type() {
            BaseType::Real => of.reals.add(target.value_reference, 0.0, link),
            BaseType::Integer => of.integers.add(target.value_reference, 0, link),
            BaseType::Boolean | BaseType::String => of.booleans.add(target.value_reference, 0, link),
        }
    }
    let [reals, integers, booleans] = sizes;
    let signals =
        Signals { reals: vec![0.0; reals], integers: vec![0; integers], booleans: vec![0; booleans] };
    (ports, signals)
}

impl Ports {
    /// Sets the connected inputs from the signals, each base type only where a value changed.
    pub(crate) fn set(&mut self, instance: &mut Instance, signals: &Signals) -> Result<(), Error> {
        let Self { reals, integers, booleans, .. } = self;
        let real = |link: &Link| {
            let value = signals.reals[link.signal];
            link.linear.map_or(value, |linear| linear.apply(value))
        };
        if reals.gather(real, |one, other| one.to_bits() == other.to_bits()) {
            instance.set_reals(&reals.references, &reals.values)?;
        }
        if integers.gather(|link| signals.integers[link.signal], |one, other| one == other) {
            instance.set_integers(&integers.references, &integers.values)?;
        }
        if booleans.gather(|link| signals.booleans[link.signal], |one, other| one == other) {
            instance.set_booleans(&booleans.references, &booleans.values)?;
        }
        Ok(())
    }

    /// Reads the connected outputs into the signals.
    pub(crate) fn get(&self, instance: &mut Instance, signals: &mut Signals) -> Result<(), Error> {
        let [reals, integers, booleans] = &self.outputs;
        if !reals.references.is_empty() {
            instance.get_reals(&reals.references, &mut signals.reals[reals.range.clone()])?;
        }
        if !integers.references.is_empty() {
            instance.get_integers(&integers.references, &mut signals.integers[integers.range.clone()])?;
        }
        if !booleans.references.is_empty() {
            instance.get_booleans(&booleans.references, &mut signals.booleans[booleans.range.clone()])?;
            // Any number but 0 is true; FMUs are given 1.
            for value in &mut signals.booleans[booleans.range.clone()] {
                *value = i32::from(*value != 0);
            }
        }
        Ok(())
    }
}

impl Signals {
    /// A copy of all values, to see whether they change.
    pub(crate) fn bits(&self) -> Vec<u64> {
        let whole = self.integers.iter().chain(&self.booleans).map(|value| *value as u32 as u64);
        self.reals.iter().map(|value| value.to_bits()).chain(whole).collect()
    }
}
