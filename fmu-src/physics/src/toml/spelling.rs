//! Spelling: the known word that an unknown one was probably meant to be.

/// Words of earlier versions, with what they are called now.
const RENAMED: &[(&str, &str)] = &[("mdis", "gimbal")];

/// The candidate that the word is called now, or that takes the fewest edits, if it takes few.
pub fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let renamed = RENAMED.iter().find(|(before, _)| *before == word);
    if let Some(now) = renamed.and_then(|(_, now)| candidates.iter().find(|candidate| *candidate == now)) {
        return Some(now);
    }
    candidates
        .iter()
        .map(|candidate| (edits(word, candidate), *candidate))
        .filter(|(distance, candidate)| *distance <= 2.max(candidate.len().min(word.len()) / 2))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The hint at the word that was probably meant, to follow the unknown one; empty without one.
pub fn hint(word: &str, candidates: &[&str]) -> String {
    nearest(word, candidates).map(|meant| format!(" (did you mean `{meant}`?)")).unwrap_or_default()
}

/// Levenshtein's distance: insertions, deletions and substitutions between two words.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = core::mem::replace(&mut row[0], i + 1);
        for (j, to) in b.iter().enumerate() {
            let cost = (diagonal + usize::from(from != *to)).min(row[j] + 1).min(row[j + 1] + 1);
            diagonal = core::mem::replace(&mut row[j + 1], cost);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    //! Words have neighbours.
    use super::*;

    #[test]
    fn edit_distance_of_known_words() {
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(edits("abc", ""), 3);
        assert_eq!(edits("same", "same"), 0);
        assert_eq!(nearest("arae_m2", &["name", "area_m2", "normal"]), Some("area_m2"));
        assert_eq!(nearest("mdis", &["nadir", "gimbal"]), Some("gimbal"));
        assert_eq!(nearest("mdis", &["nadir"]), None);
        assert_eq!(nearest("zzzzzzzz", &["name", "area_m2"]), None);
    }
}
