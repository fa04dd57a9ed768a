//! Random states: options by their items, numbers by rows of ranges.

use fmi_export::Model;

use super::super::named_model::Tables;
use super::super::random::RandomNumbers;
use super::bench::Bench;
use super::variable::Base;

/// How a variable is drawn.
#[derive(Clone, Copy)]
pub(super) enum Draw {
    /// A vector in any direction, its length between two bounds.
    Vector(f64, f64),
    /// A quaternion.
    Rotation,
    Between(f64, f64),
    Whole(i32, i32),
    /// True with this share.
    Flag(f64),
}

/// A variable, with `*` for every index of a group, how it is drawn and how often; otherwise it stays at its default.
pub(super) type DrawRule = (&'static str, Draw, f64);

/// Enumerations and flags that stay as they are, by the beginning of their names.
pub(super) type Kept = &'static [&'static str];

/// Draws options and numbers.
pub(super) fn draw<M: Model>(bench: &mut Bench<M>, kept: Kept, rows: &[DrawRule]) -> Tables {
    let mut random = bench.random.clone();
    let mut values = bench.defaults();
    for at in 0..bench.variables.len() {
        let variable = &bench.variables[at];
        if !variable.exact || kept.iter().any(|beginning| variable.name.starts_with(beginning)) {
            continue;
        }
        let value = match variable.base {
            Base::Integer if !variable.items.is_empty() => {
                let k = random.whole(0, variable.items.len() as i32 - 1) as usize;
                f64::from(variable.items[k])
            }
            Base::Boolean => random.whole(0, 1),
            _ => continue,
        };
        bench.write(&mut values, at, value);
    }
    redraw(bench, &mut random, rows, &mut values);
    bench.random = random;
    values
}

/// Draws numbers.
pub(super) fn redraw<M: Model>(
    bench: &Bench<M>,
    random: &mut RandomNumbers,
    rows: &[DrawRule],
    values: &mut Tables,
) {
    for (name, variation, share) in rows {
        for name in names(name) {
            if random.next() < *share {
                put(bench, random, &name, *variation, values);
            }
        }
    }
}

fn put<M: Model>(
    bench: &Bench<M>,
    random: &mut RandomNumbers,
    name: &str,
    variation: Draw,
    values: &mut Tables,
) {
    let mut vector = |elements: &[f64]| {
        for (i, value) in elements.iter().enumerate() {
            bench.put(values, &format!("{name}[{}]", i + 1), *value);
        }
    };
    match variation {
        Draw::Vector(low, high) => {
            let length = random.between(low, high);
            vector(&random.direction().map(|x| length * x));
        }
        Draw::Rotation => {
            let (axis, half) = (random.direction(), random.between(0.0, core::f64::consts::PI));
            let [x, y, z] = axis.map(|x| x * half.sin());
            vector(&[x, y, z, half.cos()]);
        }
        Draw::Between(low, high) => bench.put(values, name, random.between(low, high)),
        Draw::Whole(low, high) => bench.put(values, name, random.whole(low, high)),
        Draw::Flag(share) => bench.put(values, name, f64::from(u8::from(random.next() < share))),
    }
}

/// No file of the tests has more of anything.
const MOST: usize = 20;

fn names(name: &str) -> Vec<String> {
    if name.contains('*') {
        (1..=MOST).map(|k| name.replace('*', &k.to_string())).collect()
    } else {
        vec![name.to_owned()]
    }
}
