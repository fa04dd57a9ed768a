//! Names of variables as people write them: exact, a whole vector, or with `*`.

use crate::{Error, Fmu};

/// Positions in `ModelVariables` of everything `pattern` means, in declaration order.
///
/// An exact name means itself; `torque.solar` all elements `torque.solar[1]`, `torque.solar[2]`, …; a `*` stands
/// for any text, so `torque.*` and `momentum.body[*]` work. Brackets and dots are plain text.
pub fn select(fmu: &Fmu, pattern: &str) -> Result<Vec<usize>, Error> {
    let pattern = pattern.trim();
    if let Some(index) = fmu.position(pattern) {
        return Ok(vec![index]);
    }
    let vector = format!("{pattern}[*]");
    let pattern_or_vector = if pattern.contains('*') { pattern } else { &vector };
    let found: Vec<usize> = fmu
        .description()
        .variables
        .iter()
        .enumerate()
        .filter(|(_, variable)| matches(pattern_or_vector, &variable.name))
        .map(|(index, _)| index)
        .collect();
    if found.is_empty() { Err(fmu.unknown(pattern)) } else { Ok(found) }
}

/// Whether `text` fits `pattern`, in which `*` stands for any text.
fn matches(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split('*');
    let Some(mut rest) = parts.next().and_then(|first| text.strip_prefix(first)) else { return false };
    let mut last = None;
    for part in parts {
        if let Some(previous) = last.replace(part) {
            let Some(at) = rest.find(previous) else { return false };
            rest = &rest[at + previous.len()..];
        }
    }
    match last {
        Some(last) => rest.len() >= last.len() && rest.ends_with(last),
        None => rest.is_empty(),
    }
}

/// The names closest to `name`, best first.
pub(crate) fn similar<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let wanted = name.to_lowercase();
    let mut ranked: Vec<(usize, &str)> = names
        .map(|candidate| {
            let lower = candidate.to_lowercase();
            let contained = lower.contains(&wanted) || wanted.contains(&lower);
            (if contained { 1 } else { distance(&wanted, &lower) }, candidate)
        })
        .filter(|(distance, _)| *distance <= 2 + name.len() / 5 && *distance < name.len().max(2))
        .collect();
    ranked.sort();
    ranked.into_iter().take(3).map(|(_, candidate)| candidate).collect()
}

/// Levenshtein's edit distance, in characters.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_text() {
        assert!(matches("torque.*", "torque.solar[1]"));
        assert!(matches("momentum.body[*]", "momentum.body[3]"));
        assert!(matches("*.solar[*]", "force.solar[2]"));
        assert!(matches("a*a", "aa"));
        assert!(!matches("a*a", "a"));
        assert!(!matches("torque.*[1]", "torque.solar[1][2]"));
        assert!(!matches("torque.*", "force.solar[1]"));
        assert!(!matches("momentum.body", "momentum.body[1]"));
    }

    #[test]
    fn a_slip_of_the_pen_is_recognised() {
        let names = ["spacecraft.mass", "solar.flux", "dump.count"];
        assert_eq!(similar("spacecraft.maas", names.into_iter()), ["spacecraft.mass"]);
        assert_eq!(similar("flux", names.into_iter()), ["solar.flux"]);
        assert!(similar("nothing.like.it", names.into_iter()).is_empty());
    }
}
