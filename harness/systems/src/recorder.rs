//! Rows of a system's recording: every component read by one call a base type.

use std::borrow::Cow;

use fmi::{Error, Instance, Row, Rows};
use model_description::Causality;

use crate::{joint::ConnectedVariable, structure::Linear, system::System};

/// Recorded variables of one component and base type: references, and where their values stand in a row.
#[derive(Debug, Default)]
struct Group {
    references: Vec<u32>,
    places: Vec<usize>,
    linears: Vec<Linear>,
}

/// Reads the recorded variables of all components.
pub(crate) struct Recorder {
    /// By component, then by base type: Reals, Integers, Booleans, Strings.
    groups: Vec<[Group; 4]>,
    reals: Vec<f64>,
    integers: Vec<i32>,
    booleans: Vec<i32>,
    texts: Vec<String>,
    read_reals: Vec<f64>,
    read_integers: Vec<i32>,
}

impl Recorder {
    /// Recorder of variables of the system's description, by their positions.
    pub(crate) fn new(system: &System, positions: &[usize]) -> Self {
        let mut groups: Vec<[Group; 4]> = system.parts().iter().map(|_| Default::default()).collect();
        let mut sizes = [0; 4];
        for &position in positions {
            let variable = &system.description().variables[position];
            let base = variable.kind.base_type() as usize;
            let Some(&ConnectedVariable { at: (number, _), linear }) = system.places(position).first() else {
                continue;
            };
            let group = &mut groups[number][base];
            group.references.push(variable.value_reference);
            // Of an input of the system the value is what it was given: back from the variable's unit.
            let is_input = variable.causality != Causality::Output;
            group.linears.push(if is_input { linear.inverse() } else { linear });
            group.places.push(sizes[base]);
            sizes[base] += 1;
        }
        let [reals, integers, booleans, texts] = sizes;
        Self {
            groups,
            reals: vec![0.0; reals],
            integers: vec![0; integers],
            booleans: vec![0; booleans],
            texts: vec![String::new(); texts],
            read_reals: Vec::with_capacity(reals),
            read_integers: Vec::with_capacity(integers.max(booleans)),
        }
    }

    /// Hands one row on; a Real that is NaN is an error.
    pub(crate) fn record(
        &mut self,
        instances: &mut [Instance],
        time_s: f64,
        rows: &mut dyn Rows,
    ) -> Result<(), Error> {
        for (instance, [reals, integers, booleans, texts]) in instances.iter_mut().zip(&self.groups) {
            if !reals.references.is_empty() {
                self.read_reals.resize(reals.references.len(), 0.0);
                instance.get_reals(&reals.references, &mut self.read_reals)?;
                if let Some(at) = self.read_reals.iter().position(|value| value.is_nan()) {
                    return Err(instance.not_a_number(reals.references[at], time_s));
                }
                for (value, linear) in self.read_reals.iter_mut().zip(&reals.linears) {
                    if *linear != Linear::IDENTITY {
                        *value = linear.apply(*value);
                    }
                }
                scatter(&self.read_reals, &reals.places, &mut self.reals);
            }
            if !integers.references.is_empty() {
                self.read_integers.resize(integers.references.len(), 0);
                instance.get_integers(&integers.references, &mut self.read_integers)?;
                scatter(&self.read_integers, &integers.places, &mut self.integers);
            }
            if !booleans.references.is_empty() {
                self.read_integers.resize(booleans.references.len(), 0);
                instance.get_booleans(&booleans.references, &mut self.read_integers)?;
                scatter(&self.read_integers, &booleans.places, &mut self.booleans);
            }
            if !texts.references.is_empty() {
                let read = instance.get_strings(&texts.references)?;
                scatter(&read, &texts.places, &mut self.texts);
            }
        }
        let (reals, texts) = (Cow::from(&self.reals), Cow::from(&self.texts));
        let [integers, booleans] = [&self.integers, &self.booleans].map(Cow::from);
        rows.take(&Row { time_s, reals, integers, booleans, texts })
    }
}

fn scatter<T: Clone>(read: &[T], places: &[usize], row: &mut [T]) {
    for (value, &place) in read.iter().zip(places) {
        row[place].clone_from(value);
    }
}
